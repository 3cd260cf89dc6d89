// Keys that must, may or must not be given, depending on the choices of a study.
#pragma once

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

Presence always(const Study&);
Presence may(const Study&);
Presence with_life(const Study&);    // only where gearboxes live on
Presence life_needs(const Study&);   // there, and then required
Presence paris_needs(const Study&);  // there, unless a curve says how deep the crack is
Presence curve_needs(const Study&);  // with that curve
Presence with_curve(const Study&);

// A key of one kind of gearbox only; there Rule decides.
Presence of_kind(const Study&, GearboxKind kind, Presence (*rule)(const Study&));
template <Presence (*Rule)(const Study&)>
Presence planetary(const Study& s) {
    return of_kind(s, GearboxKind::planetary, Rule);
}
template <Presence (*Rule)(const Study&)>
Presence fixed_shaft(const Study& s) {
    return of_kind(s, GearboxKind::fixed_shaft, Rule);
}

// The length of a member's relief: with its amount, and then required.
Presence relief_length(const Study&, Member member, std::string_view end);
template <Member kMember>
Presence tip_relief_length(const Study& s) {
    return relief_length(s, kMember, "tip");
}
template <Member kMember>
Presence root_relief_length(const Study& s) {
    return relief_length(s, kMember, "root");
}

Presence tooth_numbers(const Study&);       // unless the stiffness is constant
Presence tooth_module(const Study&);        // as these; a fixed-shaft gearbox always needs it
Presence shifted_teeth(const Study&);       // only if the gears are known
Presence relief_shape(const Study&);        // only with relief
Presence flank_gaps(const Study&);          // only with relief, crowning or extended contact
Presence tooth_body(const Study&);          // unless the stiffness is given
Presence tooth_model(const Study&);         // only if it is not
Presence constant_stiffness(const Study&);  // only if it is
Presence square_wave(const Study&);         // only if it is
Presence foundation(const Study&);          // required for one
Presence ring_foundation(const Study&);     // required for one of which rings have one
// Rim and web of a member's blank: either with the other, where bodies are elastic.
enum class BlankPart { rim, web };
Presence blank_part(const Study&, Member member, BlankPart part);
template <Member kMember, BlankPart kPart>
Presence blank(const Study& s) {
    return blank_part(s, kMember, kPart);
}
Presence backlash(const Study&);       // only for two-sided separation
Presence tooth_quality(const Study&);  // and the gears are known
Presence bearings_move(const Study&);  // only where planets move on their bearings
Presence bearings_damp(const Study&);  // and not without inertia
Presence planet_masses(const Study&);  // only where their masses have a part

Presence with_tones(const Study&);    // only with sensor.tones
Presence torque_sine(const Study&);   // only with operation.torque_fluctuation
Presence torque_noise(const Study&);  // only with operation.torque_noise, and then required
Presence speed_sine(const Study&);    // likewise
Presence speed_phase(const Study&);
Presence speed_noise(const Study&);
Presence gravity(const Study&);  // only with effects.gravity

Presence mass(const Study&);             // unless the motion is quasi-static
Presence inertia(const Study&);          // J needs the radii
Presence inertia_over_r2(const Study&);  // required where no disc can be assumed
Presence bearing(const Study&);          // unless the motion is torsional
Presence damping_ratio(const Study&);
Presence damping_time(const Study&);
Presence damping_constant(const Study&);

Presence acceleration(const Study&);  // required unless the motion is quasi-static
Presence noise_rms(const Study&);     // has no place beside the density
Presence noise_density(const Study&);
Presence white_records(const Study&);        // only with several records, of white noise
Presence acceleration_detail(const Study&);  // has no place where it is
Presence integration(const Study&);          // has no place where nothing is integrated

Presence with_baseline(const Study&);  // only with features that compare with one

Presence length_edges(const Study&);  // only if the fault's size is a length
Presence number_edges(const Study&);  // only if it is none

Presence until_part(const Study&);   // only with until.half_width, and then required
Presence until_level(const Study&);  // only with until.half_width

}  // namespace gearpod::mc
