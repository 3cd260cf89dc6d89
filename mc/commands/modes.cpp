#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "dynamics/gearbox_matrices.hpp"
#include "mc/commands/commands.hpp"
#include "mc/files/json_text.hpp"
#include "mc/run/support.hpp"
#include "mc/scene/body.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {
namespace {

// Relative difference below which frequencies are printed as one mode with a multiplicity.
constexpr double kSameMode = 1e-6;

std::vector<double> mean_pairs(const Study& study) {
    return study.gearbox.tooth_profile == ToothProfile::constant
               ? constant_pairs(study)
               : Scene(resolve_numerics(study).study).mean_pairs();
}

// Gearbox layout at rest, without inertial terms, for the natural frequencies.
dynamics::GearboxLayout layout_at_rest(const Study& study) {
    dynamics::GearboxLayout layout = gearbox_layout(study);
    if (auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&layout)) {
        planetary->inertial_terms = false;
    }
    return layout;
}

// True if the study gives every mass and inertia that the modes need.
bool has_masses(const Study& study) {
    const Gearbox& g = study.gearbox;
    const FixedShaft& f = study.fixed_shaft;
    const auto has = [&](Member member) { return g.bodies[member].mass_kg.has_value(); };
    return g.kind == GearboxKind::planetary ? has(Member::sun) && has(Member::planet) &&
                                                  has(Member::ring) && has(Member::carrier)
                                            : has(Member::pinion) && has(Member::gear) &&
                                                  f.motor_inertia_kg_m2 && f.load_inertia_kg_m2;
}

}  // namespace

int modes_command(const ModesOptions& options) {
    const bool writable = can_write({"--json", options.json}, {{"the study", options.study.path}});
    const auto study = load_study(options.study);
    if (!study || !writable) {
        return kBadInput;
    }
    if (!has_masses(*study)) {
        print_problems(
            {{options.study.path, 0, "gearbox",
              "masses or inertias are missing, but modes need them", "add them to [gearbox]"}});
        return kBadInput;
    }
    const auto inputs = body_inputs(*study, nominal_inputs(*study));
    std::vector<double> frequencies;
    try {
        frequencies = dynamics::natural_frequencies_Hz(
            dynamics::assemble(layout_at_rest(*study), inputs, mean_pairs(*study)));
    } catch (const SceneError& error) {
        print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
        return kBadInput;
    }

    if (!options.json.empty()) {
        const nlohmann::json json{{"frequencies_Hz", frequencies}};
        return write_text_to(options.json, json_text(json, 2) + "\n") ? kDone : kBadInput;
    }
    fmt::print("natural frequencies at mean mesh stiffness, {} degrees of freedom\n",
               frequencies.size());
    fmt::print("{:>12}  {}\n", "Hz", "multiplicity");
    for (std::size_t i = 0; i < frequencies.size();) {
        std::size_t end = i + 1;
        while (end < frequencies.size() &&
               std::abs(frequencies[end] - frequencies[i]) <= kSameMode * frequencies[end]) {
            ++end;
        }
        fmt::print("{:>12.1f}  {}\n", frequencies[i], end - i);
        i = end;
    }
    return kDone;
}

}  // namespace gearpod::mc
