// Checks lives of gearboxes: records against integration, crack growth against Paris' integral, one
// record against the run, and the same bits for any threads and lanes.
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/lives/life_monitor.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"
#include "stiffness/growth/crack_growth.hpp"
#include "tests/mc/lives/campaign_in_memory.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_lives {

using namespace test;

TEST_CASE("A record equals its gearbox integrated at that depth and torque") {
    const std::string use = GENERATE("\"te_rms\",\"sensor_rms\",\"window_ratio\"",
                                     "\"crest_factor\",\"window_kurtosis\",\"sun_window_ratio\"");
    const mc::Scene scene(
        life_study({"life.torque_scatter=0.05", "life.gain_scatter=0.1", "sensor.noise_m_s2=0",
                    "sensor.encoder_noise_arcsec=0", "features.use=[" + use + "]"}));
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    const mc::GearboxId id{mc::Group::test, 1};
    mc::LifeCosts costs;
    const auto life = tiles.run(std::vector{tiles.draw(id)}, true, costs).front();
    REQUIRE(life.status == mc::Status::ok);
    const mc::HealthyReference none;
    mc::RealizationFeatures features(scene.tile(), &none);
    // Records without a crack, and at a depth that is integrated.
    for (const std::size_t r : {std::size_t{0}, std::size_t{3}, std::size_t{6}}) {
        const mc::LifeRecord& record = life.history.records[r];
        mc::Realization gearbox = scene.sampler().draw(id);
        mc::InstanceInputs& inputs = gearbox.inputs;
        inputs.fault_size = record.depth_m;
        inputs.torque_N_m *= record.torque;
        inputs.gain *= record.gain;
        const auto tile = mc::run_realizations(scene.tile(), {gearbox}, 1);
        const auto integrated_features = features.compute(
            mc::lane_signals(scene.tile(), tile, LaneId{0}, scene.record().signal_meshes), gearbox);
        for (std::size_t f = 0; f < integrated_features.size(); ++f) {
            INFO(r << " " << scene.features().used[f]->name);
            CHECK(life.values[f][r] == Approx(integrated_features[f]).epsilon(1e-6));
        }
    }
    CHECK(life.history.records[6].depth_m == Approx(1e-3).epsilon(1e-12));
    CHECK(life.history.records[5].depth_m == 0.0);
}

TEST_CASE("A tooth breaks at the time given by Paris' integral") {
    const mc::Scene scene(life_study({"life.records=400"}));
    const mc::CrackLife crack(scene.life());
    const mc::Realization gearbox = scene.sampler().draw({mc::Group::test, 0});
    const mc::InstanceInputs& inputs = gearbox.inputs;
    // Carrier speed 8.87 rpm, 81 ring teeth, 31 planet teeth.
    CHECK(crack.cycles_per_hour(inputs) == Approx(60.0 * 8.87 * 81.0 / 31.0));
    const auto history = crack.history(gearbox, true);
    REQUIRE(history.end_hours);
    // Force along the line of action for 19 sun teeth of 3.175 mm and four planets.
    const double base_radius = 0.5 * 19 * 3.175e-3 * std::cos(20.0 * std::numbers::pi / 180.0);
    const double force = inputs.torque_N_m / (4.0 * base_radius);
    double cycles = 0.0;
    constexpr int kSteps = 4'000;
    const auto rate = [&](double depth) {
        const double range_MPa = 1e-6 * force * crack.range_per_force(depth);
        return 1e-3 * 1.36e-7 * std::pow(range_MPa, 2.25);
    };
    for (int i = 0; i < kSteps; ++i) {
        const double width = 3e-3 / kSteps;
        cycles += width / rate(1e-3 + (i + 0.5) * width);
    }
    const double hours = cycles / crack.cycles_per_hour(inputs);
    CHECK(*history.end_hours - 6 * 5.0 == Approx(hours).epsilon(1e-5));
    CHECK(history.records.size() == static_cast<std::size_t>(std::ceil(*history.end_hours / 5.0)));
    for (std::size_t r = 1; r < history.records.size(); ++r) {
        CHECK(history.records[r].depth_m >= history.records[r - 1].depth_m);
    }
}

// Lives of one record at 2 mm: the interval is so long that every tooth breaks before the next one.
mc::Study one_record(std::vector<std::string> more) {
    more.insert(more.end(),
                {"life.records=1", "monitoring.baseline_records=0", "life.first_depth_mm=2",
                 "life.interval_h=1e9", "monitoring.false_alarms_per_1000_h=5e-8"});
    return life_study(more);
}

TEST_CASE("A life of one record with a population threshold equals the snapshot study") {
    const std::string noise = GENERATE("noise_m_s2=1", "noise_density_m_s2_per_sqrt_Hz=0.03");
    const std::vector<std::string> both{
        "sensor." + noise,         "sensor.quantisation_m_s2=0.5",
        "sensor.noise_levels=[1]", "features.use=[\"sensor_rms\",\"window_ratio\",\"fm4\",\"m6a\"]",
        "ensemble.instances=16",   "ensemble.threshold_instances=40",
        "fault.depth_mm=2",        "detection.false_alarm_rate=0.05"};
    const auto snapshot = run(shipped_study("planet-crack-ideal.toml", both));
    const auto detection = mc::detect_all(snapshot, mc::ColumnRows(snapshot));
    auto one = both;
    one.insert(one.end(), {"monitoring.detectors=[\"single\"]", "life.healthy_lives=1"});
    const mc::Scene scene(one_record(one));
    const auto campaign = mc::run_campaign(mc::LifeTiles(scene.tile(), scene.life()));
    const mc::LifeMonitor monitor(scene.life().campaign, campaign);
    const auto& monitored = monitor.results();
    for (std::size_t f = 0; f < 4; ++f) {
        INFO(monitored[f].feature);
        REQUIRE(monitored[f].feature == snapshot.features[f].name);
        const auto& level = detection[f].levels[0];
        CHECK(monitored[f].performance.threshold.value == Approx(level.threshold).epsilon(1e-9));
        CHECK(monitored[f].performance.ended == 16);
        if (f < 2) {  // an alarm before the crack has an effect finds nothing: fm4 does not see it
            CHECK(monitored[f].performance.found == level.cells[0].detected);
        }
        for (std::size_t g = 0; g < 16; ++g) {
            CHECK(campaign.cracked[g].values[f][0] ==
                  Approx(snapshot.features[f].values[40 + g]).epsilon(1e-9));
        }
    }
    // Some but not all are found in both, so that the comparison is meaningful.
    CHECK(monitored[1].performance.found > 0);
}

TEST_CASE("A change in lives equals that of the snapshot study") {
    const std::vector<std::string> both{
        "sensor.noise_levels=[0]", "fault.depth_mm=2", "features.baseline_torque_scatter=0",
        "features.use=[\"change_kurtosis\",\"change_m6a\",\"change_sensor_rms\","
        "\"baseline_correlation\",\"own_crest_factor\"]"};
    const mc::Scene scene(one_record(both)),
        snapshot(shipped_study("planet-crack-ideal.toml", both));
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    const mc::GearboxId id{mc::Group::test, 1};
    mc::LifeCosts costs;
    const auto life = tiles.run(std::vector{tiles.draw(id)}, true, costs).front();
    REQUIRE(life.history.records.front().depth_m == Approx(2e-3));
    const mc::HealthyReference none;
    mc::RealizationFeatures features(snapshot.tile(), &none);
    const auto tile = mc::run_gearboxes(snapshot.tile(), std::vector{id}, 1);
    const auto values = features.compute(
        mc::lane_signals(snapshot.tile(), tile, LaneId{0}, snapshot.record().signal_meshes),
        tile.realizations.front());
    for (std::size_t f = 0; f < values.size(); ++f) {
        INFO(snapshot.features().used[f]->name);
        CHECK(life.values[f][0] == Approx(values[f]).epsilon(1e-6));
    }
}

std::string life_options() {
    return life_arguments() +
           " --set life.torque_scatter=0.02 --set 'features.use=[\"window_ratio\",\"" +
           "change_window_ratio\"]' --quiet --json -";
}

TEST_CASE("Lives have the same bits for any lanes") {
    const std::vector<std::string> few{
        "ensemble.threshold_instances=1", "life.healthy_lives=1", "life.torque_scatter=0.02",
        "features.use=[\"sensor_rms\",\"change_window_z\",\"change_kurtosis\",\"fm4\"]"};
    const auto of = [&](const std::string& lanes) {
        auto overrides = few;
        overrides.push_back(lanes);
        const mc::Scene scene(life_study(overrides));
        return mc::run_campaign(mc::LifeTiles(scene.tile(), scene.life()));
    };
    const auto eight = of("numerics.lanes=8"), one = of("numerics.lanes=1");
    for (std::size_t g = 0; g < eight.cracked.size(); ++g) {
        CHECK(eight.cracked[g].values == one.cracked[g].values);
        CHECK(eight.cracked[g].history.end_hours == one.cracked[g].history.end_hours);
    }
    CHECK(eight.interpolation.last == one.interpolation.last);
    CHECK(eight.threshold_lives[0].values == one.threshold_lives[0].values);
}

TEST_CASE("Lives integrate the span once, whether [sensor] or [life] gives the length of records") {
    for (const char* length : {"sensor.record_s=10", "life.record_s=10"}) {
        const mc::Scene scene(
            life_study({length, "numerics.horizon=\"full\"", "features.use=[\"sensor_rms\"]"}));
        const mc::LifeTiles tiles(scene.tile(), scene.life());
        CHECK(tiles.tile().record.signal_meshes == 31 * 81);
        CHECK(tiles.tile().solve->perturbation_only);
        CHECK(scene.life().record_span(scene.gearbox().nominal.speed_rad_s).turns == 3);
    }
}

TEST_CASE("Gearboxes are integrated only at depths next to one of their records") {
    const mc::Scene scene(life_study());  // four steps from 0 to 4 mm
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    mc::LifeHistory none, few;
    none.records = {{0.0, 0.0}};
    few.records = {{0.0, 0.0}, {5.0, 1e-3}, {10.0, 3.5e-3}};
    const std::vector<const mc::LifeHistory*> one{&none}, both{&none, &few};
    const auto depths = [&](const auto& histories, bool tested) {
        return tiles.integrated_depths(histories, tested);
    };
    CHECK(depths(one, false) == std::vector<bool>(5, false));
    CHECK(depths(both, false) == std::vector{true, true, false, true, true});
    // The interpolation error is measured in the step where cracks begin, from 1 to 2 mm, and in
    // the last one.
    CHECK(depths(one, true) == std::vector{false, true, true, true, true});
    few.first_cracked = 1;
    few.end_hours = 12.0;
    CHECK(mc::crack_records_text(one) == "none fails");
    CHECK(mc::crack_records_text(both) == "2");
    mc::LifeHistory long_life = few;
    long_life.records.resize(9);
    CHECK(mc::crack_records_text(std::vector<const mc::LifeHistory*>{&few, &long_life, &none}) ==
          "8 (2 to 8)");
}

// JSON results without run times.
nlohmann::json results_of(const Outcome& outcome) {
    auto json = json_of(outcome);
    json.erase("costs");
    for (auto& section : json["findings"]) {
        for (auto& block : section["blocks"]) {
            if (block["key"] == "basis.costs") {
                block.erase("text");
            }
        }
    }
    return json;
}

TEST_CASE("Lives have the same bits for any threads, and the command prints all required parts") {
    const Folder folder;
    const std::string command = "lives " + study("planet-crack-ideal.toml") + life_options() +
                                " --set monitoring.false_alarms_per_1000_h=10 --out " +
                                folder.file("l.h5");
    const auto reference = results_of(program(command));
    const auto one = bits(folder.file("l.h5"));
    CHECK(results_of(program(command + " --set numerics.threads=1")) == reference);
    CHECK(bits(folder.file("l.h5")) == one);
    CHECK(results_of(program(command + " --seed 77 --force")) != reference);
    REQUIRE(reference["monitored"].size() == 15);  // two features and both, five detectors
    for (const auto& each : reference["monitored"]) {
        CHECK(each["false_alarms"]["hours"] == 4 * 34 * 5.0);
        CHECK(each["found"].get<int>() <= each["ended"].get<int>());
        CHECK(each["alarm_h"].size() == 3);
    }
    CHECK(reference["lives"].size() == 3);
    REQUIRE(reference["trade_offs"].size() == 3);
    double last = 0.0;
    for (const auto& point : reference["trade_offs"][0]["points"]) {
        CHECK(point["stated_per_1000_h"].get<double>() > last);
        last = point["stated_per_1000_h"].get<double>();
    }
    CHECK(reference["fans"][2]["lives"].size() == 3);
}

TEST_CASE("A report on lives repeats the run's text, and other commands refuse them") {
    const auto [folder, file] = TemporaryFile("l.h5");
    const std::string command =
        "lives " + study("planet-crack-ideal.toml") + life_options() + " --out " + file;
    const auto whole = results_of(program(command));
    CHECK(results_of(program("report " + file + " --json -")) == whole);
    std::istringstream text(program("report " + file).output);
    for (std::string line; std::getline(text, line);) {
        CHECK(line.size() <= 80);
    }
    const mc::Results read = mc::read_results(file);
    REQUIRE(read.status.size() == 11);
    CHECK(read.noise_levels.size() == 40);  // hours
    CHECK(read.noise_levels[7] == 35.0);
    CHECK(read.features.back().name == "record_noise");
    // Lives of another study are not overwritten; those of the same study are.
    check_refused(command + " --set life.interval_h=6", {"interval_h = 6", "--force"});
    CHECK(results_of(program(command)) == whole);
    // Additional gearboxes with cracks are appended to the existing ones.
    const auto more = results_of(program(command + " --resume --instances 5"));
    CHECK(more["lives"].size() == 5);
    CHECK(more == results_of(program(command + " --force --instances 5")));
    for (const std::string& refused :
         {"compare " + file + " " + file, "report " + file + " --csv " + folder.file("tables"),
          "report " + file + " --pdf " + folder.file("l.pdf"),
          "merge " + file + " --out " + folder.file("m.h5")}) {
        check_refused(refused, {"holds lives"});
    }
    // Their evidence has the detectors with their numbers.
    const Outcome evidence = program("report " + file + " --evidence " + folder.file("pack"));
    INFO(evidence.output);
    CHECK(evidence.code == program("report " + file).code);
    const auto report = json_of_file(folder.file("pack/report.json"))["evidence"];
    CHECK(report["sections"][0]["key"] == "scope");
    CHECK(report["sections"][1]["blocks"][0]["rows"].size() == 2);  // the study's two features
    CHECK(bytes_of(folder.file("pack/evidence.pdf")).starts_with("%PDF-"));
    const std::string table = bytes_of(folder.file("pack/lives.csv"));
    CHECK(table.starts_with("feature,detector,threshold,"));
    CHECK(std::count(table.begin(), table.end(), '\n') ==
          1 + static_cast<long>(more["monitored"].size()));
}

TEST_CASE("Stopped lives resume to the same bits") {
    const Folder folder;
    const std::string command = "lives " + study("planet-crack-ideal.toml") + life_options() +
                                " --set ensemble.threshold_instances=20 --out ";
    const auto whole = results_of(program(command + folder.file("w.h5")));
    const Outcome stopped =
        shell("timeout --preserve-status -s TERM 0.7 " + std::string(GEARPOD_PROGRAM) + " " +
              command + folder.file("s.h5"));
    CHECK((stopped.code == 4 || stopped.code == 0));  // all were done on a fast machine
    // A slow machine is stopped while it chooses the integrated torques.
    CHECK(std::filesystem::exists(folder.file("s.h5.part")) ==
          (stopped.code == 4 && !stopped.mentions("nothing has been computed yet")));
    CHECK(results_of(program(command + folder.file("s.h5") + " --resume")) == whole);
    CHECK(bits(folder.file("s.h5")) == bits(folder.file("w.h5")));
}

TEST_CASE("Two ranks compute the same lives", "[mpi]") {
    const Folder folder;
    const std::string command = "lives " + study("planet-crack-ideal.toml") + life_options() +
                                " --set numerics.threads=1 --out ";
    const auto one = results_of(program(command + folder.file("1.h5")));
    const Outcome two = shell(mpirun(2) + GEARPOD_PROGRAM + " " + command + folder.file("2.h5"));
    CHECK(results_of(two) == one);
    CHECK(bits(folder.file("2.h5")) == bits(folder.file("1.h5")));
}

TEST_CASE("Too coarse an interpolation withholds the results, and quiet runs print problems only") {
    const Folder folder;
    std::string command = "lives " + study("planet-crack-ideal.toml") + " --force --out " +
                          folder.file("l.h5") + " --set monitoring.false_alarms_per_1000_h=10" +
                          life_arguments();
    const Outcome quiet = require_success(command + " --quiet");
    CHECK(quiet.output.empty());
    check_mentions(program(command + " --full"), {"Effect of the crack", "count as false"});
    command +=
        " --set life.speed_scatter=0.02 --set life.integrated_speeds=3 "
        "--set life.interpolation_tolerance=0.1";
    const Outcome withheld =
        check_refused(command + " --quiet", {"No answer", "of what a crack of 2 mm changes"});
    CHECK(!withheld.mentions("Features and detectors"));
    check_mentions(require_success("report " + folder.file("l.h5") + " --show-withheld"),
                   {"between the integrated torques and speeds"});
}

TEST_CASE("Studies without possible lives are refused with the key") {
    const auto refused = [&](const std::string& more) {
        return check_refused("lives " + study("planet-crack-ideal.toml") + life_options() + more);
    };
    CHECK(
        program("lives " + study("planet-crack-ideal.toml")).mentions("life.interval_h: missing"));
    // All problems at once.
    const Outcome two = refused(
        " --set 'features.use=[\"fm4\",\"na4\"]' --set life.recordings=2"
        " --set 'sensor.noise_levels=[1,2]'");
    check_mentions(two,
                   {"\"fm4\" needs the samples of one recording, but a record averages 2",
                    "\"na4\" compares with the records of other healthy gearboxes", "one noise"});
    CHECK(refused(" --set 'features.use=[\"sun_window_ratio\"]' --set sensor.record_turns=2")
              .mentions("\"sun_window_ratio\" needs"));
    CHECK(refused(" --set 'features.use=[\"own_te_rms\"]' --set sensor.record_turns=2")
              .mentions("\"own_te_rms\" averages the transmission error over the whole span"));
    CHECK(refused(" --set life.record_s=20000").mentions("h between two records"));
    CHECK(refused(" --set life.first_depth_mm=4").mentions("is not below last_depth_mm"));
    CHECK(refused(" --set life.last_depth_mm=40").mentions("cuts through the tooth"));
    CHECK(refused(" --set life.records=6").mentions("is not above monitoring.baseline_records"));
    CHECK(refused(" --set fault.kind=reduction --set fault.reduction=0").code == 2);
    CHECK(refused(" --set 'sensor.noise_levels=[1,2]'").mentions("one noise"));
    CHECK(refused(" --set numerics.verify=true --set 'sensor.noise_levels=[1,2]'")
              .mentions("`lives` ignores keys that only `run` uses: numerics.verify\n"));
}

}  // namespace gearpod::test_lives
