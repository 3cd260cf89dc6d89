#include "mc/library/open_study.hpp"

#include <fmt/format.h>

#include "mc/files/input/problems.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

namespace {

std::string text_of(Problems problems, bool with_lines) {
    for (Problem& problem : problems) {
        problem.line = with_lines ? problem.line : 0;
    }
    const std::string text = format(problems);
    return text.substr(0, text.empty() ? 0 : text.size() - 1);
}

}  // namespace

OpenStudy::OpenStudy(std::string name, const std::optional<std::string>& text,
                     const std::vector<std::string>& overrides, bool with_lines)
    : name_(std::move(name)),
      with_lines_(with_lines),
      reading_(text ? read_study_text(*text, name_, overrides, PythonFiles::run)
                    : read_study(name_, overrides)),
      notices_(text_of(reading_.notices, with_lines)) {
    if (!reading_.study) {
        throw BadInput(text_of(reading_.problems, with_lines));
    }
}

const Scene& OpenStudy::scene() {
    const std::scoped_lock lock(making_);
    if (!scene_) {
        StudyScene made = make_scene(name_, reading_);
        if (!made) {
            throw BadInput(text_of(made.problems, with_lines_));
        }
        scene_ = std::move(made.scene);
    }
    return *scene_;
}

std::string OpenStudy::message(const SceneError& error) const {
    return text_of({{name_, 0, error.key(), error.what(), error.remedy()}}, with_lines_);
}

Simulation simulate_row(const Scene& scene, long row, long meshes) {
    const auto rows = static_cast<long>(scene.ensemble().batches().rows());
    const long simulated = meshes > 0 ? meshes : scene.record().span.planet_teeth;
    // A record of given length begins within the span.
    const int most =
        scene.record().signal_meshes - (scene.record().length ? scene.record().span.meshes() : 0);
    std::string problems;
    if (row < 0 || row >= rows) {
        problems =
            fmt::format("--instance {}: must be a row of the results, 0 to {}", row, rows - 1);
    }
    if (simulated > most) {
        problems += fmt::format("{}--meshes {}: must be at most {}", problems.empty() ? "" : "\n",
                                simulated, most);
    }
    if (!problems.empty()) {
        throw BadInput(problems);
    }
    return simulate(scene.tile(), scene.draw().rows.id_of(row), simulated);
}

}  // namespace gearpod::mc
