#include "lockstep/plan/fault_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dynamics/effects/mesh_damping.hpp"

namespace gearpod::lockstep {

namespace {

// Passage of the tooth pair of `pair` that engages nearest to `due` (mesh periods), shifted into
// [0, length).
FaultPassage passage_near(const PairSet& pairs, PairId pair, double due, int length, int curve) {
    const double start = pairs.start[pair];
    const long meshes = std::lround(due - start) % length;
    return {pair, start + static_cast<double>(meshes < 0 ? meshes + length : meshes), curve};
}

void sort_passages(FaultPattern& pattern) {
    std::ranges::sort(pattern.passages,
                      [](const auto& a, const auto& b) { return a.start < b.start; });
}

// Pattern of a sun or ring tooth. `order` is +1 if the tooth meets the planets in ascending order,
// -1 if in descending order.
FaultPattern central_gear_pattern(const PairSet& pairs, const PlanetPositions& planets, int teeth,
                                  int first_pair, int order) {
    FaultPattern pattern;
    pattern.length = teeth;
    const double first = pairs.start[static_cast<std::size_t>(first_pair)];
    for (int n = 0; n < planets.planets(); ++n) {
        const double turn = planets.position[static_cast<std::size_t>(n)];
        pattern.passages.push_back(
            passage_near(pairs, PairId{first_pair + n}, first + order * turn * teeth, teeth, 0));
    }
    sort_passages(pattern);
    return pattern;
}

}  // namespace

// The sun overtakes the planets in ascending order, and the planets overtake the ring in descending
// order. Both orders are swapped if the sun turns more slowly than the carrier.
FaultPattern sun_fault_pattern(const PairSet& pairs, const PlanetPositions& planets,
                               int sun_teeth) {
    return central_gear_pattern(pairs, planets, sun_teeth, 0, pairs.reversed ? -1 : 1);
}

FaultPattern ring_fault_pattern(const PairSet& pairs, const PlanetPositions& planets,
                                int ring_teeth) {
    return central_gear_pattern(pairs, planets, ring_teeth, planets.planets(),
                                pairs.reversed ? 1 : -1);
}

FaultPattern planet_fault_pattern(const PairSet& pairs, PlanetId planet, PlanetSide side,
                                  int planet_teeth) {
    const PairId with_sun = sun_pair(planet), with_ring = ring_pair(planet, pairs.pairs() / 2);
    FaultPattern pattern;
    pattern.length = planet_teeth;
    const PairId first = side == PlanetSide::ring ? with_ring : with_sun;
    pattern.passages.push_back({first, pairs.start[static_cast<std::size_t>(first)], 0});
    if (side == PlanetSide::both) {
        const double half_turn = 0.5 * (planet_teeth + (pairs.reversed ? 1 : -1));
        const double pitch = pairs.pitch_phase(with_sun) + half_turn;
        const double since = pairs.pitch_phase(with_ring) - pairs.start[with_ring];
        pattern.passages.push_back(passage_near(pairs, with_ring, pitch - since, planet_teeth, 1));
    }
    sort_passages(pattern);
    return pattern;
}

FaultPattern shaft_fault_pattern(const PairSet& pairs, int teeth) {
    return {teeth, {{PairId{0}, pairs.start[0], 0}}};
}

bool FaultCurves::faulty(LaneId lane) const {
    return std::ranges::any_of(curve, [&](const auto& lanes) { return lanes[lane] != nullptr; });
}

FaultSchedule::FaultSchedule(const IntegrationPlan& plan, const FaultCurves& faults,
                             const ToothErrors* tooth_errors)
    : plan_(plan), faults_(faults), tooth_errors_(tooth_errors) {
    if (tooth_errors != nullptr && plan.nodes.tooth_pairs == 0) {
        throw std::invalid_argument(
            "tooth errors need a mesh law with single tooth pairs (unilateral contact)");
    }
    if (!faults.wear.empty() && plan.nodes.tooth_wear.empty()) {
        throw std::invalid_argument("wear needs its shape on the flanks (tooth_wear of the plan)");
    }
    for (const auto& lanes : faults.curve) {
        double longest = 0.0;
        for (const auto& lane : lanes) {
            longest = std::max(longest, lane ? lane->duration() : 0.0);
        }
        duration_.push_back(longest);
    }
}

// Start of the passage that overlaps mesh period k, if any: one in this pattern or in the previous
// one.
std::optional<double> FaultSchedule::passage_start(const FaultPassage& passage, int k) const {
    for (const double from : {passage.start, passage.start - faults_.pattern.length}) {
        if (from < k + 1 && from + duration(passage) > k) {
            return from;
        }
    }
    return std::nullopt;
}

std::vector<PairOverride> FaultSchedule::overrides(int k) const {
    std::vector<PairOverride> all;
    for (const FaultPassage& passage : faults_.pattern.passages) {
        if (const auto start = passage_start(passage, k)) {
            all.push_back(make_override(passage, k, *start));
        }
    }
    return all;
}

int FaultSchedule::in_pattern(int k) const {
    const int length = faults_.pattern.length;
    return (k % length + length) % length;
}

MeshOverrides FaultSchedule::all_overrides(int k) {
    const int mesh = in_pattern(k);
    auto cached = cache_.find(mesh);
    if (cached == cache_.end()) {
        cached = cache_.emplace(mesh, overrides(mesh)).first;
    }
    MeshOverrides all{cached->second, {}, faults_.wear};
    if (tooth_errors_ != nullptr) {
        all.gaps = tooth_gaps(plan_, *tooth_errors_, k);
    }
    return all;
}

bool FaultSchedule::passes(int k) const {
    return std::ranges::any_of(faults_.pattern.passages,
                               [&, mesh = in_pattern(k)](const FaultPassage& passage) {
                                   return passage_start(passage, mesh).has_value();
                               });
}

bool FaultSchedule::continues_after(int k) const {
    return std::ranges::any_of(faults_.pattern.passages,
                               [&, mesh = in_pattern(k)](const FaultPassage& passage) {
                                   const auto start = passage_start(passage, mesh);
                                   return start && *start + duration(passage) > mesh + 1;
                               });
}

// Stiffness of the pair with the faulty tooth, lane by lane; healthy lanes keep the plan's values.
PairOverride FaultSchedule::make_override(const FaultPassage& passage, int k, double start) const {
    const StepPositions steps = overlapping_steps(plan_.grid, k, start, duration(passage));
    const auto& curves = faults_.curve[static_cast<std::size_t>(passage.curve)];
    const std::size_t lanes = curves.size(), count = steps.node.size();
    const auto slots = static_cast<std::size_t>(plan_.nodes.contacts());
    PairOverride o{passage.pair, steps.first_step, steps.last_step,
                   machine::AlignedVector(count * lanes), machine::AlignedVector(count * lanes)};
    o.tooth_stiffness.resize(count * slots * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        if (!curves[l]) {
            copy_healthy(LaneId{l}, lanes, o);
            continue;
        }
        const stiffness::MeshStiffness& healthy = faults_.pairs->curve(passage.pair);
        const PairTotals totals =
            faulty_totals(healthy, *curves[l], faults_.pairs->reversed, steps);
        dynamics::with_mesh_damping(dynamics::mesh_damping(plan_.layout), [&](auto law) {
            for (std::size_t i = 0; i < count; ++i) {
                o.stiffness[i * lanes + l] = totals.all[i];
                o.damping_shape[i * lanes + l] = law.shape(totals.paths[i]);
            }
        });
        if (slots > 0) {
            const std::vector<double> teeth =
                faulty_tooth_pairs(*faults_.pairs, *curves[l], {passage.pair, k, start}, steps,
                                   plan_.nodes.tooth_pairs, plan_.nodes.slices);
            for (std::size_t i = 0; i < teeth.size(); ++i) {
                o.tooth_stiffness[i * lanes + l] = teeth[i];
            }
        }
    }
    return o;
}

// Copies the plan's healthy values into a lane without a fault.
void FaultSchedule::copy_healthy(LaneId lane, std::size_t lanes, PairOverride& o) const {
    const StiffnessNodes& nodes = plan_.nodes;
    const auto pairs = static_cast<std::size_t>(nodes.pairs);
    const std::size_t first =
        static_cast<std::size_t>(o.first_step) * plan_.grid.stage_nodes.size();
    const auto copy = [&](const std::vector<double>& from, std::size_t slots, auto& to) {
        for (std::size_t i = 0; i < to.size() / lanes; ++i) {
            to[i * lanes + lane] = from[(first * slots + i) * pairs + o.pair];
        }
    };
    copy(nodes.stiffness, 1, o.stiffness);
    copy(nodes.damping_shape, 1, o.damping_shape);
    copy(nodes.tooth_stiffness, static_cast<std::size_t>(nodes.contacts()), o.tooth_stiffness);
}

}  // namespace gearpod::lockstep
