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

}  // namespace

void InterpolationErrors::take(const InterpolationErrors& other) {
    first = std::fmax(first, other.first);
    last = std::fmax(last, other.last);
    load = std::fmax(load, other.load);
}

void LifeTiles::InterpolationCheck::between_depths(int step, const SignalsByLoad& healthy,
                                                   const SignalsByLoad& low,
                                                   const SignalsByLoad& high) {
    const CampaignPlan& campaign = tiles_.plan_.campaign;
    const bool first = step == campaign.first_step, last = step + 1 == campaign.depth_steps;
    if (errors_.empty() || !(first || last)) {
        return;
    }
    const HealthySolution::Signals middle = solution_.with_fault(campaign.middle_m(step));
    for (std::size_t lane = 0; lane < errors_.size(); ++lane) {
        const auto& none = healthy[lane][0].sensor;
        const auto& between = middle.lane[lane].sensor;
        const auto &below = low[lane][0].sensor, &above = high[lane][0].sensor;
        if (between.empty() || none.empty() || below.empty() || above.empty()) {
            errors_[lane] = {};
            continue;
        }
        const double error =
            rms_apart(between, below, 0.5, above, 0.5) / rms_apart(between, none, 1.0, none, 0.0);
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
        for (InterpolationErrors& errors : errors_) {
            errors.load = 0.0;
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
        const auto& integrated = there.healthy().lane[lane].sensor;
        const bool failed = integrated.empty() ||
                            std::ranges::any_of(healthy[lane], [](const LaneSignals& signals) {
                                return signals.sensor.empty();
                            });
        if (failed) {
            continue;
        }
        std::vector<double> superposed(integrated.size(), 0.0);
        for (std::size_t l = 0; l < load_weights.size(); ++l) {
            for (std::size_t i = 0; i < superposed.size() && load_weights[l] != 0.0; ++i) {
                superposed[i] += load_weights[l] * healthy[lane][l].sensor[i];
            }
        }
        errors_[lane].load = std::fmax(errors_[lane].load,
                                       rms_apart(integrated, superposed, 1.0, integrated, 0.0) /
                                           rms_apart(integrated, integrated, 0.0, integrated, 0.0));
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
            gearboxes_.push_back(tiles.draw({Group::test, i}));
        }
    }

    // Healthy signals of all pilots; empty for those that failed.
    const std::vector<Samples>& signals(const LifeTiles::Load& load) {
        const std::pair key(load.torque, load.speed);
        const auto known = signals_.find(key);
        if (known != signals_.end()) {
            return known->second;
        }
        const bool nominal = load.torque == 1.0 && load.speed == 1.0;
        std::vector<Samples> all;
        for (std::size_t first = 0; first < gearboxes_.size(); first += tiles_.lanes()) {
            const auto part =
                std::span(gearboxes_)
                    .subspan(first, std::min(tiles_.lanes(), gearboxes_.size() - first));
            const HealthySolution solution = tiles_.healthy_solution(part, load);
            const HealthySolution::Signals faulty =
                nominal ? solution.with_fault(tiles_.plan().campaign.smallest_m)
                        : HealthySolution::Signals{};
            for (std::size_t lane = 0; lane < part.size(); ++lane) {
                all.push_back(solution.healthy().lane[lane].sensor);
                if (nominal) {
                    changes_.push_back(change(all.back(), faulty.lane[lane].sensor));
                }
            }
        }
        return signals_.emplace(key, std::move(all)).first->second;
    }

    // Largest error along one axis, at the gearboxes' own value of the other.
    double error(const LoadAxis& axis, bool of_speed) {
        signals({});
        const auto load = [&](double factor) {
            return of_speed ? LifeTiles::Load{1.0, factor} : LifeTiles::Load{factor, 1.0};
        };
        double largest = std::nan("");
        for (const double check : axis.checks()) {
            const std::vector<double> weights = axis.weights(check);
            std::vector<Samples> misses = signals(load(check));
            for (std::size_t node = 0; node < weights.size(); ++node) {
                if (weights[node] != 0.0) {
                    subtract(signals(load(axis.factors()[node])), weights[node], misses);
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
    static void subtract(const std::vector<Samples>& node, double weight,
                         std::vector<Samples>& misses) {
        for (std::size_t g = 0; g < misses.size(); ++g) {
            if (node[g].empty()) {
                misses[g].clear();
            }
            for (std::size_t i = 0; i < misses[g].size(); ++i) {
                misses[g][i] -= weight * node[g][i];
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
    LoadNumber number;
    bool of_speed;
    double error = 0.0;

    LoadAxis axis() const { return {distribution, number}; }
    std::size_t count() const { return axis().factors().size(); }
    int more() const { return number.nodes ? *number.nodes + 2 : kLeastNodes; }
    void measure(Pilots& pilots) {
        error = axis().interpolates() ? pilots.error(axis(), of_speed) : 0.0;
    }
};

}  // namespace

InterpolationChoice choose_interpolation(const Scene& scene) {
    const LifeTiles tiles(scene);
    const LifePlan& plan = tiles.plan();
    InterpolationChoice best{plan};
    ChosenAxis axes[]{{plan.distributions.torque, plan.torques, false},
                      {plan.distributions.speed, plan.speeds, true}};
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
            best.plan.torques = axes[0].number;
            best.plan.speeds = axes[1].number;
        }
        // `!(>)` also ends the search if no pilot was integrated.
        ChosenAxis* next = nullptr;
        for (ChosenAxis& axis : axes) {
            const std::size_t others = axes[axis.of_speed ? 0 : 1].count();
            const bool grows = axis.distribution.varies() && !axis.number.given &&
                               axis.more() <= kMostNodes &&
                               static_cast<std::size_t>(axis.more()) * others <= kMostLoads;
            if (grows && (next == nullptr || axis.error > next->error)) {
                next = &axis;
            }
        }
        if (!(error > plan.interpolation_tolerance) || next == nullptr) {
            break;
        }
        next->number.nodes = next->more();
        next->measure(pilots);
    }
    best.loads = pilots.loads();
    return best;
}

}  // namespace gearpod::mc
