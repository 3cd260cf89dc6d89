#include "gears/power_flow.hpp"

#include <cmath>

namespace gearpod::gears {
namespace {

double& value_of(CentralMembers& members, Member member) {
    return member == Member::sun    ? members.sun
           : member == Member::ring ? members.ring
                                    : members.carrier;
}

}  // namespace

Member output_member(const PowerFlow& flow) {
    for (const Member member : {Member::sun, Member::ring})
        if (member != flow.input && member != flow.fixed)
            return member;
    return Member::carrier;
}

Speeds signed_speeds(const PlanetaryTrain& train, const PowerFlow& flow, Member given,
                     double magnitude) {
    const Speeds s = train_speeds(train, flow.fixed, given, magnitude);
    const bool with_torque = (speed_of(s, flow.input) >= 0) == (flow.input != Member::carrier);
    return with_torque ? s : Speeds{-s.sun, -s.planet, -s.ring, -s.carrier};
}

CentralMembers balanced_torques(const PlanetaryTrain& train, Member given, double magnitude) {
    const double s = train.sun_teeth, r = train.ring_teeth;
    CentralMembers torques{-(s + r), r, s};
    const double per_tooth = magnitude / std::abs(value_of(torques, given));
    return {per_tooth * torques.carrier, per_tooth * torques.ring, per_tooth * torques.sun};
}

CentralMembers transmission_error_weights(const PlanetaryTrain& train, const PowerFlow& flow) {
    const Speeds s = train_speeds(train, flow.fixed, flow.input, 1);
    const Member output = output_member(flow);
    CentralMembers weights;
    value_of(weights, output) = 1;
    value_of(weights, flow.input) = -speed_of(s, output);
    return weights;
}

}  // namespace gearpod::gears
