#include "mc/ensemble/gearbox/record_window.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mc/plan/drivetrain.hpp"
#include "mc/plan/feature_needs.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/false_alarm_target.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

std::vector<double> part(const std::vector<double>& samples, std::size_t first, std::size_t count) {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

// Distinct teeth of a mate that the faulty tooth meets in a record, and in any number of turns.
struct Meetings {
    Member mate;
    int met = 0, all = 0;
};

// Meetings of the faulty tooth, or of any planet or pinion tooth without a fault, in a number of
// mesh periods. A planet's tooth meets only one mate on each side.
std::vector<Meetings> meetings_in(const Study& study, int meshes) {
    const Member faulty = study.fault.member.value_or(
        study.gearbox.kind == GearboxKind::planetary ? Member::planet : Member::pinion);
    const bool sun_side = !study.fault.side || *study.fault.side != FaultSide::ring,
               ring_side = !study.fault.side || *study.fault.side != FaultSide::sun;
    std::vector<Meetings> all;
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        if (mesh.member_1 != faulty && mesh.member_2 != faulty) {
            continue;
        }
        const Member mate = mesh.member_1 == faulty ? mesh.member_2 : mesh.member_1;
        if ((mate == Member::sun && !sun_side) || (mate == Member::ring && !ring_side)) {
            continue;
        }
        const int own = *teeth_of(study, faulty), mates = *teeth_of(study, mate);
        const int distinct = mates / std::gcd(own, mates);
        all.push_back({mate, std::min(distinct, meshes / own), distinct});
    }
    return all;
}

std::string shared_text(const Study& study) {
    return shares_windows(study)
               ? fmt::format(", the same for {} gearboxes that are computed together",
                             kSharedWindows)
               : "";
}

std::string record_conditions(const Study& study) {
    const auto drivetrain = make_drivetrain(study);
    const signals::SpanLayout span = drivetrain->span();
    const double mesh_Hz = std::abs(nominal_mesh_frequency_Hz(study, *drivetrain));
    const RecordLength length = record_length(study);
    const int turns = length.given() ? whole_turns(length, span, mesh_Hz) : span.ring_teeth;
    const int meshes = turns * span.planet_teeth;
    std::vector<std::string> mates;
    for (const Meetings& one : meetings_in(study, meshes)) {
        mates.push_back(fmt::format("{} of the {} {} teeth that it can meet ({:.0f} %)", one.met,
                                    one.all, member_name(one.mate), 100.0 * one.met / one.all));
    }
    std::string text = fmt::format(
        " A record lasts {:.3g} s{}, in which {} tooth meets {}.", meshes / mesh_Hz,
        length.given() ? " and begins at a random tooth position" + shared_text(study)
                       : " by default (sensor.record_s)",
        study.fault.kind != nullptr && !study.fault.kind->wears_flanks() ? "the faulty" : "a",
        fmt::join(mates, " and "));
    if (const std::optional<double> interval_h = record_interval_h(study)) {
        text += fmt::format(" There are {:g} h between two records.", *interval_h);
    }
    return text;
}

}  // namespace

double sample_s(const Scene& scene, const InstanceInputs& inputs) {
    return dynamics::mesh_period_s(scene.inputs(inputs)) / scene.samples_per_mesh();
}

std::size_t turn_samples(const Scene& scene) {
    return static_cast<std::size_t>(scene.span().planet_teeth) *
           static_cast<std::size_t>(scene.samples_per_mesh());
}

std::span<const double> folded_part(const Scene& scene, const LaneSignals& record,
                                    std::span<const double> samples) {
    const int turns = record.turns > 0 ? record.turns : scene.span().ring_teeth;
    return samples.first(static_cast<std::size_t>(turns) * turn_samples(scene));
}

std::vector<double> folded_squares(const Scene& scene, const LaneSignals& record,
                                   std::span<const double> samples) {
    return signals::fold_of_squares(folded_part(scene, record, samples), turn_samples(scene));
}

void fold_again(const Scene& scene, LaneSignals& record) {
    record.folded = folded_squares(scene, record, record.sensor);
}

LaneSignals cut_record(const Scene& scene, const LaneSignals& signals, const RecordWindow& window,
                       bool samples) {
    const auto teeth = static_cast<std::size_t>(scene.span().planet_teeth);
    const auto first = static_cast<std::size_t>(window.first_mesh),
               meshes = static_cast<std::size_t>(window.turns) * teeth;
    LaneSignals record;
    record.noise = signals.noise;
    record.turns = window.turns;
    record.first_mesh = window.first_mesh;
    if (!signals.sensor.empty()) {
        const auto phases = static_cast<std::size_t>(scene.samples_per_mesh());
        record.sensor = part(signals.sensor, first * phases, meshes * phases);
        fold_again(scene, record);
    }
    if (!samples) {
        record.sensor.clear();
    }
    const auto phases = static_cast<std::size_t>(scene.te_samples_per_mesh());
    const std::vector<double> te = part(signals.te, first * phases, meshes * phases);
    record.te_turn = signals::synchronous_average(te, teeth * phases);
    remove_mean(record.te_turn);
    return record;
}

LaneSignals drawn_record(const Scene& scene, LaneSignals signals, const Realization& realization) {
    if (!has_record_length(scene.study())) {
        return signals;
    }
    return cut_record(scene, signals,
                      record_window(scene, realization.id, record_turns(scene, realization.inputs)),
                      true);
}

void rotate_to_first_tooth(const LaneSignals& record, int per_mesh, std::vector<double>& turn) {
    if (turn.empty()) {
        return;
    }
    const std::size_t first = static_cast<std::size_t>(record.first_mesh) *
                              static_cast<std::size_t>(per_mesh) % turn.size();
    std::ranges::rotate(turn, turn.end() - static_cast<std::ptrdiff_t>(first));
}

std::string record_length_text(const Scene& scene) {
    const RecordLength length = record_length(scene.study());
    const signals::SpanLayout& span = scene.span();
    const double mesh_Hz = std::abs(scene.nominal_mesh_frequency_Hz());
    const int turns = length.given() ? whole_turns(length, span, mesh_Hz) : span.ring_teeth;
    return fmt::format(
        "{:.3g} s: {} turns of {} mesh periods; all teeth that can meet have met after {}{}",
        turns * span.planet_teeth / mesh_Hz, turns, span.planet_teeth,
        span.ring_teeth / std::gcd(span.planet_teeth, span.ring_teeth),
        length.given() ? ", from a random tooth position" + shared_text(scene.study()) : "");
}

std::string run_conditions(const Study& study) {
    return has_gears(study) ? assumptions(study, false) + record_conditions(study) : "";
}

}  // namespace gearpod::mc
