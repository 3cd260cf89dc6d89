// The studies of a sweep: one for each combination of the values of some keys.
#pragma once

#include <string>
#include <vector>

#include "mc/input/problems.hpp"

namespace gearpod::mc {

struct VariedKey {
    std::string key;                  // "sensor.noise_m_s2"
    std::vector<std::string> values;  // as TOML writes them
};

// Of texts "section.key=[a, b, c]"; any TOML values, which may be tables or arrays themselves.
// Problems are of `--vary`.
std::vector<VariedKey> read_varied(const std::vector<std::string>& texts, Problems& problems);

struct SweepPoint {
    std::vector<std::string> values;     // in the order of the keys
    std::vector<std::string> overrides;  // "section.key=value", as `run --set` takes them
    std::string name;                    // of a file without its ending: "noise_m_s2=2_gain=1"
};

// More is not for a table to read.
inline constexpr std::size_t kMostPoints = 10000;

// All combinations, the last key's values fastest. Names are distinct, and those of a larger grid
// are the same as far as it has the same points. Empty beyond kMostPoints.
std::vector<SweepPoint> grid_of(const std::vector<VariedKey>& keys);

// "sensor.noise_m_s2" without its section.
std::string short_key(const std::string& key);

}  // namespace gearpod::mc
