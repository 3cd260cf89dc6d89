#include "lockstep/plan/tooth_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "dynamics/effects/mesh_law.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/stretch.hpp"

namespace gearpod::lockstep {
namespace {

// The part of the load that a tooth pair carries so long after its engagement began; `inside` lies
// in the same stretch.
double share_at(const PairSet& pairs, int pair, double since, double inside) {
    const stiffness::MeshStiffness& mesh = pairs.curve(pair);
    const auto position = [&](double x) { return pairs.reversed ? mesh.contact_ratio() - x : x; };
    const auto stretch = stiffness::stretch_around(mesh.transitions(), {}, position(inside));
    const double at = std::clamp(position(since), stretch.begin, stretch.end);
    double share = 0.0;
    mesh.share({&at, 1}, position(inside), {&share, 1});
    return share;
}

}  // namespace

double engagement_place(const PairSet& pairs, int pair, double since) {
    const double place = pairs.curve(pair).flank_place(since);
    return pairs.reversed ? -place : place;
}

TouchingTeeth touching_teeth(const PairSet& pairs, int pair, double phase) {
    const double since = phase - pairs.start[static_cast<std::size_t>(pair)];
    const int youngest = static_cast<int>(std::floor(-since)) + 1;
    const double left = pairs.curve(pair).contact_ratio() - (since + youngest);
    return {youngest, static_cast<int>(std::ceil(left))};
}

void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes) {
    for (int pair = 0; pair < nodes.pairs; ++pair) {
        for (int i = 0; const Step& step : grid.steps) {
            const auto [youngest, count] =
                touching_teeth(pairs, pair, step.phase + 0.5 * step.length);
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
    const auto count = static_cast<std::size_t>(nodes.pairs);
    const auto slots = static_cast<std::size_t>(nodes.tooth_pairs);
    nodes.tooth_stiffness.assign(nodes.stiffness.size() * slots, 0.0);
    nodes.tooth_place.assign(nodes.stiffness.size() * slots, 0.0);
    std::size_t at = 0;  // stage node
    for (const Step& step : grid.steps) {
        const double middle = step.phase + 0.5 * step.length;
        for (const double part : grid.stage_nodes) {
            for (int pair = 0; pair < nodes.pairs; ++pair) {
                const auto p = static_cast<std::size_t>(pair);
                const TouchingTeeth teeth = touching_teeth(pairs, pair, middle);
                for (int j = 0; j < teeth.count; ++j) {
                    const double engaged = pairs.start[p] - teeth.youngest - j;
                    const double since = step.phase + part * step.length - engaged;
                    const std::size_t slot = (at * slots + static_cast<std::size_t>(j)) * count + p;
                    nodes.tooth_stiffness[slot] = nodes.stiffness[at * count + p] *
                                                  share_at(pairs, pair, since, middle - engaged);
                    nodes.tooth_place[slot] = engagement_place(pairs, pair, since);
                }
            }
            ++at;
        }
    }
}

std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs) {
    const stiffness::MeshStiffness& mesh = pairs.curve(passage.pair);
    const std::vector<double> transitions = mesh.transitions(), jumps = faulty.jumps();
    const int last = static_cast<int>(std::lround(faulty.duration() - mesh.contact_ratio()));
    const std::size_t nodes = steps.middle.empty() ? 0 : steps.node.size() / steps.middle.size();
    const auto slots = static_cast<std::size_t>(tooth_pairs);
    const double begun = pairs.start[static_cast<std::size_t>(passage.pair)];
    std::vector<double> all(steps.node.size() * slots, 0.0), tau(nodes), one(nodes);
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
            std::reverse(tau.begin(), tau.end());  // ascending
        }
        const TouchingTeeth teeth =
            touching_teeth(pairs, passage.pair, passage.start - passage.mesh + steps.middle[step]);
        for (int j = 0; j < teeth.count; ++j) {
            const double engaged = passage.mesh - teeth.youngest - j + begun;
            const int later = static_cast<int>(std::lround(engaged - passage.start));
            faulty.tooth_pair(pairs.reversed ? last - later : later, tau, inside, one);
            for (std::size_t n = 0; n < nodes; ++n) {
                all[(step * nodes + n) * slots + static_cast<std::size_t>(j)] =
                    one[pairs.reversed ? nodes - 1 - n : n];
            }
        }
    }
    return all;
}

}  // namespace gearpod::lockstep
