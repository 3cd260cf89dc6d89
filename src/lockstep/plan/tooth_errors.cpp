#include "lockstep/plan/tooth_errors.hpp"

#include <cmath>
#include <span>
#include <stdexcept>

#include "lockstep/plan/tooth_pairs.hpp"

namespace gearpod::lockstep {
namespace {

int tooth_of(int mesh_period, int first, int teeth) {
    const int tooth = (mesh_period - first) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
}

// A gear's tooth in an engagement, and which end of its flank the contact starts from.
struct Flank {
    const GearErrors& gear;
    std::size_t tooth;
    double sense;  // 1: from the root, -1: from the tip

    // Adds its gaps at a place along the line of action, -1/2 to 1/2 from its start to its end.
    void add(double place, std::span<double> gap) const {
        const std::size_t width = gap.size();
        for (std::size_t l = 0; l < width; ++l) {
            gap[l] += gear.error_m[tooth * width + l];
        }
        for (std::size_t l = 0; l < width && !gear.slope_m.empty(); ++l) {
            gap[l] = std::fma(sense * place, gear.slope_m[tooth * width + l], gap[l]);
        }
    }
};

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
        const double ratio = pairs.curve(pair).contact_ratio();
        PairOverride o{pair, 0, static_cast<int>(plan.grid.steps.size()), {}, {}};
        o.tooth_error.assign(plan.grid.steps.size() * nodes * slots * width, 0.0);
        std::size_t at = 0;  // stage node
        for (const Step& step : plan.grid.steps) {
            const TouchingTeeth touching =
                touching_teeth(pairs, pair, step.phase + 0.5 * step.length);
            for (int j = 0; j < touching.count; ++j) {
                const int age = touching.youngest + j;
                const double engaged = pairs.start[static_cast<std::size_t>(pair)] - age;
                for (std::size_t n = 0; n < nodes; ++n) {
                    const double since =
                        step.phase + plan.grid.stage_nodes[n] * step.length - engaged;
                    const double place = (pairs.reversed ? -1.0 : 1.0) * (since / ratio - 0.5);
                    const std::span gap(
                        &o.tooth_error[((at + n) * slots + static_cast<std::size_t>(j)) * width],
                        width);
                    for (const int side : {0, 1}) {
                        const auto& gear = errors.gears[static_cast<std::size_t>(teeth.gear[side])];
                        const int tooth = tooth_of(k - age, teeth.first[side], gear.teeth);
                        const double sense = side == teeth.driver ? 1.0 : -1.0;
                        Flank{gear, static_cast<std::size_t>(tooth), sense}.add(place, gap);
                    }
                }
            }
            at += nodes;
        }
        all.push_back(std::move(o));
    }
    return all;
}

}  // namespace gearpod::lockstep
