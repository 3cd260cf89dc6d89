// The parts of a fluctuation at many nodes of W gearboxes in lockstep.
#pragma once

namespace gearpod::lockstep {

// At nodes n of phase phase[n] and time time[n][lane]: adds
//   amplitude sin(2 pi z),  z = turns_per_mesh phase + turns_per_s time + turns,
// to sum[n][lane], and its derivative by the phase at fixed time to slope[n][lane] unless that is
// null. The others are [lane].
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
void add_sines_1(const SineRows& rows);
void add_sines_4(const SineRows& rows);
void add_sines_8(const SineRows& rows);

// At the same nodes: adds the cubic B-spline of knots ([knot][lane]) at
//   time knots_per_s + first_knot
// to sum, and its derivative by the phase, with `period` seconds a mesh period, to slope unless
// that is null. Knots before the first and behind the last of `count` are 0; kSplineMargin of them
// must be stored as zeros at both ends, and do count.
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
void add_splines_1(const SplineRows& rows);
void add_splines_4(const SplineRows& rows);
void add_splines_8(const SplineRows& rows);

// From the variation x of a speed and its derivative by the phase at every node: the pace
// (PaceValue) as three values, and before it the acceleration of the train's turning, in rows of
// `values` values that lie `first_value` from their beginning.
struct PaceRows {
    int nodes = 0, values = 0, first_value = 0;
    const double* variation = nullptr;
    const double* slope = nullptr;
    const double* period = nullptr;       // [lane], mean, s
    const double* turning_m_s = nullptr;  // [lane]
    double* rows = nullptr;
};
void write_pace_1(const PaceRows& rows);
void write_pace_4(const PaceRows& rows);
void write_pace_8(const PaceRows& rows);

}  // namespace gearpod::lockstep
