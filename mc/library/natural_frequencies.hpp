// Natural frequencies of the gearbox of a study.
#pragma once

#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Natural frequencies, Hz, ascending, one per degree of freedom: undamped, at rest, at the mean
// mesh stiffness. The study may lack tooth numbers if its mesh stiffness is constant. Throws
// SceneError (mc/scene/scene_error.hpp) if masses or inertias are missing.
std::vector<double> natural_frequencies_Hz(const Study& study);

// Natural frequencies at one speed of speed_member(), in the frame that turns with the carrier.
struct SpeedFrequencies {
    double speed_rad_s = 0.0, mesh_Hz = 0.0;
    std::vector<double> frequencies_Hz;  // ascending, one per degree of freedom
};
// Natural frequencies from rest to `highest` times the nominal speed, at equal intervals. Empty
// without tooth numbers. Throws like natural_frequencies_Hz().
std::vector<SpeedFrequencies> frequencies_over_speed(const Study& study, double highest,
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
