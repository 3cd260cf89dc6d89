// A study's features of measured signals: what each needs, and what it gives.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/measured_change.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

struct MeasuredFeature {
    const features::Feature* feature;
    double value;
    std::string missing;  // why it has none, else empty
};

// The loudest tooth of a gear.
struct WorstTooth {
    std::string gear;  // "planet"
    int tooth = 0;     // from 1, the one whose window is the recording's first
    int teeth = 0;
    double ratio = 0.0;  // of its RMS to the median
};

// Whole planet turns of sensor signal that a recording has for the planets' teeth, at most the
// span's. Fewer than the span's meet fewer ring teeth, and average less.
int planet_turns(const MeasuredSignal& signal, const Scene& scene);

// Mesh periods of its signal that a feature looks at, at least.
int meshes_of(const features::Feature& feature, const Scene& scene);

// An earlier recording of the gearbox while it was healthy.
struct MeasuredBaseline {
    std::string file;
    MeasuredSignal signal;
};

// None if `path` is "". Throws SignalError.
std::optional<MeasuredBaseline> measured_baseline(const std::string& path,
                                                  const SignalColumns& columns, const Scene& scene);

// What is measured: all features with a baseline, those of one record without.
std::span<const features::Feature> measurable(const MeasuredBaseline* baseline);

// measurable() features, in their order; of every gear that features look at, its loudest tooth, of
// what has changed if there is a baseline. `healthy` may be empty, `baseline` null.
struct Measurement {
    std::vector<MeasuredFeature> features;
    std::vector<WorstTooth> teeth;
    std::optional<MeasuredChange> change;
};
Measurement measure(const Scene& scene, const MeasuredSignal& signal,
                    const HealthyReference& healthy, const MeasuredBaseline* baseline = nullptr);

// Of some features alone that need no healthy gearboxes, in their order; NaN for what the signal
// does not give.
std::vector<double> measured_values(const Scene& scene, const MeasuredSignal& signal,
                                    std::span<const features::Feature* const> wanted);

// Of recordings of healthy gearboxes, each as long as `turns` planet turns at least. Throws
// SignalError.
HealthyReference measured_reference(const std::vector<std::string>& paths,
                                    const SignalColumns& columns, const Scene& scene, int turns);

// The simulated one at a noise level; empty if the study lacks it.
HealthyReference simulated_reference_at(double noise_level, const Scene& scene);

}  // namespace gearpod::mc
