// The scenes that a ladder's rungs march: one that takes on the numerics of each, and one for every
// graded grid, which takes a pilot to make.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

class RungScenes {
  public:
    // `study` without a tolerance. Throws SceneError.
    explicit RungScenes(const Study& study);
    // As the study says.
    Scene& own() { return *scene_; }
    // Valid until the next call. Throws SceneError.
    const Scene& of(const Rung& rung);

  private:
    const Study study_;
    std::unique_ptr<Scene> scene_;
    std::map<std::string, std::unique_ptr<Scene>> graded_;
};

}  // namespace gearpod::mc
