// Checks the messages of a program that lacks the kernels that a study requires.
#include "tests/mc/program.hpp"

namespace gearpod::test_built_kernels {

using namespace test;

TEST_CASE("Lanes without a kernel in this build are bad input, reported with the available ones") {
    for (const int lanes : {1, 4}) {
        const std::string change = " --set numerics.lanes=" + std::to_string(lanes);
        const Outcome here = program("describe " + study("planet-crack-ideal.toml") + change);
        INFO(here.output);
        if (GEARPOD_PORTABLE) {
            CHECK(here.code == 0);
        } else {
            CHECK(here.code == 2);
            CHECK(here.mentions("numerics.lanes: this build has no kernels for " +
                                std::to_string(lanes) + " lanes"));
            CHECK(
                here.mentions("built: 8 lanes in double precision, 16 in single precision, for "));
        }
    }
}

TEST_CASE("Results contain the kernels of the program") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
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

}  // namespace gearpod::test_built_kernels
