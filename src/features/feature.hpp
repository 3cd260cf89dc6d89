// Condition indicators (features): one number for one gearbox at one noise level. A feature is a
// short header with its definition, and one line in all_features.cpp. README.md lists all
// definitions.
#pragma once

#include <span>
#include <string_view>

#include "features/signals.hpp"

namespace gearpod::features {

// Direction in which the feature changes as damage grows, and thus the alarm side of a threshold.
enum class AlarmSide { high, low };

// Comparison with the baseline record.
// - nothing: the feature of the record.
// - change: the feature of the change since the baseline record.
// - baseline: the feature of the record divided by that of the baseline record, or by the mean over
//   several.
// - record_and_change: the feature of both signals together.
enum class BaselineUse { nothing, change, baseline, record_and_change };

struct Feature {
    std::string_view name;
    // Name in plain language, for headlines: a noun phrase that follows "the".
    std::string_view title;
    std::string_view unit;  // "1" for a ratio
    AlarmSide alarm = AlarmSide::high;
    std::string_view doc;
    // NaN where the definition divides by zero (for example, a constant signal).
    double (*compute)(const FeatureInput& input) = nullptr;
    SignalSet needs;           // signals that `compute` uses
    bool from_sensor = false;  // true if one of them is of the sensor
    BaselineUse baseline_use = BaselineUse::nothing;
    bool external = false;  // true if code outside of the program computes it; no `compute`

    bool operator==(const Feature&) const = default;
    // Studies use the basic features by default: those of a single record that need basic signals
    // only.
    bool basic() const {
        return baseline_use == BaselineUse::nothing && needs.within(kBasicSignals);
    }
    // NaN as for `compute`, and if the baseline value is zero.
    double value(const FeatureInput& input) const;
};

// All features: those of a single record, then those of its change (and of both), then those
// relative to the baseline.
std::span<const Feature> all_features();

// Features of a single record only.
std::span<const Feature> record_features();

// Copy of an external feature with a permanent address. Equal features have the same address.
// Thread-safe.
const Feature& declare_feature(const Feature& feature);

// Feature of all_features(), or else the external feature declared last with this name. nullptr if
// there is none.
const Feature* find_feature(std::string_view name);

}  // namespace gearpod::features
