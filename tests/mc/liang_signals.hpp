// Signals and spectra of one gearbox of a study, for the tests of Liang's published results.
#pragma once

#include <kissfft/kissfft.hh>

#include "signals/sensor/sensor_signal.hpp"
#include "study_file.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test {

// Simulates the test gearbox of that number alone.
inline mc::GearboxTile run_one(const mc::Scene& scene, bool with_motion = false,
                               std::uint64_t number = 0) {
    const mc::GearboxId id{mc::Group::test, number};
    return mc::run_gearboxes(
        scene.tile(), std::span(&id, 1), 1,
        {.records = lockstep::RecordOptions{.motion_meshes =
                                                with_motion ? scene.record().recorded_meshes : 0}});
}

// Displacements of some degrees of freedom over so many mesh periods, in m: [degree][sample].
inline std::vector<std::vector<double>> motion_of(const mc::Scene& scene, std::uint64_t number,
                                                  std::size_t meshes,
                                                  const std::vector<int>& degrees) {
    const auto tile = run_one(scene, true, number).integration;
    REQUIRE(tile.status[0] == lockstep::LaneStatus::ok);
    const int freedoms = dynamics::degrees_of_freedom(scene.solve().integration().layout);
    std::vector<std::vector<double>> motions(degrees.size());
    for (std::size_t k = 0; k < meshes; ++k) {
        const auto id = static_cast<std::size_t>(tile.content[k % tile.content.size()]);
        const auto& motion = tile.records[id].motion;
        for (std::size_t i = 0; i < motion.size(); i += static_cast<std::size_t>(freedoms)) {
            for (std::size_t d = 0; d < degrees.size(); ++d) {
                motions[d].push_back(motion[i + static_cast<std::size_t>(degrees[d])]);
            }
        }
    }
    return motions;
}

// Sensor signal over the first `meshes` mesh periods, in m/s^2.
inline std::vector<double> sensor_signal(const mc::Scene& scene, int meshes,
                                         std::uint64_t number = 0) {
    const auto tile = run_one(scene, false, number);
    REQUIRE(tile.integration.status[0] == lockstep::LaneStatus::ok);
    return signals::synthesize(tile.views, LaneId{0}, tile.integration.content, scene.record().span,
                               scene.sensors().front().paths.front(),
                               tile.realizations[0].inputs.path_exponent, 0, meshes);
}

// Amplitudes of a signal's spectral lines; line 0 is twice its mean.
inline std::vector<double> lines(const std::vector<double>& signal) {
    std::vector<std::complex<double>> in(signal.begin(), signal.end()), out(signal.size());
    kissfft<double> fft(signal.size(), false);
    fft.transform(in.data(), out.data());
    return test::tabulated(out.size() / 2, [&](std::size_t i) {
        return 2.0 * std::abs(out[i]) / static_cast<double>(out.size());
    });
}

// Spectral lines of that sensor signal; line i lies at i f_m / meshes.
inline std::vector<double> spectrum(const mc::Scene& scene, int meshes, std::uint64_t number = 0) {
    return lines(sensor_signal(scene, meshes, number));
}

// Tolerance for lines that must be zero: the convergence tolerance of periodic orbit and decay
// (1e-10 of the displacement, which is more of the acceleration).
inline constexpr double kNothing = 1e-7;

inline double largest_off_multiples_of_4(const std::vector<double>& amplitudes) {
    double largest = 0.0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
        if (i % 4 != 0) {
            largest = std::max(largest, amplitudes[i]);
        }
    }
    return largest;
}

}  // namespace gearpod::test
