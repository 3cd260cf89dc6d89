// Checks the spectrogram of a signal whose line follows an uneven speed.
#include "mc/report/example_gearboxes.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_spectrogram {

constexpr int kSamples = 40;  // per mesh period
constexpr double kMesh_Hz = 100.0, kOrder = 3.0;

// Times of the samples of `meshes` mesh periods at a speed of 0.8 (1 + 0.5 x) times its mean, x the
// part of the mesh periods passed: time is the integral of 1 / speed over the mesh phase.
std::vector<double> rising_times(int meshes) {
    std::vector<double> times;
    for (int i = 0; i < meshes * kSamples; ++i) {
        const double part = static_cast<double>(i) / (meshes * kSamples);
        times.push_back(std::log(1.0 + 0.5 * part) / 0.4 * meshes / kMesh_Hz);
    }
    return times;
}

TEST_CASE("The spectrogram's largest line follows the mesh frequency of an uneven speed") {
    constexpr int kMeshes = 60;
    const std::vector<double> times = rising_times(kMeshes);
    std::vector<double> signal;
    for (int i = 0; i < kMeshes * kSamples; ++i) {
        signal.push_back(std::sin(2.0 * std::numbers::pi * kOrder * i / kSamples));
    }
    const nlohmann::json json = spectrogram_json(times, signal, kSamples, 900.0);
    const auto frequency = json["frequency_Hz"].get<std::vector<double>>();
    const double line_Hz = frequency[1] - frequency[0];
    REQUIRE(json["time_s"].size() == kMeshes - kSpectrogramWindow + 1);
    const auto mesh_Hz = json["mesh_Hz"].get<std::vector<double>>();
    CHECK(mesh_Hz.back() > 1.3 * mesh_Hz.front());
    for (std::size_t slice = 0; slice < mesh_Hz.size(); ++slice) {
        const auto levels = json["level_dB"][slice].get<std::vector<double>>();
        REQUIRE(levels.size() == frequency.size());
        const auto loudest =
            static_cast<std::size_t>(std::ranges::max_element(levels) - levels.begin());
        CHECK(frequency[loudest] == Approx(kOrder * mesh_Hz[slice]).margin(1.5 * line_Hz));
        CHECK(levels[loudest] > -6.0);
        CHECK(levels.back() < -30.0);
        // The speed at the middle of the window, from the closed form.
        const double speed =
            0.8 * std::exp(0.4 * json["time_s"][slice].get<double>() * kMesh_Hz / kMeshes);
        CHECK(mesh_Hz[slice] == Approx(speed * kMesh_Hz).epsilon(2e-3));
    }
}

TEST_CASE("A signal shorter than a window of the spectrogram has no slices") {
    const std::vector<double> times = rising_times(4), signal(4 * kSamples, 1.0);
    CHECK(spectrogram_json(times, signal, kSamples, 900.0)["time_s"].empty());
}

}  // namespace gearpod::mc::test_spectrogram
