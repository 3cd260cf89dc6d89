#include "lockstep/plan/tooth_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dynamics/effects/mesh_law.hpp"
#include "stiffness/helical_slices.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/positions.hpp"

namespace gearpod::lockstep {
namespace {

// Position on the path of contact in the mesh's own sense, from the time since the engagement
// began.
double position_of(const PairSet& pairs, PairId pair, double since) {
    return pairs.reversed ? pairs.curve(pair).contact_ratio() - since : since;
}

// Stiffness of one slice of a tooth pair at time `since` after its engagement began, N/m; `inside`
// is a time within the same stretch between transitions.
double contact_stiffness(const PairSet& pairs, PairId pair, int slice, double since,
                         double inside) {
    const stiffness::MeshStiffness& mesh = pairs.curve(pair);
    const double middle = position_of(pairs, pair, inside);
    const auto stretch = stiffness::stretch_around(mesh.transitions(), {}, middle);
    const double tau = std::clamp(position_of(pairs, pair, since), stretch.begin, stretch.end);
    double stiffness = 0.0;
    mesh.slice_stiffness(slice, {&tau, 1}, middle, {&stiffness, 1});
    return stiffness;
}

// Fills the springs of one pair at one stage node; `first` is the index of the first in the tables,
// `worn` is true if the pair's flanks wear.
void fill_node(const PairSet& pairs, PairId pair, double phase, double middle, std::size_t first,
               bool worn, StiffnessNodes& nodes) {
    const stiffness::MeshStiffness& mesh = pairs.curve(pair);
    const EngagedTeeth teeth = engaged_teeth(pairs, pair, middle);
    const auto count = static_cast<std::size_t>(nodes.pairs);
    for (int j = 0; j < teeth.count; ++j) {
        const double engaged = pairs.start[pair] - teeth.youngest - j;
        const double since = phase - engaged;
        const double tau = position_of(pairs, pair, since);
        for (int slice = 0; slice < mesh.slices(); ++slice) {
            const std::size_t i =
                first + static_cast<std::size_t>(j * nodes.slices + slice) * count;
            nodes.tooth_stiffness[i] =
                contact_stiffness(pairs, pair, slice, since, middle - engaged);
            nodes.tooth_position[i] = mesh.slice_flank_position(slice, tau);
            if (!nodes.tooth_gap.empty()) {
                nodes.tooth_gap[i] = mesh.slice_gap(slice, tau);
                nodes.tooth_on_path[i] = mesh.slice_on_path(slice, tau);
            }
            if (worn) {
                nodes.tooth_wear[i] = mesh.slice_wear(slice, tau);
            }
        }
    }
}

void fill_contacts(const PairSet& pairs, const PhaseGrid& grid, const std::vector<int>& worn,
                   StiffnessNodes& nodes) {
    const auto contacts = static_cast<std::size_t>(nodes.contacts());
    const auto count = static_cast<std::size_t>(nodes.pairs);
    std::size_t index = 0;  // index of the stage node
    for (const Step& step : grid.steps) {
        const double middle = step.phase + 0.5 * step.length;
        for (const double part : grid.stage_nodes) {
            for (PairId pair{0}; pair < nodes.pairs; ++pair) {
                fill_node(pairs, pair, step.phase + part * step.length, middle,
                          index * contacts * count + pair, std::ranges::count(worn, pair) > 0,
                          nodes);
            }
            ++index;
        }
    }
}

int tooth_of(int mesh_period, int first, int teeth) {
    const int tooth = (mesh_period - first) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
}

// Gap of a tooth pair in one lane, m, and its growth along the engagement.
struct ToothPairGap {
    double gap = 0.0, growth = 0.0;
};

ToothPairGap tooth_pair_gap(const ToothErrors& errors, PairId pair, int k, LaneId lane,
                            std::size_t width) {
    const PairTeeth& teeth = errors.pairs[pair];
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

EngagedTeeth engaged_teeth(const PairSet& pairs, PairId pair, double phase) {
    const double since = phase - pairs.start[pair];
    const int youngest = static_cast<int>(std::floor(-since)) + 1;
    const double left = pairs.curve(pair).contact_ratio() - (since + youngest);
    return {youngest, static_cast<int>(std::ceil(left))};
}

void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes,
                     const std::vector<int>& worn) {
    for (PairId pair{0}; pair < nodes.pairs; ++pair) {
        for (int i = 0; const Step& step : grid.steps) {
            const auto [youngest, count] =
                engaged_teeth(pairs, pair, step.phase + 0.5 * step.length);
            nodes.tooth_pairs = std::max(nodes.tooth_pairs, count);
            if (i == 0 || youngest != nodes.engagements.back().youngest) {
                nodes.engagements.push_back({pair, i, i, youngest});
            }
            nodes.engagements.back().last_step = ++i;
        }
    }
    if (nodes.tooth_pairs > dynamics::kMostToothPairs) {
        throw std::invalid_argument(
            fmt::format("{} tooth pairs of a gear pair touch at once (at most {} can push each for "
                        "itself)",
                        nodes.tooth_pairs, dynamics::kMostToothPairs));
    }
    nodes.slices = 1;
    bool gaps = false;
    for (PairId pair{0}; pair < nodes.pairs; ++pair) {
        nodes.slices = std::max(nodes.slices, pairs.curve(pair).slices());
        gaps = gaps || pairs.curve(pair).has_gaps();
    }
    static_assert(dynamics::kMostContacts >= stiffness::kMostSlicedSprings);
    if (nodes.contacts() > dynamics::kMostContacts) {
        throw std::invalid_argument(
            fmt::format("{} tooth pairs of a gear pair with {} slices each (at most {} slices in "
                        "all)",
                        nodes.tooth_pairs, nodes.slices, dynamics::kMostContacts));
    }
    const std::size_t size = nodes.stiffness.size() * static_cast<std::size_t>(nodes.contacts());
    nodes.tooth_stiffness.assign(size, 0.0);
    nodes.tooth_position.assign(size, 0.0);
    nodes.tooth_gap.assign(gaps ? size : 0, 0.0);
    nodes.tooth_on_path.assign(gaps ? size : 0, 0.0);
    nodes.tooth_wear.assign(worn.empty() ? 0 : size, 0.0);
    fill_contacts(pairs, grid, worn, nodes);
}

std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs, int slices) {
    const stiffness::MeshStiffness& mesh = pairs.curve(passage.pair);
    const std::vector<double> transitions = mesh.transitions(), jumps = faulty.jumps();
    const int last = static_cast<int>(std::lround(faulty.duration() - mesh.contact_ratio()));
    const std::size_t nodes = steps.middle.empty() ? 0 : steps.node.size() / steps.middle.size();
    const auto contacts = static_cast<std::size_t>(tooth_pairs * slices);
    const double begun = pairs.start[passage.pair];
    std::vector<double> all(steps.node.size() * contacts, 0.0), tau(nodes), slice_values(nodes);
    for (std::size_t step = 0; step < steps.middle.size(); ++step) {
        const auto position = [&](double since) {
            return pairs.reversed ? faulty.duration() - since : since;
        };
        const double inside = position(steps.middle[step]);
        const auto stretch = stiffness::stretch_around(transitions, jumps, inside);
        for (std::size_t n = 0; n < nodes; ++n) {
            tau[n] = std::clamp(position(steps.node[step * nodes + n]), stretch.begin, stretch.end);
        }
        if (pairs.reversed) {
            std::reverse(tau.begin(), tau.end());  // ascending again
        }
        const EngagedTeeth teeth =
            engaged_teeth(pairs, passage.pair, passage.start - passage.mesh + steps.middle[step]);
        for (int contact = 0; contact < teeth.count * slices; ++contact) {
            const int j = contact / slices, slice = contact % slices;
            const double engaged = passage.mesh - teeth.youngest - j + begun;
            const int later = static_cast<int>(std::lround(engaged - passage.start));
            if (slice < mesh.slices()) {
                faulty.slice_stiffness(pairs.reversed ? last - later : later, slice, tau, inside,
                                       slice_values);
            }
            for (std::size_t n = 0; n < nodes && slice < mesh.slices(); ++n) {
                all[(step * nodes + n) * contacts + static_cast<std::size_t>(contact)] =
                    slice_values[pairs.reversed ? nodes - 1 - n : n];
            }
        }
    }
    return all;
}

std::vector<PairTeeth> planetary_teeth(const PairSet& pairs, const gears::PlanetaryTrain& train,
                                       gears::PlanetSense sense) {
    std::vector<PairTeeth> teeth;
    for (PairId pair{0}; pair < pairs.pairs(); ++pair) {
        const PlanetId n = planet_of(pair, train.planets);
        const bool with_sun = pair == n;
        const double delay = with_sun ? gears::sun_tooth_delay(train, n, sense)
                                      : gears::ring_tooth_delay(train, n, sense);
        // Delay of the tooth's engagement with this planet after its engagement with planet 1.
        const double engages = pairs.start[static_cast<std::size_t>(pair - n)] + delay;
        const double first = engages - pairs.start[pair];
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
                const ToothPairGap gap =
                    tooth_pair_gap(errors, engaged.pair, k - engaged.youngest - static_cast<int>(j),
                                   LaneId{l}, width);
                g.gap[j * width + l] = gap.gap;
                g.growth[j * width + l] = gap.growth;
            }
        }
        all.push_back(std::move(g));
    }
    return all;
}

const PairGaps* gaps_of_pair(std::span<const PairGaps> gaps, PairId pair, int step) {
    for (const PairGaps& g : gaps) {
        if (g.pair == pair && g.first_step <= step && step < g.last_step) {
            return &g;
        }
    }
    return nullptr;
}

std::size_t tooth_pair_at(const IntegrationPlan& plan, int step, int node, int contact,
                          PairId pair) {
    const auto nodes = static_cast<int>(plan.grid.stage_nodes.size());
    return static_cast<std::size_t>(
        ((step * nodes + node) * plan.nodes.contacts() + contact) * plan.nodes.pairs + pair);
}

double tooth_gap(const IntegrationPlan& plan, std::span<const PairGaps> gaps, PairId pair, int step,
                 int node, int contact, LaneId lane, double wear) {
    const std::size_t index = tooth_pair_at(plan, step, node, contact, pair);
    const auto worn = [&](double gap) {
        return plan.nodes.tooth_wear.empty() ? gap
                                             : std::fma(plan.nodes.tooth_wear[index], wear, gap);
    };
    const double shared = plan.nodes.tooth_gap.empty() ? 0.0 : plan.nodes.tooth_gap[index];
    const PairGaps* const pair_gaps = gaps_of_pair(gaps, pair, step);
    if (pair_gaps == nullptr) {
        return worn(shared);
    }
    const auto teeth = static_cast<std::size_t>(plan.nodes.tooth_pairs);
    const auto tooth = static_cast<std::size_t>(contact / plan.nodes.slices);
    const auto i = tooth * (pair_gaps->gap.size() / teeth) + lane;
    return worn(
        std::fma(plan.nodes.tooth_position[index], pair_gaps->growth[i], pair_gaps->gap[i]) +
        shared);
}

}  // namespace gearpod::lockstep
