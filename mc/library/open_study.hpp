// Study that is read once, with its scene, for programs that link the library.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/numerics/study_scene.hpp"

namespace gearpod::mc {

// Thread-safe.
class OpenStudy {
  public:
    // Study file `name`, or the TOML text, which messages then call `name`; overrides are those of
    // read_study(). Without `with_lines` messages have no line numbers. Throws BadInput
    // (mc/files/input/problems.hpp) with every problem.
    explicit OpenStudy(std::string name, const std::optional<std::string>& text = std::nullopt,
                       const std::vector<std::string>& overrides = {}, bool with_lines = true);

    const Study& study() const { return *reading_.study; }
    // Made by the first call. Throws BadInput with every problem.
    const Scene& scene();
    // Text of accepted statements that should be written in another way; may be empty.
    const std::string& notices() const { return notices_; }

    // Message for an error found while the scene is built.
    std::string message(const SceneError& error) const;

  private:
    std::string name_;
    bool with_lines_;
    StudyReading reading_;
    std::string notices_;
    std::mutex making_;
    std::unique_ptr<const Scene> scene_;
};

// Simulates the gearbox in a row of the results of a study.

// The first `meshes` mesh periods of the gearbox; 0: one planet turn. Throws BadInput
// (mc/files/input/problems.hpp) if there is no such row or too many mesh periods are requested, and
// std::runtime_error if the gearbox fails.
Simulation simulate_row(const Scene& scene, long row, long meshes = 0);

}  // namespace gearpod::mc
