#include "lockstep/plan/tooth_errors.hpp"

#include <cmath>
#include <stdexcept>

#include "lockstep/plan/tooth_pairs.hpp"

namespace gearpod::lockstep {
namespace {

int tooth_of(int mesh_period, int first, int teeth) {
    const int tooth = (mesh_period - first) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
}

// Gaps of one tooth pair, [lane]: at the middle of its engagement, and how much they grow along it.
struct PairGap {
    machine::AlignedVector middle, growth;
};

// Of the tooth pair that begins to engage in mesh period m.
PairGap gap_of(const ToothErrors& errors, const PairTeeth& teeth, int m, bool reversed,
               std::size_t width) {
    PairGap gap{machine::AlignedVector(width), machine::AlignedVector(width)};
    for (const int side : {0, 1}) {
        const GearErrors& gear = errors.gears[static_cast<std::size_t>(teeth.gear[side])];
        const auto tooth =
            static_cast<std::size_t>(tooth_of(m, teeth.first[side], gear.teeth)) * width;
        // The driver's flank is touched from the root, or from the tip where contact runs back.
        const double sense = (side == teeth.driver) != reversed ? 1.0 : -1.0;
        for (std::size_t l = 0; l < width; ++l) {
            gap.middle[l] += gear.error_m[tooth + l];
            gap.growth[l] += gear.slope_m.empty() ? 0.0 : sense * gear.slope_m[tooth + l];
        }
    }
    return gap;
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
        // From the engagement with planet 1 to the one of the same tooth with this planet.
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

void check_tooth_errors(const MarchPlan& plan, const ToothErrors* errors, int march_meshes) {
    if (errors && plan.nodes.tooth_pairs == 0) {
        throw std::invalid_argument("tooth errors need a mesh law that knows the tooth pairs");
    }
    if (errors && march_meshes < 1) {
        throw std::invalid_argument("tooth errors need every mesh marched for itself");
    }
}

std::vector<PairOverride> tooth_error_overrides(const MarchPlan& plan, const PairSet& pairs,
                                                const ToothErrors& errors, int k) {
    const std::size_t nodes = plan.grid.stage_nodes.size();
    const GearErrors& any = errors.gears.front();
    const std::size_t width = any.error_m.size() / static_cast<std::size_t>(any.teeth);
    const auto slots = static_cast<std::size_t>(plan.nodes.tooth_pairs);
    std::vector<PairOverride> all;
    for (int pair = 0; pair < plan.nodes.pairs; ++pair) {
        const PairTeeth& teeth = errors.pairs[static_cast<std::size_t>(pair)];
        const double start = pairs.start[static_cast<std::size_t>(pair)];
        const double ratio = pairs.curve(pair).contact_ratio();
        std::vector<PairGap> gaps;  // [age]
        for (int age = 0; age < start + ratio; ++age) {
            gaps.push_back(gap_of(errors, teeth, k - age, pairs.reversed, width));
        }
        PairOverride o{pair, 0, static_cast<int>(plan.grid.steps.size()), {}, {}};
        o.tooth_error.resize(plan.grid.steps.size() * nodes * slots * width);
        double* row = o.tooth_error.data();
        for (const Step& step : plan.grid.steps) {
            const TouchingTeeth touching =
                touching_teeth(pairs, pair, step.phase + 0.5 * step.length);
            for (const double part : plan.grid.stage_nodes) {
                const double since = step.phase + part * step.length - start + touching.youngest;
                for (int j = 0; j < touching.count; ++j) {
                    const PairGap& gap = gaps[static_cast<std::size_t>(touching.youngest + j)];
                    const double place = (since + j) / ratio - 0.5;
                    const double* middle = gap.middle.data();
                    const double* growth = gap.growth.data();
                    double* own = row + static_cast<std::size_t>(j) * width;
#pragma omp simd
                    for (std::size_t l = 0; l < width; ++l) {
                        own[l] = std::fma(place, growth[l], middle[l]);
                    }
                }
                row += slots * width;
            }
        }
        all.push_back(std::move(o));
    }
    return all;
}

}  // namespace gearpod::lockstep
