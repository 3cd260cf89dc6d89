#include "analysis/comparison/comparison_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

std::string letter(std::size_t file) {
    return file < 26 ? std::string(1, static_cast<char>('A' + file)) : fmt::format("#{}", file + 1);
}

std::string noise_text(double level) {
    return "noise x " + number_text(level);
}

// Writes values of one kind: rates and areas with three decimals, sizes in the displayed unit.
struct ValueText {
    bool fixed = true;
    double per_unit = 1.0;

    std::string operator()(double value) const {
        if (std::isnan(value)) {
            return "-";
        }
        const std::string text = fmt::format("{:.3f}", value);
        return !fixed ? number_text(value / per_unit) : text == "-0.000" ? "0.000" : text;
    }
    std::string with_sign(double value) const {
        const std::string text = (*this)(value);
        return (value >= 0.0 && text[0] != '-' ? "+" : "") + text;
    }
    std::string bound(double value) const { return std::isfinite(value) ? (*this)(value) : "open"; }
    std::string difference(double value, const Interval& bounds) const {
        return std::isnan(value) ? "-"
                                 : fmt::format("{} [{}, {}]", with_sign(value), bound(bounds.lower),
                                               bound(bounds.upper));
    }
};

std::string difference_text(const NumberDifference& number, const ValueText& text) {
    return number.refusal.empty() ? text.difference(number.difference(), number.bounds) : "-";
}

std::string difference_text(const RateDifference& rate) {
    return std::isnan(rate.a) ? "-" : ValueText{}.difference(rate.b - rate.a, rate.bounds);
}

std::string size_name(const RateDifference& rate, const SizeUnit& unit) {
    return rate.size.high > 0.0 ? range_text(rate.size, unit) : "0";
}

// Calls use(feature, index) for the features at the noise level shown.
template <typename Use>
void for_shown(const ComparedResults& results, const ComparedFile& file, Use&& use) {
    std::size_t index = 0;
    for (const ComparedFeature& feature : file.features) {
        if (feature.noise_level == results.noise_level) {
            use(feature, index++);
        }
    }
}

// Index of the noise level shown among the file's own; their number if the file lacks it.
std::size_t shown_index(const ComparedResults& results, const ComparedFile& file) {
    std::size_t n = 0;
    while (n < file.noise_levels.size() && file.noise_levels[n] != results.noise_level) {
        ++n;
    }
    return n;
}

std::string smallest_text(const ComparedResults& results, const ComparedFile& file) {
    const std::size_t n = shown_index(results, file);
    if (n >= file.smallest.size()) {
        return "-";
    }
    if (const auto& found = file.smallest[n]) {
        return with_unit(found->size, results.size) + " by " + feature_text(found->feature);
    }
    return file.without_threshold[n] ? "no threshold" : "no tested size";
}

Section headline(const ComparedResults& results) {
    Section section{"headline", "", {}};
    std::string found;
    Table table{"files", "", {"", "file", "gearboxes", "study"}, {}, Shown::screen, 2};
    for (std::size_t f = 0; f < results.files.size(); ++f) {
        const ComparedFile& file = results.files[f];
        found +=
            fmt::format("{}{}: {}", f > 0 ? "; " : "", letter(f), smallest_text(results, file));
        table.rows.push_back({letter(f), file.path, std::to_string(file.gearboxes), file.title});
    }
    section.state(
        "headline",
        fmt::format("Smallest fault found with 90 % probability at {} "
                    "confidence, {}: {}.",
                    percent_text(results.confidence), noise_text(results.noise_level), found),
        Shown::screen);
    for (std::size_t f = 0; f < results.files.size(); ++f) {
        const std::string& shortage = results.files[f].shortage;
        section.state(fmt::format("shortage.{}", f),
                      shortage.empty() ? "" : letter(f) + ": " + shortage, Shown::screen);
    }
    section.add(std::move(table));
    section.state("first_records", results.first_records
                                       ? "The differences use thresholds set by the first record "
                                         "of each healthy gearbox; the smallest faults use all "
                                         "records."
                                       : "");
    return section;
}

// The differences of a90 or AUC in all files, for the figure of them.
void add_differences(Section& section, const ComparedResults& results, const std::string& key,
                     const std::string& title, NumberDifference Comparison::*number,
                     const ValueText& text) {
    Table table{key, title,       {"feature", "file", "A", "file's", "difference", "p"},
                {},  Shown::page, 2};
    for (std::size_t f = 1; f < results.files.size(); ++f) {
        for_shown(results, results.files[f], [&](const ComparedFeature& feature, std::size_t) {
            const NumberDifference& value = feature.comparison.*number;
            table.rows.push_back({feature.feature, letter(f), text(value.a), text(value.b),
                                  difference_text(value, text), p_text(value.p_value)});
        });
    }
    section.add(std::move(table));
}

void state_facts(Section& section, const ComparedResults& results, std::size_t f) {
    const ComparedFile& file = results.files[f];
    const std::string key = fmt::format("about.{}.", f);
    section.state(key + "pairs",
                  file.unpaired.empty()
                      ? fmt::format("On {} test gearboxes that are the same in both; differences "
                                    "are taken gearbox by gearbox.",
                                    file.pairs)
                      : fmt::format("Different gearboxes ({}), compared as independent samples.",
                                    file.unpaired),
                  Shown::screen);
    std::vector<std::string> same;
    for_shown(results, file, [&](const ComparedFeature& feature, std::size_t) {
        if (feature.same) {
            same.push_back(feature.feature);
        }
    });
    section.state(key + "same",
                  same.empty() ? "" : "The same in every gearbox: " + joined(same) + ".",
                  Shown::screen);
    for (std::size_t i = 0; i < file.differing.size(); ++i) {
        section.state(fmt::format("{}input.{}", key, i), "Input " + file.differing[i] + ".");
    }
    for (std::size_t i = 0; i < file.left_out.size(); ++i) {
        section.state(fmt::format("{}left_out.{}", key, i),
                      "Not compared: " + file.left_out[i] + ".");
    }
}

// The terminal's table: rates, a90 and AUC of every feature that differs.
Table main_table(const ComparedResults& results, std::size_t f) {
    const std::string other = letter(f);
    Table table{fmt::format("differences.{}", f),
                "",
                {"feature", "", "A", other,
                 fmt::format("{} - A [{}]", other, percent_text(results.confidence)), "p"},
                {},
                Shown::screen,
                2};
    const ValueText area, size{false, results.size.per_unit()};
    for_shown(results, results.files[f], [&](const ComparedFeature& feature, std::size_t) {
        if (feature.same) {
            return;
        }
        std::string name = feature.feature;
        const auto add = [&](const std::string& what, const ValueText& text, double a, double b,
                             const std::string& difference, double p) {
            table.rows.push_back(
                {std::exchange(name, ""), what, text(a), text(b), difference, p_text(p)});
        };
        for (const RateDifference& rate : feature.comparison.rates) {
            add("Pd at " + size_name(rate, results.size), area, rate.a, rate.b,
                difference_text(rate), rate.p_value);
        }
        const NumberDifference &a90 = feature.comparison.a90, &auc = feature.comparison.auc;
        add(in_unit("a90", results.size), size, a90.a, a90.b, difference_text(a90, size),
            a90.p_value);
        add("AUC", area, auc.a, auc.b, difference_text(auc, area), auc.p_value);
    });
    return table;
}

void state_refusals(Section& section, const ComparedResults& results, std::size_t f) {
    for_shown(results, results.files[f], [&](const ComparedFeature& feature, std::size_t index) {
        for (const auto& [name, number] : {std::pair{"a90", &feature.comparison.a90},
                                           std::pair{"AUC", &feature.comparison.auc}}) {
            section.state(fmt::format("refusal.{}.{}.{}", f, index, name),
                          number->refusal.empty() || feature.same
                              ? ""
                              : fmt::format("{}: no difference of {}: {}.", feature.feature, name,
                                            number->refusal));
        }
    });
}

void add_details(Section& section, const ComparedResults& results, std::size_t f) {
    const std::string other = letter(f);
    const ComparedFile& file = results.files[f];
    for_shown(results, file, [&](const ComparedFeature& feature, std::size_t index) {
        Table table{fmt::format("rates.{}.{}", f, index),
                    feature.feature,
                    {"size", "tested A", "tested " + other, "Pd A", "Pd " + other, "difference",
                     "only A found", "only " + other + " found", "p"},
                    {},
                    Shown::page};
        for (const RateDifference& rate : feature.comparison.rates) {
            const bool paired = rate.pairs.pairs() > 0;
            table.rows.push_back(
                {size_name(rate, results.size), std::to_string(rate.tested_a),
                 std::to_string(rate.tested_b), rate_text(rate.a), rate_text(rate.b),
                 difference_text(rate), paired ? std::to_string(rate.pairs.only_a) : "-",
                 paired ? std::to_string(rate.pairs.only_b) : "-", p_text(rate.p_value)});
        }
        section.add(std::move(table));
    });
    Table levels{fmt::format("levels.{}", f),
                 fmt::format("All noise levels: {} minus A", other),
                 {"feature", "noise", in_unit("a90", results.size), "AUC", "p"},
                 {},
                 Shown::page};
    const ValueText area, size{false, results.size.per_unit()};
    for (const ComparedFeature& feature : file.features) {
        const Comparison& comparison = feature.comparison;
        levels.rows.push_back({feature.feature, "x " + number_text(feature.noise_level),
                               difference_text(comparison.a90, size),
                               difference_text(comparison.auc, area),
                               p_text(comparison.auc.p_value)});
    }
    section.add(std::move(levels));
}

Json number_json(const NumberDifference& value) {
    Json json = fields_json(value);
    json["values"] = json_of(std::array{value.a, value.b});
    json["difference"] = number(value.refusal.empty() ? value.difference() : kNan);
    return json;
}

Json rate_json(const RateDifference& rate) {
    Json json = fields_json(rate);
    json["tested"] = {rate.tested_a, rate.tested_b};
    json["pd"] = json_of(std::array{rate.a, rate.b});
    json["difference"] = number(rate.b - rate.a);
    json["only"] =
        rate.pairs.pairs() > 0 ? Json({rate.pairs.only_a, rate.pairs.only_b}) : Json(nullptr);
    return json;
}

}  // namespace

Report comparison_report(const ComparedResults& results) {
    Report report;
    report.add(headline(results));
    const std::string at_noise = " at " + noise_text(results.noise_level);
    Section differences{"differences", "", {}};
    add_differences(differences, results, "a90", "Difference of a90" + at_noise, &Comparison::a90,
                    {false, results.size.per_unit()});
    add_differences(differences, results, "auc", "Difference of the area under the ROC" + at_noise,
                    &Comparison::auc, {});
    report.add(std::move(differences));
    for (std::size_t f = 1; f < results.files.size(); ++f) {
        Section section{
            fmt::format("against.{}", f), fmt::format("{} against A{}", letter(f), at_noise), {}};
        state_facts(section, results, f);
        section.add(main_table(results, f));
        state_refusals(section, results, f);
        add_details(section, results, f);
        report.add(std::move(section));
    }
    Section notes{"notes", "", {}};
    notes.state("terms",
                "Pd: detection rate, p by McNemar's test on pairs; a90: size with POD "
                "90 %; AUC: area under the ROC, p by DeLong's test. \"open\": the interval "
                "has no bound on this side.",
                Shown::screen);
    report.add(std::move(notes));
    return report;
}

nlohmann::json comparison_json(const ComparedResults& results) {
    Json files = json_of(results.files);
    for (std::size_t f = 0; f < files.size(); ++f) {
        const ComparedFile& file = results.files[f];
        Json smallest = Json::array(), features = Json::array();
        for (std::size_t n = 0; n < file.smallest.size(); ++n) {
            smallest.push_back(
                {{"noise_level", file.noise_levels[n]},
                 {"fault", file.smallest[n] ? fields_json(*file.smallest[n]) : Json(nullptr)},
                 {"without_threshold", bool{file.without_threshold[n]}}});
        }
        for (const ComparedFeature& feature : file.features) {
            Json sizes = Json::array();
            for (const RateDifference& rate : feature.comparison.rates) {
                sizes.push_back(rate_json(rate));
            }
            features.push_back(fields_json(feature));
            features.back().update({{"sizes", sizes},
                                    {"a90", number_json(feature.comparison.a90)},
                                    {"auc", number_json(feature.comparison.auc)}});
        }
        files[f].update({{"smallest_faults", smallest},
                         {"shortage", text_or_null(file.shortage)},
                         {"unpaired", text_or_null(file.unpaired)},
                         {"features", features}});
    }
    return {{"kind", "comparison"},
            {"size", json_of(results.size)},
            {"confidence", results.confidence},
            {"noise_level", results.noise_level},
            {"first_records", results.first_records},
            {"findings", findings_json(comparison_report(results))},
            {"files", files}};
}

}  // namespace gearpod::analysis
