#include "mc/description/undamped.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "mc/scene/instance_inputs.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

// True if the damping is 0 in every gearbox. Random values are never 0.
bool none(const Study& study, const std::string& key, double nominal) {
    return nominal == 0.0 && study.find_random(key) == nullptr;
}

bool no_mesh_damping(const Study& study, const dynamics::DampingParameters& nominal) {
    return dynamics::with_mesh_damping(study.effects.mesh_damping, [&](auto law) {
        std::size_t next = 0;
        return std::ranges::all_of(law.kParameters, [&](const dynamics::DampingParameter& one) {
            return none(study, "gearbox." + std::string(one.key), nominal[next++]);
        });
    });
}

std::vector<Member> supported_members(const Study& study) {
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return {Member::pinion, Member::gear};
    }
    return {Member::sun, Member::planet, Member::ring, Member::carrier};
}

}  // namespace

std::string undamped(const Study& study) {
    if (study.effects.quasi_static()) {
        return "";
    }
    const Gearbox& g = study.gearbox;
    const InstanceInputs nominal = nominal_inputs(study);
    std::vector<std::string> parts, bearings;
    if (no_mesh_damping(study, nominal.mesh_damping)) {
        parts.push_back("meshes");
    }
    for (const Member member : supported_members(study)) {
        const std::string name(member_name(member));
        if (!study.effects.torsional() && none(study, "gearbox." + name + "_bearing_damping_N_s_m",
                                               g.bodies[member].bearing_damping_N_s_m)) {
            bearings.push_back(name);
        }
    }
    if (!bearings.empty()) {
        parts.push_back(fmt::format("bearings of {}", fmt::join(bearings, " and ")));
    }
    if (g.kind == GearboxKind::planetary) {
        if (none(study, "gearbox.support_damping_N_s_m", g.support_damping_N_s_m)) {
            parts.push_back(fmt::format("support of the {}", member_name(study.operation.fixed)));
        }
    } else {
        const FixedShaft& f = study.fixed_shaft;
        if (none(study, "gearbox.motor_coupling_damping_N_m_s_rad",
                 f.motor_coupling_damping_N_m_s_rad)) {
            parts.push_back("motor coupling");
        }
        if (none(study, "gearbox.load_coupling_damping_N_m_s_rad",
                 f.load_coupling_damping_N_m_s_rad)) {
            parts.push_back("load coupling");
        }
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace gearpod::mc
