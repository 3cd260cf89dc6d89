// Complete studies of the other kinds of gearbox, degrees of freedom and fault, for variation in
// tests.
#pragma once

#include "tests/mc/study_example.hpp"
#include "tests/test.hpp"

namespace gearpod::tests {

// The sections at the end of every example.
inline const std::string kVibrationSections = R"([sensor]
sampling_Hz = 50000
low_pass_Hz = 10000
encoder_sampling_Hz = 50000
[ensemble]
instances = 3
threshold_instances = 2
seed = 1
)";

// Source: Tian (2004), Table 4.1; a chip as in section 3.2.
inline const std::string kFixedShaftStudy = R"(title = "fixed-shaft"
[gearbox]
kind = "fixed-shaft"
pinion.teeth = 19
gear.teeth = 48
module_mm = 3.175
pressure_angle_deg = 20
face_width_mm = 16
young_modulus_Pa = 2.068e11
poisson_ratio = 0.3
tooth_profile = "base-circle"
pinion.mass_kg = 0.96
gear.mass_kg = 2.88
pinion.inertia_kg_m2 = 4.3659e-4
gear.inertia_kg_m2 = 8.3602e-3
motor_inertia_kg_m2 = 0.0021
load_inertia_kg_m2 = 0.0105
pinion.bearing_stiffness_N_m = 6.56e7
gear.bearing_stiffness_N_m = 6.56e7
pinion.bearing_damping_N_s_m = 1.8e5
gear.bearing_damping_N_s_m = 1.8e5
motor_coupling_stiffness_N_m_rad = 4.4e4
load_coupling_stiffness_N_m_rad = 4.4e4
motor_coupling_damping_N_m_s_rad = 5e5
load_coupling_damping_N_m_s_rad = 5e5
mesh_damping_time_s = 3.99e-6
[effects]
mesh_damping = "proportional"
[operation]
torque_N_m = 11.9
load_torque_N_m = 48.8
pinion_speed_rpm = 1800
[fault]
kind = "chip"
member = "pinion"
chip_mm = 8
chip_height_mm = 2
)" + kVibrationSections;

// Source: Park et al. (2016), 16/26/68 with the carrier driving; a planet tooth that loses
// stiffness.
inline const std::string kQuasiStaticStudy = R"(title = "quasi-static"
[gearbox]
kind = "planetary"
planets = 3
sun.teeth = 16
planet.teeth = 26
ring.teeth = 68
module_mm = 10
pressure_angle_deg = 20
helix_angle_deg = 7
tooth_profile = "square-wave"
sun_planet.low_stiffness_N_m = 1.2e9
sun_planet.high_stiffness_N_m = 2e9
sun_planet.contact_ratio = 1.5
ring_planet.low_stiffness_N_m = 1.4e9
ring_planet.high_stiffness_N_m = 2.4e9
ring_planet.contact_ratio = 1.6
ring_to_sun_phase = 0.625
planet_positions_deg = [0, 90, 180]
support_stiffness_N_m = 1e12
[operation]
input = "carrier"
torque_on = "carrier"
torque_N_m = 180e3
carrier_speed_rpm = 30
[effects]
motion = "quasi-static-torsional"
[fault]
kind = "reduction"
member = "planet"
side = "both"
[random]
fault.reduction = { distribution = "levels", values = [0, 0.1, 0.2, 0.3] }
operation.torque_N_m = { distribution = "uniform", low = 30e3, high = 240e3 }
[sensor]
encoder_sampling_Hz = 2000
encoder_noise_arcsec = 1
[ensemble]
instances = 8
threshold_instances = 4
seed = 3
)";

// Source: Yang et al. (2022), Tables 1 and 2.
inline const std::string kSpatialCrackStudy = R"(title = "spatial crack"
[gearbox]
kind = "planetary"
planets = 4
sun.teeth = 28
planet.teeth = 34
ring.teeth = 96
module_mm = 2
pressure_angle_deg = 20
face_width_mm = 18
young_modulus_Pa = 2.06e11
poisson_ratio = 0.3
tooth_profile = "fillet"
sun.bore_mm = 20
planet.bore_mm = 24
ring.outer_mm = 230
sun.mass_kg = 0.3929
planet.mass_kg = 0.4639
ring.mass_kg = 2.6140
carrier.mass_kg = 7.0405
sun.inertia_kg_m2 = 2.192e-4
planet.inertia_kg_m2 = 3.873e-4
ring.inertia_kg_m2 = 4.657e-3
carrier.inertia_kg_m2 = 1.53e-2
sun.bearing_stiffness_N_m = 1e8
planet.bearing_stiffness_N_m = 1e8
ring.bearing_stiffness_N_m = 1e8
carrier.bearing_stiffness_N_m = 1e8
support_stiffness_N_m = 1e10
mesh_damping_ratio = 0.07
backlash_mm = 0.1
sun_planet.error_um = [10, 2]
ring_planet.error_um = [10, 1]
ring_planet.error_phase_deg = [0, 90]
pitch_error_um = 3
[operation]
torque_N_m = 100
sun_speed_rpm = 1500
[effects]
foundation = "elastic-ring"
contact = "load-dependent"
separation = "two-sided"
[numerics]
integrator = "newmark"
horizon = "full"
[fault]
kind = "spatial-crack"
member = "sun"
stage = 5
growth_depth_mm = [0.5, 1, 1.5, 2, 2]
growth_end_depth_mm = [0, 0, 0, 1, 2]
growth_length_mm = [6, 12, 18, 18, 18]
growth_height_mm = [0.5, 0.5, 0.5, 0.5, 0.5]
growth_end_height_mm = [2, 2, 2, 2, 2]
end_angle_deg = 90
)" + kVibrationSections;

}  // namespace gearpod::tests
