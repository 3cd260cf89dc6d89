#include "mc/report/description/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "analysis/report/false_alarm_text.hpp"
#include "features/feature.hpp"
#include "lockstep/integrators/facts.hpp"
#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/python/python_worker.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

struct DescribeOptions {
    StudyOptions study;
    bool keys = false;  // print the keys of study files instead
    bool full = false;  // print all settings, loads, effects and costs, not only the first screen
    int ranks = 0;      // also forecast a run with this many MPI ranks; 0: do not
    // Processor seconds of each thread for the forecast; then it falls back on step counts.
    double seconds = 30.0;
};

// Prints the lengths of graded time steps and where the short ones lie.
void print_steps(const lockstep::PhaseGrid& grid, const Calibration& how,
                 const std::vector<double>& transitions, double tolerance) {
    const auto [shortest, longest] = std::minmax_element(grid.lengths.begin(), grid.lengths.end());
    print_entry("step lengths", fmt::format("{:.3g} to {:.3g} mesh periods, {} different lengths",
                                            *shortest, *longest, grid.lengths.size()));
    print_entry("calibrated by",
                fmt::format("pilot run of {} gearboxes: signal error {:.2g} rms (allowed: {:g})",
                            lockstep::kPilotLanes, how.signal_error, tolerance));
    print_entry("graded steps",
                fmt::format("{:.3g} after a transition, then up to {:g} of the phase since the "
                            "transition, never more than {:.3g}",
                            how.grading.first, how.grading.growth, how.grading.longest));
    std::vector<double> since;
    for (const lockstep::Step& step : grid.steps) {
        since.push_back(lockstep::since_transition(transitions, step.phase));
    }
    std::sort(since.begin(), since.end());
    print_entry("short steps",
                fmt::format("half of the steps begin within {:.3g} mesh periods after a "
                            "transition",
                            since[since.size() / 2]));
}

void print_python_features(const std::vector<PythonFeature>& all) {
    if (all.empty()) {
        return;
    }
    print_heading("features in Python");
    for (const PythonFeature& python : all) {
        const features::Feature& feature = *python.feature;
        print_entry(std::string(feature.name),
                    fmt::format("{}unit {}, {} values alarm; {}",
                                feature.title.empty() ? "" : std::string(feature.title) + "; ",
                                feature.unit, analysis::alarm_name(feature.alarm), python.file));
    }
}

void print_cost(const GearboxPlan& gearbox, const SolvePlan& solve, const RecordPlan& record,
                const FeaturePlan& features, const EnsemblePlan& ensemble, const Numerics& numerics,
                const std::optional<NumericsChoice>& choice) {
    const lockstep::IntegrationPlan& plan = solve.integration();
    print_heading("cost");
    print_entry("degrees of freedom", std::to_string(dynamics::degrees_of_freedom(plan.layout)));
    print_entry("samples per mesh period",
                solve.settings.quasi_static
                    ? fmt::format("{} (encoders)", record.te_samples)
                    : fmt::format("{} (sensor), {} (encoders)", record.samples, record.te_samples));
    print_entry("sampling rate",
                fmt::format("{:.1f} Hz", record.samples * record.mesh_frequency_Hz));
    if (!solve.settings.quasi_static) {
        const std::string least =
            solve.stepping().least > 1 ? fmt::format(" (at least {})", solve.stepping().least) : "";
        print_entry("steps per mesh period", fmt::format("{}{}, {}", plan.grid.steps.size(), least,
                                                         lockstep::name(plan.integrator)));
    }
    if (const lockstep::ModeInertia& inertia = plan.mode_inertia; inertia.modes > 0) {
        print_entry(
            "selective mass scaling",
            fmt::format("{} natural modes of up to {:.0f} Hz have so much more inertia that "
                        "they lie at {:g} Hz",
                        inertia.modes, inertia.fastest_rad_s / (2.0 * std::numbers::pi),
                        numerics.mass_scaling_Hz));
    }
    if (choice) {
        print_entry("chosen for the tolerance", choice->text());
    }
    if (const int pairs = numerics.paired_gearboxes; pairs > 0) {
        print_entry(
            "computed twice",
            fmt::format("up to {} healthy and {} faulty gearboxes after the run, to correct "
                        "for the error of the steps",
                        pairs, pairs));
    }
    if (const auto& calibration = solve.steps->calibration) {
        print_steps(plan.grid, *calibration, gearbox.stiffness->transitions(),
                    numerics.grid_tolerance);
    }
    if (plan.precision == lockstep::Precision::single_precision) {
        print_entry("precision", "single within a mesh period, double between mesh periods");
        print_entry("convergence",
                    fmt::format("to the periodic orbit within {:g} (requested: {:g})",
                                solve.convergence.tolerance, numerics.convergence_tolerance));
    }
    print_entry("record", record_length_text(record));
    if (const std::string shown = shown_teeth_text(record, features); !shown.empty()) {
        print_entry("shown by a record", shown);
    }
    print_entry("mesh periods integrated",
                fmt::format("about {:.0f}{}; the signals span {}{}{}", solve.integrated_meshes,
                            integrated_records_text(record, solve), record.span.meshes(),
                            std::holds_alternative<Superposed>(solve.strategy)
                                ? fmt::format("; {:.0f} without the fault", solve.healthy_meshes)
                                : "",
                            record.baselines > 0 ? "; more for the baseline record" : ""));
    print_entry(
        "gearboxes",
        fmt::format(
            "{} to test and {} for the thresholds{}, {} noise level{}", ensemble.test_gearboxes,
            ensemble.threshold_gearboxes,
            ensemble.threshold_records > 1
                ? fmt::format(" ({} {}records of each)", ensemble.threshold_records,
                              ensemble.request.importance_sampling ? "exponentially tilted " : "")
                : "",
            record.noise_levels.size(), record.noise_levels.size() == 1 ? "" : "s"));
    const std::optional<std::size_t> distinct = solve.settings.distinct_integrations;
    print_entry("distinct solutions",
                distinct ? fmt::format("{}; gearboxes that differ only in path exponent and noise "
                                       "share one time integration",
                                       *distinct)
                         : "every gearbox needs its own time integration");
    if (!Ranks::built_with_mpi()) {
        print_entry("processes", "built without MPI: one process");
    }
}

// Processor seconds that this process has used, and time for which it waited for Python.
double processor_s() {
    timespec used{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec) +
           PythonWorker::waited_s();
}

// Share of the processor seconds for measuring effects, and of that after which no effect begins.
constexpr double kEffectsShare = 1.0 / 3.0, kLastEffect = 0.5;

// Stops a description that takes more processor time. Other programs do not shorten it.
class Deadline final : public machine::CancellationSource {
  public:
    explicit Deadline(double seconds) : end_s_(processor_s() + seconds) {}

    bool stop() const override { return processor_s() > end_s_; }

  private:
    const double end_s_;
};

void print_omitted(const char* what, double seconds, const char* unit) {
    print_heading("not computed");
    print_paragraph(fmt::format(
        "{}: it needs more than {:g} s of processor time{}; raise --seconds", what, seconds, unit));
}

void print_description(const Planner& planner, const Numerics& numerics) {
    for (const DescriptionSection& section : planner.description(numerics)) {
        print_section(section);
    }
}

// Forecast where the budget is used up. `chosen`: false if the pilot run that chooses the solver
// setting took too long.
void print_fallback(const Planner& planner, bool chosen, double setup_s, int ranks,
                    const PeakMemory& memory) {
    try {
        const Numerics numerics = without_tolerance(planner.facts().numerics);
        const TilePlan tile = planner.tile(numerics);
        if (!chosen) {
            print_entry("solver setting", "the default, not the one that a pilot run would choose");
        }
        if (const StudyLives lives = planner.lives(numerics); lives.plan) {
            print_lives_forecast(tile, *lives.plan, setup_s, ranks, false);
        } else {
            print_step_forecast(tile, planner.ensemble(numerics), memory);
        }
    } catch (const SceneError& error) {
        print_problems({{"", 0, error.key(), error.what(), error.remedy()}});
    }
}

// Prints all keys, or those where a word of section, name or explanation begins with `word`.
int print_keys(const std::string& word) {
    const std::string keys = schema_help(word);
    if (keys.empty()) {
        fmt::print(stderr,
                   "--keys {}: no word of a section, key or explanation begins with it; give a "
                   "word like sensor or stiffness, or a section: {}\n",
                   printable(word), fmt::join(section_names(), ", "));
        return kBadInput;
    }
    fmt::print("{}", keys);
    return kDone;
}

// Entries of the first screen (print_first_screen).
const std::set<std::string> kScreen = {"false alarms: in time",
                                       "false alarms: gearboxes per size",
                                       "false alarms: false-alarm rate",
                                       "false alarms: ",
                                       "gearbox: teeth (sun/planet/ring)",
                                       "gearbox: teeth (pinion/gear)",
                                       "gearbox: mesh frequency",
                                       "gearbox: fault sizes",
                                       "gearbox: check the torque",
                                       "effects simulated: names",
                                       "effects omitted: names",
                                       "lives: gearboxes",
                                       "lives: refused by `lives`",
                                       "cost: record",
                                       "cost: gearboxes",
                                       "not computed: ",
                                       "forecast of a run: time integration",
                                       "forecast of a run: memory",
                                       "forecast of a run: estimated time",
                                       "forecast of a run: estimated memory",
                                       "forecast of lives: records of a crack",
                                       "forecast of lives: estimated time",
                                       "forecast of lives: estimated memory",
                                       "forecast for MPI ranks: *",
                                       "what the effects change: ",
                                       "what the effects change: *"};

int describe_study(const DescribeOptions& options) {
    // Processor time used so far to load the program.
    const double begun_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    if (options.keys) {
        return print_keys(options.study.path);
    }
    const auto study = load_study(options.study);
    if (!study) {
        return kBadInput;
    }
    if (options.full) {
        fmt::print("# the resolved study, with all defaults\n{}",
                   wrapped_study(resolved_text(*study)));
    } else {
        print_first_screen(kScreen);
        fmt::print("{}\n", wrapped_text(printable(study->title), 2));
    }
    if (!has_gears(*study)) {
        fmt::print("\nthe study has no tooth numbers: only `gearpod modes` can use it\n");
        return kDone;
    }
    const Planner planner(*study);
    print_section(false_alarm_description(*study));
    std::fflush(stdout);
    const auto start = WallClock::now();
    const char* missing = "solver setting and cost, which a pilot run chooses";
    std::optional<Planner> chosen;  // with the chosen numerics
    PeakMemory memory{.setup_bytes = peak_memory_bytes()};
    double setup_s = begun_s;
    double before_bytes = std::numeric_limits<double>::infinity();  // before the forecast
    try {
        const Deadline deadline(options.seconds * std::max(1, thread_count(EnsemblePlan(*study))));
        const auto made = make_scene(options.study);
        if (!made) {
            print_problems(made.problems);
            return kBadInput;
        }
        setup_s = begun_s + seconds_since(start);
        const Scene& scene = *made.scene;
        chosen = made.planner;
        memory.setup_bytes = peak_memory_bytes();
        print_python_features(scene.features().python);
        const Numerics& numerics = chosen->facts().numerics;
        print_description(*chosen, numerics);
        print_life(scene.lives());
        missing = "cost";
        print_cost(scene.gearbox(), scene.solve(), scene.record(), scene.features(),
                   scene.ensemble(), numerics, made.choice);
        std::fflush(stdout);
        missing = "computing some gearboxes and their analysis for the forecast";
        before_bytes = peak_memory_bytes();
        if (scene.lives().plan) {
            print_lives_forecast(scene.tile(), scene.life(), setup_s, options.ranks, true);
        } else {
            print_forecast(scene, *chosen, setup_s, options.ranks);
        }
    } catch (const SceneError& error) {  // the records of some gearbox are too short
        print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
        return kBadInput;
    } catch (const machine::Cancelled&) {
        if (!chosen) {
            print_description(planner, without_tolerance(planner.facts().numerics));
        }
        print_omitted(missing, options.seconds, " of each thread");
        const double now_bytes = peak_memory_bytes();
        memory.computed_bytes = now_bytes > before_bytes ? now_bytes : 0.0;
        print_fallback(chosen.value_or(planner), chosen.has_value(), setup_s, options.ranks,
                       memory);
        return kDone;
    }
    std::fflush(stdout);
    const double budget_s = kEffectsShare * options.seconds;
    try {
        const Deadline deadline(budget_s);
        const RecordPlan record = chosen->tile(chosen->facts().numerics).record;
        print_effect_changes(planner, record.span, record.mesh_frequency_Hz,
                             kLastEffect * budget_s);
    } catch (const machine::Cancelled&) {
        print_omitted("measuring what further effects change", budget_s, "");
    } catch (const SceneError& error) {
        print_heading("what the effects change");
        print_entry("not measured", error.key() + ": " + error.what());
    }
    return kDone;
}

int describe_command(const DescribeOptions& options) {
    const int code = describe_study(options);
    if (code == kDone && !options.full && !options.keys) {
        fmt::print("\nall settings, loads, effects and costs:\n  gearpod describe {} --full\n",
                   printable(options.study.path));
    }
    return code;
}

}  // namespace

void add_describe(CLI::App& app, int& code) {
    const auto options = std::make_shared<DescribeOptions>();
    auto* command = app.add_subcommand(
        "describe",
        "print what a study simulates and omits, and the estimated time and memory of a run; "
        "computes for up to --seconds and writes nothing");
    add_study(*command, options->study)->required(false);
    command->add_flag(
        "--keys", options->keys,
        "print all keys of study files; `describe --keys WORD`: those with a word that begins so");
    command->add_flag("--full", options->full,
                      "print all settings, loads, effects and costs, not only the first screen");
    add_number(*command, "--ranks", options->ranks,
               "also forecast a run with this many MPI ranks: time, memory per rank, disk, and the "
               "number of ranks from which rank 0 limits the speed",
               from_to(1, 1e6));
    add_number(
        *command, "--seconds", options->seconds,
        "processor seconds of each thread for the description, 30 by default; if they do not "
        "suffice, the forecast is from the number of time steps alone",
        from_to(0.1, 1e5));
    command->callback([options, &code] {
        if (options->study.path.empty() && !options->keys) {
            throw CLI::RequiredError("study");
        }
        code = describe_command(*options);
    });
}

}  // namespace gearpod::mc
