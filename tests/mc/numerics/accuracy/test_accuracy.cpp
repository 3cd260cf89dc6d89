// Checks the error and cost of solver settings: errors against closed forms and an independent
// method, and the choice of numerics.tolerance.
#include "mc/library/run/run_options.hpp"
#include "mc/numerics/accuracy/report.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "tests/mc/program_json.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_accuracy {

using namespace test;

// Tian's cracked pinion with a sensor of narrower band, to reduce computation time.
const std::vector<std::string> kNarrow{"sensor.sampling_Hz=17100", "sensor.low_pass_Hz=7695",
                                       "sensor.encoder_sampling_Hz=17100"};

Study tian(const std::vector<std::string>& more = {}) {
    return shipped_study("published/tian-fig-4-9.toml", joined(more, kNarrow));
}

ResolvedNumerics resolved_tian(const std::vector<std::string>& more) {
    const Study study = tian(more);
    return resolve_numerics(Planner(study), study.numerics);
}

Reference tian_reference() {
    const Study study = tian();
    ReferenceRequest request;
    request.agreement = 1e-6;
    return converged_reference(Pilot(Planner(study)), study.numerics, request);
}

PilotRecord record(std::vector<double> sensor, std::vector<double> te,
                   std::vector<double> features) {
    PilotRecord r;
    r.ok = {true};
    r.sensor = {std::move(sensor)};
    r.te = {std::move(te)};
    r.features_used = static_cast<int>(features.size());
    r.features = {std::move(features)};
    r.levels = 1;
    return r;
}

TEST_CASE("errors of a pilot are relative L2 norms") {
    const PilotRecord reference = record({3.0, 4.0}, {1.0, -1.0}, {10.0, -2.0});
    const PilotRecord other = record({3.0, 4.5}, {1.0, -1.0}, {10.1, -2.0});
    const PilotError error = pilot_error(other, reference);
    CHECK(error.sensor == Approx(0.5 / 5.0));
    CHECK(error.te == 0.0);
    CHECK(error.feature(0, 1) == Approx(0.01));
    CHECK(error.feature(1, 1) == 0.0);
    CHECK(error.largest_feature() == Approx(0.01));
    CHECK(error.largest[0] == Approx(0.1));

    PilotRecord failed = other;
    failed.ok = {false};
    CHECK(std::isinf(pilot_error(failed, reference).sensor));
    CHECK(std::isinf(pilot_error(failed, reference).largest_feature()));
}

TEST_CASE("the reference is the limit of two independent methods", "[accuracy]") {
    const Reference reference = tian_reference();
    CHECK(reference.reached);
    CHECK(reference.first.integrator() != reference.second.integrator());
    CHECK(reference.agreement.signals() <= 1e-6);
    CHECK(reference.agreement.sensor > 0.0);
}

TEST_CASE("Single and double precision agree except for rounding", "[accuracy]") {
    const auto yang = [](std::vector<std::string> more) {
        more.insert(more.end(), {"numerics.integrator=rk4", "numerics.steps_per_mesh=384"});
        return shipped_study("published/yang-fig-15.toml", more);
    };
    const Study study = yang({});
    const Numerics doubles = study.numerics, singles = yang({"numerics.precision=single"}).numerics;
    const Pilot pilot{Planner(study)};
    const PilotRecord first = pilot.run(doubles), second = pilot.run(singles);
    CHECK(second.sensor.size() == first.sensor.size());
    const PilotError error = pilot_error(second, first);
    CHECK(error.sensor > 0.0);
    CHECK(error.sensor < 1e-3);
    CHECK(error.te < 1e-3);
    CHECK(error.largest_feature() < 1e-3);
}

TEST_CASE("numerics.tolerance keeps the features and reduces the cost", "[accuracy]") {
    const Reference reference = tian_reference();
    const Planner planner(tian());
    const Pilot pilot(planner);
    const PilotRecord before = pilot.run(planner.facts().numerics);
    double cost = std::numeric_limits<double>::infinity();
    for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
        const ResolvedNumerics resolved =
            resolved_tian({"numerics.tolerance=" + std::to_string(tolerance)});
        REQUIRE(resolved.choice.has_value());
        const PilotRecord found = pilot.run(resolved.numerics);
        CHECK(pilot_error(found, reference.record).largest_feature() <= 1.1 * tolerance);
        const NumericsChoice& choice = *resolved.choice;
        CHECK(choice.error <= tolerance);
        CHECK(choice.cost <= cost);  // a looser tolerance never costs more
        cost = choice.cost;
    }
    SolverSetting sdirk3 = own_setting(planner.facts().numerics);
    sdirk3.numerics.integrator = lockstep::Integrator::sdirk3;
    CHECK(cost < 0.3 * step_cost(planner.facts(), sdirk3).value() * before.steps *
                     before.meshes_per_tile());
}

TEST_CASE("a tolerance leads to the same choice on any lanes and instruction set", "[accuracy]") {
    const NumericsChoice choice = *resolved_tian({"numerics.tolerance=1e-3"}).choice;
    for (const char* other : {"numerics.lanes=1", "numerics.instruction_set=baseline"}) {
        const NumericsChoice again = *resolved_tian({"numerics.tolerance=1e-3", other}).choice;
        CHECK(again.setting.text() == choice.setting.text());
        CHECK(again.error == choice.error);
    }
}

static Study resolved(Study study) {
    study.numerics = resolve_numerics(Planner(study), study.numerics).numerics;
    return study;
}

TEST_CASE("a study with its choice written out leads to the same choice", "[accuracy]") {
    const Study study = resolved(tian({"numerics.tolerance=1e-3"}));
    check_reads_back(study);
    CHECK(resolved(study) == study);
}

TEST_CASE("A study in single precision is compared with double precision too", "[accuracy]") {
    const auto listed =
        listed_settings(Planner(tian({"numerics.integrator=rk4", "numerics.precision=single"})));
    CHECK(std::ranges::any_of(listed, [](const ListedSetting& one) {
        return one.setting.numerics.precision == Precision::double_precision;
    }));
}

TEST_CASE("a tolerance that the given steps cannot meet is refused", "[accuracy]") {
    const Study study = tian(
        {"numerics.tolerance=1e-3", "numerics.integrator=newmark", "numerics.steps_per_mesh=120"});
    CHECK_THROWS_AS(resolved_plan(study), SceneError);
    CHECK_THROWS_WITH(resolved_plan(study),
                      Catch::Contains("no solver setting keeps the features within 0.001"));
}

// The error of Newmark decreases as the square of the step: four times the steps leave a sixteenth.
TEST_CASE("the numerical error from finer steps equals the error against a reference",
          "[accuracy]") {
    const Study study = tian(
        {"numerics.verify=true", "numerics.integrator=newmark", "numerics.steps_per_mesh=480"});
    const Planner planner(study);
    const auto found = find_numerical_error(planner);
    REQUIRE(found.has_value());
    CHECK(found->gearboxes == 8);
    // The study has two kinds of gearboxes, and both pilots contain them.
    const Pilot pilot(planner);
    const PilotError error = pilot_error(pilot.run(study.numerics), tian_reference().record);
    const auto& use = study.features.use;
    const auto rms =
        static_cast<std::size_t>(std::find(use.begin(), use.end(), "sensor_rms") - use.begin());
    CHECK(found->rms[rms] == Approx(error.rms[rms]).epsilon(0.15));
    CHECK(found->largest[rms] >= found->rms[rms]);
    CHECK_FALSE(find_numerical_error(Planner(tian())).has_value());
}

TEST_CASE("the share of decisions that the numerical error could change is counted", "[accuracy]") {
    Results r;
    r.parameters = {{"fault_depth_m", "m", {}}};
    r.noise_levels = {1.0};
    r.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    r.request = {0.05, 0.95, {1.0}, {{0.001, 0.001}}, {"fault_depth_m", "m"}};
    for (int i = 0; i < 100; ++i) {  // healthy: 0, 0.01, ...; faulty: 0.5, 0.51, ...
        r.group.push_back(static_cast<int>(Group::threshold));
        r.parameters[0].values.push_back(0.0);
        r.features[0].values.push_back(0.01 * i);
    }
    for (int i = 0; i < 100; ++i) {
        r.group.push_back(static_cast<int>(Group::test));
        r.parameters[0].values.push_back(0.001);
        r.features[0].values.push_back(0.5 + 0.01 * i);
    }
    r.status.assign(r.group.size(), 0);
    analysis::LevelDetection level;
    level.noise_level = 1.0;
    level.threshold = 0.955;
    level.cells = {{{0.001, 0.001}, 100, 54, 0, 0.54, 0.44, 0.64, {}}};
    r.detection = {{"te_rms", analysis::Alarm::high, {level}, {}}};
    // Decisions within 2 x 0.01 of 0.955: 0.94, 0.95, 0.96 and 0.97.
    r.numerical = NumericalError{"here", "finer", 8, {0.004}, {0.01}};
    const auto shares = numerical_contributions(r, ColumnRows(r));
    REQUIRE(shares.size() == 1);
    CHECK(shares[0].pd == Approx(0.04));
    CHECK(shares[0].pd_half_width == Approx(0.1));
    CHECK_FALSE(shares[0].numerical_dominates);
    // The standard deviation of 0 ... 99 is sqrt(100 101 / 12).
    CHECK(shares[0].spread == Approx(0.01 * std::sqrt(100.0 * 101.0 / 12.0)));

    r.numerical->largest = {0.1};
    CHECK(numerical_contributions(r, ColumnRows(r))[0].numerical_dominates);

    const Folder folder;
    write_results(folder.file("r.h5"), r);
    const Results back = read_results(folder.file("r.h5"));
    REQUIRE(back.numerical.has_value());
    CHECK(back.numerical->setting == "here");
    CHECK(back.numerical->gearboxes == 8);
    CHECK(back.numerical->rms == r.numerical->rms);
    CHECK(back.numerical->largest == r.numerical->largest);
}

TEST_CASE("accuracy lists every solver setting, marks the frontier and reports what is refused",
          "[accuracy]") {
    const Folder folder;
    write_bytes(
        folder.file("peers.csv"),
        "name,command,integration_s,mesh_s,sensor,te,te_rms\nother,\"a, b\",1,0.5,0.1,0.2,0.3\n");
    const Outcome run = program(
        "accuracy " + test::study("published/tian-fig-4-9.toml") + set_options(kNarrow) +
        " --quiet --repeats 1 --gearboxes 0 --seconds 0 --peers " + folder.file("peers.csv") +
        " --json " + folder.file("accuracy.json") + " --html " + folder.file("accuracy.html"));
    INFO(run.output);
    REQUIRE(run.code == kDone);
    CHECK(std::count(run.output.begin(), run.output.end(), '\n') <= 40);
    const auto json = json_of_file(folder.file("accuracy.json"));
    CHECK(std::ranges::any_of(json["settings"], [](const auto& setting) {
        return setting.contains("refused") &&
               setting["refused"].template get<std::string>().starts_with(
                   "the explicit method would need");
    }));
    CHECK(json["reference"]["agreement"]["sensor"].get<double>() < 1e-7);
    CHECK(json["explicit_limit"]["refused"].get<bool>());
    CHECK(json["explicit_limit"]["steps"].get<double>() > 8e5);
    CHECK(json["peers"][0]["command"].get<std::string>() == "a, b");
    CHECK(json["peers"][0]["worst_feature"].get<double>() == 0.3);
    std::vector<std::pair<double, double>> frontier;
    double fastest = 1e9, closest = 1e9;
    for (const auto& solver_setting : json["settings"]) {
        // A solver setting may be unstable: then it has no error.
        if (solver_setting.contains("refused") ||
            solver_setting["error"]["worst_feature"].is_null()) {
            continue;
        }
        const double error = solver_setting["error"]["worst_feature"],
                     time = solver_setting["gearbox_s"];
        fastest = std::min(fastest, time);
        closest = std::min(closest, error);
        if (solver_setting["frontier"].get<bool>()) {
            frontier.emplace_back(time, error);
        }
    }
    std::sort(frontier.begin(), frontier.end());
    REQUIRE(frontier.size() > 2);
    CHECK(frontier.front().first == fastest);
    CHECK(frontier.back().second == closest);
    for (std::size_t i = 1; i < frontier.size(); ++i) {
        CHECK(frontier[i].second < frontier[i - 1].second);
    }
    const std::string headline = json["headline"];
    CHECK(headline.find("The study's own setting, auto") == 0);
    CHECK(run.mentions(headline));
    check_mentions({0, bytes_of(folder.file("accuracy.html"))},
                   {"Figure 1. Error of the worst feature against time", "te_rms",
                    "rk4 at its stability limit, refused", "Detection rates were not"});
    // A tolerance of 1e-3 is met with fewer steps and fewer run-in mesh periods than the study's
    // own.
    CHECK(json["choices"][1]["tolerance"].get<double>() == 1e-3);
    CHECK(json["choices"][1].contains("chosen"));
    CHECK(json["left_out"].empty());
}

TEST_CASE("an error is compared with the scatter of its feature between gearboxes") {
    AccuracyReport report;
    report.features = {"te_rms", "window_ratio"};
    report.noise_levels = {0.0, 1.0};
    for (const auto& [time, error] : {std::pair{3e-3, 0.001}, {2e-3, 0.01}, {1e-3, 0.5}}) {
        SettingResult setting;
        setting.setting.numerics.integrator = lockstep::Integrator::rk4;
        setting.integration_s = time;
        setting.error.rms = {0.01 * error, 0.01 * error, 0.1 * error, 0.3 * error};
        setting.error.relative = {error, error, 2.0 * error, 2.0 * error};
        report.settings.push_back(setting);
    }
    const PilotError& own = report.settings[0].error;
    CHECK(std::isnan(report.share_of_scatter(own, 1)));
    CHECK(report.fastest_within(0.2) == -1);
    CHECK(contains(accuracy_headline(report), "was not measured"));

    // A feature without scatter, e.g. of equal gearboxes without noise, has no share.
    report.scatter = {0.0, 0.0, 0.05, 0.1};
    CHECK(std::isnan(report.share_of_scatter(own, 0)));
    CHECK(report.share_of_scatter(own, 1) == Approx(0.003));
    CHECK(report.largest_share_of_scatter(own) == Approx(0.003));
    CHECK(own.worst_feature(2) == 1);
    CHECK(report.fastest_within(0.2) == 1);
    CHECK(report.fastest_within(1e-4) == -1);
    check_mentions({0, accuracy_headline(report)},
                   {"takes 3 ms of integration per gearbox; its worst feature, window_ratio, "
                    "has an error of 2.0e-03 of its value",
                    "exceeds 3.0e-03 of a feature's scatter", ": 2 ms of integration."});
}

TEST_CASE("the cost of an effect is the change of the pilot without it", "[accuracy]") {
    const Study study = tian({"effects.shear=true"});
    AccuracyReport report;
    report.features = study.features.use;
    report.noise_levels = study.sensor.noise_levels;
    const Planner planner(study);
    report.effects = measure_effects(planner, {}).effects;
    const auto shear =
        std::ranges::find(report.effects, "shear of the teeth", &MeasuredEffect::effect);
    REQUIRE(shear != report.effects.end());
    CHECK(shear->in_study);
    CHECK(shear->time_ratio > 0.0);
    const Pilot with{planner}, without{Planner(tian({"effects.shear=false"}))};
    const PilotError direct = pilot_error(without.run(study.numerics), with.run(study.numerics));
    CHECK(direct.sensor > 0.0);
    CHECK(shear->change.sensor == direct.sensor);
    CHECK(shear->change.largest_feature() == direct.largest_feature());
    CHECK(report.matters(shear->change) == (direct.largest_feature() > kChangeOfFeature));
    // Effects that the study does not contain are not left out of it. A torsional model has neither
    // pin errors nor inertial terms.
    for (const char* absent : {"tooth errors", "pin errors", "inertial terms"}) {
        INFO(absent);
        CHECK(std::ranges::find(report.effects, absent, &MeasuredEffect::effect) ==
              report.effects.end());
    }

    const EffectMeasurement late = measure_effects(planner, {.seconds = 1e-9});
    CHECK(late.effects.empty());
    CHECK(std::ranges::count(late.omitted, "shear of the teeth") == 1);
}

// The study's own setting is compared with two methods even under a short time limit.
TEST_CASE("accuracy omits what it has no time for, and reports this", "[accuracy]") {
    AccuracyRequest request;
    request.seconds = 1e-3;
    const AccuracyReport report = measure_accuracy(Planner(tian()), request);
    CHECK(!report.reference.reached);
    CHECK(report.reference.agreement.sensor < 0.1);
    CHECK(report.settings[0].refusal.empty());
    CHECK(report.settings[0].integration_s > 0.0);
    std::size_t untried = 0;
    for (std::size_t i = 1; i < report.settings.size(); ++i) {
        CHECK(!report.settings[i].refusal.empty());
        untried += report.settings[i].refusal == kNotTried ? 1 : 0;
    }
    CHECK(untried > 5);
    for (const ChoiceCheck& check : report.choices) {
        CHECK(check.chosen < 0);
    }
    test::check_mentions(
        {0, accuracy_text(report)},
        {"Omitted because the time had run out", std::to_string(untried) + " solver settings",
         "the setting for numerics.tolerance = 0.001", "settings with a larger settle_tolerance",
         "detection rates"});
}

TEST_CASE("accuracy reports what it cannot do", "[accuracy]") {
    check_refused("accuracy " + test::study("published/park-fig-13.toml"), {"effects.motion"});
    const Folder folder;
    write_bytes(folder.file("bad.csv"), "name,command,march_s,mesh_s,sensor,te\nx,y,1,2,z,3\n");
    check_refused("accuracy " + test::study("published/tian-fig-4-9.toml") + " --quiet --peers " +
                      folder.file("bad.csv"),
                  {"bad.csv:2: sensor: \"z\" is not a number >= 0"});
}

TEST_CASE("stiffer meshes need more steps of explicit methods to be stable", "[accuracy]") {
    const Study study = test::shipped_study("published/tian-fig-4-9.toml", {});
    const Scene plan(study);
    const StabilityMap map = stability_map(
        {plan.solve().integration().layout, plan.gearbox().inputs(nominal_inputs(study)),
         plan.gearbox().stiffness->stiffest_pairs()},
        Planner(study).steps(study.numerics));
    const std::size_t own = map.factors.size() / 2;
    REQUIRE(map.factors[own] == Approx(1.0));
    REQUIRE(!map.curves.empty());
    for (const StabilityCurve& curve : map.curves) {
        INFO(curve.integrator);
        CHECK(curve.steps.back() >= curve.steps[own]);
    }
}

}  // namespace gearpod::mc::test_accuracy
