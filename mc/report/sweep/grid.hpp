// Points of a sweep: one study for each combination of the values of some keys.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "machine/fields.hpp"
#include "mc/files/input/problems.hpp"

namespace gearpod::mc {

struct VariedKey {
    std::string key;                  // "sensor.noise_m_s2"
    std::vector<std::string> values;  // as TOML text
};
GEARPOD_FIELDS(VariedKey, key, values)

// Parses texts "section.key=[a, b, c]" with any TOML values, including tables and arrays. Problems
// name `--vary`.
std::vector<VariedKey> read_varied(const std::vector<std::string>& texts, Problems& problems);

struct SweepPoint {
    std::vector<std::string> values;     // in the order of the keys
    std::vector<std::string> labels;     // of the values, for tables and sentences
    std::vector<std::string> overrides;  // "section.key=value", as for `run --set`
    std::string name;                    // file name without extension: "noise_m_s2=2_gain=1"
};

struct PointResults {
    SweepPoint point;
    std::string results;
};

// Limit of the number of points, which keeps the table readable.
inline constexpr std::size_t kMostPoints = 10000;

// Returns all combinations; the last key varies fastest. Names are distinct. A point has the same
// name in a larger grid. Returns none beyond kMostPoints.
std::vector<SweepPoint> grid_of(const std::vector<VariedKey>& keys);

// Names of points, at most five: "gain = 1; gain = 2; and 3 more".
std::string names_text(const std::vector<std::string>& points);

// Returns the key without its section.
std::string short_key(const std::string& key);
// Labels of a key's values: "uniform, high=2, low=1" for { distribution = "uniform", low = 1, high
// = 2 }. Long ones are clipped, and numbered where they would be the same.
std::vector<std::string> value_labels(const std::vector<std::string>& toml);
// "noise_m_s2 = 2, gain = 1".
std::string point_text(const std::vector<VariedKey>& keys, const SweepPoint& point);
// Columns of a table with a row for each point: the keys.
std::vector<std::string> key_columns(const std::vector<VariedKey>& keys);
// The beginning, and at how many of the other points the result is larger or smaller (`beyond`)
// than at the best one by more than scatter; `within`: names of those where it is not.
std::string within_scatter_text(const std::string& begin, const char* beyond, std::size_t count,
                                const std::vector<std::string>& within);
nlohmann::json values_json(const std::vector<VariedKey>& keys, const SweepPoint& point);
// Section with what all points have in common, and their results files.
analysis::Section files_section(const std::vector<VariedKey>& keys,
                                const std::vector<PointResults>& points);

}  // namespace gearpod::mc
