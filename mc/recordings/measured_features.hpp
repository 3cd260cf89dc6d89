// Features of measured signals: the requirements and the value of each feature.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/recordings/measured_signal.hpp"

namespace gearpod::mc {

struct MeasuredFeature {
    const features::Feature* feature;
    double value;
    std::string missing;  // reason if there is no value, else empty
};

// Tooth of a gear with the largest RMS.
struct WorstTooth {
    std::string gear;  // "planet"
    int tooth = 0;     // from 1; tooth 1 has the recording's first window
    int teeth = 0;
    double ratio = 0.0;  // RMS of this tooth divided by the median
};

// Empty if `source` is empty. Throws SignalError.
std::optional<MeasuredBaseline> measured_baseline(const SignalSource& source,
                                                  const SignalColumns& columns,
                                                  const MeasurementPlan& plan);

// Features that can be measured: those of the program, then those in Python that the study names.
// Only those of one record unless there is a baseline.
std::vector<const features::Feature*> measurable(const FeaturePlan& plan, bool with_baseline);

// RMS of every tooth of the planet, from the tooth that passes `first` mesh periods after the
// start. A record with a change has those of the change, and its start is the baseline's.
struct ToothMap {
    std::vector<double> rms;  // m/s^2; empty without a sensor signal
    double first = 0.0;       // in [0, 1)

    // Position of the tooth with the largest RMS, in mesh periods from the start; NaN if empty.
    double worst() const;
};

// Features in the order of measurable(), and the loudest tooth of every gear that features use.
// With a baseline, the teeth are those of the change. `healthy` may be empty and `baseline` null.
struct Measurement {
    std::vector<MeasuredFeature> features;
    std::vector<WorstTooth> teeth;
    ToothMap map;
    std::optional<MeasuredChange> change;
};
Measurement measure(const MeasurementPlan& plan, const MeasuredSignal& signal,
                    const HealthyReference& healthy, const MeasuredBaseline* baseline = nullptr);

// Values of `requested` features that need no healthy reference, in this order. NaN where the
// signal is insufficient.
std::vector<double> measured_values(const MeasurementPlan& plan, const MeasuredSignal& signal,
                                    std::span<const features::Feature* const> requested);

// Mean over recordings of healthy gearboxes. Adds the notes on them to `notes`. Throws SignalError,
// also for a recording of fewer than `turns` planet turns.
HealthyReference measured_reference(const std::vector<SignalSource>& recordings,
                                    const SignalColumns& columns, const MeasurementPlan& plan,
                                    int turns, std::vector<std::string>& notes);

// Adds the notes on a recording with its name.
void add_notes(const MeasuredSignal& signal, const std::string& name,
               std::vector<std::string>& notes);

}  // namespace gearpod::mc
