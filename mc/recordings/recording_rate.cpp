#include "mc/recordings/recording_rate.hpp"

#include <fmt/format.h>

namespace gearpod::mc {

std::vector<std::string> rate_problems(std::span<const double> phase, const Scene& scene,
                                       RecordedSignals has) {
    constexpr double kFewestSamples = 2.0;  // per mesh period
    constexpr double kRateTolerance = 1.02;
    const double per_mesh = static_cast<double>(phase.size() - 1) / (phase.back() - phase.front());
    const double mesh_Hz = scene.nominal_mesh_frequency_Hz();
    const double low_pass = scene.study().sensor.low_pass_Hz;
    std::vector<std::string> problems;
    if (has.te && per_mesh < kFewestSamples) {
        problems.push_back(
            fmt::format("{:.6g} samples per mesh period do not resolve the mesh frequency of "
                        "the transmission error; check the speed and the sampling rate",
                        per_mesh));
    }
    if (has.sensor && per_mesh > kRateTolerance * scene.samples_per_mesh()) {
        problems.push_back(
            fmt::format("{:.6g} samples per mesh period, but the study's grid has {}; set "
                        "sensor.sampling_Hz to that of the recording, about {:.6g} Hz",
                        per_mesh, scene.samples_per_mesh(), per_mesh * mesh_Hz));
    }
    if (has.sensor && per_mesh * mesh_Hz < 2.0 * low_pass) {
        problems.push_back(
            fmt::format("{:.6g} Hz ({:.6g} samples per mesh period) is too low for signals up "
                        "to {:.6g} Hz; set sensor.low_pass_Hz to at most {:.6g}",
                        per_mesh * mesh_Hz, per_mesh, low_pass, 0.5 * per_mesh * mesh_Hz));
    }
    return problems;
}

}  // namespace gearpod::mc
