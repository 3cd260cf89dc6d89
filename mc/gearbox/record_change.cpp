#include "mc/gearbox/record_change.hpp"

#include <algorithm>
#include <cmath>

#include "mc/gearbox/record_window.hpp"

namespace gearpod::mc {
namespace {

// Subtracts `factor` times the values of b.
void subtract(std::span<const double> b, double factor, std::vector<double>& a) {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(),
                   [&](double x, double y) { return x - factor * y; });
}

}  // namespace

LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record,
                                  std::span<const LaneSignals* const> baselines) {
    LaneSignals change;
    change.te_turn = record.te_turn;
    change.sensor = record.sensor;
    change.turns = record.turns;
    const double share = 1.0 / static_cast<double>(baselines.size());
    for (const LaneSignals* baseline : baselines) {
        subtract(baseline->te_turn, share, change.te_turn);
        subtract(baseline->sensor, share, change.sensor);
    }
    fold_again(scene, change);
    return change;
}

RealizationNoise noise_of_change(const Scene& scene, const LaneSignals& change,
                                 const RealizationNoise& record,
                                 std::span<const BaselineNoise> baselines) {
    RealizationNoise noise;
    noise.samples = record.samples;
    noise.encoder = record.encoder;
    const double share = 1.0 / static_cast<double>(baselines.size());
    for (const BaselineNoise& one : baselines) {
        subtract(one.noise->samples, share * one.rms, noise.samples);
        subtract(one.noise->encoder, share, noise.encoder);
    }
    noise.sensor = signals::noise_variates_of_samples(folded_part(scene, change, change.sensor),
                                                      folded_part(scene, change, noise.samples),
                                                      turn_samples(scene));
    return noise;
}

}  // namespace gearpod::mc
