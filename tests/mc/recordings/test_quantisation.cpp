// Checks the rounding of recorded samples: its step, and features that would measure it.
#include "mc/recordings/quantisation.hpp"
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_quantisation {

using namespace test;

constexpr int kTeeth = 11, kPerMesh = 8, kSamples = kTeeth * kPerMesh;
constexpr double kStep = 2e-3;

// Orders between the mesh lines, RMS about 1, and the mesh lines near this RMS. The first is the
// strongest: rounding must not decide which one is demodulated.
std::vector<double> turn(double mesh) {
    std::mt19937_64 engine(4);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    std::vector<double> samples(kSamples, 0.0);
    for (int k = 1; k < kSamples / 2; ++k) {
        const int from_mesh = std::min(k % kTeeth, kTeeth - k % kTeeth);
        const double amplitude = k == kTeeth ? mesh / 2.0 : from_mesh <= 1 ? mesh / 3.0 : 0.25;
        const double begin = phase(engine);
        for (int i = 0; i < kSamples; ++i) {
            samples[static_cast<std::size_t>(i)] +=
                amplitude * std::cos(2.0 * std::numbers::pi * k * i / kSamples + begin);
        }
    }
    return samples;
}

std::vector<double> rounded(std::vector<double> samples, double step) {
    for (double& one : samples) {
        one = step * std::round(one / step);
    }
    return samples;
}

nlohmann::json features_of(const std::vector<double>& samples) {
    const Folder folder;
    return json_of("features " + write_csv(folder.file("s.csv"), "sensor [m/s^2]", {samples}) +
                   " --study " + kSmallStudy + " --samples-per-mesh 8 --speed stated --json -");
}

TEST_CASE("The step of rounded samples is found, also of coarse ones, and others have none") {
    for (const double step : {1e-5, 2.132e-5, 0.3, 1.0}) {
        INFO(step);
        std::vector<double> samples = turn(1.0);
        for (double& one : samples) {
            one *= 40.0 * step;
        }
        CHECK(mc::quantisation_step(rounded(samples, step)) == Approx(step).epsilon(1e-9));
    }
    CHECK(mc::quantisation_step(turn(1.0)) == 0.0);
    CHECK(mc::quantisation_step(std::vector<double>(50, 3.0)) == 0.0);
    CHECK(mc::rounding_rms(rounded(turn(1.0), kStep)) == Approx(kStep / std::sqrt(12.0)));
    // Without a step: the rounding of double-precision arithmetic.
    CHECK(mc::rounding_rms(turn(1.0)) < 1e-10);
    CHECK(mc::rounding_rms(turn(1.0)) > 0.0);
}

TEST_CASE("Files with steps twelve times apart have the same features, or none with the reason") {
    for (const double mesh : {1.0, 0.0}) {
        const auto fine = features_of(rounded(turn(mesh), kStep));
        const auto coarse = features_of(rounded(turn(mesh), 12.0 * kStep));
        // Relative bound: the rounding error of a sample, 12 steps / 12^(1/2), over the signal's
        // RMS near 1, times 8, the largest power in a definition (m8a).
        const double bound = 8.0 * 12.0 * kStep / std::sqrt(12.0);
        int compared = 0;
        for (const auto& [name, value] : fine["features"].items()) {
            if (coarse["features"].contains(name)) {
                INFO(name);
                ++compared;
                CHECK(coarse["features"][name].get<double>() ==
                      Approx(value.get<double>()).epsilon(bound));
            }
        }
        CHECK(compared > 5);
        for (const char* name : {"energy_ratio", "sideband_index", "sideband_level"}) {
            INFO(name);
            // With mesh lines: values. Without: reasons, although the lines of the rounded samples
            // are not zero.
            CHECK(fine["features"].contains(name) == (mesh > 0.0));
            CHECK(coarse["features"].contains(name) == (mesh > 0.0));
            if (mesh == 0.0) {
                CHECK_THAT(fine["unavailable"][name].get<std::string>(),
                           Catch::Contains("at the level of the recording's rounding"));
            }
        }
    }
}

TEST_CASE("Mesh lines that are zero apart from double-precision rounding have no ratio") {
    const auto found = features_of(turn(0.0));
    CHECK_THAT(found["unavailable"]["energy_ratio"].get<std::string>(),
               Catch::Contains("at the level of the recording's rounding"));
    CHECK(found["features"].contains("fm4"));
}

}  // namespace gearpod::test_quantisation
