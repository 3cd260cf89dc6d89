// SIMD kernels that evaluate fluctuations at the stage nodes of W gearboxes.
#pragma once

namespace gearpod::lockstep {

// Arguments of add_sines. At nodes n with phase phase[n] and time time[n][lane], it adds
//   amplitude sin(2 pi z),  z = turns_per_mesh phase + turns_per_s time + turns,
// to sum[n][lane]. Unless slope is null, it adds the derivative by the phase at fixed time to
// slope[n][lane]. The other arrays are [lane].
struct SineRows {
    int nodes = 0;
    const double* phase = nullptr;
    const double* time = nullptr;
    const double* amplitude = nullptr;
    const double* turns_per_mesh = nullptr;
    const double* turns_per_s = nullptr;
    const double* turns = nullptr;
    double* sum = nullptr;
    double* slope = nullptr;
};
void add_sines(int lanes, const SineRows& rows);

// Arguments of add_splines. At the same nodes, it adds the cubic B-spline with knots [knot][lane]
// at
//   time knots_per_s + first_knot
// to sum. Unless slope is null, it adds the derivative by the phase, with `period` seconds per mesh
// period, to slope. The spline is 0 outside its `count` knots. These must include kSplineMargin
// zeros at each end.
inline constexpr int kSplineMargin = 4;
struct SplineRows {
    int nodes = 0, count = 0;
    const double* time = nullptr;
    const double* knots_per_s = nullptr;
    const double* first_knot = nullptr;
    const double* period = nullptr;
    const double* knot = nullptr;
    double* sum = nullptr;
    double* slope = nullptr;
};
void add_splines(int lanes, const SplineRows& rows);

// Arguments of write_speed_values. Inputs are the variation x of a speed and its derivative by the
// phase at every node. It writes the acceleration of the train's rotation and then the three
// SpeedValue values. Rows have `values` values; these start at index `first_value`.
struct SpeedRows {
    int nodes = 0, values = 0, first_value = 0;
    const double* variation = nullptr;
    const double* slope = nullptr;
    const double* period = nullptr;        // [lane], mean, s
    const double* rotation_m_s = nullptr;  // [lane]
    double* rows = nullptr;
};
void write_speed_values(int lanes, const SpeedRows& rows);

}  // namespace gearpod::lockstep
