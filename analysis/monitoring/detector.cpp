#include "analysis/monitoring/detector.hpp"

#include <charconv>

namespace gearpod::analysis {
namespace {

constexpr int kLongest = 10'000;  // limit of the records that a rule remembers
constexpr std::string_view kTwoSided = " two-sided";

template <class Number>
std::optional<Number> number_in(std::string_view text, Number low, Number high) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

std::optional<DetectionRule> parse_rule(std::string_view text) {
    if (text == "single") {
        return SingleRule{};
    }
    const auto after = [&](std::string_view word) { return text.substr(word.size()); };
    if (text.starts_with("ewma ")) {
        const auto lambda = number_in(after("ewma "), 1e-6, 1.0);
        return lambda ? std::optional<DetectionRule>(EwmaRule{*lambda}) : std::nullopt;
    }
    if (text.starts_with("cusum ")) {
        const auto k = number_in(after("cusum "), 0.0, 1e6);
        return k ? std::optional<DetectionRule>(CusumRule{*k}) : std::nullopt;
    }
    if (text.starts_with("trend ")) {
        const auto window = number_in(after("trend "), 1, kLongest);
        return window ? std::optional<DetectionRule>(TrendRule{*window}) : std::nullopt;
    }
    const auto of = text.find(" of ");
    if (of == std::string_view::npos) {
        return std::nullopt;
    }
    const auto n = number_in(text.substr(of + 4), 1, kLongest);
    const auto m = number_in(text.substr(0, of), 1, n.value_or(0));
    return m ? std::optional<DetectionRule>(MOfNRule{*m, *n}) : std::nullopt;
}

double next_of(DetectionRule& rule, double value) {
    return std::visit([&](auto& alternative) { return alternative.next(value); }, rule);
}

}  // namespace

std::optional<Detector> parse_detector(std::string_view text) {
    const bool two_sided = text.ends_with(kTwoSided);
    if (two_sided) {
        text.remove_suffix(kTwoSided.size());
    }
    const auto rule = parse_rule(text);
    return rule ? std::optional(Detector{*rule, two_sided}) : std::nullopt;
}

std::string detector_forms() {
    return "single, 2 of 3, ewma 0.1 (weight of the latest record), cusum 0.5 (reference value), "
           "trend 100 (records in its window), each optionally followed by two-sided";
}

DetectorState::DetectorState(const Detector& detector)
    : start_(detector), up_(detector.rule), down_(detector.rule) {}

double DetectorState::next(double value) {
    if (std::isnan(value)) {
        return -std::numeric_limits<double>::infinity();
    }
    const double up = next_of(up_, value);
    return start_.two_sided ? std::max(up, next_of(down_, -value)) : up;
}

void DetectorState::reset() {
    up_ = start_.rule;
    down_ = start_.rule;
}

DetectorAlarms detector_alarms(const Detector& detector, std::span<const double> values,
                               double threshold) {
    DetectorAlarms result;
    DetectorState state(detector);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double statistic = state.next(values[i]);
        if (statistic > threshold) {
            result.alarms.push_back(i);
            state.reset();
        } else {
            result.largest_quiet = std::max(result.largest_quiet, statistic);
        }
    }
    return result;
}

}  // namespace gearpod::analysis
