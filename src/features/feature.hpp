// Condition indicators (features): one number for one gearbox at one noise level. A feature is a
// short source file with its definition, and one line in all_features.cpp. README.md lists all
// definitions.
#pragma once

#include <span>
#include <string_view>

namespace gearpod::features {

// Direction in which the feature changes as damage grows, and thus the alarm side of a threshold.
enum class AlarmSide { high, low };

// Signal averaged over the turns of a gear, and its parts: signals/spectra/mesh_separation.hpp.
struct TurnSignals {
    std::span<const double> turn;  // mean not removed
    std::span<const double> regular, residual, difference, envelope;
    std::span<const double> amplitude;  // [order]
};

// Statistics of the windowed and mapped signal of every tooth: signals/windowing/tooth_signals.hpp.
struct ToothSignals {
    std::span<const double> rms, kurtosis, crest, m8a;
};

// Reference values of healthy gearboxes for trending indicators: means over several records.
struct HealthyRecords {
    double residual_variance = 0.0;     // (m/s^2)^2
    double envelope_variance = 0.0;     // (m/s^2)^2, about the envelope's mean
    std::span<const double> amplitude;  // m/s^2, [order] of the averaged turn
};

// Signals of one gearbox at one noise level. Signals that no requested feature needs are empty.
struct FeatureInput {
    // Signals of the gearbox's own baseline record, and of the change since then (record minus
    // baseline, sample by sample). Null unless requested.
    const FeatureInput* baseline = nullptr;
    const FeatureInput* change = nullptr;

    std::span<const double> te_turn;       // rad, one planet turn, averaged, mean removed
    std::span<const double> te_amplitude;  // rad, [order], order 0 to the Nyquist order of te_turn
    int planet_teeth = 0;                  // Z_p, the mesh order
    int te_harmonics = 0;                  // number of mesh harmonics in te_fm0
    std::span<const double> tooth_rms;     // m/s^2, one per planet tooth, at the best first window
    double sensor_mean_square = 0.0;       // (m/s^2)^2 over the span

    TurnSignals te;                  // rad
    TurnSignals sensor;              // m/s^2, averaged over planet turns
    ToothSignals planet, sun, ring;  // of the sensor
    double filtered_rms = 0.0;       // m/s^2, of the sensor without its average over carrier turns
    HealthyRecords healthy;
};

// Signals that a feature needs in addition to folded squares and the averaged TE. A feature without
// needs is basic: studies use the basic features by default.
enum Need : unsigned {
    kTeParts = 1,         // FeatureInput::te
    kSensorTurn = 2,      // sensor
    kSunRms = 4,          // sun.rms
    kRingRms = 8,         // ring.rms
    kPlanetMoments = 16,  // planet, except rms (which is tooth_rms)
    kSunMoments = 32,     // sun, except rms
    kRingMoments = 64,    // ring, except rms
    kFiltered = 128,      // filtered_rms
    kHealthy = 256,       // healthy
    kBaseline = 512,      // baseline
    kChange = 1024,       // change
};
inline constexpr unsigned kSun = kSunRms | kSunMoments;
inline constexpr unsigned kRing = kRingRms | kRingMoments;

// Comparison with the baseline record.
// - nothing: the feature of the record.
// - change: the feature of the change since the baseline record.
// - baseline: the feature of the record divided by that of the baseline record.
enum class BaselineUse { nothing, change, baseline };

struct Feature {
    std::string_view name;
    std::string_view unit;  // "1" for a ratio
    AlarmSide alarm = AlarmSide::high;
    std::string_view doc;
    // NaN where the definition divides by zero (for example, a constant signal).
    double (*compute)(const FeatureInput& input) = nullptr;
    bool from_sensor = false;  // true if it needs the sensor signal
    unsigned needs = 0;        // of Need; compared features include those of the underlying feature
    BaselineUse baseline_use = BaselineUse::nothing;

    bool basic() const { return needs == 0; }
    // NaN as for `compute`, and if the baseline value is zero.
    double value(const FeatureInput& input) const;
};

// All features: those of a single record, then those of its change, then those relative to the
// baseline.
std::span<const Feature> all_features();

// Features of a single record only.
std::span<const Feature> record_features();

// nullptr if no feature has this name.
const Feature* find_feature(std::string_view name);

double te_rms(const FeatureInput& input);
double te_kurtosis(const FeatureInput& input);
double te_fc(const FeatureInput& input);
double te_fm0(const FeatureInput& input);
double te_fm4(const FeatureInput& input);
double te_m6a(const FeatureInput& input);
double te_m8a(const FeatureInput& input);

double sensor_rms(const FeatureInput& input);
double crest_factor(const FeatureInput& input);
double fm4(const FeatureInput& input);
double m6a(const FeatureInput& input);
double m8a(const FeatureInput& input);
double na4(const FeatureInput& input);
double nb4(const FeatureInput& input);
double energy_ratio(const FeatureInput& input);
double sideband_index(const FeatureInput& input);
double sideband_level(const FeatureInput& input);
double frms(const FeatureInput& input);
double nsds(const FeatureInput& input);

double window_ratio(const FeatureInput& input);
double window_z(const FeatureInput& input);
double window_kurtosis(const FeatureInput& input);
double window_crest(const FeatureInput& input);
double window_m8a(const FeatureInput& input);
double sun_window_ratio(const FeatureInput& input);
double sun_window_z(const FeatureInput& input);
double sun_window_kurtosis(const FeatureInput& input);
double sun_window_crest(const FeatureInput& input);
double sun_window_m8a(const FeatureInput& input);
double ring_window_ratio(const FeatureInput& input);
double ring_window_z(const FeatureInput& input);
double ring_window_kurtosis(const FeatureInput& input);
double ring_window_crest(const FeatureInput& input);
double ring_window_m8a(const FeatureInput& input);

}  // namespace gearpod::features
