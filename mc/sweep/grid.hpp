// Points of a sweep: one study for each combination of the values of some keys.
#pragma once

#include <string>
#include <vector>

#include "mc/input/problems.hpp"

namespace gearpod::mc {

struct VariedKey {
    std::string key;                  // "sensor.noise_m_s2"
    std::vector<std::string> values;  // as TOML text
};

// Parses texts "section.key=[a, b, c]" with any TOML values, including tables and arrays. Problems
// name `--vary`.
std::vector<VariedKey> read_varied(const std::vector<std::string>& texts, Problems& problems);

struct SweepPoint {
    std::vector<std::string> values;     // in the order of the keys
    std::vector<std::string> overrides;  // "section.key=value", as for `run --set`
    std::string name;                    // file name without extension: "noise_m_s2=2_gain=1"
};

// Limit of the number of points, which keeps the table readable.
inline constexpr std::size_t kMostPoints = 10000;

// Returns all combinations; the last key varies fastest. Names are distinct. A point has the same
// name in a larger grid. Returns none beyond kMostPoints.
std::vector<SweepPoint> grid_of(const std::vector<VariedKey>& keys);

// Returns the key without its section.
std::string short_key(const std::string& key);

}  // namespace gearpod::mc
