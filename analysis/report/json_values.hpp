// Conversion of numbers, intervals, reasons and sizes to JSON; null where there is no value.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

using Json = nlohmann::json;

inline Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

inline Json numbers(std::span<const double> values) {
    Json all = Json::array();
    for (const double value : values) {
        all.push_back(number(value));
    }
    return all;
}

// JSON form: [lower, upper]
inline Json to_json(const Interval& bounds) {
    return Json::array({number(bounds.lower), number(bounds.upper)});
}

inline Json text_or_null(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

// JSON form: {"where": "reached", "below_tested" or "not_reached", "size": number or null}
inline Json to_json(const SizeEstimate& estimate) {
    const char* where[] = {"reached", "below_tested", "not_reached"};
    return {{"where", where[static_cast<int>(estimate.where)]},
            {"size",
             estimate.where == SizeEstimate::Where::reached ? Json(estimate.size) : Json(nullptr)}};
}

inline Json to_json(const SizeBounds& bounds) {
    return {{"estimate", to_json(bounds.estimate)},
            {"lower", to_json(bounds.lower)},
            {"upper", to_json(bounds.upper)}};
}

}  // namespace gearpod::analysis
