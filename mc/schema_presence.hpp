// Which keys must, may or must not be given, depending on the choices of a study.
#pragma once

#include "mc/schema.hpp"

namespace gearpod::mc {

Presence always(const Study&);
Presence may(const Study&);

Presence tooth_geometry(const Study&);      // unless the stiffness is constant
Presence constant_stiffness(const Study&);  // only if it is
Presence inertia(const Study&);             // J needs the radii
Presence inertia_over_r2(const Study&);     // required where no disc can be assumed
Presence bearing(const Study&);             // unless the motion is torsional

Presence damping_ratio(const Study&);
Presence damping_time(const Study&);
Presence damping_constant(const Study&);

Presence crack(const Study&);          // required for a crack
Presence planet_side(const Study&);    // required for a crack in a planet
Presence planet_number(const Study&);  // only for a crack in a planet

Presence until_part(const Study&);   // only with until.half_width, and then required
Presence until_level(const Study&);  // only with until.half_width

}  // namespace gearpod::mc
