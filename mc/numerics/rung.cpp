#include "mc/numerics/rung.hpp"

#include <fmt/format.h>

#include "mc/study/keys/access.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

std::vector<std::string> Rung::overrides() const {
    std::vector<std::string> all{"numerics.integrator=" + integrator,
                                 fmt::format("numerics.steps_per_mesh={}", steps),
                                 fmt::format("numerics.settle_tolerance={:g}", settle_tolerance)};
    all.insert(all.end(), other.begin(), other.end());
    return all;
}

std::string Rung::text() const {
    std::string text =
        fmt::format("{}, {}converged to {:g}", integrator,
                    steps > 0 ? fmt::format("{} steps, ", steps) : "", settle_tolerance);
    for (const std::string& key : other) {
        text += ", " + key.substr(key.find('.') + 1);
    }
    return text;
}

Rung own_rung(const Study& study) {
    return {std::string(choice_text(study, "numerics", "integrator")),
            study.numerics.steps_per_mesh,
            study.numerics.settle_tolerance,
            {}};
}

Study with_rung(const Study& study, const Rung& rung) {
    Study plain = study;
    plain.numerics.tolerance = 0.0;
    StudyReading reading = read_study_text(resolved_text(plain), "study", rung.overrides());
    if (!reading.study) {
        const Problem& problem = reading.problems.front();
        throw SceneError(problem.key, problem.what, problem.remedy);
    }
    return *std::move(reading.study);
}

Scene rung_scene(const Study& study, const Rung& rung) {
    return Scene(with_rung(study, rung));
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
