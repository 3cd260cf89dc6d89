// Signals of one gearbox at one noise level, one type per signal. A feature is a function of some
// of them, and its parameters say which signals it needs.
#pragma once

#include <span>
#include <tuple>
#include <type_traits>

#include "gears/gear.hpp"

namespace gearpod::features {

// Transmission error averaged over planet turns.
struct TeTurn {
    std::span<const double> turn;       // rad, one planet turn, mean removed
    std::span<const double> amplitude;  // rad, [order], order 0 to the Nyquist order
    int mesh_order = 0;                 // number of planet teeth Z_p
    int harmonics = 0;                  // number of mesh harmonics in te_fm0
};

// Power of the sensor signal over the span.
struct SensorPower {
    double mean_square = 0.0;  // (m/s^2)^2
};

// RMS of the windowed sensor signal of every tooth of a gear, m/s^2, at the best first window.
template <gears::Member kGear>
struct ToothRms {
    std::span<const double> rms;
};
// Other statistics of the same signals: signals/windowing/tooth_statistics.hpp.
template <gears::Member kGear>
struct ToothMoments {
    std::span<const double> kurtosis, crest, m8a;
};

// RMS of the windowed sensor signal of every planet tooth after cepstral pre-whitening of the
// record, in arbitrary units: signals/prediction/prewhitening.hpp.
struct WhitenedToothRms {
    std::span<const double> rms;
};

// Signal averaged over planet turns, and its parts: signals/spectra/order_spectrum.hpp.
struct SeparatedTurn {
    std::span<const double> turn;  // mean not removed
    std::span<const double> regular, residual, difference;
    std::span<const double> amplitude;  // [order]
    int mesh_order = 0;                 // number of planet teeth Z_p
};
struct TeParts : SeparatedTurn {};     // of the transmission error, rad
struct SensorTurn : SeparatedTurn {};  // of the sensor signal, m/s^2

// Sensor signal without its average over carrier turns.
struct FilteredSensor {
    double rms = 0.0;  // m/s^2
};

// Sensor signal over the span, m/s^2.
struct SensorSamples {
    std::span<const double> samples;
};

// Reference value of healthy gearboxes for a trending indicator: mean over several records.
struct HealthyRecords {
    double residual_variance = 0.0;  // (m/s^2)^2
};

using AllSignals = std::tuple<TeTurn, SensorPower, ToothRms<gears::Member::planet>, TeParts,
                              SensorTurn, FilteredSensor, SensorSamples,
                              ToothMoments<gears::Member::planet>, ToothRms<gears::Member::sun>,
                              ToothMoments<gears::Member::sun>, ToothRms<gears::Member::ring>,
                              ToothMoments<gears::Member::ring>, HealthyRecords, WhitenedToothRms>;

// Signals of one record. Signals that no requested feature needs are empty.
struct FeatureInput {
    // Signals of the gearbox's own baseline records, and of the change since then (record minus the
    // baselines' mean, sample by sample). Null unless requested.
    const FeatureInput* baseline = nullptr;
    int baselines = 1;  // number of baseline records; `baseline` is the first
    const FeatureInput* change = nullptr;

    template <class Signal>
    Signal& get() {
        return std::get<Signal>(signals_);
    }
    template <class Signal>
    const Signal& get() const {
        return std::get<Signal>(signals_);
    }

  private:
    AllSignals signals_;
};

class SignalSet {
  public:
    template <class... Signals>
    static constexpr SignalSet of() {
        SignalSet set;
        set.bits_ = (0U | ... | bit<Signals>(static_cast<AllSignals*>(nullptr)));
        return set;
    }

    constexpr bool empty() const { return bits_ == 0; }
    constexpr bool within(SignalSet other) const { return (bits_ & ~other.bits_) == 0; }
    constexpr bool overlaps(SignalSet other) const { return (bits_ & other.bits_) != 0; }
    // True if the set contains at least one of these signals.
    template <class... Signals>
    constexpr bool has() const {
        return overlaps(of<Signals...>());
    }
    bool operator==(const SignalSet&) const = default;
    constexpr SignalSet& operator|=(SignalSet other) {
        bits_ |= other.bits_;
        return *this;
    }

  private:
    template <class Signal, class... All>
    static constexpr unsigned bit(std::tuple<All...>*) {
        unsigned next = 1, found = 0;
        ((found |= std::is_same_v<Signal, All> ? next : 0U, next <<= 1U), ...);
        return found;
    }

    unsigned bits_ = 0;
};

// Signals that every study computes: folded squares and the averaged transmission error.
inline constexpr SignalSet kBasicSignals =
    SignalSet::of<TeTurn, SensorPower, ToothRms<gears::Member::planet>>();

// Signals of sun and ring, which only planetary gearboxes have.
inline constexpr SignalSet kCentralGears =
    SignalSet::of<ToothRms<gears::Member::sun>, ToothMoments<gears::Member::sun>,
                  ToothRms<gears::Member::ring>, ToothMoments<gears::Member::ring>>();

}  // namespace gearpod::features
