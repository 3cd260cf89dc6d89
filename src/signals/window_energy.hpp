// The kernel behind Windowing; see windowing.hpp.
#pragma once

namespace gearpod::signals {

// energy[b] = sum over m < phases of weight_squared[m] extended[b + m] for b < bins, where the
// weights are 1 at flat_first .. flat_first + flat_count - 1. `extended` holds bins + phases - 1
// values; `scratch` twice that. Every window is summed in the same order, whatever its
// place.
struct WindowEnergyArguments {
    long bins = 0;
    int phases = 0;
    int flat_first = 0;
    int flat_count = 0;
    const double* weight_squared = nullptr;
    const double* extended = nullptr;
    double* scratch = nullptr;
    double* energy = nullptr;
    double* largest = nullptr;  // the largest energy
};

void window_energy(const WindowEnergyArguments& a);

}  // namespace gearpod::signals
