#include "mc/lives/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace gearpod::mc {
namespace {

using Samples = std::vector<double>;

double rms(std::span<const double> values) {
    const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
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
            for (LaneId lane{0}; lane < part.size(); ++lane) {
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

InterpolationChoice choose_interpolation(const TilePlan& tile, const LifePlan& plan) {
    const LifeTiles tiles(tile, plan);
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
