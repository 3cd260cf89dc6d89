#include "analysis/comparison/comparison_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "analysis/report/text_lines.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

std::string letter(std::size_t file) {
    return file < 26 ? std::string(1, static_cast<char>('A' + file)) : fmt::format("#{}", file + 1);
}

std::string bound_text(double bound, int digits, bool fixed) {
    return !std::isfinite(bound) ? "open"
           : fixed               ? fmt::format("{:.{}f}", bound, digits)
                                 : fmt::format("{:.{}g}", bound, digits);
}

struct Row {
    std::string what, a, b, difference, p;
};

void add_row(std::string& out, const std::string& feature, std::size_t width, const Row& row) {
    const std::string line = fmt::format("{:<{}}{:<15}{:>7}{:>8}  {:<24}{:>8}", feature, width,
                                         row.what, row.a, row.b, row.difference, row.p);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

Row rate_row(const RateDifference& rate, const SizeUnit& unit) {
    Row row{"Pd at " + (rate.size.high > 0.0 ? range_text(rate.size, unit) : "0"), "-", "-", "-",
            ""};
    if (!std::isnan(rate.a)) {
        row.a = fmt::format("{:.3f}", rate.a);
        row.b = fmt::format("{:.3f}", rate.b);
        row.difference = fmt::format("{:+.3f} [{:.3f}, {:.3f}]", rate.b - rate.a, rate.bounds.lower,
                                     rate.bounds.upper);
        row.p = p_text(rate.p_value);
    }
    return row;
}

Row number_row(const std::string& what, const NumberDifference& number, double per_unit,
               bool fixed) {
    const auto value = [&](double size, const char* sign) {
        return std::isnan(size) ? std::string("-")
               : fixed          ? fmt::format("{0}{1:.3f}", *sign == '+' && size >= 0.0 ? "+" : "",
                                              size / per_unit)
                                : fmt::format("{0}{1:.3g}", *sign == '+' && size >= 0.0 ? "+" : "",
                                              size / per_unit);
    };
    Row row{what, value(number.a, ""), value(number.b, ""), "-", p_text(number.p_value)};
    if (number.refusal.empty()) {
        row.difference = fmt::format("{} [{}, {}]", value(number.difference(), "+"),
                                     bound_text(number.bounds.lower / per_unit, 3, fixed),
                                     bound_text(number.bounds.upper / per_unit, 3, fixed));
    }
    return row;
}

void add_file(std::string& out, const ComparisonReport& report, std::size_t f) {
    const ComparedFile& file = report.files[f];
    out += '\n';
    add_wrapped(
        out,
        file.unpaired.empty()
            ? fmt::format("{} against A: on {} graded gearboxes that are the same in both",
                          letter(f), file.pairs)
            : fmt::format("{} against A: different gearboxes ({})", letter(f), file.unpaired),
        2);
    for (const std::string& line : file.differing) {
        add_wrapped(out, "input " + line, 2);
    }
    for (const std::string& line : file.left_out) {
        add_wrapped(out, "not compared: " + line, 2);
    }
    std::size_t width = 9;
    for (const ComparedFeature& feature : file.features) {
        width = std::max(width, feature.feature.size() + 2);
    }
    const SizeUnit& unit = report.size;
    std::string same;
    for (const ComparedFeature& feature : file.features) {
        if (feature.same && feature.noise_level == report.noise_level) {
            same += (same.empty() ? "" : ", ") + feature.feature;
        }
    }
    if (!same.empty()) {
        add_wrapped(out, "the same in every gearbox: " + same, 2);
    }
    add_row(out, "feature", width,
            {"", "A", letter(f),
             fmt::format("{} - A [{:g} %]", letter(f), 100.0 * report.confidence), "p"});
    for (const ComparedFeature& feature : file.features) {
        if (feature.same || feature.noise_level != report.noise_level) {
            continue;
        }
        std::string name = feature.feature;
        for (const RateDifference& rate : feature.comparison.rates) {
            add_row(out, name, width, rate_row(rate, unit));
            name.clear();
        }
        const std::string shown = unit.shown_unit();
        add_row(out, name, width,
                number_row("a90" + (shown.empty() ? "" : ", " + shown), feature.comparison.a90,
                           unit.per_unit(), false));
        add_row(out, "", width, number_row("AUC", feature.comparison.auc, 1.0, true));
        for (const NumberDifference* number : {&feature.comparison.a90, &feature.comparison.auc}) {
            if (!number->refusal.empty()) {
                add_wrapped(
                    out,
                    fmt::format("  no difference of {}: {}",
                                number == &feature.comparison.a90 ? "a90" : "AUC", number->refusal),
                    4);
            }
        }
    }
}

Json number_json(const NumberDifference& value) {
    return {{"values", {number(value.a), number(value.b)}},
            {"difference", number(value.refusal.empty() ? value.difference() : kNan)},
            {"lower", number(value.bounds.lower)},
            {"upper", number(value.bounds.upper)},
            {"p_value", number(value.p_value)},
            {"refusal", text_or_null(value.refusal)}};
}

Json rate_json(const RateDifference& rate) {
    return {{"size_low", rate.size.low},
            {"size_high", rate.size.high},
            {"tested", {rate.tested_a, rate.tested_b}},
            {"pd", {number(rate.a), number(rate.b)}},
            {"difference", number(rate.b - rate.a)},
            {"lower", number(rate.bounds.lower)},
            {"upper", number(rate.bounds.upper)},
            {"p_value", number(rate.p_value)},
            {"only", rate.pairs.pairs() > 0 ? Json({rate.pairs.only_a, rate.pairs.only_b})
                                            : Json(nullptr)}};
}

}  // namespace

std::string comparison_text(const ComparisonReport& report) {
    std::string out;
    for (std::size_t f = 0; f < report.files.size(); ++f) {
        const ComparedFile& file = report.files[f];
        add_wrapped(out,
                    fmt::format("{}  {}{}: {} gearboxes{}", letter(f), file.path,
                                file.title.empty() ? "" : " (" + file.title + ")", file.gearboxes,
                                file.shortage.empty() ? "" : ". " + file.shortage),
                    3);
        for (std::size_t n = 0; n < file.noise_levels.size(); ++n) {
            if (file.noise_levels[n] == report.noise_level && n < file.smallest.size()) {
                const auto& found = file.smallest[n];
                out += found ? fmt::format("   smallest fault found at noise x {:g}: {} by {}\n",
                                           report.noise_level, with_unit(found->size, report.size),
                                           found->feature)
                             : fmt::format("   {} at noise x {:g}\n",
                                           file.without_threshold[n]
                                               ? "no threshold, so detection is unknown"
                                               : "no tested fault found",
                                           report.noise_level);
            }
        }
    }
    add_wrapped(out,
                fmt::format("\nNoise x {:g}. Pd: detection rate, p by McNemar's test on pairs; "
                            "a90: size with POD 90 %; AUC: area under the ROC, p by DeLong's test",
                            report.noise_level),
                0);
    if (report.first_records) {
        add_wrapped(out,
                    "These differences use thresholds set by the first record of each healthy "
                    "gearbox; the results above use all records.",
                    0);
    }
    for (std::size_t f = 1; f < report.files.size(); ++f) {
        add_file(out, report, f);
    }
    return out;
}

nlohmann::json comparison_json(const ComparisonReport& report) {
    Json files = Json::array();
    for (const ComparedFile& file : report.files) {
        Json smallest = Json::array(), features = Json::array();
        for (std::size_t n = 0; n < file.smallest.size(); ++n) {
            Json fault = nullptr;
            if (const auto& found = file.smallest[n]) {
                fault = {{"feature", found->feature},
                         {"size", found->size},
                         {"from_curve", found->from_curve}};
            }
            smallest.push_back({{"noise_level", file.noise_levels[n]},
                                {"fault", fault},
                                {"without_threshold", bool{file.without_threshold[n]}}});
        }
        for (const ComparedFeature& feature : file.features) {
            Json sizes = Json::array();
            for (const RateDifference& rate : feature.comparison.rates) {
                sizes.push_back(rate_json(rate));
            }
            features.push_back({{"name", feature.feature},
                                {"noise_level", feature.noise_level},
                                {"same", feature.same},
                                {"sizes", sizes},
                                {"a90", number_json(feature.comparison.a90)},
                                {"auc", number_json(feature.comparison.auc)}});
        }
        files.push_back({{"path", file.path},
                         {"title", file.title},
                         {"gearboxes", file.gearboxes},
                         {"smallest_faults", smallest},
                         {"shortage", text_or_null(file.shortage)},
                         {"pairs", file.pairs},
                         {"unpaired", text_or_null(file.unpaired)},
                         {"differing_inputs", file.differing},
                         {"left_out", file.left_out},
                         {"features", features}});
    }
    return {{"kind", "comparison"},
            {"size", {{"name", report.size.name}, {"unit", report.size.unit}}},
            {"confidence", report.confidence},
            {"noise_level", report.noise_level},
            {"first_records", report.first_records},
            {"files", files}};
}

}  // namespace gearpod::analysis
