#include "mc/study/elements/housing_modes.hpp"

#include <fmt/format.h>

#include "mc/study/housing_bearings.hpp"

namespace gearpod::mc {

std::vector<HousingMode> read_housing_modes(const Value& list, const RejectElement& reject) {
    std::vector<HousingMode> modes;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(
            list.elements[i], fmt::format("mode {}", i + 1), kHousingFields,
            "write { frequency_Hz = 420, damping = 0.03, participation = 0.8 }", reject);
        HousingMode mode;
        mode.frequency_Hz = element.number("frequency_Hz", {.low = 1.0});
        mode.damping = element.number("damping", {0.001, 1.0});
        mode.participation = element.number("participation", kParticipation);
        if (element.has("nodal_diameters")) {
            mode.nodal_diameters = element.integer("nodal_diameters", {0.0, 100.0});
        }
        for (const HousingBearing& bearing : kHousingBearings) {
            mode.*bearing.per_kg = element.number(bearing.per_kg_name, kParticipation, 0.0);
        }
        modes.push_back(mode);
    }
    return modes;
}

std::string housing_table(const HousingMode& mode) {
    std::string more =
        mode.nodal_diameters ? fmt::format(", nodal_diameters = {}", *mode.nodal_diameters) : "";
    for (const HousingBearing& bearing : kHousingBearings) {
        if (mode.*bearing.per_kg != 0.0) {
            more += fmt::format(", {} = {}", bearing.per_kg_name, mode.*bearing.per_kg);
        }
    }
    return fmt::format("{{ frequency_Hz = {}, damping = {}, participation = {}{} }}",
                       mode.frequency_Hz, mode.damping, mode.participation, more);
}

}  // namespace gearpod::mc
