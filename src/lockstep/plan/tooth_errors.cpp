#include "lockstep/plan/tooth_errors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stiffness/teeth/stretch.hpp"

namespace gearpod::lockstep {
namespace {

// Shares are smooth within a step; their rate is that of a chord this long, mesh periods.
constexpr double kChord = 1e-5;

// The share of the tooth pair at positions within one step, and its rate.
struct StepShares {
    const stiffness::MeshStiffness& mesh;
    stiffness::Stretch stretch;
    double inside;

    double share(double tau) const {
        const double at = std::clamp(tau, stretch.begin, stretch.end);
        double value = 0.0;
        mesh.share(std::span(&at, 1), inside, std::span(&value, 1));
        return value;
    }
    double rate(double tau) const {
        const double before = std::max(tau - kChord, stretch.begin);
        const double after = std::min(tau + kChord, stretch.end);
        return (share(after) - share(before)) / (after - before);
    }
};

LoadShares::ToothPair tooth_pair(const stiffness::MeshStiffness& mesh, bool reversed,
                                 const PhaseGrid& grid, double start, int age) {
    LoadShares::ToothPair pair{age, {}, {}};
    const double sense = reversed ? -1.0 : 1.0;
    const auto position = [&](double phase) {
        const double since = phase + age - start;
        return reversed ? mesh.contact_ratio() - since : since;
    };
    const std::vector<double> transitions = mesh.transitions();
    for (const Step& step : grid.steps) {
        const double inside = position(step.phase + 0.5 * step.length);
        const bool touches = inside > 0.0 && inside < mesh.contact_ratio();
        const StepShares at{mesh, stiffness::stretch_around(transitions, {}, inside), inside};
        for (const double node : grid.stage_nodes) {
            const double tau = position(step.phase + node * step.length);
            pair.share.push_back(touches ? at.share(tau) : 0.0);
            pair.rate.push_back(touches ? sense * at.rate(tau) : 0.0);
        }
    }
    return pair;
}

int tooth_of(int mesh_period, int first, int teeth) {
    const int tooth = (mesh_period - first) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
}

}  // namespace

LoadShares::LoadShares(const PairSet& pairs, const PhaseGrid& grid) {
    for (int pair = 0; pair < pairs.pairs(); ++pair) {
        const auto& mesh = pairs.curve(pair);
        const double start = pairs.start[static_cast<std::size_t>(pair)];
        std::vector<ToothPair> touching;
        for (int age = 0; start + mesh.contact_ratio() > age; ++age) {
            touching.push_back(tooth_pair(mesh, pairs.reversed, grid, start, age));
        }
        tooth_pairs_.push_back(std::move(touching));
    }
}

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
                         {static_cast<int>(std::lround(first)), 0}});
    }
    return teeth;
}

std::vector<PairTeeth> fixed_shaft_teeth() {
    return {{{0, 1}, {0, 0}}};
}

void check_tooth_errors(const MarchPlan& plan, const ToothErrors* errors, int march_meshes) {
    if (errors && plan.mesh_law == dynamics::MeshLaw::linear) {
        throw std::invalid_argument("tooth errors need a mesh law with transmission error");
    }
    if (errors && march_meshes < 1) {
        throw std::invalid_argument("tooth errors need every mesh marched for itself");
    }
}

std::vector<PairOverride> tooth_error_overrides(const MarchPlan& plan, const ToothErrors& errors,
                                                int k) {
    std::vector<PairOverride> all;
    const int steps = static_cast<int>(plan.grid.steps.size());
    const std::size_t nodes = plan.grid.steps.size() * plan.grid.stage_nodes.size();
    const GearErrors& any = errors.gears.front();
    const std::size_t width = any.error_m.size() / static_cast<std::size_t>(any.teeth);
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    std::vector<double> error(width);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        PairOverride o{static_cast<int>(pair), 0, steps, {}, {}};
        o.error.assign(nodes * width, 0.0);
        o.error_rate.assign(nodes * width, 0.0);
        for (std::size_t i = 0; i < nodes && !plan.nodes.error.empty(); ++i) {
            std::fill_n(o.error.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                        plan.nodes.error[i * pairs + pair]);
            std::fill_n(o.error_rate.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                        plan.nodes.error_rate[i * pairs + pair]);
        }
        const PairTeeth& teeth = errors.pairs[pair];
        for (const auto& touching : errors.shares->tooth_pairs(static_cast<int>(pair))) {
            std::fill(error.begin(), error.end(), 0.0);
            for (const int side : {0, 1}) {
                const GearErrors& gear = errors.gears[static_cast<std::size_t>(teeth.gear[side])];
                const int tooth = tooth_of(k - touching.age, teeth.first[side], gear.teeth);
                for (std::size_t l = 0; l < width; ++l) {
                    error[l] += gear.error_m[static_cast<std::size_t>(tooth) * width + l];
                }
            }
            for (std::size_t i = 0; i < nodes; ++i) {
                for (std::size_t l = 0; l < width; ++l) {
                    o.error[i * width + l] += touching.share[i] * error[l];
                    o.error_rate[i * width + l] += touching.rate[i] * error[l];
                }
            }
        }
        all.push_back(std::move(o));
    }
    return all;
}

}  // namespace gearpod::lockstep
