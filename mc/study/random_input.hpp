// Random inputs of the section [random]: their distributions and correlations.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mc/study/distributions/distribution.hpp"

namespace gearpod::mc {

struct RandomInput {
    std::string key;            // "gearbox.planet_bearing_stiffness_N_m"
    std::string unit;           // of the key and of the distribution, e.g. "N/m"
    Distribution distribution;  // in that unit
    double to_si = 1.0;         // SI value = drawn value * to_si

    bool operator==(const RandomInput&) const = default;
};

// Quantities that may vary from record to record.
enum class RecordQuantity { torque, speed, gain, noise };
// Record quantity that a key gives; empty for keys whose values belong to the gearbox.
std::optional<RecordQuantity> record_quantity(std::string_view key);

// Rank correlation (Spearman's) of two random inputs.
struct Correlation {
    std::string first, second;  // keys of random inputs
    double rank = 0.0;

    bool operator==(const Correlation&) const = default;
};

}  // namespace gearpod::mc
