// FRMS, root mean square of the filtered signal, after Lei, Kong, Lin and Zuo, Meas. Sci. Technol.
// 23 (2012) 055605: the signal of a planetary gearbox without its regular lines. These are the mesh
// harmonics and their sidebands due to the carrier's rotation. All are whole multiples of the
// carrier frequency, so the filter subtracts the average over carrier turns. Lines of sun and
// planet teeth have other orders; those of a tooth of a fixed ring coincide with the regular ones.
#pragma once

#include "features/signals.hpp"

namespace gearpod::features {

inline double frms(const FilteredSensor& sensor) {
    return sensor.rms;
}

}  // namespace gearpod::features
