// LifeTiles::interpolation_errors().
#include <algorithm>
#include <cmath>

#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {
namespace {

// Rms of signal - (a share_a + b share_b).
double rms_apart(std::span<const double> signal, std::span<const double> a, double share_a,
                 std::span<const double> b, double share_b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const double miss = signal[i] - share_a * a[i] - share_b * b[i];
        sum += miss * miss;
    }
    return std::sqrt(sum / static_cast<double>(signal.size()));
}

}  // namespace

void InterpolationErrors::take(const InterpolationErrors& other) {
    first = std::fmax(first, other.first);
    last = std::fmax(last, other.last);
    load = std::fmax(load, other.load);
}

double first_interpolated_m(const Life& life) {
    return 0.5 * *life.last_depth_m / life.depth_steps;
}

double last_interpolated_m(const Life& life) {
    return *life.last_depth_m - first_interpolated_m(life);
}

std::vector<InterpolationErrors> LifeTiles::interpolation_errors(
    std::span<const GearboxId> ids) const {
    const Life& life = scene_.study().life;
    const std::vector<Load> marched = loads();
    std::vector<HealthyMarch::Signals> at_depth, at_load;
    const HealthyMarch low = march(ids, marched[0]);
    for (const double depth_m : {depth(1), depth(life.depth_steps - 1), depth(life.depth_steps),
                                 first_interpolated_m(life), last_interpolated_m(life)}) {
        at_depth.push_back(low.with_fault(depth_m));
    }
    if (marched.size() > 1) {
        at_load.push_back(march(ids, {}).healthy());
        for (const Load& load : marched) {
            at_load.push_back(march(ids, load).healthy());
        }
    }
    const auto &first = at_depth[0], &before = at_depth[1], &behind = at_depth[2],
               &in_first = at_depth[3], &in_last = at_depth[4];
    const std::vector<double> share = shares({});
    std::vector<InterpolationErrors> all(ids.size());
    for (std::size_t lane = 0; lane < ids.size(); ++lane) {
        const auto failed = [&](const HealthyMarch::Signals& one) {
            return one.status[lane] != Status::ok;
        };
        if (std::ranges::any_of(at_depth, failed) || std::ranges::any_of(at_load, failed)) {
            continue;
        }
        const auto& none = low.healthy().lane[lane].sensor;
        const auto of = [&](const HealthyMarch::Signals& one) -> const std::vector<double>& {
            return one.lane[lane].sensor;
        };
        InterpolationErrors& errors = all[lane];
        errors.first = rms_apart(of(in_first), none, 0.5, of(first), 0.5) /
                       rms_apart(of(in_first), none, 1.0, none, 0.0);
        errors.last = rms_apart(of(in_last), of(before), 0.5, of(behind), 0.5) /
                      rms_apart(of(in_last), none, 1.0, none, 0.0);
        errors.load = 0.0;
        if (!at_load.empty()) {
            std::vector<double> composed(none.size(), 0.0);
            for (std::size_t l = 0; l < share.size(); ++l) {
                for (std::size_t i = 0; i < composed.size(); ++i) {
                    composed[i] += share[l] * of(at_load[l + 1])[i];
                }
            }
            errors.load = rms_apart(of(at_load[0]), composed, 1.0, none, 0.0) /
                          rms_apart(of(at_load[0]), none, 0.0, none, 0.0);
        }
    }
    return all;
}

}  // namespace gearpod::mc
