#include "mc/numerics/solver_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "lockstep/integrators/facts.hpp"
#include "mc/study/keys/access.hpp"
#include "mc/study/numerics_problems.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// "precision=single": an assignment as a study file has it, but without quotation marks.
std::string option_text(const Numerics& numerics, std::string_view option) {
    Study study;
    study.numerics = numerics;
    const auto* const number = std::get_if<NumberAccess>(&find_key("numerics", option)->access);
    return number != nullptr ? fmt::format("{}={:g}", option, number->get(study).value())
                             : fmt::format("{}={}", option, choice_text(study, "numerics", option));
}

}  // namespace

bool SolverSetting::chooses(std::string_view option) const {
    return std::ranges::find(options, option) != options.end();
}

std::string_view SolverSetting::integrator() const {
    return numerics.integrator ? lockstep::name(*numerics.integrator) : kAutomatic.text;
}

std::vector<std::string> SolverSetting::overrides() const {
    std::vector<std::string> all{
        fmt::format("numerics.integrator={}", integrator()),
        fmt::format("numerics.steps_per_mesh={}", numerics.steps_per_mesh),
        fmt::format("numerics.settle_tolerance={:g}", numerics.convergence_tolerance)};
    for (const std::string_view option : options) {
        all.push_back("numerics." + option_text(numerics, option));
    }
    return all;
}

std::string SolverSetting::text() const {
    const int steps = numerics.steps_per_mesh;
    std::string text = fmt::format("{}, {}converged to {:g}", integrator(),
                                   steps > 0 ? fmt::format("{} steps, ", steps) : "",
                                   numerics.convergence_tolerance);
    for (const std::string_view option : options) {
        text += ", " + option_text(numerics, option);
    }
    return text;
}

SolverSetting own_setting(const Study& study) {
    SolverSetting setting{study.numerics};
    setting.numerics.tolerance = 0.0;
    if (study.numerics.mass_scaling_Hz > 0.0) {
        setting.options.emplace_back("mass_scaling_Hz");
    }
    return setting;
}

Study with_setting(const Study& study, const SolverSetting& setting) {
    Study changed = study;
    changed.numerics = setting.numerics;
    std::vector<std::string_view> keys{"integrator", "steps_per_mesh", "settle_tolerance"};
    keys.insert(keys.end(), setting.options.begin(), setting.options.end());
    if (const Problems problems = numerics_problems(changed, keys); !problems.empty()) {
        const Problem& first = problems.front();
        throw SceneError(first.key, first.what, first.remedy);
    }
    return changed;
}

}  // namespace gearpod::mc
