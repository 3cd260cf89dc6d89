#include "mc/study/elements/housing_modes.hpp"

#include <fmt/format.h>

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
        modes.push_back(mode);
    }
    return modes;
}

std::string housing_table(const HousingMode& mode) {
    return fmt::format(
        "{{ frequency_Hz = {}, damping = {}, participation = {}{} }}", mode.frequency_Hz,
        mode.damping, mode.participation,
        mode.nodal_diameters ? fmt::format(", nodal_diameters = {}", *mode.nodal_diameters) : "");
}

}  // namespace gearpod::mc
