// [life]: gearboxes that are measured again and again.
#pragma once

#include <optional>
#include <vector>

namespace gearpod::mc {

// Gearboxes that are measured again and again while a crack grows; none without an interval_h.
struct Life {
    std::optional<double> interval_h;  // between records
    int records = 200;                 // the most a life has, the baseline's included
    int healthy_lives = 100;           // that count false alarms, and set no threshold
    // The crack is there, as deep as this, when the baseline is known; and where a life ends.
    std::optional<double> first_depth_m, last_depth_m;
    // In place of the first depth and Paris' law: hours since the crack is there, and how deep it
    // is then; linear between. An hour of a gearbox is `curve_pace` of the curve's.
    std::vector<double> curve_h, curve_depth_m;
    std::optional<double> curve_pace;
    // Paris' law: C in mm a cycle at 1 MPa m^(1/2), and m.
    std::optional<double> paris_factor, paris_exponent;
    std::optional<double> fracture_toughness_Pa_m05;  // at which the ligament breaks
    int depth_steps = 8;  // depths from none to the last that are marched; between, interpolated
    // Of a record about its gearbox's value: rms of its logarithm. In short what [random] may say
    // of a record's torque, speed, gain and noise.
    double torque_scatter = 0.0, speed_scatter = 0.0, gain_scatter = 0.0, noise_scatter = 0.0;
    // Torques and speeds at which a gearbox is marched where its records' differ, two without:
    // signals between are interpolated.
    std::optional<int> marched_torques, marched_speeds;
    // How long a recording is, in seconds or in turns of the carrier; without either every tooth of
    // a planet meets every tooth of the ring once. A record averages so many.
    std::optional<double> record_s, record_turns;
    int recordings = 1;

    bool operator==(const Life&) const = default;
};
inline int torques_marched(const Life& life) {
    return life.marched_torques.value_or(2);
}
inline int speeds_marched(const Life& life) {
    return life.marched_speeds.value_or(2);
}
// How deep the crack of a life begins.
double crack_begin_m(const Life& life);

}  // namespace gearpod::mc
