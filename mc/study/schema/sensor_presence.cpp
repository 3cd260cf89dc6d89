#include <fmt/format.h>

#include "mc/study/schema/presence.hpp"

namespace gearpod::mc {
namespace {

// Forbidden unless another key is given, "no tones are given".
Presence companion(bool given, const std::string& without, std::string_view key,
                   const Presence& otherwise) {
    return given ? otherwise
                 : Presence{Need::forbidden, fmt::format("{}: {}", without, key), {key}};
}

Presence required_by(std::string_view key) {
    return {Need::required, fmt::format("{} is given", key), {key}};
}

constexpr std::string_view kBackground = "sensor.background_Hz", kResponse = "sensor.response_Hz";

}  // namespace

Presence with_tones(const Study& s) {
    return companion(!s.sensor.tones.empty(), "no tones are given", "sensor.tones",
                     acceleration_detail(s));
}

Presence with_bearings(const Study& s) {
    return companion(!s.sensor.bearings.empty(), "no bearings are given", "sensor.bearings",
                     acceleration_detail(s));
}

Presence background_needs(const Study& s) {
    return companion(!s.sensor.background_Hz.empty(), "no background is given", kBackground,
                     required_by(kBackground));
}

Presence with_background(const Study& s) {
    return companion(!s.sensor.background_Hz.empty(), "no background is given", kBackground,
                     acceleration_detail(s));
}

Presence response_needs(const Study& s) {
    return companion(!s.sensor.response_Hz.empty(), "no response is given", kResponse,
                     required_by(kResponse));
}

Presence bearing_response(const Study& s) {
    return companion(!s.sensor.response_Hz.empty(), "no response is given", kResponse,
                     bearings_move(s));
}

Presence sun_phase_needs(const Study& s) {
    constexpr std::string_view kGain = "sensor.sun_response_gain";
    return companion(!s.sensor.sun_response_gain.empty(), "no gain is given", kGain,
                     required_by(kGain));
}

Presence carrier_phase_needs(const Study& s) {
    constexpr std::string_view kGain = "sensor.carrier_response_gain";
    return companion(!s.sensor.carrier_response_gain.empty(), "no gain is given", kGain,
                     required_by(kGain));
}

Presence without_response(const Study& s) {
    return companion(s.sensor.response_Hz.empty(), "a measured response contains the modes",
                     kResponse, acceleration_detail(s));
}

Presence with_housing_modes(const Study& s) {
    return companion(!s.sensor.housing_modes.empty(), "no modes are given", "sensor.housing_modes",
                     acceleration_detail(s));
}

}  // namespace gearpod::mc
