// Search in a list by the value of a member.
#pragma once

#include <algorithm>

namespace gearpod::mc {

// First element whose member, for example &Entry::name, has the value; nullptr if there is none.
template <class List, class Value, class Member>
auto* find_in(List& list, const Value& value, Member member) {
    const auto found = std::ranges::find(list, value, member);
    return found == std::ranges::end(list) ? nullptr : &*found;
}

}  // namespace gearpod::mc
