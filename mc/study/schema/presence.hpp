// Rules that say whether a key is required, optional or forbidden, depending on the rest of a
// study.
#pragma once

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

Presence always(const Study&);
Presence may(const Study&);
Presence with_life(const Study&);    // only with life.interval_h
Presence life_needs(const Study&);   // only with life.interval_h, and then required
Presence paris_needs(const Study&);  // as life_needs(), but forbidden with a growth curve
Presence curve_needs(const Study&);  // required with a growth curve, else forbidden
Presence with_curve(const Study&);

// Key of one kind of gearbox only; for that kind `rule` decides.
Presence of_kind(const Study&, GearboxKind kind, const PresenceRule& rule);
template <Presence (*Rule)(const Study&)>
Presence planetary(const Study& s) {
    return of_kind(s, GearboxKind::planetary, Rule);
}
template <Presence (*Rule)(const Study&)>
Presence fixed_shaft(const Study& s) {
    return of_kind(s, GearboxKind::fixed_shaft, Rule);
}

// Length of a member's relief: required if the amount is given and not 0.
Presence tip_relief_length(const Study&, Member member);

Presence tooth_numbers(const Study&);  // unless the stiffness is constant
Presence tooth_module(const Study&);   // as tooth_numbers(); a fixed-shaft gearbox always needs it
Presence shifted_teeth(const Study&);  // only if the gears are known
Presence tooth_body(const Study&);     // unless the stiffness is given
Presence tooth_model(const Study&);    // forbidden if the stiffness is given
Presence constant_stiffness(const Study&);  // only for the profile "constant"
Presence square_wave(const Study&);         // only for the profile "square-wave"
Presence foundation(const Study&);          // required if gear bodies are elastic
Presence ring_foundation(const Study&);     // required if rings are elastic
// Rim and web of a member's gear blank: each one requires the other; forbidden where gear bodies
// are rigid.
Presence rim(const Study&, Member member);
Presence web(const Study&, Member member);
Presence backlash(const Study&);       // only for two-sided separation
Presence tooth_quality(const Study&);  // only if the gears are known
Presence bearings_move(const Study&);  // only where planets move on their bearings

Presence with_tones(const Study&);  // only with sensor.tones
// background_needs: required with sensor.background_Hz; with_background: only with it.
Presence background_needs(const Study&);
Presence with_background(const Study&);
// without_response: not with a measured response; with_housing_modes: only with modes;
// response_needs: required with sensor.response_Hz.
Presence without_response(const Study&);
Presence with_housing_modes(const Study&);
Presence response_needs(const Study&);
// bearing_response: only with sensor.response_Hz, and where sun and carrier move on bearings;
// sun_phase_needs, carrier_phase_needs: required with the gain, else forbidden.
Presence bearing_response(const Study&);
Presence sun_phase_needs(const Study&);
Presence carrier_phase_needs(const Study&);
Presence with_bearings(const Study&);  // only with sensor.bearings
Presence torque_sine(const Study&);    // only with operation.torque_fluctuation
Presence torque_noise(const Study&);   // only with operation.torque_noise, and then required
Presence speed_sine(const Study&);     // only with operation.speed_fluctuation, and then required
Presence speed_phase(const Study&);
Presence speed_noise(const Study&);
Presence gravity(const Study&);  // only with effects.gravity

Presence mass(const Study&);             // unless the motion is quasi-static
Presence inertia(const Study&);          // J needs the radii
Presence inertia_over_r2(const Study&);  // required where no disc can be assumed
Presence bearing(const Study&);          // unless the motion is torsional

Presence acceleration(const Study&);         // required unless the motion is quasi-static
Presence white_records(const Study&);        // only with several records, of white noise
Presence acceleration_detail(const Study&);  // forbidden if the motion is quasi-static
Presence integration(const Study&);          // forbidden if nothing is integrated in time

Presence with_alarm_target(const Study&);   // only with a target of false alarms in time
Presence alarm_target_needs(const Study&);  // required with one, unless life.interval_h is given
Presence with_baseline(const Study&);       // only with features that use a baseline record

Presence length_edges(const Study&);  // only if the fault's size is a length
Presence number_edges(const Study&);  // only if the fault's size is a pure number

Presence until_part(const Study&);   // only with until.half_width, and then required
Presence until_level(const Study&);  // only with until.half_width

}  // namespace gearpod::mc
