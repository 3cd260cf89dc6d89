// Rules that say whether a key is required, optional or forbidden, depending on the rest of a
// study.
#pragma once

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

Presence always(const Study&);
Presence may(const Study&);
Presence paris_needs(
    const Study&);  // required with life.interval_h, but forbidden with a growth curve

// True if the study gives the key: a value, or a list that is not empty.
bool gives(const Study&, std::string_view path);
// Forbidden unless the study gives the key `other`.
Presence belonging_to(const Study&, std::string_view other, const Presence& otherwise);
// Key that belongs to another one: forbidden without it, else by `kRule`, or required.
template <KeyText kOther, Presence (*kRule)(const Study&) = may>
Presence only_with(const Study& s) {
    return belonging_to(s, kOther.text, kRule(s));
}
template <KeyText kOther>
Presence needed_with(const Study& s) {
    return belonging_to(s, kOther.text,
                        {Need::required, std::string(kOther.text) + " is given", {kOther.text}});
}

// Key that one value of a choice needs: required with it, else forbidden.
Presence belonging_to_choice(const Study&, std::string_view choice, std::string_view value);
template <KeyText kChoice, KeyText kValue>
Presence needed_for(const Study& s) {
    return belonging_to_choice(s, kChoice.text, kValue.text);
}

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
Presence foundation(const Study&);          // required if gear bodies are elastic
Presence ring_foundation(const Study&);     // required if rings are elastic
// Rim and web of a member's gear blank: each one requires the other; forbidden where gear bodies
// are rigid.
Presence rim(const Study&, Member member);
Presence web(const Study&, Member member);
Presence tooth_quality(const Study&);  // only if the gears are known
Presence bearings_move(const Study&);  // only where planets move on their bearings

Presence without_response(const Study&);  // not with a measured response

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

}  // namespace gearpod::mc
