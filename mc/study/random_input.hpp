// What [random] says: which inputs are drawn from what, and which go together.
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

// What a record may have of its own.
enum class RecordQuantity { torque, speed, gain, noise };
// That of a key; nothing of what belongs to a gearbox.
std::optional<RecordQuantity> record_quantity(std::string_view key);

// Two random inputs that go together: their rank correlation (Spearman's).
struct Correlation {
    std::string first, second;  // keys of random inputs
    double rank = 0.0;

    bool operator==(const Correlation&) const = default;
};

}  // namespace gearpod::mc
