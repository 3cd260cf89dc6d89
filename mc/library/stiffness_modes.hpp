// Curves of the gear pairs of a study over one mesh period, as columns of a table, and the natural
// frequencies of its gearbox.
#pragma once

#include <vector>

#include "mc/files/signal_file.hpp"
#include "mc/plan/gearbox_plan.hpp"

namespace gearpod::mc {

// The mesh phase at `points` evenly spaced values (mesh periods) and the mesh stiffness (N/m): a
// column for each gear pair without a fault, and one for each faulty pair, fault size of the study
// and mesh period of the faulty tooth's engagement, for example sp1_crack_3mm_period2.
std::vector<SignalColumn> stiffness_columns(const GearboxPlan& gearbox, int points);

// The mesh phase and the loaded static transmission error (um) of each gear pair, without a fault.
std::vector<SignalColumn> transmission_error_columns(const GearboxPlan& gearbox, int points);

// Natural frequencies, Hz, ascending, one per degree of freedom: undamped, at rest, at the mean
// mesh stiffness.
std::vector<double> natural_frequencies_Hz(const ModalPlan& plan);

// Natural frequencies at one speed of ModalPlan::speed_member, in the frame that turns with the
// carrier.
struct SpeedFrequencies {
    double speed_rad_s = 0.0, mesh_Hz = 0.0;
    std::vector<double> frequencies_Hz;  // ascending, one per degree of freedom
};
// Natural frequencies from rest to `highest` times the nominal speed, at equal intervals. Empty
// without tooth numbers.
std::vector<SpeedFrequencies> frequencies_over_speed(const ModalPlan& plan, double highest,
                                                     int points);

// Speed at which a mesh harmonic meets a natural frequency.
struct CriticalSpeed {
    double speed_rad_s = 0.0, frequency_Hz = 0.0;
    int harmonic = 0, modes = 0;  // modes of the same frequency
};
// Critical speeds of mesh harmonics 1 to `harmonics`, ascending, by straight lines between the
// given speeds.
std::vector<CriticalSpeed> critical_speeds(const std::vector<SpeedFrequencies>& speeds,
                                           int harmonics);

}  // namespace gearpod::mc
