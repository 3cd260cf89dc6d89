#include "mc/study/elements/bearings.hpp"

#include <fmt/format.h>

#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"
#include "signals/noise/bearing_impulses.hpp"

namespace gearpod::mc {
namespace {

Bearing read_bearing(const ListElement& element) {
    Bearing bearing;
    bearing.fault =
        static_cast<BearingFault>(element.choice("fault", kBearingFaults, true).value_or(0));
    if (element.first_of("shaft", "shaft_Hz")) {
        bearing.shaft = element.shaft();
    } else if (element.has("shaft_Hz")) {
        bearing.shaft_Hz = element.number("shaft_Hz", kAbove0);
    }
    bearing.elements = element.integer("elements", {3.0, 1000.0});
    bearing.diameter_ratio = element.number("diameter_ratio", {0.01, 0.9});
    bearing.contact_angle_deg = element.number("contact_angle_deg", {0.0, 60.0}, 0.0);
    bearing.amplitude_m_s2 = element.number("amplitude_m_s2", kAbove0);
    bearing.resonance_Hz = element.number("resonance_Hz", {.low = 1.0});
    bearing.damping = element.number("damping", {0.001, signals::kMostResonanceDamping}, 0.05);
    bearing.slip = element.number("slip", {0.0, signals::kMostSlip}, 0.01);
    bearing.load_zone_deg = element.number("load_zone_deg", {0.0, 360.0, true}, 180.0);
    if (element.has("load_zone_deg") && load_turns_per_turn(bearing) == 0.0) {
        element.reject("load_zone_deg has no effect: the load of this part is constant",
                       "remove it, or use fault = \"inner\" or \"roller\"");
    }
    bearing.role = static_cast<SourceRole>(element.choice("role", kSourceRoles, false).value_or(0));
    return bearing;
}

}  // namespace

std::vector<Bearing> read_bearings(const Value& list, const RejectElement& reject) {
    std::vector<Bearing> bearings;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        bearings.push_back(read_bearing(ListElement(
            list.elements[i], fmt::format("bearing {}", i + 1), kBearingFields,
            "write { fault = \"outer\", shaft = \"sun\", elements = 9, diameter_ratio = 0.2, "
            "amplitude_m_s2 = 3, resonance_Hz = 2500 }",
            reject)));
    }
    return bearings;
}

std::string bearing_table(const Bearing& bearing) {
    return fmt::format(
        "{{ fault = \"{}\", {}, elements = {}, diameter_ratio = {}, contact_angle_deg = {}, "
        "amplitude_m_s2 = {}, resonance_Hz = {}, damping = {}, slip = {}, {}role = \"{}\" }}",
        kBearingFaults[static_cast<std::size_t>(bearing.fault)].text,
        bearing.shaft ? fmt::format("shaft = \"{}\"", member_name(*bearing.shaft))
                      : fmt::format("shaft_Hz = {}", bearing.shaft_Hz),
        bearing.elements, bearing.diameter_ratio, bearing.contact_angle_deg, bearing.amplitude_m_s2,
        bearing.resonance_Hz, bearing.damping, bearing.slip,
        load_turns_per_turn(bearing) > 0.0
            ? fmt::format("load_zone_deg = {}, ", bearing.load_zone_deg)
            : "",
        kSourceRoles[static_cast<std::size_t>(bearing.role)].text);
}

}  // namespace gearpod::mc
