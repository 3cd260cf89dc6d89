// A complete planetary study for variation in tests.
#pragma once

#include "tests/test.hpp"

namespace gearpod::tests {

// Source: Liang (2016), Tables 3.1 and 4.1; a crack on the ring side of a planet tooth.
inline const std::string kExampleStudy = R"(title = "example"

[gearbox]
kind = "planetary"
planets = 4
sun.teeth = 19
planet.teeth = 31
ring.teeth = 81
module_mm = 3.175
pressure_angle_deg = 20
face_width_mm = 38.1
young_modulus_Pa = 2.068e11
poisson_ratio = 0.3
sun.mass_kg = 0.7
planet.mass_kg = 1.822
ring.mass_kg = 5.982
carrier.mass_kg = 10
sun.bearing_stiffness_N_m = 1e8
planet.bearing_stiffness_N_m = 1e8
ring.bearing_stiffness_N_m = 1e8
carrier.bearing_stiffness_N_m = 1e8
support_stiffness_N_m = 1e9
mesh_damping_ratio = 0.07

[operation]
torque_N_m = 429
carrier_speed_rpm = 8.87

[fault]
kind = "crack"
member = "planet"
side = "ring"

[sensor]
sampling_Hz = 5000
low_pass_Hz = 800
encoder_sampling_Hz = 5000
encoder_noise_arcsec = 1.5
noise_m_s2 = 0.3
noise_levels = [0, 0.5, 1]

[random]
gearbox.planet.bearing_stiffness_N_m = { distribution = "lognormal", median = 1.1e8, cv = 0.2 }
fault.depth_mm = { distribution = "levels", values = [0, 1, 2, 3, 4.3] }
sensor.path_exponent = { distribution = "truncated-normal", mean = 0.1, sd = 0.05, low = -0.1, high = 0.3 }

[ensemble]
instances = 100
threshold_instances = 50
seed = 7
)";

// Overrides for short meshes and fast convergence. Without damping of its bearings the example
// would exceed the allowed number of run-in mesh periods.
inline const std::vector<std::string> kFast{
    "operation.carrier_speed_rpm=200",           "sensor.sampling_Hz=5000",
    "gearbox.planet.bearing_damping_N_s_m=5000", "gearbox.sun.bearing_damping_N_s_m=5000",
    "gearbox.ring.bearing_damping_N_s_m=5000",   "gearbox.carrier.bearing_damping_N_s_m=5000"};

// The text with the first occurrence of `from` replaced; empty if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    return at == std::string::npos ? "" : text.replace(at, from.size(), to);
}

// The example with the first occurrence of `from` replaced.
inline std::string example_with(const std::string& from, const std::string& to) {
    return replaced(kExampleStudy, from, to);
}

}  // namespace gearpod::tests
