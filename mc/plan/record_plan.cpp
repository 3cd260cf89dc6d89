#include "mc/plan/record_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mc/files/input/problems.hpp"
#include "mc/plan/sensor_plan.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

// The most lanes of a tile, and of a coupled tile.
constexpr std::uint64_t kTileLanes = 16, kCoupledLanes = 8;

// True if the motion of all baseline records of a gearbox is the same.
bool same_baselines(const Study& study) {
    return study.features.baseline_torque_scatter == 0.0 && !has_random_fluctuations(study) &&
           study.sensor.tones.empty() && !has_other_sources(study) &&
           std::ranges::none_of(study.random, [](const RandomInput& input) {
               return input.distribution.per_record();
           });
}

// True for records of given length in gearboxes that need every mesh period integrated. Independent
// of the numerics. Not for fluctuating speed and elastic shafts, which need all of the signal.
bool shares_windows(const Study& study) {
    return record_length(study).given() && !reason_not_periodic(study).empty() &&
           !study.effects.quasi_static() && !speed_fluctuates(study) && !is_coupled(study);
}

double meshes_of_record(const RecordLength& length, const signals::SpanLayout& span,
                        double mesh_frequency_Hz) {
    return length.seconds ? *length.seconds * mesh_frequency_Hz
                          : *length.carrier_turns * span.carrier_meshes;
}

// Throws SceneError if features need longer records than these.
void check_covered_features(const RecordLength& length, const FeaturePlan& features, int meshes,
                            double mesh_frequency_Hz) {
    std::vector<std::string> needs;
    int needed = 0;
    for (const features::Feature* feature : features.used) {
        const int least = features.least_meshes(*feature);
        if (least > meshes) {
            needs.push_back(fmt::format("\"{}\" needs {} mesh periods", feature->name, least));
            needed = std::max(needed, least);
        }
    }
    if (!needs.empty()) {
        const int teeth = features.span.planet_teeth;
        throw SceneError("features.use",
                         fmt::format("{}, but a record has {} (sensor.{})", fmt::join(needs, ", "),
                                     meshes, length.key()),
                         fmt::format("remove these features, or record {:.3g} s",
                                     (needed + teeth - 1) / teeth * teeth / mesh_frequency_Hz));
    }
}

// Mesh periods of the sensor signal: those that the study's features need, or the span and a
// record.
int signal_meshes(const RecordLength& length, const FeaturePlan& features,
                  double mesh_frequency_Hz) {
    if (!length.given()) {
        return features.signal_meshes;
    }
    const signals::SpanLayout& span = features.span;
    constexpr int kMostSpans = 100;
    check_record_length(length, span, mesh_frequency_Hz);
    const int turns = whole_turns(length, span, mesh_frequency_Hz);
    if (turns > kMostSpans * span.ring_teeth) {
        throw SceneError("sensor." + std::string(length.key()),
                         fmt::format("is more than {} times the {} mesh periods after which all "
                                     "teeth have met",
                                     kMostSpans, span.meshes()),
                         "shorten the record");
    }
    const int meshes = turns * span.planet_teeth;
    check_covered_features(length, features, meshes, mesh_frequency_Hz);
    return span.meshes() + meshes;
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
    const FaultSide side = study.fault.kind != nullptr && faulty == Member::planet
                               ? study.fault.side
                               : FaultSide::both;
    std::vector<Meetings> all;
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        if (mesh.member_1 != faulty && mesh.member_2 != faulty) {
            continue;
        }
        const Member mate = mesh.member_1 == faulty ? mesh.member_2 : mesh.member_1;
        if ((mate == Member::sun && side == FaultSide::ring) ||
            (mate == Member::ring && side == FaultSide::sun)) {
            continue;
        }
        const int teeth = *teeth_of(study, faulty), mates = *teeth_of(study, mate);
        const int distinct = mates / std::gcd(teeth, mates);
        all.push_back({mate, std::min(distinct, meshes / teeth), distinct});
    }
    return all;
}

std::string shared_text(std::uint64_t gearboxes) {
    return gearboxes > 1
               ? fmt::format(", the same for {} gearboxes that are computed together", gearboxes)
               : "";
}

// Turns of the monitored gear in a record at nominal speed.
int nominal_turns(const RecordPlan& plan) {
    return plan.length ? whole_turns(*plan.length, plan.span, std::abs(plan.mesh_frequency_Hz))
                       : plan.span.ring_teeth;
}

}  // namespace

std::string RecordLength::text() const {
    return seconds ? fmt::format("{:g} s", *seconds)
                   : fmt::format("{:g} carrier turns", *carrier_turns);
}

RecordLength record_length(const Study& study) {
    return {"sensor", study.sensor.record_s, study.sensor.record_turns};
}

RecordLength life_record_length(const Study& study) {
    const RecordLength of_life{"life", study.life.record_s, {}};
    return of_life.given() ? of_life : record_length(study);
}

int whole_turns(const RecordLength& length, const signals::SpanLayout& span,
                double mesh_frequency_Hz) {
    const double turns = meshes_of_record(length, span, mesh_frequency_Hz) / span.planet_teeth;
    return static_cast<int>(std::min(1e6, turns + 1e-9));
}

void check_record_length(const RecordLength& length, const signals::SpanLayout& span,
                         double mesh_frequency_Hz) {
    const std::string key = length.section + "." + length.key();
    if (length.carrier_turns && span.carrier_meshes == 1) {
        throw SceneError(key, "the carrier stands still", "use record_s");
    }
    if (whole_turns(length, span, mesh_frequency_Hz) < kLeastRecordTurns) {
        const double least = kLeastRecordTurns * span.planet_teeth;
        throw SceneError(
            key,
            fmt::format("{:.1f} mesh periods, but windows repeat every {}",
                        meshes_of_record(length, span, mesh_frequency_Hz), span.planet_teeth),
            fmt::format("give at least {} of these, {:.3g} {}", kLeastRecordTurns,
                        least / (length.seconds ? mesh_frequency_Hz : double(span.carrier_meshes)),
                        length.seconds ? "s" : "turns"));
    }
}

double RecordPlan::mesh_period_s(const InstanceInputs& inputs) const {
    return drivetrain->mesh_period_s(inputs.speed_rad_s);
}

std::size_t RecordPlan::turn_samples() const {
    return static_cast<std::size_t>(span.planet_teeth) * static_cast<std::size_t>(samples);
}

int RecordPlan::sensor_meshes(features::SignalSet needs) const {
    return needs_samples(needs) || samples_needed == SampleNeed::signal ? signal_meshes
           : samples_needed == SampleNeed::span                         ? span.meshes()
                                                                        : 0;
}

int RecordPlan::turns(const InstanceInputs& inputs) const {
    return std::clamp(whole_turns(length.value(), span, 1.0 / mesh_period_s(inputs)),
                      kLeastRecordTurns, signal_meshes / span.planet_teeth);
}

RecordPlan make_record_plan(const Study& study, const GearboxPlan& gearbox,
                            const FeaturePlan& features, std::span<const SensorPlan> sensors,
                            int samples, int te_samples) {
    RecordPlan plan;
    plan.span = features.span;
    plan.mesh_frequency_Hz = gearbox.mesh_frequency_Hz;
    plan.samples = samples;
    plan.te_samples = te_samples;
    plan.sources = dynamics::sources(gearbox.bodies.layout);
    plan.planet_sources =
        plan.sources - (housing_bearings(study).empty() ? 0 : dynamics::kBearingSources);
    const RecordLength length = record_length(study);
    plan.signal_meshes = signal_meshes(length, features, std::abs(plan.mesh_frequency_Hz));
    plan.recorded_meshes = plan.signal_meshes;
    if (length.given()) {
        plan.length = length;
        plan.samples_needed = features.sensor ? SampleNeed::signal : SampleNeed::none;
    }
    plan.samples_needed = std::max(plan.samples_needed, samples_of(sensors));
    // A response needs the whole signal.
    const bool responds = samples_of(sensors) == SampleNeed::signal;
    plan.same_window = shares_windows(study) && !responds ? kTileLanes : 1;
    plan.same_positions = is_coupled(study) ? kCoupledLanes : plan.same_window;
    plan.baselines = static_cast<std::size_t>(features.baselines);
    plan.computed_baselines =
        same_baselines(study) ? std::min<std::size_t>(1, plan.baselines) : plan.baselines;
    plan.noise_levels = study.sensor.noise_levels;
    plan.seed = static_cast<std::uint64_t>(study.ensemble.seed);
    plan.drivetrain = gearbox.drivetrain;
    return plan;
}

std::string record_length_text(const RecordPlan& plan) {
    const signals::SpanLayout& span = plan.span;
    const double mesh_Hz = std::abs(plan.mesh_frequency_Hz);
    const int turns = nominal_turns(plan);
    return fmt::format(
        "{:.3g} s: {} turns of {} mesh periods; all teeth that can meet have met after {}{}",
        turns * span.planet_teeth / mesh_Hz, turns, span.planet_teeth,
        span.ring_teeth / std::gcd(span.planet_teeth, span.ring_teeth),
        plan.length ? ", from a random tooth position" + shared_text(plan.same_window) : "");
}

std::string shown_teeth_text(const RecordPlan& plan, const FeaturePlan& features) {
    if (!plan.length || !features.sensor || !features.sun) {
        return "";
    }
    const int meshes = nominal_turns(plan) * plan.span.planet_teeth;
    std::vector<std::string> shown, hidden;
    const auto add = [&](const char* what, int least) {
        (least <= meshes ? shown : hidden)
            .push_back(fmt::format("{} (from {} mesh periods, {:.3g} s)", what, least,
                                   least / std::abs(plan.mesh_frequency_Hz)));
    };
    const auto central = [&](Member gear) {
        return signals::fewest_turns(features.teeth[gear], plan.span.carrier_meshes).meshes();
    };
    add("planet teeth", kLeastRecordTurns * plan.span.planet_teeth);
    add("ring teeth", central(Member::ring));
    add("sun teeth", central(Member::sun));
    add("frms", 2 * plan.span.carrier_meshes);
    return fmt::format(
        "{}{}", fmt::join(shown, ", "),
        hidden.empty() ? "" : fmt::format("; too short for {}", fmt::join(hidden, ", ")));
}

RecordFacts record_facts(const Study& study) {
    if (!has_gears(study)) {
        return {};
    }
    const auto drivetrain = make_drivetrain(study);
    const signals::SpanLayout span = drivetrain->span();
    const double mesh_Hz = std::abs(nominal_mesh_frequency_Hz(study, *drivetrain));
    const RecordLength length = record_length(study);
    const int turns = length.given() ? whole_turns(length, span, mesh_Hz) : span.ring_teeth;
    const int meshes = turns * span.planet_teeth;
    std::vector<std::string> mates;
    for (const Meetings& meetings : meetings_in(study, meshes)) {
        mates.push_back(fmt::format("{} of the {} {} teeth that it can meet ({:.0f} %)",
                                    meetings.met, meetings.all, member_name(meetings.mate),
                                    100.0 * meetings.met / meetings.all));
    }
    RecordFacts facts;
    facts.conditions = fmt::format(
        "A record lasts {:.3g} s{}, in which {} tooth meets {}.", meshes / mesh_Hz,
        length.given() ? " and begins at a random tooth position" +
                             shared_text(shares_windows(study) ? kTileLanes : 1)
                       : " by default (sensor.record_s)",
        study.fault.kind != nullptr && !study.fault.kind->wears_flanks() ? "the faulty" : "a",
        fmt::join(mates, " and "));
    if (const std::optional<double> interval_h = record_interval_h(study)) {
        facts.conditions += fmt::format(" There are {:g} h between two records.", *interval_h);
    }
    if (turns < span.ring_teeth) {
        facts.longer = fmt::format(
            "take longer records: these have {} turns of the {} in {:.3g} s, those without "
            "sensor.{} "
            "{} turns in {:.3g} s",
            turns, study.gearbox.kind == GearboxKind::planetary ? "planet" : "pinion",
            meshes / mesh_Hz, length.key(), span.ring_teeth, span.meshes() / mesh_Hz);
    }
    return facts;
}

}  // namespace gearpod::mc
