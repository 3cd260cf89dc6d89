// Makes the scene of a study that has been read.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

struct StudyScene {
    std::unique_ptr<const Scene> scene;    // null: see `problems`
    std::optional<NumericsChoice> choice;  // of the numerics; empty without a tolerance
    Problems problems;
    Problems notices = {};           // StudyReading::notices
    std::optional<Planner> planner;  // of the study with the chosen numerics

    explicit operator bool() const { return scene != nullptr; }
};

// Sets the kernels' instruction set, chooses the numerics and makes the scene. Messages about
// problems use `name` for the study.
StudyScene make_scene(const std::string& name, StudyReading reading);

}  // namespace gearpod::mc
