#include "mc/lives/interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::mc {
namespace {

// Rms of signal - (share_a a + share_b b).
double rms_apart(std::span<const double> signal, std::span<const double> a, double share_a,
                 std::span<const double> b, double share_b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const double miss = signal[i] - share_a * a[i] - share_b * b[i];
        sum += miss * miss;
    }
    return std::sqrt(sum / static_cast<double>(signal.size()));
}

// Step of depth in which the crack begins to grow.
int first_measured_step(const Life& life) {
    constexpr double kRounding = 1e-9;
    const double steps = crack_begin_m(life) / *life.last_depth_m * life.depth_steps;
    return std::min(static_cast<int>(steps + kRounding), life.depth_steps - 1);
}

double middle_m(int step, const Life& life) {
    return *life.last_depth_m * (step + 0.5) / life.depth_steps;
}

}  // namespace

void InterpolationErrors::take(const InterpolationErrors& other) {
    first = std::fmax(first, other.first);
    last = std::fmax(last, other.last);
    load = std::fmax(load, other.load);
}

double first_interpolated_m(const Life& life) {
    return middle_m(first_measured_step(life), life);
}

double last_interpolated_m(const Life& life) {
    return middle_m(life.depth_steps - 1, life);
}

void LifeTiles::InterpolationCheck::between_depths(int step, const SignalsByLoad& healthy,
                                                   const SignalsByLoad& low,
                                                   const SignalsByLoad& high) {
    const Life& life = tiles_.scene_.study().life;
    const bool first = step == first_measured_step(life), last = step + 1 == life.depth_steps;
    if (errors_.empty() || !(first || last)) {
        return;
    }
    const HealthySolution::Signals middle =
        solution_.with_fault(last ? last_interpolated_m(life) : first_interpolated_m(life));
    for (std::size_t lane = 0; lane < errors_.size(); ++lane) {
        const auto& none = healthy[lane][0].sensor;
        const auto& at = middle.lane[lane].sensor;
        const auto &below = low[lane][0].sensor, &above = high[lane][0].sensor;
        if (at.empty() || none.empty() || below.empty() || above.empty()) {
            errors_[lane] = {};
            continue;
        }
        const double error =
            rms_apart(at, below, 0.5, above, 0.5) / rms_apart(at, none, 1.0, none, 0.0);
        if (first) {
            errors_[lane].first = error;
        }
        if (last) {
            errors_[lane].last = error;
        }
    }
}

void LifeTiles::InterpolationCheck::between_loads(const SignalsByLoad& healthy) {
    if (errors_.empty() || tiles_.gap_count() == 0) {
        for (InterpolationErrors& one : errors_) {
            one.load = 0.0;
        }
        return;
    }
    for (const double torque : tiles_.torques_.between()) {
        for (const double speed : tiles_.speeds_.between()) {
            at_load({torque, speed}, healthy);
        }
    }
}

void LifeTiles::InterpolationCheck::at_load(const Load& load, const SignalsByLoad& healthy) {
    const HealthySolution there = tiles_.healthy_solution(gearboxes_, load);
    const std::vector<double> load_weights = tiles_.load_weights(load);
    for (std::size_t lane = 0; lane < errors_.size(); ++lane) {
        const auto& at = there.healthy().lane[lane].sensor;
        const bool failed =
            at.empty() || std::ranges::any_of(healthy[lane], [](const LaneSignals& one) {
                return one.sensor.empty();
            });
        if (failed) {
            continue;
        }
        std::vector<double> superposed(at.size(), 0.0);
        for (std::size_t l = 0; l < load_weights.size(); ++l) {
            for (std::size_t i = 0; i < superposed.size() && load_weights[l] != 0.0; ++i) {
                superposed[i] += load_weights[l] * healthy[lane][l].sensor[i];
            }
        }
        errors_[lane].load = std::fmax(errors_[lane].load, rms_apart(at, superposed, 1.0, at, 0.0) /
                                                               rms_apart(at, at, 0.0, at, 0.0));
    }
}

}  // namespace gearpod::mc
