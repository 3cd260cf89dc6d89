// Checks the cost forecast of `describe`: arithmetic on given measurements, and a bounded measuring
// time.
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/forecast/forecast.hpp"
#include "mc/study/gears.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/shipped_studies.hpp"

namespace gearpod::mc::test_forecast {

constexpr std::size_t kLanes = 8;

// Integration of a tile takes a second unless it is reused; the features of every gearbox take
// another sixteenth.
RunCost given_costs(int threads) {
    RunCost calibration;
    calibration.threads = threads;
    calibration.lanes = kLanes;
    for (GroupCost& group : calibration.cost) {
        group.integrated.whole.integration = 1.0;
        group.integrated.row.features = group.reused.row.features = 1.0 / 16.0;
    }
    return calibration;
}

IntegrationCounts all_integrated(const BatchPlan& plan) {
    IntegrationCounts counts;
    counts.integrated = {(plan.threshold_rows() + kLanes - 1) / kLanes,
                         (plan.test_rows() + kLanes - 1) / kLanes};
    return counts;
}

double forecast_s(const RunCost& calibration, const BatchPlan& plan) {
    return gearboxes_s(calibration, plan, all_integrated(plan));
}

BatchRows first_tile(const Scene& scene) {
    const BatchTask task(scene.tile(), scene.ensemble());
    Seconds seconds;
    return BatchWorker(task).compute({Group::test, 0, 0, kLanes}, seconds);
}

const std::vector<std::string> kFast{"operation.carrier_speed_rpm=60", "sensor.sampling_Hz=20000",
                                     "sensor.encoder_sampling_Hz=20000"};

// Limit with enough time for one tile per thread.
constexpr double kNoBudget_s = 1e-9;

TEST_CASE(
    "A run takes the rounds of batches that its threads need; the last round may be partial") {
    // Cost of a batch of sixteen gearboxes: two integrations, and a second for the features.
    const double batch_s = 3.0;
    const RunCost two = given_costs(2);
    CHECK(forecast_s(two, {16, 16}) == Approx(batch_s));
    CHECK(forecast_s(two, {16, 32}) == Approx(2 * batch_s));
    CHECK(forecast_s(two, {16, 48}) == Approx(2 * batch_s));
    CHECK(forecast_s(two, {1600, 1600}) == Approx(100 * batch_s));
    CHECK(forecast_s(given_costs(1), {16, 48}) == Approx(4 * batch_s));
    CHECK(forecast_s(given_costs(3), {16, 48}) == Approx(2 * batch_s));
    // A tile costs one integration, however few gearboxes it has.
    CHECK(forecast_s(given_costs(1), {16, 1}) == Approx(batch_s + 1.0 + 1.0 / 16.0));
    CHECK(forecast_s(given_costs(1), {16, 9}) == Approx(batch_s + 2.0 + 9.0 / 16.0));
}

TEST_CASE("Each group has its own cost, and a thread starts once") {
    RunCost calibration = given_costs(1);
    calibration.cost[static_cast<std::size_t>(Group::test)].integrated.whole.integration = 5.0;
    calibration.start_s = 0.25;
    CHECK(forecast_s(calibration, {16, 16}) == Approx(0.25 + 3.0 + 11.0));
    calibration.threads = 2;
    CHECK(forecast_s(calibration, {16, 16}) == Approx(0.25 + 11.0));
    calibration.cost[0].integrated.rest = 0.5;
    // Ten batches for two threads, and one gearbox for one of them.
    CHECK(forecast_s(calibration, {160, 1}) == Approx(0.25 + 5 * 4.0 + 5.0 + 1.0 / 16.0));
}

TEST_CASE("Cached responses are not integrated again") {
    RunCost calibration = given_costs(1);
    for (GroupCost& group : calibration.cost) {
        group.reused.whole.integration = 0.01;
    }
    IntegrationCounts counts;
    counts.integrated = {1, 3};
    CHECK(gearboxes_s(calibration, {160, 160}, counts) == Approx(4 * 1.0 + 36 * 0.01 + 320 / 16.0));
}

TEST_CASE("Integrations are counted as the cache keeps them") {
    Study study = test::shipped_study("planet-crack-ideal.toml", kFast);
    std::erase_if(study.random, [](const RandomInput& input) {
        return !input.key.starts_with("sensor.") && !input.key.starts_with("fault.");
    });
    const Scene scene(study);
    // Full tiles at each of seven sizes, and a partial one in each group.
    const BatchPlan plan(20, 180);
    const BatchTask task(scene.tile(), scene.ensemble());
    BatchWorker worker(task);
    Seconds seconds;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        worker.compute(plan.batch(b), seconds);
    }
    const IntegrationCounts counts = count_integrations(scene.sampler(), scene.solve(), plan, 1.0);
    CHECK(counts.kept == task.cache.kept());
    CHECK(counts.integrated[0] + counts.integrated[1] == counts.kept);
    // With capacity for half of them, the others are integrated each time.
    const IntegrationCounts half =
        count_integrations(scene.sampler(), scene.solve(), plan,
                           256e6 / (0.5 * static_cast<double>(counts.kept) + 0.1));
    CHECK(half.kept == counts.kept / 2);
    CHECK(half.integrated[1] > counts.integrated[1] + 5);
    CHECK(half.integrated[1] < 23);

    const Scene scattered(test::shipped_study("planet-crack-ideal.toml", kFast));
    CHECK(count_integrations(scattered.sampler(), scattered.solve(), plan, 1.0).integrated ==
          std::array<std::size_t, 2>{3, 23});
    CHECK(count_integrations(scattered.sampler(), scattered.solve(), plan, 1.0).kept == 0);
}

TEST_CASE("Peak memory is that of the gearboxes, or of the analysis after them") {
    MemoryUse memory{20e6, 50e6, 30e6, -8e6};
    IntegrationCounts counts;
    CHECK(memory_bytes(memory, counts, 4e6, 0.0) == 80e6);
    counts.kept = 10;
    CHECK(memory_bytes(memory, counts, 4e6, 0.0) == 80e6 + 32e6);
    // The analysis reuses half of what the gearboxes have freed.
    memory.held = 40e6;
    CHECK(memory_bytes(memory, counts, 4e6, 500e6) > 530e6);
    CHECK(memory_bytes(memory, counts, 4e6, 500e6) < 540e6);
    memory.fragments = 7e6;
    CHECK(memory_bytes(memory, counts, 4e6, 0.0) == 80e6 + 32e6 + 7e6);
    CHECK(memory_bytes(memory, counts, 4e6, 500e6) > 537e6);
    CHECK(memory_bytes(memory, counts, 4e6, 500e6) < 547e6);
}

TEST_CASE("Every shipped study is measured with at most one tile per thread if time is short") {
    int studies = 0;
    for (const std::string& name : test::shipped_studies()) {
        Study study = test::shipped_study(name);
        if (!has_gears(study)) {
            continue;
        }
        INFO(name);
        if (!study.sensor.stages.empty()) {
            // Signals of several stages take minutes; test_neighbour_stages.cpp and
            // test_coupled_train.cpp have short ones.
            study = test::shipped_study(name, {"sensor.stages=[]"});
        }
        const Scene scene(study);
        const BatchPlan plan(study.ensemble.threshold_instances, study.ensemble.instances);
        const RunCost calibration =
            measure_run_cost(scene.tile(), scene.ensemble(), plan, 1, kNoBudget_s);
        const RunForecast forecast =
            forecast_run(calibration, scene.ensemble().shape, plan,
                         verification_s(Planner(study), calibration, false), 0.0);
        ++studies;
        CHECK(calibration.to_record == scene.record().signal_meshes);
        CHECK(!calibration.gearboxes.empty());
        CHECK(calibration.gearboxes.size() <= static_cast<std::size_t>(study.numerics.lanes));
        const bool shortened =
            study.numerics.horizon != Horizon::periodic && !study.effects.quasi_static();
        CHECK(calibration.recorded ==
              (shortened ? std::min(kFewestMeshes, calibration.to_record) : calibration.to_record));
        CHECK(std::isfinite(forecast.total_s()));
        CHECK(forecast.gearboxes_s > 0.0);
        CHECK(forecast.memory_bytes > 1e6);
    }
    CHECK(studies > 30);
}

TEST_CASE(
    "An integration that is truncated for the measurement counts in full, without side effects") {
    std::vector<std::string> overrides = kFast;
    overrides.push_back("numerics.horizon=full");
    const Scene scene(test::shipped_study("planet-crack-ideal.toml", overrides));
    const auto before = test::bits_of(first_tile(scene).values);
    const BatchPlan plan(16, 32);
    const RunCost cut = measure_run_cost(scene.tile(), scene.ensemble(), plan, 1, kNoBudget_s);
    CHECK(cut.recorded == kFewestMeshes);
    CHECK(cut.to_record == 2511);
    // Run-in to the periodic orbit, and eight mesh periods.
    CHECK(cut.meshes >= kFewestMeshes + 2);
    CHECK(cut.meshes < kFewestMeshes + scene.solve().convergence.max_meshes);
    const Seconds& whole = cut.cost[0].integrated.whole;
    CHECK(whole.integration > 20.0 * whole.signals);
    // Sensor signals recorded during integration need no stored records, in a run or here.
    CHECK(cut.memory.records == 0.0);
    CHECK(motion_bytes(scene.tile()) < 0.01 * scene.solve().record_bytes);
    CHECK(test::bits_of(first_tile(scene).values) == before);
}

TEST_CASE("A study's description ends with a forecast and writes nothing") {
    const test::Folder folder;
    for (const char* name : {"published/tian-fig-4-6.toml", "published/park-fig-11.toml",
                             "published/liang-fig-5-8.toml"}) {
        const test::Outcome described = test::require_success(
            test::shell("cd " + folder.path() + " && " GEARPOD_PROGRAM " describe " +
                        test::study(name) + " --full"));
        for (const char* entry : {"based on", "set-up", "gearboxes", "detection and results",
                                  "estimated time", "estimated memory"}) {
            CHECK(described.mentions(std::string("\n  ") + entry));
        }
    }
    CHECK(folder.empty());
    const std::string stiff =
        test::study("published/tian-fig-4-6.toml") + " --set numerics.integrator=rk4";
    const test::Outcome run = test::check_refused("run " + stiff + " --out " + folder.file("r.h5"));
    test::check_refused("describe " + stiff, {run.output});
}

// Checks the cost of accepted studies: describe ends soon and stays small, run reports in advance
// what exceeds the memory, and every count has an upper limit.

using namespace test;

std::string levels(int count) {
    std::string list;
    for (int i = 0; i < count; ++i) {
        list += (i == 0 ? "" : ",") + std::to_string(i);
    }
    return "[" + list + "]";
}

// Runs the program in 2 GB; fails on an exit code of a shell or of a signal.
Outcome bounded(const std::string& arguments, int kilobytes = 2000000) {
    return shell(within_memory(kilobytes) + "timeout 60 " + GEARPOD_PROGRAM + " " + arguments);
}

TEST_CASE("describe ends within its time and memory for any counts in a study") {
    const std::string study = test::study("crack-in-sun.toml");
    for (const std::string& set :
         {"sensor.noise_levels=" + levels(1000),
          std::string("ensemble.instances=1000000000' --set "
                      "'ensemble.threshold_instances=1000000000"),
          std::string("sensor.sampling_Hz=100000' --set 'features.te_harmonics=1000"),
          std::string("numerics.tolerance=1e-9"),
          std::string("numerics.steps_per_mesh=1000000' --set 'numerics.max_meshes=1000000")}) {
        const double start_s = children_s();
        const Outcome outcome = bounded("describe " + study + " --seconds 2 --set '" + set + "'");
        INFO(set.substr(0, 40) << "\n" << outcome.output);
        CHECK((outcome.code == 0 || outcome.code == 2));
        CHECK(children_s() - start_s < 40);  // two threads for 2 s, and the set-up
        CHECK_FALSE(outcome.mentions("std::"));
        CHECK_FALSE(outcome.mentions("nan"));
    }
}

TEST_CASE("Counts beyond their limits are refused with the limit") {
    const std::string study = test::study("crack-in-sun.toml");
    for (const auto& [set, words] :
         {std::pair{"sensor.noise_levels=" + levels(1001), "at most 1000"},
          std::pair{"random.fault.depth_mm={distribution='levels',values=" + levels(1001) + "}",
                    "at most 1000"},
          std::pair{std::string("sensor.sampling_Hz=1e7"), "at most 20000"},
          std::pair{std::string("ensemble.instances=1000000001"), "ensemble.instances"},
          std::pair{std::string("sensor.encoder_sampling_Hz=30\" --set \"features.use=['te_fm4']"),
                    "too few for te_fm4, te_m6a and te_m8a"},
          std::pair{std::string("features.te_harmonics=100000"), "features.te_harmonics"}}) {
        check_refused(bounded("describe " + study + " --set \"" + set + "\""), {words});
    }
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("A run that exceeds the memory reports this before it begins") {
    const Folder folder;
    const std::string run = "run " + test::study("crack-in-sun.toml") +
                            " --set numerics.horizon=full --set sensor.sampling_Hz=60000 --set "
                            "numerics.threads=2 --out " +
                            folder.file("r.h5");
    check_refused(bounded(run, 1500000), {"the run needs at least", "--force"});
    CHECK(folder.empty());
    // A forced run ends with a message and keeps its results.
    const Outcome forced = bounded(run + " --force --quiet --time-limit 00:00:05", 1500000);
    INFO(forced.output);
    CHECK(forced.code == 4);
    CHECK_FALSE(forced.mentions("std::"));
}
#endif

}  // namespace gearpod::mc::test_forecast
