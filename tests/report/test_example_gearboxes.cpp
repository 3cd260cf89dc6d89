// Checks the gearboxes that a report recomputes against those that the program simulates.
#include <nlohmann/json.hpp>

#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/run_sections.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_example_gearboxes {

using Json = nlohmann::json;

// A study's scene, its results and the report's examples.
struct Example {
    explicit Example(const std::string& name, const std::string& overrides = "") {
        const std::string file = folder.file("r.h5");
        require_success(
            test::program("run " + test::study(name) + " --quiet --out " + file + overrides));
        results = mc::read_results(file);
        json = mc::examples_json(results, mc::ColumnRows(results));
        scene = mc::make_scene(name, mc::read_study_text(results.provenance_value("study"), name))
                    .scene;
        REQUIRE(scene);
    }
    const Json& gearbox(std::size_t i) const { return json["examples"]["gearboxes"].at(i); }

    test::Folder folder;
    mc::Results results;
    Json json;
    std::unique_ptr<const mc::Scene> scene;
};

const std::vector<double>& column(const mc::Simulation& simulation, const std::string& name) {
    for (const mc::SignalColumn& each : simulation.columns) {
        if (each.name == name) {
            return each.values;
        }
    }
    throw std::runtime_error("no column " + name);
}

// Amplitude of one frequency component of the signal, in cycles per `signal.size()` samples.
double line(const std::vector<double>& signal, double cycles) {
    std::complex<double> sum = 0.0;
    const double turn = 2.0 * std::numbers::pi * cycles / static_cast<double>(signal.size());
    for (std::size_t i = 0; i < signal.size(); ++i) {
        sum += signal[i] * std::polar(1.0, -turn * static_cast<double>(i));
    }
    return 2.0 * std::abs(sum) / static_cast<double>(signal.size());
}

TEST_CASE("The examples are the first healthy and the first worst gearbox, bit for bit") {
    const Example example("planet-crack-ideal.toml",
                          " --instances 14 --set ensemble.threshold_instances=20");
    REQUIRE(example.json["examples"]["refusal"].is_null());
    REQUIRE(example.json["examples"]["gearboxes"].size() == 2);
    CHECK(example.gearbox(0)["row"] == 0);
    CHECK(example.gearbox(0)["engagements"].empty());
    CHECK(example.gearbox(1)["row"] == 26);  // the seventh graded one
    CHECK(example.gearbox(1)["size"] == 4.28e-3);
    for (const std::size_t i : {0, 1}) {
        CHECK(example.gearbox(i)["same_bits"] == true);
        // Feature window_ratio is the largest tooth rms over the median one.
        std::vector<double> rms = example.gearbox(i)["tooth_rms"]["noisy"];
        REQUIRE(rms.size() == 31);
        std::sort(rms.begin(), rms.end());
        CHECK(example.gearbox(i)["features"][5]["name"] == "window_ratio");
        CHECK(example.gearbox(i)["features"][5]["value"].get<double>() ==
              Approx(rms[30] / rms[15]).epsilon(1e-12));
    }
    // The crack meets the ring once per planet turn.
    CHECK(example.gearbox(1)["engagements"].size() == 1);
}

TEST_CASE("A changed feature in the file is detected") {
    Example example("published/park-fig-13.toml");
    CHECK(example.gearbox(1)["same_bits"] == true);
    CHECK(example.gearbox(1)["sensor"].is_null());
    CHECK(example.gearbox(1)["engagements"].size() == 2);  // sun side and ring side
    example.results.features[0].values.back() *= 1.0 + 1e-15;
    const Json json = mc::examples_json(example.results, mc::ColumnRows(example.results));
    CHECK(json["examples"]["gearboxes"][1]["same_bits"] == false);
}

TEST_CASE("Signals and lines equal those of the simulated gearbox") {
    const Example example("published/tian-fig-4-9.toml");
    const Json& gearbox = example.gearbox(1);
    const long meshes = example.scene->record().span.meshes();
    const mc::Simulation whole =
        mc::simulate(example.scene->tile(), example.scene->draw().rows.id_of(2), meshes);
    const std::vector<double>& sensor = column(whole, "sensor");
    const int samples = example.scene->record().samples;
    const Json& drawn = gearbox["sensor"]["clean"];
    for (std::size_t i = 0; i < drawn["mesh"].size(); ++i) {
        const auto at = std::lround(drawn["mesh"][i].get<double>() * samples);
        REQUIRE(drawn["value"][i] == sensor[static_cast<std::size_t>(at)]);
    }
    // The reduced curve contains all peaks.
    const auto turn = sensor.begin() + 19 * samples;
    CHECK(*std::max_element(drawn["value"].begin(), drawn["value"].end()) ==
          *std::max_element(sensor.begin(), turn));
    const Json& lines = gearbox["spectrum"]["zoom"]["clean"];
    const double duration_s = static_cast<double>(meshes) * gearbox["mesh_period_s"].get<double>();
    REQUIRE(lines["amplitude"].size() > 100);
    for (std::size_t i = 0; i < lines["amplitude"].size(); i += 50) {
        const double amplitude = lines["amplitude"][i];
        CHECK(amplitude == Approx(line(sensor, lines["frequency_Hz"][i].get<double>() * duration_s))
                               .epsilon(1e-6)
                               .margin(1e-9));
    }
}

TEST_CASE(
    "The faulty pair is healthy before and after its faulty tooth, and less stiff in between") {
    const Example example("published/tian-fig-4-9.toml");
    const Json& stiffness = example.json["stiffness"];
    REQUIRE(stiffness["refusal"].is_null());
    REQUIRE(stiffness["passages"].size() == 1);
    const Json& passage = stiffness["passages"][0];
    CHECK(passage["pair"] == "m1");
    REQUIRE(passage["faulty"].size() == 1);
    const Json& healthy = passage["healthy"];
    const Json& faulty = passage["faulty"][0]["stiffness"];
    const double duration = 1.6456;  // contact ratio, Tian (2004)
    double loss = 0.0;
    for (std::size_t i = 0; i < healthy.size(); ++i) {
        const double since = passage["mesh"][i];
        const double h = healthy[i], f = faulty[i];
        if (since < 0.0 || since > duration + 1e-3) {
            CHECK(f == Approx(h).epsilon(1e-12));
        } else {
            CHECK(f <= h * (1.0 + 1e-12));
            loss = std::max(loss, 1.0 - f / h);
        }
    }
    CHECK(loss > 0.1);
    // The healthy pair repeats one period later.
    const std::size_t period = stiffness["mesh"].size();
    for (std::size_t i = 0; i + period < healthy.size(); ++i) {
        CHECK(healthy[i].get<double>() == Approx(healthy[i + period].get<double>()).epsilon(1e-6));
    }
}

}  // namespace gearpod::test_example_gearboxes
