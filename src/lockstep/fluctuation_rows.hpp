// Sines of a fluctuation at many nodes of W gearboxes in lockstep.
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

}  // namespace gearpod::lockstep
