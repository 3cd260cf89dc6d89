// Scenes for benchmarks: Liang's gearbox as in studies/reference-10k.toml, and variants of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mc/plan/scene.hpp"

namespace gearpod::bench {

// Throws std::runtime_error with the problems of a study or scene that is refused.
std::unique_ptr<mc::Scene> study_scene(const std::string& study,
                                       const std::vector<std::string>& overrides);

// Scene of studies/reference-10k.toml with so many planets (3, 4 or 6). Uses other tooth counts
// where Liang's do not mesh with that many.
std::unique_ptr<mc::Scene> reference_scene(int planets, std::vector<std::string> overrides = {});

}  // namespace gearpod::bench
