// Keys of the mesh-damping laws, from their own parameters.
#include <string>
#include <utility>
#include <vector>

#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "mc/study/schema/table.hpp"

namespace gearpod::mc {
namespace {

template <MeshDamping kLaw, std::size_t kParameter>
Key damping_key(const dynamics::DampingParameter& parameter, std::string_view law) {
    const auto presence = [why = "belongs to effects.mesh_damping = \"" + std::string(law) +
                                 "\""](const Study& s) -> Presence {
        if (s.effects.quasi_static()) {
            return {Need::optional, "", {}};
        }
        return {s.effects.mesh_damping == kLaw ? Need::required : Need::forbidden,
                why,
                {"effects.mesh_damping", "effects.motion"}};
    };
    return {"gearbox",
            parameter.key,
            number<kLaw, kParameter>,
            {parameter.suffix, parameter.unit, parameter.suffix, parameter.unit, 1.0},
            kNotNegative,
            presence,
            kRandom,
            parameter.doc};
}

template <class Law, MeshDamping kLaw>
void add_keys(std::string_view law, std::vector<Key>& keys) {
    constexpr std::size_t kParameters = std::size(Law::kParameters);
    static_assert(kParameters <= dynamics::kMostDampingParameters);
    [&]<std::size_t... kAll>(std::index_sequence<kAll...>) {
        (keys.push_back(damping_key<kLaw, kAll>(Law::kParameters[kAll], law)), ...);
    }
    (std::make_index_sequence<kParameters>());
}

}  // namespace

std::span<const Key> mesh_damping_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
#define GEARPOD_MESH_DAMPING(NAME, LAW) add_keys<dynamics::LAW, MeshDamping::NAME>(#NAME, all);
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
        return all;
    }();
    return keys;
}

}  // namespace gearpod::mc
