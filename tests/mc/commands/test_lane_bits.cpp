// Checks that the commands that compute gearboxes print the same for any number of lanes, and the
// messages of a program that lacks the kernels that a study requires.
// tests/mc/ensemble and tests/mc/lives check every shipped study, in tiles of any filling.
#include "tests/mc/compared_program.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_lane_bits {

using namespace test;

// Seven milliseconds per gearbox.
const std::string kStudy = std::string(GEARPOD_SOURCE_DIR) + "/tests/bench/rare_teeth.toml";

std::string output_of(const std::string& arguments) {
    return require_success(compared_program(arguments)).output;
}

// Outputs of `misses` and `rare`, and bits of the points of a sweep, computed with so many lanes.
struct LaneOutputs {
    std::string misses, rare;
    std::vector<std::vector<std::uint64_t>> sweep;
    bool operator==(const LaneOutputs&) const = default;
};

LaneOutputs outputs_with(const std::string& lanes, const Folder& folder) {
    const std::string of_lanes = " --set numerics.lanes=" + lanes;
    const std::string results = folder.file("few.h5"), points = folder.file("sweep");
    output_of("run " + kStudy + of_lanes +
              " --instances 6 --set ensemble.threshold_instances=40 --force --quiet --out " +
              results);
    LaneOutputs outputs;
    outputs.misses = output_of("misses " + results +
                               " --feature window_ratio --size 1 --gearboxes 60 --records 64 "
                               "--quiet --json -");
    outputs.rare = output_of(
        "rare " + results + " --feature window_ratio --rate 0.05 --gearboxes 100 --quiet --json -");
    output_of("sweep " + kStudy + of_lanes +
              " --vary 'sensor.noise_m_s2=[1,2]' --set ensemble.instances=5 --set "
              "ensemble.threshold_instances=3 --quiet --out " +
              points);
    for (const auto& entry : std::filesystem::directory_iterator(points)) {
        if (entry.path().extension() == ".h5") {
            outputs.sweep.push_back(bits(entry.path().string()));
        }
    }
    std::ranges::sort(outputs.sweep);
    std::filesystem::remove_all(points);
    return outputs;
}

TEST_CASE("misses, rare and sweep give the same numbers for any lanes") {
    const Folder folder;
    const LaneOutputs reference = outputs_with("16", folder);
    REQUIRE(reference.sweep.size() == 2);
    for (const char* lanes : {"8", "1"}) {
        INFO(lanes);
        CHECK((outputs_with(lanes, folder) == reference));
    }
}

TEST_CASE("Lanes without a kernel in this build are bad input, reported with the available ones") {
    for (const int lanes : {1, 4}) {
        const std::string change = " --set numerics.lanes=" + std::to_string(lanes);
        const std::string command = "describe " + study("planet-crack-ideal.toml") + change;
        if (GEARPOD_PORTABLE) {
            require_success(command);
        } else {
            check_refused(
                command, {"numerics.lanes: this build has no kernels for " + std::to_string(lanes) +
                              " lanes",
                          "built: 8 lanes in double precision, 16 in single precision, for "});
        }
    }
}

TEST_CASE("Results contain the kernels of the program") {
    const auto [folder, out] = TemporaryFile("r.h5");
    require_success("run " + study("planet-crack-ideal.toml") +
                    " --quiet --instances 8 --set ensemble.threshold_instances=8 --out " + out);
    const std::string kernels = mc::read_frame(out).provenance_value("kernels");
    CHECK(program("--version").mentions("kernels: " + kernels + "\n"));
}

TEST_CASE("Single-precision gearboxes that do not converge are counted with sixteen lanes") {
    const Folder folder;
    for (const std::string integrator : {"rk4", "central-difference"}) {
        const Outcome run = program(
            "run " + study("planet-crack-ideal.toml") + " --set numerics.precision='\"single\"'" +
            " --set numerics.integrator='\"" + integrator + "\"' --set numerics.max_meshes=2" +
            " --set numerics.settle_tolerance=1e-5 --instances 8" +
            " --set ensemble.threshold_instances=8 --out " + folder.file(integrator + ".h5"));
        INFO(run.output);
        CHECK(run.code == 3);
        CHECK(run.mentions(" of 16 gearboxes failed: 0 diverged, "));
    }
}

}  // namespace gearpod::test_lane_bits
