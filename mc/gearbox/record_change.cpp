#include "mc/gearbox/record_change.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

std::vector<double> less(std::span<const double> a, std::span<const double> b) {
    std::vector<double> difference(a.size());
    std::transform(a.begin(), a.end(), b.begin(), difference.begin(), std::minus<>());
    return difference;
}

// The part of a signal that is folded: the span. The signal may continue after it.
std::span<const double> folding(const Scene& scene, std::span<const double> samples) {
    return samples.first(static_cast<std::size_t>(scene.span_meshes()) *
                         static_cast<std::size_t>(scene.samples_per_mesh()));
}

std::size_t turn_samples(const Scene& scene) {
    return static_cast<std::size_t>(scene.span().planet_teeth) *
           static_cast<std::size_t>(scene.samples_per_mesh());
}

}  // namespace

LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record) {
    LaneSignals change;
    change.te_turn = less(record.te_turn, record.baseline->te_turn);
    change.sensor = less(record.sensor, record.baseline->sensor);
    change.folded = signals::fold_of_squares(folding(scene, change.sensor), turn_samples(scene));
    return change;
}

RealizationNoise noise_of_change(const Scene& scene, const LaneSignals& change,
                                 const RealizationNoise& record, const RealizationNoise& baseline,
                                 double baseline_rms) {
    RealizationNoise noise;
    noise.samples.resize(record.samples.size());
    std::transform(record.samples.begin(), record.samples.end(), baseline.samples.begin(),
                   noise.samples.begin(), [&](double a, double b) { return a - baseline_rms * b; });
    noise.encoder = less(record.encoder, baseline.encoder);
    noise.sensor = signals::noise_variates_of_samples(
        folding(scene, change.sensor), folding(scene, noise.samples), turn_samples(scene));
    return noise;
}

}  // namespace gearpod::mc
