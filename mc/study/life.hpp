// Section [life]: gearboxes that are measured repeatedly while a crack grows.
#pragma once

#include <optional>
#include <vector>

namespace gearpod::mc {

// Lives of gearboxes that are measured repeatedly while a crack grows. Absent without interval_h.
struct Life {
    std::optional<double> interval_h;  // between records
    int records = 200;        // largest number of records of a life, baseline records included
    int healthy_lives = 100;  // used to count false alarms, not to set thresholds
    // Depth of the crack when the baseline is known, and depth at which a life ends.
    std::optional<double> first_depth_m, last_depth_m;
    // Replaces the first depth and Paris' law: hours since the crack started and its depth then,
    // linear in between. One hour of a gearbox is `curve_pace` hours of the curve.
    std::vector<double> curve_h, curve_depth_m;
    std::optional<double> curve_pace;
    // Paris' law: C in mm a cycle at 1 MPa m^(1/2), and m.
    std::optional<double> paris_factor, paris_exponent;
    // Stress intensity at which the remaining ligament breaks.
    std::optional<double> fracture_toughness_Pa_m05;
    // Number of depth steps from 0 to the last depth. A gearbox is integrated at their ends;
    // signals in between are interpolated.
    int depth_steps = 8;
    // Scatter of a record about its gearbox's value: standard deviation of the logarithm. Short
    // form of the record distributions of torque, speed, gain and noise in [random].
    double torque_scatter = 0.0, speed_scatter = 0.0, gain_scatter = 0.0, noise_scatter = 0.0;
    // Number of torques and speeds at which a gearbox is integrated if its records' values differ,
    // by default as many as interpolation_tolerance needs. Signals between them are interpolated.
    std::optional<int> given_torques, given_speeds;
    // The same with nodes of one polynomial, which converges faster (load_axis.hpp).
    std::optional<int> polynomial_torques, polynomial_speeds;
    // Instead of that: number of torques and speeds, equally frequent, that records have at all.
    std::optional<int> distinct_torques, distinct_speeds;
    // Largest error of signals between them, relative to the change made by the smallest crack of
    // interest. Numbers that are not given are raised until pilots keep it.
    double interpolation_tolerance = 0.1;
    std::optional<double> smallest_depth_m;  // by default half the last depth
    // Length of a recording, in seconds or in carrier turns; by default every tooth of a planet
    // meets every tooth of the ring once. A record averages `recordings` recordings.
    std::optional<double> record_s, record_turns;
    int recordings = 1;

    bool operator==(const Life&) const = default;
};
inline int integrated_torques(const Life& life) {
    return life.given_torques.value_or(2);
}
inline int integrated_speeds(const Life& life) {
    return life.given_speeds.value_or(2);
}
// Smallest crack of interest. Precondition: the last depth is given.
inline double smallest_depth_m(const Life& life) {
    return life.smallest_depth_m.value_or(0.5 * *life.last_depth_m);
}
// Depth of the crack at the start of a life.
double crack_begin_m(const Life& life);

}  // namespace gearpod::mc
