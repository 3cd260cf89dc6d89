#include "analysis/report/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::analysis {
namespace {

std::string without_zeros(std::string text) {
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        text.erase(text.find_last_not_of('.') + 1);
    }
    return text;
}

}  // namespace

std::string number_text(double value, int digits) {
    if (!std::isfinite(value)) {
        return "-";
    }
    if (value == 0.0) {
        return "0";
    }
    const int size = static_cast<int>(std::floor(std::log10(std::abs(value))));
    if (size >= -4 && size < 6) {
        return without_zeros(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - size)));
    }
    const std::string text = fmt::format("{:.{}e}", value, digits - 1);
    const std::size_t exponent = text.find('e');
    return without_zeros(text.substr(0, exponent)) + text.substr(exponent);
}

std::string rate_text(double value) {
    if (!std::isfinite(value)) {
        return "-";
    }
    if (value > 0.0 && value < 5e-5) {
        return "< 0.0001";
    }
    if (value > 0.99995 && value < 1.0) {
        return "> 0.9999";
    }
    if ((value > 0.0 && value < 0.005) || (value > 0.995 && value < 1.0)) {
        return without_zeros(fmt::format("{:.4f}", value));
    }
    const std::string text = fmt::format("{:.2f}", value);
    return text == "-0.00" ? "0.00" : text;
}

std::string rate_text(double value, double lower, double upper) {
    return std::isnan(value) || std::isnan(lower) || std::isnan(upper)
               ? rate_text(value)
               : fmt::format("{} [{}, {}]", rate_text(value), rate_text(lower), rate_text(upper));
}

std::string rate_text(double value, const Interval& bounds) {
    return rate_text(value, bounds.lower, bounds.upper);
}

std::string percent_rate_text(double value, const Interval& bounds) {
    if (std::isnan(value) || std::isnan(bounds.lower) || std::isnan(bounds.upper)) {
        return "-";
    }
    constexpr double kRounding = 1e-9;
    // Whole percent, but more digits for rare alarms and next to 100.
    const bool rare = bounds.upper < 0.01;
    const double percent = 100.0 * value;
    const bool near_all = value < 1.0 && percent > 99.5;
    const auto whole = [](double number) { return fmt::format("{:.0f}", number); };
    return fmt::format("{} [{}, {}]",
                       rare       ? number_text(percent, 2)
                       : near_all ? number_text(percent, 4)
                                  : whole(percent),
                       rare ? number_text(100.0 * bounds.lower, 2)
                            : whole(std::floor(100.0 * bounds.lower + kRounding)),
                       rare ? number_text(100.0 * bounds.upper, 2)
                            : whole(std::ceil(100.0 * bounds.upper - kRounding)));
}

std::string rate_interval_text(const Interval& bounds) {
    if (std::isnan(bounds.lower) || std::isnan(bounds.upper)) {
        return "-";
    }
    const auto text = [&](double rate) {
        return bounds.upper < 0.005 ? number_text(rate, 2) : rate_text(rate);
    };
    return fmt::format("[{}, {}]", text(bounds.lower), text(bounds.upper));
}

std::string area_text(double area, const Interval& bounds) {
    return std::isnan(area) ? "-"
           : std::isnan(bounds.lower)
               ? fmt::format("{:.3f}", area)
               : fmt::format("{:.3f} [{:.3f}, {:.3f}]", area, bounds.lower, bounds.upper);
}

std::string p_text(double p) {
    return p < 1e-4 ? "< 0.0001" : number_text(p, 2);
}

std::string percent_text(double share) {
    return distinct_text(100.0 * share, 100.0, 3) + " %";
}

std::string joined(const std::vector<std::string>& texts) {
    std::string out;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        out += (i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ") + texts[i];
    }
    return out;
}

std::string capitalised(std::string text) {
    if (!text.empty()) {
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    }
    return text;
}

std::string feature_text(const std::string& name) {
    const features::Feature* feature = features::find_feature(name);
    return feature == nullptr ? name : fmt::format("the {} ({})", feature->title, name);
}

std::string distinct_text(double value, double other, int digits) {
    constexpr int kMostDigits = 15;
    while (digits < kMostDigits && value != other && std::isfinite(other) &&
           number_text(value, digits) == number_text(other, digits)) {
        ++digits;
    }
    return number_text(value, digits);
}

std::string input_name(const std::string& name, const std::string& unit) {
    if (name == "noise_m_s2") {
        return "sensor noise";
    }
    std::string suffix = unit.empty() || unit == "1" ? "" : "_" + unit;
    if (unit.ends_with("/sqrt(Hz)")) {
        suffix.replace(suffix.find("/sqrt(Hz)"), std::string::npos, "_per_sqrt_Hz");
    }
    std::erase(suffix, '^');
    std::replace(suffix.begin(), suffix.end(), '/', '_');
    std::replace(suffix.begin(), suffix.end(), ' ', '_');
    std::string out = name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name;
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
}

std::string quantity_unit(const std::string& unit) {
    return unit == "1" || unit == "order" ? "" : unit;
}

std::string quantity_text(double value, const std::string& unit, int digits) {
    const std::string shown = quantity_unit(unit);
    return number_text(value, digits) + (shown.empty() ? "" : " " + shown);
}

std::string with_unit(double size, const SizeUnit& unit, int digits) {
    const std::string shown = unit.shown_unit();
    return number_text(size / unit.per_unit(), digits) + (shown.empty() ? "" : " " + shown);
}

std::string range_text(const SizeGroup& range, const SizeUnit& unit) {
    return range.low == range.high
               ? with_unit(range.high, unit)
               : number_text(range.low / unit.per_unit()) + " to " + with_unit(range.high, unit);
}

std::string in_unit(const std::string& name, const SizeUnit& unit) {
    const std::string shown = unit.shown_unit();
    return name + (shown.empty() ? "" : ", " + shown);
}

std::string size_estimate_text(const SizeEstimate& estimate, double smallest, double largest,
                               const SizeUnit& unit, int digits) {
    switch (estimate.where) {
        case SizeEstimate::Where::reached:
            return number_text(estimate.size / unit.per_unit(), digits);
        case SizeEstimate::Where::below_tested:
            return "< " + number_text(smallest / unit.per_unit(), digits);
        case SizeEstimate::Where::not_reached:
            break;
    }
    return "> " + number_text(largest / unit.per_unit(), digits);
}

}  // namespace gearpod::analysis
