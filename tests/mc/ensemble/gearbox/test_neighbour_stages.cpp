// Checks neighbouring stages: their vibration at the sensor against a Fourier series of their own
// signal, their gearboxes, records with their fault, and what is refused.
#include <boost/random/uniform_01.hpp>
#include <kissfft/kissfft.hh>

#include "mc/ensemble/coupling/neighbour_stages.hpp"
#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/results/results_file.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/ensemble/gearbox/stage_files.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_neighbour_stages {

using namespace test;

// Noise-free sensor signal of a gearbox over the span.
std::vector<double> sensor_signal(const mc::TilePlan& plan, const mc::Realization& gearbox) {
    const auto tile = mc::run_realizations(plan, {gearbox}, 1);
    REQUIRE(tile.status.front() == mc::Status::ok);
    return mc::lane_signals(plan, tile, LaneId{0}, plan.record.span.meshes()).sensor;
}

// Values of a signal of that period, at positions in samples, by its Fourier series.
std::vector<double> series_at(const std::vector<double>& period,
                              const std::vector<double>& positions) {
    const auto n = static_cast<double>(period.size());
    std::vector<std::complex<double>> samples(period.begin(), period.end()), lines(period.size());
    kissfft<double>(period.size(), false).transform(samples.data(), lines.data());
    std::vector<double> values(positions.size(), 0.0);
    for (std::size_t k = 0; 2 * k < period.size(); ++k) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / n;
        for (std::size_t p = 0; p < positions.size(); ++p) {
            values[p] +=
                (k == 0 ? 1.0 : 2.0) / n * (lines[k] * std::polar(1.0, turn * positions[p])).real();
        }
    }
    return values;
}

TEST_CASE("The sensor picks up the stage's own signal, at the stage's time, times the gain") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const mc::Scene scene(small_study(path, ", gain=0.5")), alone(*mc::read_study(kSmall).study);
    const mc::GearboxId id{mc::Group::test, 3};
    const mc::Realization gearbox = scene.sampler().draw(id);
    const std::vector<double> with = sensor_signal(scene.tile(), gearbox),
                              without = sensor_signal(alone.tile(), gearbox);
    const mc::Realization neighbour =
        mc::stage_gearbox(scene.gearbox(), scene.gearbox().stages[0], gearbox);
    CHECK(neighbour.inputs.fault_size == 0.0);
    const mc::TilePlan& stage = *scene.gearbox().stages[0].tile;
    const std::vector<double> own = sensor_signal(stage, neighbour);
    // Mesh frequencies: 35 Hz here, 60 / 48 * 13 / 60 * 35 Hz there.
    const double step =
        scene.record().sample_s(gearbox.inputs) / stage.record.sample_s(neighbour.inputs);
    CHECK(step ==
          Approx((1.0 / (35.0 * scene.record().samples)) * (35.0 * 13 / 48 * stage.record.samples))
              .epsilon(1e-9));
    mc::Philox engine = mc::record_stream(scene.draw().seed, id,
                                          mc::with_suffix(mc::StreamPurpose::stage_start, "slow"));
    const double start =
        boost::random::uniform_01<double>()(engine) * static_cast<double>(own.size());
    std::vector<double> positions;
    constexpr std::size_t kEvery = 97;
    for (std::size_t i = 0; i < with.size(); i += kEvery) {
        positions.push_back(start + step * static_cast<double>(i));
    }
    const std::vector<double> expected = series_at(own, positions);
    double sum = 0.0, error = 0.0;
    for (std::size_t p = 0; p < positions.size(); ++p) {
        sum += std::pow(0.5 * expected[p], 2);
        error += std::pow(with[kEvery * p] - without[kEvery * p] - 0.5 * expected[p], 2);
    }
    CHECK(sum > 0.0);
    CHECK(std::sqrt(error / sum) < 1e-3);
}

TEST_CASE("A stage's gearbox has the torque and the speed of the gearbox next to it") {
    const Folder folder;
    const mc::Scene scene(small_study(stage_file(folder, "stage.toml"), ""));
    mc::Realization gearbox = scene.sampler().draw({mc::Group::threshold, 1});
    const mc::Realization usual =
        mc::stage_gearbox(scene.gearbox(), scene.gearbox().stages[0], gearbox);
    gearbox.inputs.torque_N_m *= 0.9;
    gearbox.inputs.speed_rad_s *= 1.1;
    const mc::Realization other =
        mc::stage_gearbox(scene.gearbox(), scene.gearbox().stages[0], gearbox);
    CHECK(other.inputs.torque_N_m == Approx(0.9 * usual.inputs.torque_N_m).epsilon(1e-12));
    CHECK(other.inputs.speed_rad_s == Approx(1.1 * usual.inputs.speed_rad_s).epsilon(1e-12));
    CHECK(mc::stage_gearbox(scene.gearbox(), scene.gearbox().stages[0], gearbox, true)
              .inputs.fault_size == Approx(0.4));
}

TEST_CASE("The common shaft sets the speed of a stage, and the sensor is that of the study") {
    const Folder folder;
    const std::string path = stage_file(folder, "fast.toml", 66.0);
    const mc::Scene scene(small_study(path, ""));
    CHECK(scene.gearbox().stages[0].gearbox->nominal.speed_rad_s ==
          Approx(13.0 / 48.0 * scene.gearbox().nominal.speed_rad_s).epsilon(1e-6));
    check_mentions(
        program("describe " + kSmall + " " + stages(path, "") + "--set sensor.low_pass_Hz=100"),
        {"0.9091 times as fast as in its own study", "meshes at 9.479 Hz"});
    // A stage next to a stage: the shaft is the first one's, at its speed.
    check_mentions(
        program("describe " + kSmall + " --set 'sensor.stages=[{name=\"a\", study=\"" + path +
                "\", shaft=\"carrier\", stage_shaft=\"sun\"}, {name=\"b\", study=\"" + path +
                "\", of=\"a\", shaft=\"carrier\", stage_shaft=\"sun\"}]'"),
        {"meshes at 2.567 Hz"});
}

TEST_CASE("A stage that leaves its numerics to a tolerance has them at the speed of the shaft") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml", 66.0);
    std::ofstream(path, std::ios::app) << "\n[numerics]\ntolerance = 1e-2\n";
    const auto results = run_small(folder, "t.h5", stages(path, ""));
    CHECK(std::isfinite(results.features[4].values.front()));
    require_success("simulate " + kSmall + " " + stages(path, "") +
                    "--set operation.torque_N_m=0 --instance 0 --meshes 40 --out " +
                    folder.file("s.csv"));
}

TEST_CASE("Another fault is that of the stage, in the same records") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const mc::Results other = run_small(folder, "other.h5", stages(path, ", role=\"other_fault\"")),
                      background = run_small(folder, "background.h5", stages(path, ""));
    REQUIRE(other.variants.size() == 1);
    CHECK(background.variants.empty());
    const auto& healthy = other.features[4];
    REQUIRE(healthy.name == "sensor_rms");
    CHECK(bits_of(healthy.values) == bits_of(background.features[4].values));
    const auto& faulty = other.variants[0].features[4];
    for (std::size_t row = 0; row < 20; ++row) {
        CHECK(faulty.values[row] != healthy.values[row]);
        CHECK(faulty.values[row] == Approx(healthy.values[row]).epsilon(0.5));
    }
    // Results hold the stage's study.
    std::filesystem::remove(path);
    check_mentions(require_success("report " + folder.file("other.h5") + " --full"),
                   {"a fault of the neighbouring stage \"slow\""});
}

TEST_CASE("Rows next to a stage keep their bits over threads, parts and merging") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    check_equal_bits_over_parts(stages(path, ", role=\"other_fault\"") +
                                "--set 'features.use=[\"fm4\",\"change_sensor_rms\"]' ");
}

TEST_CASE("Stages that do not fit are refused, all at once, with what would be right") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const auto refused = [&](const std::string& options) {
        return check_refused("describe " + kSmall + " " + options);
    };
    CHECK(refused(stages(folder.file("none.toml"), "")).mentions("none.toml: cannot be read"));
    CHECK(refused("--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                  "\", shaft=\"ring\", stage_shaft=\"sun\"}]'")
              .mentions("the ring of its common shaft stands still"));
    const auto both = refused("--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                              "\", shaft=\"sun\", stage_shaft=\"sun\", gain=-1},"
                              "{name=\"a\", study=\"" +
                              path + "\", shaft=\"sun\", stage_shaft=\"sun\", of=\"b\"}]'");
    check_mentions(both, {"stage 1: gain must be > 0", "stage 2: its name \"a\" occurs twice",
                          "stage 2: of: no earlier stage has the name \"b\""});
    CHECK(refused("--set 'sensor.stages=[{name=\"a\", text=\"\", shaft=\"sun\", "
                  "stage_shaft=\"sun\"}]'")
              .mentions("stage 1: its study is empty"));
    CHECK(refused("--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                  "\", shaft=\"pinion\", stage_shaft=\"sun\"}]'")
              .mentions("a planetary gearbox has no pinion"));
    // Its mesh frequency would be 129 Hz.
    const auto fast = refused("--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                              "\", shaft=\"sun\", stage_shaft=\"carrier\"}]'");
    CHECK(fast.mentions("sensor.stages: stage \"a\": sensor.sampling_Hz"));
    std::string text = bytes_of(path);
    text.replace(text.find("reduction = 0.4"), 15, "reduction = 0");
    std::ofstream(folder.file("sound.toml")) << text;
    CHECK(refused(stages(folder.file("sound.toml"), ", role=\"other_fault\""))
              .mentions("its other fault has the size 0"));
    std::ofstream(folder.file("python.toml")) << bytes_of(path).replace(
        bytes_of(path).find("[features]"), 10, "[features]\npython = [\"own.py\"]");
    CHECK(refused(stages(folder.file("python.toml"), "")).mentions("remove features.python there"));
    std::ofstream(folder.file("nested.toml")) << bytes_of(path) << "\n[sensor.more]\n";
    CHECK(refused(stages(folder.file("nested.toml"), "")).mentions("its study has problems"));
    CHECK(program("lives " + kSmall + " " + stages(path, "")).mentions("bearings or stages"));
}

}  // namespace gearpod::test_neighbour_stages
