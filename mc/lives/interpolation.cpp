#include "mc/lives/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

namespace {

using Samples = std::vector<double>;

double rms(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value * value;
    }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

// Integrates the pilots, each load once.
class Pilots {
  public:
    explicit Pilots(const LifeTiles& tiles) : tiles_(tiles) {
        for (std::uint64_t i = 0; i < kInterpolationPilots; ++i) {
            gearboxes_.push_back(tiles.draw({Group::graded, i}));
        }
    }

    // Healthy signals of all pilots; empty for those that failed.
    const std::vector<Samples>& at(const LifeTiles::Load& load) {
        const std::pair key(load.torque, load.speed);
        const auto known = signals_.find(key);
        if (known != signals_.end()) {
            return known->second;
        }
        const bool own = load.torque == 1.0 && load.speed == 1.0;
        std::vector<Samples> all;
        for (std::size_t first = 0; first < gearboxes_.size(); first += tiles_.lanes()) {
            const auto part =
                std::span(gearboxes_)
                    .subspan(first, std::min(tiles_.lanes(), gearboxes_.size() - first));
            const HealthySolution solution = tiles_.healthy_solution(part, load);
            const HealthySolution::Signals faulty =
                own ? solution.with_fault(smallest_depth_m(tiles_.scene().study().life))
                    : HealthySolution::Signals{};
            for (std::size_t lane = 0; lane < part.size(); ++lane) {
                all.push_back(solution.healthy().lane[lane].sensor);
                if (own) {
                    changes_.push_back(change(all.back(), faulty.lane[lane].sensor));
                }
            }
        }
        return signals_.emplace(key, std::move(all)).first->second;
    }

    // Largest error along one axis, at the gearboxes' own value of the other.
    double error(const LoadAxis& axis, bool of_speed) {
        at({});
        const auto load = [&](double factor) {
            return of_speed ? LifeTiles::Load{1.0, factor} : LifeTiles::Load{factor, 1.0};
        };
        double largest = std::nan("");
        for (const double check : axis.checks()) {
            const std::vector<double> weights = axis.weights(check);
            std::vector<Samples> misses = at(load(check));
            for (std::size_t node = 0; node < weights.size(); ++node) {
                if (weights[node] != 0.0) {
                    subtract(at(load(axis.factors()[node])), weights[node], misses);
                }
            }
            for (std::size_t g = 0; g < misses.size(); ++g) {
                if (!misses[g].empty()) {
                    largest = std::fmax(largest, rms(misses[g]) / changes_[g]);
                }
            }
        }
        return largest;
    }

    int loads() const { return static_cast<int>(signals_.size()); }

  private:
    static double change(const Samples& healthy, const Samples& faulty) {
        if (healthy.empty() || faulty.empty()) {
            return std::nan("");
        }
        Samples both(healthy.size());
        for (std::size_t i = 0; i < both.size(); ++i) {
            both[i] = faulty[i] - healthy[i];
        }
        return rms(both);
    }

    // A pilot that failed at one load has no error.
    static void subtract(const std::vector<Samples>& signals, double weight,
                         std::vector<Samples>& misses) {
        for (std::size_t g = 0; g < misses.size(); ++g) {
            if (signals[g].empty()) {
                misses[g].clear();
            }
            for (std::size_t i = 0; i < misses[g].size(); ++i) {
                misses[g][i] -= weight * signals[g][i];
            }
        }
    }

    const LifeTiles& tiles_;
    std::vector<Realization> gearboxes_;
    std::map<std::pair<double, double>, std::vector<Samples>> signals_;
    std::vector<double> changes_;  // rms of the change made by the smallest crack of interest
};

// Torques or speeds while their number is chosen.
struct ChosenAxis {
    const RecordDistribution& distribution;
    int evenly_spaced;
    std::optional<int> nodes;
    bool given;
    bool of_speed;
    double error = 0.0;

    LoadAxis axis() const { return {distribution, evenly_spaced, nodes}; }
    std::size_t count() const { return axis().factors().size(); }
    int more() const { return nodes ? *nodes + 2 : kLeastNodes; }
    void measure(Pilots& pilots) {
        error = axis().interpolates() ? pilots.error(axis(), of_speed) : 0.0;
    }
};

}  // namespace

InterpolationChoice choose_interpolation(const Scene& scene) {
    const Life& life = scene.study().life;
    const RecordDistributions distributions(scene.study());
    const LifeTiles tiles(scene);
    InterpolationChoice best{life};
    ChosenAxis axes[]{{distributions.torque, integrated_torques(life), life.polynomial_torques,
                       gives_torques(life), false},
                      {distributions.speed, integrated_speeds(life), life.polynomial_speeds,
                       gives_speeds(life), true}};
    if (!axes[0].axis().interpolates() && !axes[1].axis().interpolates()) {
        best.error = 0.0;
        return best;
    }
    Pilots pilots(tiles);
    for (ChosenAxis& axis : axes) {
        axis.measure(pilots);
    }
    for (;;) {
        const double error = axes[0].error + axes[1].error;
        if (std::isnan(best.error) || error < best.error) {
            best.error = error;
            best.life.polynomial_torques = axes[0].nodes;
            best.life.polynomial_speeds = axes[1].nodes;
        }
        // `!(>)` also ends the search if no pilot was integrated.
        ChosenAxis* next = nullptr;
        for (ChosenAxis& axis : axes) {
            const std::size_t others = axes[axis.of_speed ? 0 : 1].count();
            const bool grows = axis.distribution.varies() && !axis.given &&
                               axis.more() <= kMostNodes &&
                               static_cast<std::size_t>(axis.more()) * others <= kMostLoads;
            if (grows && (next == nullptr || axis.error > next->error)) {
                next = &axis;
            }
        }
        if (!(error > life.interpolation_tolerance) || next == nullptr) {
            break;
        }
        next->nodes = next->more();
        next->measure(pilots);
    }
    best.loads = pilots.loads();
    return best;
}

}  // namespace gearpod::mc
