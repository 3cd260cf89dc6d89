// Error in a study that is found only when its scene is built: numbers of steps or samples, bodies
// that no model covers.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "mc/files/input/problems.hpp"

namespace gearpod::mc {

class SceneError : public std::runtime_error {
  public:
    SceneError(std::string key, const std::string& what, std::string remedy,
               ProblemKind kind = ProblemKind::other)
        : std::runtime_error(what), key_(std::move(key)), remedy_(std::move(remedy)), kind_(kind) {}
    const std::string& key() const { return key_; }
    const std::string& remedy() const { return remedy_; }
    ProblemKind kind() const { return kind_; }

  private:
    std::string key_, remedy_;
    ProblemKind kind_;
};

}  // namespace gearpod::mc
