// The scenes that a ladder's rungs march. They share what they have alike, and there is one plan
// for each graded grid, which takes a pilot to make.
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
    const Scene& own() const { return own_; }
    // Valid until the next call. Throws SceneError.
    const Scene& of(const Rung& rung);

  private:
    const Scene& graded(const Rung& rung);

    const Scene own_;
    // The next rung on equal steps often settles otherwise and is the same for the rest.
    std::unique_ptr<const Scene> last_;
    std::map<std::string, std::unique_ptr<const Scene>> graded_;
    std::unique_ptr<const Scene> settled_;  // of a graded one
};

}  // namespace gearpod::mc
