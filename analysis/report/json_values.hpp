// Conversion of values, and of structs with field tables, to JSON; null where there is no value.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

using Json = nlohmann::json;

inline Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

inline Json text_or_null(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

// JSON form: [lower, upper]
inline Json to_json(const Interval& bounds) {
    return Json::array({number(bounds.lower), number(bounds.upper)});
}

// JSON form: [low, high]
inline Json to_json(const SizeGroup& sizes) {
    return Json::array({number(sizes.low), number(sizes.high)});
}

inline Json to_json(Alarm alarm) {
    return alarm_name(alarm);
}

// JSON form: {"where": "reached", "below_tested" or "not_reached", "size": number or null}
inline Json to_json(const SizeEstimate& estimate) {
    const char* where[] = {"reached", "below_tested", "not_reached"};
    return {{"where", where[static_cast<int>(estimate.where)]},
            {"size",
             estimate.where == SizeEstimate::Where::reached ? Json(estimate.size) : Json(nullptr)}};
}

// Structs whose JSON is more than their fields (detection_json.cpp).
struct HitMissFit;
struct HitMissPod;
struct SignalResponseFit;
struct SignalResponsePod;
struct RatePoint;
struct FeatureRank;
struct RocPoint;
struct ConditionLevel;
struct EpistemicBand;
struct SmallestFault;
Json to_json(const std::vector<PodPoint>& band);
Json to_json(const std::vector<RocPoint>& roc);
Json to_json(const LevelDetection& level);
Json to_json(const HitMissFit& fit);
Json to_json(const HitMissPod& pod);
Json to_json(const SignalResponseFit& fit);
Json to_json(const SignalResponsePod& pod);
Json to_json(const RatePoint& point);
Json to_json(const FeatureRank& rank);
Json to_json(const ConditionLevel& level);
Json to_json(const EpistemicBand& uncertain);
Json to_json(const SmallestFault& smallest);

template <class Structure>
Json fields_json(const Structure& structure);

// A number that is not finite and an absent optional are null; a list is an array.
template <class Value>
Json json_of(const Value& value) {
    if constexpr (std::is_same_v<Value, Json>) {
        return value;
    } else if constexpr (std::is_floating_point_v<Value>) {
        return number(value);
    } else if constexpr (requires { to_json(value); }) {
        return to_json(value);
    } else if constexpr (HasFields<const Value>) {
        return fields_json(value);
    } else if constexpr (requires { value.has_value(); }) {  // std::optional
        return value ? json_of(*value) : Json(nullptr);
    } else if constexpr (requires { value.index(); }) {  // std::variant
        return std::visit([](const auto& held) { return json_of(held); }, value);
    } else if constexpr (requires { value.begin(); } &&
                         !std::is_convertible_v<Value, std::string_view>) {
        Json all = Json::array();
        for (const auto& item : value) {
            all.push_back(json_of(item));
        }
        return all;
    } else {
        return value;
    }
}

// Adds a field to an object. An interval or a size group whose name ends in lower_upper or low_high
// becomes two numbers. An empty refusal is null.
template <class Value>
void add_field(Json& json, std::string_view name, const Value& value) {
    constexpr bool bounds = std::is_same_v<Value, Interval>;
    if constexpr (bounds || std::is_same_v<Value, SizeGroup>) {
        const std::string_view pair = bounds ? "lower_upper" : "low_high";
        if (name.ends_with(pair)) {
            const std::string begin(name.substr(0, name.size() - pair.size()));
            const auto [low, high] = value;
            json[begin + (bounds ? "lower" : "low")] = number(low);
            json[begin + (bounds ? "upper" : "high")] = number(high);
            return;
        }
    }
    json[std::string(name)] = json_of(value);
    if constexpr (std::is_same_v<Value, std::string>) {
        if (name == "refusal") {
            json["refusal"] = text_or_null(value);
        }
    }
}

template <class Structure>
Json fields_json(const Structure& structure) {
    Json json = Json::object();
    for_each_field(structure, [&](auto field, const auto& member) {
        if constexpr (decltype(field)::written) {
            add_field(json, field.name, member);
        }
    });
    return json;
}

// One array for each field of a list of structs.
template <class Structure>
Json columns_json(const std::vector<Structure>& rows) {
    Json json = fields_json(Structure{});
    for (auto& [name, column] : json.items()) {
        column = Json::array();
    }
    for (const Structure& row : rows) {
        for_each_field(row, [&](auto field, const auto& member) {
            json[std::string(field.name)].push_back(json_of(member));
        });
    }
    return json;
}

}  // namespace gearpod::analysis
