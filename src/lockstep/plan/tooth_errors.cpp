#include "lockstep/plan/tooth_errors.hpp"

#include <cmath>
#include <span>

#include "lockstep/plan/tooth_pairs.hpp"

namespace gearpod::lockstep {
namespace {

int tooth_of(int mesh_period, int first, int teeth) {
    const int tooth = (mesh_period - first) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
}

// Gap of a tooth pair in one lane, m, and its growth along the engagement.
struct ToothPairGap {
    double gap = 0.0, growth = 0.0;
};

ToothPairGap tooth_pair_gap(const ToothErrors& errors, int pair, int k, std::size_t lane,
                            std::size_t width) {
    const PairTeeth& teeth = errors.pairs[static_cast<std::size_t>(pair)];
    ToothPairGap sum;
    for (const int side : {0, 1}) {
        const GearErrors& gear = errors.gears[static_cast<std::size_t>(teeth.gear[side])];
        const auto tooth = static_cast<std::size_t>(tooth_of(k, teeth.first[side], gear.teeth));
        sum.gap += gear.error_m[tooth * width + lane];
        if (!gear.slope_m.empty()) {
            // Contact runs from root to tip on the driver's flank, and from tip to root on the
            // other.
            const double slope = gear.slope_m[tooth * width + lane];
            sum.growth += side == teeth.driver ? slope : -slope;
        }
    }
    return sum;
}

}  // namespace

std::vector<PairTeeth> planetary_teeth(const PairSet& pairs, const gears::PlanetaryTrain& train,
                                       gears::PlanetSense sense) {
    std::vector<PairTeeth> teeth;
    for (int pair = 0; pair < pairs.pairs(); ++pair) {
        const int n = pair % train.planets;
        const bool with_sun = pair == n;
        const double delay = with_sun ? gears::sun_tooth_delay(train, n, sense)
                                      : gears::ring_tooth_delay(train, n, sense);
        // Delay of the tooth's engagement with this planet after its engagement with planet 1.
        const double engages = pairs.start[static_cast<std::size_t>(pair - n)] + delay;
        const double first = engages - pairs.start[static_cast<std::size_t>(pair)];
        teeth.push_back({{with_sun ? 0 : 1, 2 + 2 * n + (with_sun ? 0 : 1)},
                         {static_cast<int>(std::lround(first)), 0},
                         with_sun ? 0 : 1});
    }
    return teeth;
}

std::vector<PairTeeth> fixed_shaft_teeth() {
    return {{{0, 1}, {0, 0}}};
}

std::vector<PairGaps> tooth_gaps(const IntegrationPlan& plan, const ToothErrors& errors, int k) {
    const std::size_t width = errors.lanes();
    const auto slots = static_cast<std::size_t>(plan.nodes.tooth_pairs);
    std::vector<PairGaps> all;
    for (const ToothEngagement& engaged : plan.nodes.engagements) {
        PairGaps g{engaged.pair, engaged.first_step, engaged.last_step,
                   machine::AlignedVector(slots * width), machine::AlignedVector(slots * width)};
        for (std::size_t j = 0; j < slots; ++j) {
            for (std::size_t l = 0; l < width; ++l) {
                const ToothPairGap own = tooth_pair_gap(
                    errors, engaged.pair, k - engaged.youngest - static_cast<int>(j), l, width);
                g.gap[j * width + l] = own.gap;
                g.growth[j * width + l] = own.growth;
            }
        }
        all.push_back(std::move(g));
    }
    return all;
}

const PairGaps* gaps_of_pair(std::span<const PairGaps> gaps, int pair, int step) {
    for (const PairGaps& g : gaps) {
        if (g.pair == pair && g.first_step <= step && step < g.last_step) {
            return &g;
        }
    }
    return nullptr;
}

std::size_t tooth_pair_at(const IntegrationPlan& plan, int step, int node, int contact, int pair) {
    const auto nodes = static_cast<int>(plan.grid.stage_nodes.size());
    return static_cast<std::size_t>(
        ((step * nodes + node) * plan.nodes.contacts() + contact) * plan.nodes.pairs + pair);
}

double tooth_gap(const IntegrationPlan& plan, std::span<const PairGaps> gaps, int pair, int step,
                 int node, int contact, int lane, double wear) {
    const std::size_t at = tooth_pair_at(plan, step, node, contact, pair);
    const auto worn = [&](double gap) {
        return plan.nodes.tooth_wear.empty() ? gap : std::fma(plan.nodes.tooth_wear[at], wear, gap);
    };
    const double shared = plan.nodes.tooth_gap.empty() ? 0.0 : plan.nodes.tooth_gap[at];
    const PairGaps* const own = gaps_of_pair(gaps, pair, step);
    if (own == nullptr) {
        return worn(shared);
    }
    const auto teeth = static_cast<std::size_t>(plan.nodes.tooth_pairs);
    const auto tooth = static_cast<std::size_t>(contact / plan.nodes.slices);
    const auto i = tooth * (own->gap.size() / teeth) + static_cast<std::size_t>(lane);
    return worn(std::fma(plan.nodes.tooth_place[at], own->growth[i], own->gap[i]) + shared);
}

}  // namespace gearpod::lockstep
