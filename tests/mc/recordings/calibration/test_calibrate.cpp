// Checks that calibration recovers the inputs from which synthetic recordings were made.
#include <fmt/format.h>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/recordings/calibration/calibrate.hpp"
#include "mc/recordings/calibration/healthy_records.hpp"
#include "tests/mc/recording_files.hpp"

namespace gearpod::mc::test_calibrate {

using namespace test;

// Ten times the speed of the study and a tenth of the steps: one gearbox with real teeth takes 5
// ms.
const std::vector<std::string> kFast{
    "operation.carrier_speed_rpm=600", "sensor.sampling_Hz=2800",
    "sensor.low_pass_Hz=1200",         "sensor.encoder_sampling_Hz=1400",
    "numerics.precision=single",       "numerics.settle_tolerance=1e-5"};
const std::vector<std::string> kPriors{"gearbox.tooth_quality=3:10", "sensor.noise_m_s2=0.5:20:log",
                                       "sensor.gain=0.5:2:log"};
const std::vector<std::string> kUsed{
    "sensor_rms",   "window_ratio", "window_z",       "crest_factor",   "fm4",
    "energy_ratio", "frms",         "sideband_level", "window_kurtosis"};

// Three gearboxes with a record of the whole span each.
struct Synthetic {
    CalibrationTask task;
    std::unique_ptr<const Scene> scene;

    explicit Synthetic(std::size_t integrated) {
        Problems problems;
        task.inputs = read_priors(kPriors, problems);
        REQUIRE(problems.empty());
        std::vector<std::string> overrides = kFast;
        for (const CalibratedInput& input : task.inputs) {
            overrides.push_back(input.as_override());
        }
        overrides.emplace_back("features.use=[\"sensor_rms\"]");
        StudyScene made = make_scene(kSmallStudy, read_study(kSmallStudy, overrides));
        INFO(format(made.problems));
        REQUIRE(made);
        scene = std::move(made.scene);
        for (const std::string& name : kUsed) {
            task.measured.features.push_back(features::find_feature(name));
        }
        task.measured.lengths.assign(3, {scene->record().span.meshes()});
        task.integrated = integrated;
    }

    // Calibration result of the set at `truth` (positions in the priors).
    CalibrationResult find(const std::vector<double>& truth, std::size_t number,
                           std::vector<SimulatedSet>& first) {
        const auto simulate = [&](const PriorRegion& region, const SetPlan& plan) {
            return simulate_sets(scene->tile(), task.inputs, region, plan, task.measured.lengths,
                                 task.measured.features, 2, [](double) {});
        };
        const std::vector<double> values =
            simulate({truth, truth}, {1, 1, 1000000 + number})[0].values;
        REQUIRE(!values.empty());
        task.measured.values.clear();
        const std::size_t count = task.measured.features.size();
        for (std::size_t at = 0; at < values.size(); at += count) {
            task.measured.values.push_back({{&values[at], &values[at] + count}});
        }
        return calibrate(task, first, simulate);
    }
};

// Share of sets in which each input's 90 % interval holds the truth.
struct Coverage {
    std::vector<double> held, width_ratio;
};
Coverage coverage_of(Synthetic& synthetic, std::size_t sets) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> prior;
    std::vector<SimulatedSet> first;
    Coverage coverage{std::vector<double>(kPriors.size()), std::vector<double>(kPriors.size())};
    for (std::size_t set = 0; set < sets; ++set) {
        std::vector<double> truth =
            test::tabulated(kPriors.size(), [&](std::size_t) { return prior(engine); });
        const CalibrationResult result = synthetic.find(truth, set, first);
        for (std::size_t p = 0; p < truth.size(); ++p) {
            const nlohmann::ordered_json& found = result.json["inputs"][p];
            const double value = synthetic.task.inputs[p].at(truth[p]);
            const bool inside = found["low"] <= value && value <= found["high"];
            coverage.held[p] += (inside ? 1.0 : 0.0) / static_cast<double>(sets);
            coverage.width_ratio[p] += found["left"].get<double>() / static_cast<double>(sets);
        }
    }
    return coverage;
}

TEST_CASE("Intervals hold the tooth errors, background and gain of synthetic sets") {
    Synthetic synthetic(60);
    const Coverage coverage = coverage_of(synthetic, 10);
    for (std::size_t p = 0; p < kPriors.size(); ++p) {
        INFO(kPriors[p] << ": " << coverage.held[p] << ", left " << coverage.width_ratio[p]);
        CHECK(coverage.held[p] >= 0.6);         // fewer than in ten sets at 90 %: once in 600
        CHECK(coverage.width_ratio[p] < 0.75);  // and the records are informative about each input
    }
}

TEST_CASE("90 % intervals hold the truth of 200 synthetic sets nine times in ten",
          "[.long][calibration-coverage]") {
    Synthetic synthetic(60);
    const Coverage coverage = coverage_of(synthetic, 200);
    for (std::size_t p = 0; p < kPriors.size(); ++p) {
        fmt::print("{}: {:.1f} % of 200 intervals hold the truth, {:.0f} % of the prior is left\n",
                   kPriors[p], 100.0 * coverage.held[p], 100.0 * coverage.width_ratio[p]);
        CHECK(coverage.held[p] == Approx(0.9).margin(0.04));
    }
}

std::string fast() {
    std::string options;
    for (const std::string& one : kFast) {
        options += " --set " + one;
    }
    return options;
}

// Recordings exported by `simulate`: grade 6, 4 m/s^2 of noise.
struct Exported {
    Folder folder;

    explicit Exported(int count) {
        for (int i = 0; i < count; ++i) {
            require_success(fmt::format(
                "simulate {}{} --set gearbox.tooth_quality=6 --set sensor.noise_m_s2=4 --set "
                "ensemble.instances=10 --set features.use='[\"sensor_rms\"]' --instance {} "
                "--meshes 385 --out {}",
                kSmallStudy, fast(), i, folder.file(fmt::format("r{}.csv", i))));
        }
    }
    Outcome calibrate(const std::string& options, const std::string& before = "") const {
        return shell(before + " " + GEARPOD_PROGRAM + " calibrate " + kSmallStudy + fast() +
                     " --sensor sensor_noise_1 --draws 50 " + options);
    }
    std::string records() const { return "--healthy '" + folder.file("r*.csv") + "' "; }
};

TEST_CASE("Exported recordings give a study file that runs, independent of the number of threads") {
    const Exported exported(4);
    const std::string prior =
        "--prior gearbox.tooth_quality=3:10 --prior sensor.gain=0.5:2:log "
        "--prior sensor.noise_m_s2=0.5:20:log "
        "--prior sensor.encoder_noise_arcsec=0.1:10:log ";
    const auto& folder = exported.folder;
    const Outcome outcome = require_success(
        exported.calibrate(exported.records() + prior + "--out " + folder.file("c.toml") +
                               " --json " + folder.file("1.json"),
                           "OMP_NUM_THREADS=1"));
    check_mentions(outcome, {"4 record(s) of 4 gearbox(es)", "s of processor time"});
    CHECK(exported
              .calibrate(exported.records() + prior + "--quiet --json " + folder.file("3.json"),
                         "OMP_NUM_THREADS=3")
              .code == 0);
    CHECK(bytes_of(folder.file("1.json")) == bytes_of(folder.file("3.json")));

    const auto json = json_of_file(folder.file("1.json"));
    const auto& inputs = json["inputs"];
    REQUIRE(inputs.size() == 4);
    const std::vector<double> truth{6.0, 1.0, 4.0};
    for (std::size_t p = 0; p < truth.size(); ++p) {
        INFO(inputs[p].dump());
        // One set in ten lies outside of a 90 % interval, but close to it.
        const double low = inputs[p]["low"].get<double>(), high = inputs[p]["high"].get<double>();
        CHECK(low - (high - low) <= truth[p]);
        CHECK(high + (high - low) >= truth[p]);
    }
    CHECK(inputs[1]["is_informed"] == true);
    // The sensor signal is not sensitive to the encoders.
    CHECK(inputs[3]["is_informed"] == false);
    CHECK(inputs[3]["left"].get<double>() > 0.8);
    CHECK(outcome.mentions("NOT DETERMINED by the recordings: this is the prior"));
    CHECK(json["features"][0]["name"] == "sensor_rms");
    CHECK(json["features"][0]["reproduced"] == true);

    const StudyReading study = read_study(folder.file("c.toml"));
    INFO(format(study.problems));
    REQUIRE(study.study);
    const RandomInput* noise = study.study->find_random("sensor.noise_m_s2");
    REQUIRE(noise != nullptr);
    // Samples of all inputs together.
    CHECK(noise->distribution.name() == "empirical");
    CHECK(noise->distribution.rows().count == 200);
    CHECK(study.study->random.front().distribution.rows().group ==
          noise->distribution.rows().group);
    CHECK(noise->distribution.median() ==
          Approx(inputs[2]["median"].get<double>())
              .margin(0.1 * (inputs[2]["high"].get<double>() - inputs[2]["low"].get<double>())));
    CHECK(study.study->detection.uncertain_inputs.size() == 4);
    CHECK(contains(bytes_of(folder.file("c.toml")), "THE RECORDINGS DO NOT DETERMINE IT"));
    require_success("run " + folder.file("c.toml") + " --quiet --instances 2 --out " +
                    folder.file("c.h5"));
}

TEST_CASE("A table of features calibrates as the recordings from which it was made") {
    const Exported exported(3);
    const auto& folder = exported.folder;
    const std::string table = folder.file("t.csv");
    require_success("features '" + folder.file("r*.csv") + "' --study " + kSmallStudy + fast() +
                    " --sensor sensor_noise_1 --quiet --csv " + table);
    const std::string options =
        "--feature sensor_rms --feature window_ratio --feature frms --quiet ";
    const Outcome records =
        exported.calibrate(exported.records() + options + "--json " + folder.file("r.json"));
    const Outcome features = exported.calibrate("--features " + table + " " + options + "--json " +
                                                folder.file("t.json"));
    INFO(records.output << features.output);
    REQUIRE(records.code == 0);
    REQUIRE(features.code == 0);
    // Numbers of the table have ten digits.
    const auto a = json_of_file(folder.file("r.json"));
    const auto b = json_of_file(folder.file("t.json"));
    for (std::size_t p = 0; p < a["inputs"].size(); ++p) {
        CHECK(a["inputs"][p]["median"].get<double>() ==
              Approx(b["inputs"][p]["median"].get<double>()).epsilon(1e-3));
    }
}

TEST_CASE("Recordings that no gearbox of the study can reproduce are reported as such") {
    const Folder folder;
    write_bytes(folder.file("loud.csv"), "sensor_rms,window_ratio\n20,40\n");
    // Features of the study that need a baseline are not calibrated.
    check_mentions(
        require_success("calibrate " + kSmallStudy + fast() + " --features " +
                        folder.file("loud.csv") +
                        " --draws 50 --out - --set 'features.use=[\"window_ratio\", "
                        "\"change_window_ratio\"]' --set features.baseline_torque_scatter=0.02"),
        {"# NOT REPRODUCED: window_ratio 40, simulated"});
}

TEST_CASE("Bad input to calibrate gives one message each and exit code 2") {
    const Folder folder;
    write_bytes(folder.file("bad.csv"), "time,sensor\n0,1\n1,x\n");
    write_bytes(folder.file("table.csv"), "gearbox,speed\nA,3\n");
    write_bytes(folder.file("text.csv"), "sensor_rms [furlong],window_ratio\n1,x\n");
    const struct {
        std::string options, message;
    } cases[] = {
        {"", "no recordings; give one of --healthy REC..., --manifest T.csv, --features T.csv"},
        {"--healthy a.csv --features b.csv", "more than one source of recordings"},
        {"--healthy no-such.csv", "No such file"},
        {"--healthy '" + folder.file("none*.csv") + "'", "no file matches"},
        {"--healthy " + folder.file("bad.csv"), "\"x\" is not a number"},
        {"--features " + folder.file("table.csv"),
         "has no column with the name of a sensor feature"},
        {"--features " + folder.file("text.csv"), "unknown unit furlong"},
        {"--features " + folder.file("text.csv"), "\"x\" is not a finite number"},
        {"--healthy a.csv --prior sensor.nose=1:2", "unknown key"},
        {"--healthy a.csv --prior sensor.gain=2:1", "LOW must be below HIGH"},
        {"--healthy a.csv --prior sensor.gain=0:1:log", "LOW must be > 0"},
        {"--healthy a.csv --prior sensor.gain=1", "is not a range"},
        {"--healthy a.csv --prior fault.reduction=0:1", "healthy gearboxes have no fault"},
        {"--healthy a.csv --prior gearbox.planets=3:4", "may not be random"},
        {"--healthy a.csv --draws 3", "--draws"},
    };
    for (const auto& one : cases) {
        const Outcome outcome = program("calibrate " + kSmallStudy + " " + one.options);
        INFO(one.options << "\n" << outcome.output);
        CHECK(outcome.code == 2);
        CHECK(outcome.mentions(one.message));
    }
    write_bytes(folder.file("loud.csv"), "sensor_rms,window_ratio\n20,40\n");
    check_refused(shell("GEARPOD_PYTHON=/none " GEARPOD_PROGRAM " calibrate " + kSmallStudy +
                        fast() + " --draws 50 --features " + folder.file("loud.csv")),
                  {"/none cannot be started"});
    // A prior beyond a key's range is a problem of the study.
    write_bytes(folder.file("good.csv"), "sensor_rms,window_ratio\n1,1.2\n1.1,1.3\n");
    check_refused("calibrate " + kSmallStudy + " --features " + folder.file("good.csv") +
                      " --prior sensor.gain=-1:1",
                  {"sensor.gain"});
}

}  // namespace gearpod::mc::test_calibrate
