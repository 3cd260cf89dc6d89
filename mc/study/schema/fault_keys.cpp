// Keys of [fault]: those of every fault, then those of each kind.
#include <algorithm>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kToothed[] = {name("planet", Member::planet), name("sun", Member::sun),
                                   name("ring", Member::ring), name("pinion", Member::pinion),
                                   name("gear", Member::gear)};
constexpr ChoiceName kSides[] = {name("ring", FaultSide::ring), name("sun", FaultSide::sun),
                                 name("both", FaultSide::both)};

std::span<const ChoiceName> kind_names() {
    static const std::vector<ChoiceName> names = [] {
        std::vector<ChoiceName> all{{"none", 0}};
        for (const FaultKind* kind : all_faults()) {
            all.push_back({kind->name(), static_cast<int>(all.size())});
        }
        return all;
    }();
    return names;
}

std::string is_kind(const FaultKind& kind) {
    return "fault.kind is \"" + std::string(kind.name()) + "\"";
}

Presence faulty_member(const Study& s) {
    return s.fault.kind == nullptr
               ? may(s)
               : Presence{Need::required, is_kind(*s.fault.kind), {"fault.kind"}};
}

Presence of_planet(const Study& s) {
    return s.fault.kind == nullptr || s.fault.member == Member::planet
               ? may(s)
               : Presence{Need::forbidden, "only for fault.member = \"planet\"", {"fault.member"}};
}

// A planet's fault on one flank has a default; others may act in both meshes.
Presence planet_side(const Study& s) {
    return s.fault.kind != nullptr && s.fault.member == Member::planet &&
                   !s.fault.kind->on_one_flank()
               ? Presence{Need::required, is_kind(*s.fault.kind), {"fault.kind"}}
               : of_planet(s);
}

std::optional<Need> need_of(const FaultKind& kind, std::string_view name) {
    for (const FaultKey& key : kind.keys()) {
        if (key.name == name) {
            return key.need;
        }
    }
    return std::nullopt;
}

// Presence of a key that only some kinds have: as those kinds need it, else forbidden. Without a
// fault all may be given.
Presence of_kinds(const Study& s, std::string_view name) {
    if (s.fault.kind == nullptr) {
        return may(s);
    }
    if (const auto need = need_of(*s.fault.kind, name)) {
        return {*need, is_kind(*s.fault.kind), {"fault.kind"}};
    }
    std::string kinds;
    for (const FaultKind* kind : all_faults()) {
        if (need_of(*kind, name)) {
            kinds += (kinds.empty() ? "\"" : " or \"") + std::string(kind->name()) + "\"";
        }
    }
    return {Need::forbidden, "only for fault.kind = " + kinds, {"fault.kind"}};
}

// clang-format off
const Key kFaultKeys[] = {
    {"fault", "kind", listed<&Fault::kind, all_faults>(kind_names()), kNone, kAny, always, kShared, "kind of fault"},
    {"fault", "member", choice<&Fault::member>(kToothed), kNone, kAny, faulty_member, kShared, "gear with the faulty tooth"},
    {"fault", "side", choice<&Fault::side>(kSides), kNone, kAny, planet_side, kShared, "mesh in which a planet's fault acts; by default that with the ring for faults on one flank"},
    {"fault", "planet", integer<&Fault::planet>, kNone, closed_range(1, 8), of_planet, kShared, "number of the faulty planet"},
};
// clang-format on

// Lists each key once; a key that several kinds share stands with the first of them.
std::vector<Key> all_keys() {
    std::vector<Key> all(std::begin(kFaultKeys), std::end(kFaultKeys));
    for (const FaultKind* kind : all_faults()) {
        for (const FaultKey& key : kind->keys()) {
            const auto same = [&](const Key& known) { return known.name == key.name; };
            if (std::none_of(all.begin(), all.end(), same)) {
                const auto presence = [n = key.name](const Study& s) { return of_kinds(s, n); };
                all.push_back({"fault", std::string(key.name), key.access, key.unit, key.range,
                               presence, key.fixed_because, std::string(key.doc)});
            }
        }
    }
    return all;
}

}  // namespace

std::span<const Key> fault_keys() {
    static const std::vector<Key> keys = all_keys();
    return keys;
}

}  // namespace gearpod::mc
