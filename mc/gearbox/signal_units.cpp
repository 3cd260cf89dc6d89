#include "mc/gearbox/signal_units.hpp"

#include <fmt/format.h>

#include <numbers>
#include <span>

namespace gearpod::mc {
namespace {

struct SignalUnit {
    const char* name;
    double factor;
    bool listed = true;  // false for another spelling of the previous unit
};

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr SignalUnit kAccelerations[] = {
    {"m/s^2", 1.0},         {"m/s2", 1.0, false}, {"m/s²", 1.0, false},
    {"m s^-2", 1.0, false}, {"mm/s^2", 1e-3},     {"mm/s2", 1e-3, false},
    {"mm/s²", 1e-3, false}, {"g", 9.80665},       {"mg", 9.80665e-3}};
constexpr SignalUnit kAngles[] = {{"rad", 1.0},
                                  {"mrad", 1e-3},
                                  {"urad", 1e-6},
                                  {"µrad", 1e-6, false},
                                  {"deg", kDegree},
                                  {"°", kDegree, false},
                                  {"arcmin", kDegree / 60.0},
                                  {"arcsec", kDegree / 3600.0},
                                  {"turns", 2.0 * std::numbers::pi}};
constexpr SignalUnit kTimes[] = {
    {"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6, false}, {"min", 60.0}};
constexpr SignalUnit kSpeeds[] = {
    {"rpm", 1.0}, {"1/min", 1.0, false}, {"Hz", 60.0}, {"rad/s", 30.0 / std::numbers::pi}};
constexpr SignalUnit kPhases[] = {{"mesh periods", 1.0}, {"1", 1.0, false}};

std::span<const SignalUnit> units_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::acceleration:
            return kAccelerations;
        case Quantity::angle:
            return kAngles;
        case Quantity::time:
            return kTimes;
        case Quantity::speed:
            return kSpeeds;
        case Quantity::phase:
            break;
    }
    return kPhases;
}

}  // namespace

std::optional<double> unit_factor(Quantity quantity, const std::string& unit) {
    if (unit.empty()) {
        return 1.0;
    }
    for (const SignalUnit& known : units_of(quantity)) {
        if (unit == known.name) {
            return known.factor;
        }
    }
    return std::nullopt;
}

std::string known_units(Quantity quantity) {
    std::string text;
    for (const SignalUnit& known : units_of(quantity)) {
        if (known.listed) {
            text += fmt::format("{}{}", text.empty() ? "" : ", ", known.name);
        }
    }
    return text;
}

}  // namespace gearpod::mc
