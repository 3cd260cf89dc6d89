// Members of a gearbox, and arrays indexed by an enumeration.
#pragma once

#include <array>
#include <cstddef>

#include "gears/gear.hpp"

namespace gearpod::mc {

using gears::Member;
inline constexpr std::array kAllMembers{Member::sun,     Member::planet, Member::ring,
                                        Member::carrier, Member::pinion, Member::gear};

// Array indexed by an enumeration with `kCount` enumerators.
template <class Enum, std::size_t kCount, class Value>
struct EnumArray {
    std::array<Value, kCount> values{};

    Value& operator[](Enum which) { return values.at(static_cast<std::size_t>(which)); }
    const Value& operator[](Enum which) const { return values.at(static_cast<std::size_t>(which)); }
    bool operator==(const EnumArray&) const = default;
};
template <class Value>
using MemberArray = EnumArray<Member, kAllMembers.size(), Value>;

}  // namespace gearpod::mc
