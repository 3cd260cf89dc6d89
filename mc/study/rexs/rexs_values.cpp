#include "mc/study/rexs/rexs_values.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "mc/files/input/number_text.hpp"

namespace gearpod::mc {
namespace {

struct RexsUnit {
    RexsQuantity quantity;
    std::string_view name;  // without blanks
    double factor;
};

using Q = RexsQuantity;
using std::numbers::pi;

// Units of REXS 1.0 to 1.6 first, then other spellings. "mum" is REXS's micrometre.
constexpr std::array kRexsUnits{
    RexsUnit{Q::number, "none", 1.0},
    RexsUnit{Q::number, "", 1.0},
    RexsUnit{Q::number, "-", 1.0},
    RexsUnit{Q::number, "1", 1.0},
    RexsUnit{Q::number, "%", 0.01},
    RexsUnit{Q::length, "mm", 1.0},
    RexsUnit{Q::length, "m", 1e3},
    RexsUnit{Q::length, "mum", 1e-3},
    RexsUnit{Q::length, "um", 1e-3},
    RexsUnit{Q::length, "\xc2\xb5m", 1e-3},
    RexsUnit{Q::length, "\xce\xbcm", 1e-3},
    RexsUnit{Q::length, "cm", 10.0},
    RexsUnit{Q::length, "dm", 100.0},
    RexsUnit{Q::length, "in", 25.4},
    RexsUnit{Q::angle, "deg", 1.0},
    RexsUnit{Q::angle, "\xc2\xb0", 1.0},
    RexsUnit{Q::angle, "rad", 180.0 / pi},
    RexsUnit{Q::angle, "mrad", 0.18 / pi},
    RexsUnit{Q::modulus, "N/mm^2", 1e6},
    RexsUnit{Q::modulus, "MPa", 1e6},
    RexsUnit{Q::modulus, "GPa", 1e9},
    RexsUnit{Q::modulus, "Pa", 1.0},
    RexsUnit{Q::modulus, "kPa", 1e3},
    RexsUnit{Q::modulus, "N/m^2", 1.0},
    RexsUnit{Q::modulus, "kN/mm^2", 1e9},
    RexsUnit{Q::modulus, "N/mm\xc2\xb2", 1e6},
    RexsUnit{Q::modulus, "N/m\xc2\xb2", 1.0},
    RexsUnit{Q::stiffness, "N/m", 1.0},
    RexsUnit{Q::stiffness, "N/mm", 1e3},
    RexsUnit{Q::stiffness, "N/mum", 1e6},
    RexsUnit{Q::stiffness, "N/um", 1e6},
    RexsUnit{Q::stiffness, "kN/mm", 1e6},
    RexsUnit{Q::stiffness, "kN/m", 1e3},
    RexsUnit{Q::stiffness, "MN/m", 1e6},
    RexsUnit{Q::speed, "1/min", 1.0},
    RexsUnit{Q::speed, "rpm", 1.0},
    RexsUnit{Q::speed, "U/min", 1.0},
    RexsUnit{Q::speed, "rev/min", 1.0},
    RexsUnit{Q::speed, "min^-1", 1.0},
    RexsUnit{Q::speed, "1/s", 60.0},
    RexsUnit{Q::speed, "Hz", 60.0},
    RexsUnit{Q::speed, "rad/s", 30.0 / pi},
    RexsUnit{Q::torque, "Nm", 1.0},
    RexsUnit{Q::torque, "kNm", 1e3},
    RexsUnit{Q::torque, "Nmm", 1e-3},
    RexsUnit{Q::torque, "MNm", 1e6},
};

}  // namespace

std::optional<double> rexs_factor(std::string_view unit, RexsQuantity quantity) {
    std::string name;
    for (const char c : unit) {
        if (c != ' ' && c != '\t') {
            name += c;
        }
    }
    for (const RexsUnit& candidate : kRexsUnits) {
        if (candidate.quantity == quantity && candidate.name == name) {
            return candidate.factor;
        }
    }
    return {};
}

std::string rexs_units(RexsQuantity quantity) {
    std::string list;
    for (const RexsUnit& unit : kRexsUnits) {
        if (unit.quantity == quantity && !unit.name.empty()) {
            list += (list.empty() ? "" : ", ") + std::string(unit.name);
        }
    }
    return list;
}

namespace {

// Finite number that takes the whole text.
std::optional<double> parsed(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
    }
    const auto value = parsed_number<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

// Attributes that place a component in space or describe it to a user.
bool is_position(std::string_view attribute) {
    constexpr std::array kPositions{"support_vector",
                                    "u_axis_vector",
                                    "v_axis_vector",
                                    "w_axis_vector",
                                    "reference_component_for_position",
                                    "u_coordinate_on_shaft",
                                    "u_coordinate_on_shaft_inner_side",
                                    "u_coordinate_on_shaft_outer_side",
                                    "rotating_angle_around_neg_u_axis",
                                    "name",
                                    "display_color"};
    for (const std::string_view position : kPositions) {
        if (attribute == position) {
            return true;
        }
    }
    return false;
}

// True for zero, false and empty values, which leave nothing to take into account.
bool is_trivial(const RexsAttribute& attribute) {
    return attribute.text.empty() || attribute.text == "false" || parsed(attribute.text) == 0.0;
}

}  // namespace

void RexsValues::reject(const RexsComponent& component, std::string_view attribute,
                        std::string what, std::string remedy) {
    const RexsAttribute* at = component.find(attribute);
    problems_.push_back(
        {model_.file, at == nullptr ? component.line : at->line,
         component.label() + (attribute.empty() ? "" : ": ") + std::string(attribute),
         std::move(what), std::move(remedy)});
}

std::optional<double> RexsValues::number(const RexsComponent& component, std::string_view attribute,
                                         RexsQuantity quantity) {
    const RexsAttribute* at = component.find(attribute);
    if (at == nullptr) {
        return {};
    }
    const bool again = !used_.insert(at).second;
    const std::optional<double> value = at->scalar ? parsed(at->text) : std::nullopt;
    const std::optional<double> factor = rexs_factor(at->unit, quantity);
    if (!value && !again) {
        reject(component, attribute,
               at->scalar ? fmt::format("must be a number, but is {}", at->text)
                          : "must be one number, but is an array");
    }
    if (!factor && !again) {
        reject(component, attribute,
               at->unit.empty() ? "states no unit" : fmt::format("unit {} is not known", at->unit),
               "the units known here are " + rexs_units(quantity));
    }
    return value && factor ? std::optional(*value * *factor) : std::nullopt;
}

std::optional<double> RexsValues::number(const RexsComponent& component,
                                         std::initializer_list<std::string_view> attributes,
                                         RexsQuantity quantity) {
    for (const std::string_view attribute : attributes) {
        if (component.find(attribute) != nullptr) {
            return number(component, attribute, quantity);
        }
    }
    return {};
}

std::optional<int> RexsValues::count(const RexsComponent& component, std::string_view attribute) {
    const std::optional<double> value = number(component, attribute, RexsQuantity::number);
    constexpr double kMost = 1e6;
    if (value && (*value != std::round(*value) || std::abs(*value) > kMost)) {
        reject(component, attribute, fmt::format("must be a whole number, but is {:g}", *value));
        return {};
    }
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

std::optional<bool> RexsValues::flag(const RexsComponent& component, std::string_view attribute) {
    const RexsAttribute* at = component.find(attribute);
    if (at == nullptr) {
        return {};
    }
    used_.insert(at);
    return at->text == "true" || at->text == "1";
}

std::optional<double> RexsValues::common(const std::vector<const RexsComponent*>& components,
                                         std::initializer_list<std::string_view> attributes,
                                         RexsQuantity quantity) {
    constexpr double kRounded = 1e-6;
    const RexsComponent* first = nullptr;
    std::optional<double> value;
    for (const RexsComponent* component : components) {
        const std::optional<double> next = number(*component, attributes, quantity);
        if (!next) {
            continue;
        }
        if (!value) {
            value = next;
            first = component;
        } else if (std::abs(*next - *value) > kRounded * std::max(1.0, std::abs(*value))) {
            reject(*component, *attributes.begin(),
                   fmt::format("is {:.9g}, but {} has {:.9g}", *next, first->label(), *value),
                   "a study has one value for both");
        }
    }
    return value;
}

std::vector<std::string> RexsValues::unused() const {
    // By type: attributes with the components that have them; and the other types with their
    // number.
    std::map<std::string, std::map<std::string, std::string>> attributes;
    std::map<std::string, int> types;
    for (const RexsComponent& component : model_.components) {
        if (!considered_.contains(&component)) {
            ++types[component.type];
            continue;
        }
        for (const RexsAttribute& attribute : component.attributes) {
            if (used_.contains(&attribute) || is_position(attribute.id) || is_trivial(attribute)) {
                continue;
            }
            std::string& value = attributes[component.type][attribute.id];
            const std::string here =
                attribute.scalar
                    ? attribute.text + (attribute.unit == "none" ? "" : " " + attribute.unit)
                    : "an array";
            value = value.empty() || value == here ? here : "several values";
        }
    }
    std::vector<std::string> lines;
    for (const auto& [type, values] : attributes) {
        std::string list;
        for (const auto& [id, value] : values) {
            list += (list.empty() ? "" : ", ") + id + " (" + value + ")";
        }
        lines.push_back(type + ": " + list);
    }
    std::string list;
    for (const auto& [type, number] : types) {
        list += (list.empty() ? "" : ", ") + fmt::format("{} {}", number, type);
    }
    if (!list.empty()) {
        lines.push_back("components: " + list);
    }
    return lines;
}

}  // namespace gearpod::mc
