#include "mc/numerics/solver_setting.hpp"

#include <fmt/format.h>

#include "mc/study/keys/access.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

std::vector<std::string> SolverSetting::overrides() const {
    std::vector<std::string> all{
        "numerics.integrator=" + integrator, fmt::format("numerics.steps_per_mesh={}", steps),
        fmt::format("numerics.settle_tolerance={:g}", convergence_tolerance)};
    all.insert(all.end(), other.begin(), other.end());
    return all;
}

std::string SolverSetting::text() const {
    std::string text =
        fmt::format("{}, {}converged to {:g}", integrator,
                    steps > 0 ? fmt::format("{} steps, ", steps) : "", convergence_tolerance);
    for (const std::string& key : other) {
        text += ", " + key.substr(key.find('.') + 1);
    }
    return text;
}

SolverSetting own_setting(const Study& study) {
    return {std::string(choice_text(study, "numerics", "integrator")),
            study.numerics.steps_per_mesh,
            study.numerics.convergence_tolerance,
            {}};
}

Study with_setting(const Study& study, const SolverSetting& setting) {
    Study plain = study;
    plain.numerics.tolerance = 0.0;
    StudyReading reading = read_study_text(resolved_text(plain), "study", setting.overrides());
    if (!reading.study) {
        const Problem& problem = reading.problems.front();
        throw SceneError(problem.key, problem.what, problem.remedy);
    }
    return *std::move(reading.study);
}

Scene setting_scene(const Study& study, const SolverSetting& setting) {
    return Scene(with_setting(study, setting));
}

std::vector<std::string> integrator_names() {
    std::vector<std::string> names;
    for (const ChoiceName& choice :
         std::get<ChoiceAccess>(find_key("numerics", "integrator")->access).names) {
        if (choice.value != kAutomatic.value) {
            names.emplace_back(choice.text);
        }
    }
    return names;
}

}  // namespace gearpod::mc
