// Condition indicators: one number for one gearbox at one noise level. A feature is one short file
// with its definition, and one line in all_features.cpp.
#pragma once

#include <span>
#include <string_view>

namespace gearpod::features {

// Which way the feature moves as damage grows, hence which side of a threshold raises the alarm.
enum class AlarmSide { high, low };

// The signals of one gearbox at one noise level.
struct FeatureInput {
    std::span<const double> te_turn;       // rad, one planet turn, averaged, mean removed
    std::span<const double> te_amplitude;  // rad, [order], order 0 to the Nyquist order of te_turn
    int planet_teeth = 0;                  // Z_p, the mesh order
    int te_harmonics = 0;                  // mesh harmonics that te_fm0 counts
    std::span<const double> tooth_rms;     // m/s^2, one per planet tooth, at the best first window
    double sensor_mean_square = 0.0;       // (m/s^2)^2 over the span
};

struct Feature {
    std::string_view name;
    std::string_view unit;  // "1" for a ratio
    AlarmSide alarm = AlarmSide::high;
    std::string_view doc;
    // NaN where the definition divides by zero (a signal that is exactly constant, say).
    double (*compute)(const FeatureInput& input) = nullptr;
    bool from_sensor = false;  // whether it needs the sensor's signal
};

std::span<const Feature> all_features();

// nullptr if there is none of this name.
const Feature* find_feature(std::string_view name);

double te_rms(const FeatureInput& input);
double te_kurtosis(const FeatureInput& input);
double te_fc(const FeatureInput& input);
double te_fm0(const FeatureInput& input);
double sensor_rms(const FeatureInput& input);
double window_ratio(const FeatureInput& input);
double window_z(const FeatureInput& input);

}  // namespace gearpod::features
