#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/text_lines.hpp"
#include "lockstep/integrators/facts.hpp"
#include "machine/stop.hpp"
#include "machine/wall_clock.hpp"
#include "mc/commands/support.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/forecast/describe_effects.hpp"
#include "mc/forecast/describe_forecast.hpp"
#include "mc/forecast/effect_costs.hpp"
#include "mc/gearbox/march_cache.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/gearbox/tile_draws.hpp"
#include "mc/input/printable.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

std::string joined(const std::vector<std::string>& texts) {
    return fmt::format("{}", fmt::join(texts, " "));
}

void print_planetary(const PlanetaryDrive& drive) {
    const auto& train = drive.train();
    print_entry("teeth (sun/planet/ring)",
                fmt::format("{}/{}/{}, {} planets", train.sun_teeth, train.planet_teeth,
                            train.ring_teeth, train.planets));
    std::vector<std::string> sun, ring;
    for (int n = 0; n < train.planets; ++n) {
        sun.push_back(fmt::format("{:.4g}", gears::sun_mesh_phase(train, n, drive.sense())));
        ring.push_back(fmt::format("{:.4g}", gears::ring_mesh_phase(train, n, drive.sense())));
    }
    if (!train.positions_rad.empty()) {
        const gears::PlanetPlaces places = gears::planet_places(train);
        std::vector<std::string> positions;
        for (int n = 0; n < train.planets; ++n) {
            positions.push_back(
                fmt::format("{:.6g}", gears::planet_angle(places, n) * 180.0 / std::numbers::pi));
        }
        print_entry("planet positions", joined(positions) + " deg");
    }
    print_entry("mesh phases, sun", joined(sun));
    print_entry("mesh phases, ring",
                fmt::format("{}; ring to sun {:g}", joined(ring), drive.ring_to_sun_phase()));
}

void print_fixed_shaft(const Study& study) {
    const int pinion = *teeth_of(study, Member::pinion), gear = *teeth_of(study, Member::gear);
    print_entry("teeth (pinion/gear)", fmt::format("{}/{}", pinion, gear));
    const InstanceInputs nominal = Sampler(study).nominal();
    const double balanced = nominal.torque_N_m * gear / pinion;
    const double load = nominal.fixed_shaft.load_torque_N_m;
    if (std::abs(load - balanced) > 1e-6 * balanced) {
        print_entry("torques out of balance",
                    fmt::format("the load takes {:g} N m, {:.4g} N m would balance the motor; the "
                                "speed is kept, only the vibration feels the difference",
                                load, balanced));
    }
}

// A rack leaves no involute below its form circle: flanks that are touched deeper rub in the
// fillet.
void print_fillet_warnings(const MeshMembers& members, const gears::MeshGeometry& mesh) {
    for (const int which : {1, 2}) {
        const gears::Gear& gear = mesh.gear(which);
        const double lowest = mesh.contact_radius(which, which == 1 ? 0.0 : mesh.contact_ratio());
        if (!gear.internal && lowest < gear.form_radius()) {
            print_entry("fillet interference",
                        fmt::format("the {} is touched down to a diameter of {:.4f} mm, but the "
                                    "fillet that a rack leaves begins at {:.4f} mm (a tip circle "
                                    "of its mate farther away avoids it)",
                                    member_name(which == 1 ? members.driver : members.driven),
                                    2e3 * lowest, 2e3 * gear.form_radius()));
        }
    }
}

// Shifts, and what follows from them; nothing for standard gears.
void print_shifts(const Scene& scene) {
    const Study& study = scene.study();
    if (!shift_given(study)) {
        return;
    }
    std::string shifts;
    for (const Member member : kAllMembers) {
        if (has_toothed_member(study.gearbox.kind, member)) {
            const gears::Gear gear = gear_of(study, member);
            shifts += fmt::format(
                "{}{} {:.4f}, tip {:.4f} mm ({:.3f} mm thick)", shifts.empty() ? "" : "; ",
                member_name(member), gear.profile_shift / normal_over_transverse(study.gearbox),
                2e3 * gear.tip_radius(), 1e3 * gear.thickness_at(gear.tip_radius()));
        }
    }
    print_entry("profile shifts", shifts);
    print_entry("centre distance", fmt::format("{:.6g} mm", 1e3 * centre_distance_m(study)));
    for (const SceneMesh& mesh : scene.meshes()) {
        if (mesh.geometry) {
            const gears::MeshGeometry& g = *mesh.geometry;
            print_entry((mesh_name(mesh.members) + " works at").c_str(),
                        fmt::format("{:.4f} deg, backlash {:.4f} mm, tip clearances {:.3f} and "
                                    "{:.3f} mm",
                                    g.working_pressure_angle() * 180.0 / std::numbers::pi,
                                    1e3 * g.backlash(), 1e3 * g.tip_clearance(1),
                                    1e3 * g.tip_clearance(2)));
            print_fillet_warnings(mesh.members, g);
        }
    }
}

// What a helical pair's contact ratio consists of.
std::string helical_parts(const stiffness::MeshStiffness& mesh) {
    const double transverse = mesh.slice().contact_ratio();
    return transverse < mesh.contact_ratio()
               ? fmt::format(" (transverse {:.4f}, overlap {:.4f})", transverse,
                             mesh.contact_ratio() - transverse)
               : "";
}

void print_gearbox(const Scene& scene) {
    print_heading("gearbox");
    if (const auto* planetary = dynamic_cast<const PlanetaryDrive*>(&scene.drive())) {
        print_planetary(*planetary);
    } else {
        print_fixed_shaft(scene.study());
    }
    print_shifts(scene);
    for (const SceneMesh& mesh : scene.meshes()) {
        print_entry(
            (mesh_name(mesh.members) + " mesh").c_str(),
            fmt::format("contact ratio {:.4f}{}, mean {:.4g} N/m", mesh.stiffness->contact_ratio(),
                        helical_parts(*mesh.stiffness), mean_total(*mesh.stiffness)));
    }
    print_entry("mesh frequency", fmt::format("{:.4f} Hz", scene.nominal_mesh_frequency_Hz()));
}

// Lengths of the steps, and where the short ones lie.
void print_steps(const Scene& scene) {
    const lockstep::PhaseGrid& grid = scene.plan().grid;
    const auto [shortest, longest] = std::minmax_element(grid.lengths.begin(), grid.lengths.end());
    print_entry("step lengths", fmt::format("{:.3g} to {:.3g} mesh periods, {} different ones",
                                            *shortest, *longest, grid.lengths.size()));
    if (!scene.calibration()) {
        return;
    }
    const Calibration& how = *scene.calibration();
    const Numerics& n = scene.study().numerics;
    if (how.estimated) {
        print_entry("calibrated by", fmt::format("a pilot of {}: estimated error of a step {:g} of "
                                                 "the largest motion",
                                                 lockstep::kPilotLanes, n.step_tolerance));
    } else {
        print_entry("calibrated by",
                    fmt::format("a pilot of {}: signals within {:.2g} rms (allowed: {:g})",
                                lockstep::kPilotLanes, how.signal_error, n.grid_tolerance));
        print_entry("graded",
                    fmt::format("{:.3g} after a transition, then up to {:g} of the phase "
                                "since it, at most {:.3g}",
                                how.grading.first, how.grading.growth, how.grading.longest));
    }
    std::vector<double> since;
    for (const lockstep::Step& step : grid.steps) {
        since.push_back(lockstep::since_transition(scene.transitions(), step.phase));
    }
    std::sort(since.begin(), since.end());
    print_entry("where fine",
                fmt::format("half of the steps begin within {:.3g} mesh periods after "
                            "a transition",
                            since[since.size() / 2]));
}

// Whether the healthy gearboxes suffice for the false-alarm rate: known before anything is
// computed.
void print_false_alarms(const Study& study) {
    const double rate = study.detection.false_alarm_rate, confidence = study.detection.confidence;
    const long healthy = study.ensemble.threshold_instances;
    print_heading("false alarms");
    const std::string shortage =
        analysis::sample_shortage(healthy, rate, confidence, analysis::Subject::gearboxes);
    if (!shortage.empty()) {
        std::string text;
        analysis::add_wrapped(text, shortage, 2);
        fmt::print("{}", text);
        return;
    }
    const analysis::Interval found = analysis::threshold_rate_interval(healthy, rate, confidence);
    print_entry("rate", fmt::format("{:g}; {} healthy gearboxes fix it to between {:.2g} and "
                                    "{:.2g} at {:g} % confidence",
                                    rate, healthy, found.lower, found.upper, 100.0 * confidence));
}

// Beside a step without them; path, noise, tones and encoders work on signals, not in steps.
void print_effect_costs(const Study& study) {
    for (const EffectCost& cost : effect_costs(study)) {
        print_entry(("cost of " + cost.effect).c_str(),
                    fmt::format("{:.0f} % of a plain step of rk4", 100.0 * cost.share));
    }
}

void print_cost(const Scene& scene, const std::optional<NumericsChoice>& choice) {
    const Study& study = scene.study();
    const auto& plan = scene.plan();
    print_heading("cost");
    print_entry("degrees of freedom", std::to_string(dynamics::degrees_of_freedom(plan.layout)));
    print_entry("samples a mesh period",
                study.effects.quasi_static()
                    ? fmt::format("{} (encoders)", scene.te_samples_per_mesh())
                    : fmt::format("{} (sensor), {} (encoders)", scene.samples_per_mesh(),
                                  scene.te_samples_per_mesh()));
    print_entry("sampling rate", fmt::format("{:.1f} Hz", scene.samples_per_mesh() *
                                                              scene.nominal_mesh_frequency_Hz()));
    if (!study.effects.quasi_static()) {
        const std::string least =
            scene.least_steps() > 1 ? fmt::format(" (at least {})", scene.least_steps()) : "";
        print_entry("steps a mesh period", fmt::format("{}{}, {}", plan.grid.steps.size(), least,
                                                       lockstep::name(plan.integrator)));
    }
    print_effect_costs(study);
    if (choice) {
        print_entry("chosen for the tolerance", choice->text());
    }
    if (scene.study().numerics.grid == StepGrid::graded || scene.calibration()) {
        print_steps(scene);
    }
    if (plan.precision == lockstep::Precision::single_precision) {
        print_entry("precision",
                    fmt::format("single within a mesh period, double between; orbits settle to "
                                "{:g} (asked for: {:g})",
                                settle_tolerance(study), study.numerics.settle_tolerance));
    }
    print_entry("mesh periods marched",
                fmt::format("about {:.0f} of the {} looked at{}", marched_meshes(scene),
                            scene.span_meshes(),
                            compares_records(study) ? ", and those of the baseline record" : ""));
    print_entry("gearboxes",
                fmt::format("{} graded and {} for the thresholds, {} noise levels",
                            study.ensemble.instances, study.ensemble.threshold_instances,
                            study.sensor.noise_levels.size()));
    const std::optional<std::size_t> distinct = distinct_marches(scene);
    print_entry("distinct motions",
                distinct ? fmt::format("{}; gearboxes that differ in path exponent and noise alone "
                                       "share one march",
                                       *distinct)
                         : "every gearbox moves differently");
    if (!Ranks::of_mpi()) {
        print_entry("processes", "built without MPI: one process");
    }
}

// What takes longer is left out.
class Deadline final : public machine::StopWish {
  public:
    static constexpr int kSeconds = 7;

    bool stop() const override { return seconds_since(start_) > kSeconds; }

  private:
    const WallClock::time_point start_ = WallClock::now();
};

void print_left_out(const char* what) {
    fmt::print("\nleft out, because {} s are over: {}\n", Deadline::kSeconds, what);
}

// All keys, or those that a word is found in.
int print_keys(const std::string& word) {
    const std::string keys = schema_help(word);
    if (keys.empty()) {
        fmt::print(stderr,
                   "--keys {}: in no section, name or explanation; give a word like sensor or "
                   "stiffness, or a section: {}\n",
                   printable(word), fmt::join(section_names(), ", "));
        return kBadInput;
    }
    fmt::print("{}", keys);
    return kDone;
}

}  // namespace

int describe_command(const DescribeOptions& options) {
    // Processor time so far: loading the program.
    const double begun_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    if (options.keys) {
        return print_keys(options.study.path);
    }
    const auto study = load_study(options.study);
    if (!study) {
        return kBadInput;
    }
    fmt::print("# the resolved study\n{}", resolved_text(*study));
    if (!has_gears(*study)) {
        fmt::print("\nno tooth numbers: only modes are defined\n");
        return kDone;
    }
    print_false_alarms(*study);
    std::fflush(stdout);
    const Deadline deadline;
    const auto start = WallClock::now();
    const char* missing =
        "gearbox, effects, cost and forecast; the numerics are chosen by a pilot (numerics)";
    try {
        const auto made = load_scene(options.study);
        if (!made) {
            return kBadInput;
        }
        const double setup_s = seconds_since(start);
        const Scene& scene = *made.scene;
        print_gearbox(scene);
        print_effects(scene);
        missing = "cost and forecast";
        print_cost(scene, made.choice);
        std::fflush(stdout);
        missing = "the forecast, for which gearboxes and their analysis are computed";
        print_forecast(scene, begun_s + setup_s);
    } catch (const machine::Stopped&) {
        print_left_out(missing);
    }
    return kDone;
}

}  // namespace gearpod::mc
