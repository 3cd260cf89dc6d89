#include "mc/study/other_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

double projected_ratio(const Bearing& bearing) {
    return bearing.diameter_ratio * std::cos(bearing.contact_angle_deg * std::numbers::pi / 180.0);
}

double cage_order(const Bearing& bearing) {
    return 0.5 * (1.0 - projected_ratio(bearing));
}

std::string_view part_name(BearingFault fault) {
    switch (fault) {
        case BearingFault::outer:
            return "outer ring";
        case BearingFault::inner:
            return "inner ring";
        case BearingFault::roller:
            return "rolling element";
        case BearingFault::cage:
            return "cage";
    }
    return "";
}

}  // namespace

double impulses_per_turn(const Bearing& bearing) {
    const double ratio = projected_ratio(bearing);
    switch (bearing.fault) {
        case BearingFault::outer:
            return 0.5 * bearing.elements * (1.0 - ratio);
        case BearingFault::inner:
            return 0.5 * bearing.elements * (1.0 + ratio);
        case BearingFault::roller:
            return (1.0 - ratio * ratio) / bearing.diameter_ratio;
        case BearingFault::cage:
            return cage_order(bearing);
    }
    return 0.0;
}

double load_turns_per_turn(const Bearing& bearing) {
    switch (bearing.fault) {
        case BearingFault::inner:
            return 1.0;
        case BearingFault::roller:
            return cage_order(bearing);
        case BearingFault::outer:
        case BearingFault::cage:
            break;
    }
    return 0.0;
}

bool has_other_sources(const Study& study) {
    return !study.sensor.bearings.empty() || !study.sensor.stages.empty();
}

bool is_coupled(const Study& study) {
    return std::ranges::any_of(study.sensor.stages, &NeighbourStage::coupled);
}

bool has_other_fault(const Study& study) {
    const auto is_fault = [](const auto& source) { return source.role == SourceRole::other_fault; };
    return std::ranges::any_of(study.sensor.bearings, is_fault) ||
           std::ranges::any_of(study.sensor.stages, is_fault);
}

std::string bearing_text(const Bearing& bearing) {
    return bearing.shaft
               ? fmt::format("{} of a bearing of the {}", part_name(bearing.fault),
                             member_name(*bearing.shaft))
               : fmt::format("{} of a bearing of another shaft", part_name(bearing.fault));
}

std::string other_fault_text(const Study& study) {
    std::string text;
    const auto add = [&](SourceRole role, const std::string& what) {
        if (role == SourceRole::other_fault) {
            text += (text.empty() ? "a fault of " : " and ") + what;
        }
    };
    for (const Bearing& bearing : study.sensor.bearings) {
        add(bearing.role, "the " + bearing_text(bearing));
    }
    for (const NeighbourStage& stage : study.sensor.stages) {
        add(stage.role, "the neighbouring stage \"" + stage.name + "\"");
    }
    return text;
}

}  // namespace gearpod::mc
