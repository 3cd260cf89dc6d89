#include "mc/report/run_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/wording.hpp"
#include "features/feature.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostNamedRows = 20;

// Meaning of a status, from the list "0 ok, 1 diverged, ...".
std::string status_meaning(int status) {
    const std::string all = std::string(", ") + kStatusMeanings + ",";
    const std::string start = fmt::format(", {} ", status);
    const std::size_t at = all.find(start), first = at + start.size();
    return at == std::string::npos ? fmt::format("status {}", status)
                                   : all.substr(first, all.find(',', first) - first);
}

std::string rows_text(const Failures& failures) {
    std::vector<std::string> named;
    for (const auto& [row, status] : failures.first) {
        named.push_back(fmt::format("{} ({})", row, status_meaning(status)));
    }
    if (named.empty()) {
        return "";
    }
    const std::size_t more =
        failures.counts.failed() - std::min(failures.counts.failed(), named.size());
    if (more > 0) {
        named.push_back(fmt::format("{} more", more));
    }
    return "Rows: " + analysis::joined(named) + ".";
}

using analysis::number_text;
using analysis::Shown;

analysis::Table error_table(const std::vector<NumericalContribution>& contributions) {
    analysis::Table table{"numerical",
                          "Numerical error (rms, of Pd) and statistical error (half width of the "
                          "interval of Pd)",
                          {"feature", "noise", "rms", "spread of healthy gearboxes", "of Pd",
                           "half width of Pd", "larger"},
                          {}};
    table.labels = 2;
    for (const NumericalContribution& one : contributions) {
        table.rows.push_back({one.feature, "x " + number_text(one.noise_level),
                              number_text(one.rms, 2), number_text(one.spread, 2),
                              number_text(one.pd, 2), number_text(one.pd_half_width, 2),
                              one.numerical_dominates ? "numerical" : "statistical"});
    }
    return table;
}

// Quantile of sorted values, interpolated linearly.
double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

constexpr std::size_t kMostRead = 60;   // gearboxes
constexpr std::size_t kMostInputs = 4;  // columns before the features

using analysis::number_text;

struct ReadRow {
    std::size_t row = 0;
    std::vector<double> values;  // as in RowShape
};

bool any_threshold(const Results& frame) {
    return std::ranges::any_of(frame.detection, [](const auto& feature) {
        return std::ranges::any_of(feature.levels,
                                   [](const auto& level) { return !std::isnan(level.threshold); });
    });
}

// Returns the test rows, or none if there are more than kMostRead.
std::vector<ReadRow> test_rows(const RowShape& shape, const RowSource& rows) {
    std::vector<ReadRow> test;
    std::size_t seen = 0;
    for_each_row(rows, [&](const ResultRow& row) {
        if (row.group == static_cast<int>(Group::test) && ++seen <= kMostRead) {
            test.push_back({row.index, {row.values, row.values + shape.values()}});
        }
    });
    if (seen > kMostRead) {
        test.clear();
    }
    return test;
}

// Inputs that differ between the rows, at most kMostInputs, the last first.
std::vector<std::size_t> differing_inputs(const Results& frame, const std::vector<ReadRow>& test) {
    std::vector<std::size_t> inputs;
    for (std::size_t p = frame.parameters.size(); p-- > 0 && inputs.size() < kMostInputs;) {
        if (std::ranges::any_of(
                test, [&](const ReadRow& row) { return row.values[p] != test[0].values[p]; })) {
            inputs.push_back(p);
        }
    }
    return inputs;
}

analysis::Table values_table(const Results& frame, const std::vector<ReadRow>& test,
                             std::size_t level) {
    const RowShape shape = row_shape(frame);
    const analysis::SizeUnit& size = frame.request.size;
    const std::string unit = size.shown_unit(), noise = number_text(frame.noise_levels[level]);
    const bool levels = frame.noise_levels.size() > 1 || frame.noise_levels[level] != 0.0;
    analysis::Table table{
        fmt::format("values.{}", level), levels ? "Noise x " + noise : "", {"row"}, {}};
    const std::vector<std::size_t> inputs = differing_inputs(frame, test);
    for (const std::size_t p : inputs) {
        const std::string& name = frame.parameters[p].name;
        table.columns.push_back(name != size.name ? name
                                                  : "size" + (unit.empty() ? "" : " " + unit));
    }
    table.labels = table.columns.size();
    for (const FeatureResult& feature : frame.features) {
        const bool pure = feature.unit.empty() || feature.unit == "1";
        table.columns.push_back(feature.name + (pure ? "" : fmt::format(" [{}]", feature.unit)));
    }
    for (const ReadRow& row : test) {
        std::vector<std::string> cells{std::to_string(row.row)};
        for (const std::size_t p : inputs) {
            const bool is_size = frame.parameters[p].name == size.name;
            cells.push_back(number_text(row.values[p] / (is_size ? size.per_unit() : 1.0), 5));
        }
        for (std::size_t f = 0; f < frame.features.size(); ++f) {
            const double value = row.values[shape.value_of(f, level)];
            cells.push_back(std::isnan(value) ? "none" : number_text(value, 5));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::size_t other_fault_variant(const Results& frame) {
    const auto found = std::ranges::find(frame.variants, kOtherFault, &Variant::name);
    return static_cast<std::size_t>(found - frame.variants.begin());
}

std::string share_text(const OtherFaultAlarms& one) {
    return analysis::percent_text(static_cast<double>(one.alarms) /
                                  static_cast<double>(one.tested));
}

std::string bounds_text(const OtherFaultAlarms& one) {
    return fmt::format("{} to {}", analysis::percent_text(one.interval.lower),
                       analysis::percent_text(one.interval.upper));
}

}  // namespace

RowCounts count_rows(const RowSource& rows, std::size_t records) {
    RowCounts counts;
    for_each_row(rows, [&](const ResultRow& row) {
        const bool threshold = row.group == static_cast<int>(Group::threshold);
        if (threshold && row.index % records != 0) {
            return;  // a further record of the gearbox before
        }
        ++counts.all;
        const int status = row.status;
        if (status >= 0 && status < kStatuses) {
            ++counts.with_status[static_cast<std::size_t>(status)];
        }
    });
    counts.not_converged = counts.with_status[static_cast<std::size_t>(Status::not_converged)];
    counts.diverged = counts.all - counts.not_converged -
                      counts.with_status[static_cast<std::size_t>(Status::ok)];
    return counts;
}

Failures failures_of(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    Failures failures;
    failures.counts = count_rows(rows, frame.request.threshold_records);
    failures.no_value.assign(shape.features, std::vector<long>(shape.levels, 0));
    for_each_row(rows, [&](const ResultRow& row) {
        if (row.status != static_cast<int>(Status::ok)) {
            if (failures.first.size() < kMostNamedRows) {
                failures.first.emplace_back(row.index, row.status);
            }
            return;
        }
        const double* values = row.values + shape.parameters;
        for (std::size_t v = 0; v < shape.features * shape.levels; ++v) {
            failures.no_value[v / shape.levels][v % shape.levels] +=
                std::isfinite(values[v]) ? 0 : 1;
        }
    });
    return failures;
}

analysis::Section failures_section(const Results& frame, const Failures& failures) {
    const RowCounts& counts = failures.counts;
    const Shown shown = counts.failed() > 0 ? Shown::screen : Shown::page;
    analysis::Section section{"failures", "", {}};
    section.state("failures",
                  fmt::format("{} of {} gearboxes failed: {} diverged, {} did not converge to the "
                              "periodic orbit. Failed gearboxes count neither as detected nor as "
                              "missed.",
                              counts.failed(), counts.all, counts.diverged, counts.not_converged),
                  shown);
    for (const Status status : {Status::supercritical, Status::parametric, Status::step_too_long,
                                Status::no_equilibrium}) {
        const std::size_t count = counts.with_status[static_cast<std::size_t>(status)];
        section.state(
            fmt::format("failures.status.{}", static_cast<int>(status)),
            count == 0 ? "" : fmt::format("{} of them: each {}.", count, failure_text(status)),
            shown);
    }
    section.state("failures.not_converged",
                  counts.not_converged == 0
                      ? ""
                      : "For convergence, raise numerics.max_meshes or numerics.settle_tolerance.",
                  shown);
    section.state("failures.rows", rows_text(failures), Shown::page);
    std::vector<std::string> without;
    for (std::size_t f = 0; f < failures.no_value.size(); ++f) {
        for (std::size_t n = 0; n < failures.no_value[f].size(); ++n) {
            if (failures.no_value[f][n] > 0) {
                without.push_back(fmt::format("{} at noise x {}: {}", frame.features[f].name,
                                              analysis::number_text(frame.noise_levels[n]),
                                              failures.no_value[f][n]));
            }
        }
    }
    section.state("failures.no_value",
                  !without.empty()
                      ? fmt::format("Gearboxes that did not fail, but for which a feature has no "
                                    "value (not a number): {}.",
                                    analysis::joined(without))
                  : counts.all > counts.failed()
                      ? "Every feature has a value for every gearbox that did not fail."
                      : "",
                  Shown::page);
    return section;
}

nlohmann::json failures_json(const Results& frame, const Failures& failures) {
    nlohmann::json named = nlohmann::json::array(), without = nlohmann::json::array();
    for (const auto& [row, status] : failures.first) {
        named.push_back({{"row", row}, {"status", status}});
    }
    for (std::size_t f = 0; f < failures.no_value.size(); ++f) {
        without.push_back({{"name", frame.features[f].name}, {"gearboxes", failures.no_value[f]}});
    }
    return {{"gearboxes", failures.counts.all},
            {"diverged", failures.counts.diverged},
            {"not_settled", failures.counts.not_converged},
            {"status_meanings", kStatusMeanings},
            {"first_rows", named},
            {"no_value", without}};
}

analysis::Section numerical_section(const Results& frame,
                                    const std::vector<NumericalContribution>& contributions) {
    analysis::Section section{"numerical", "Numerical and statistical error", {}};
    if (frame.step_error) {
        section.state("step_error",
                      "Error of the time steps: " + step_error_text(*frame.step_error) + ".");
    }
    if (!frame.numerical) {
        section.state("numerical.none",
                      "The study requested no check of its numerical error (numerics.verify or "
                      "numerics.tolerance), so it cannot be compared with the statistical error.",
                      Shown::page);
        return section;
    }
    std::vector<std::string> dominated;
    for (const NumericalContribution& one : contributions) {
        if (one.numerical_dominates) {
            dominated.push_back(
                fmt::format("{} at noise x {}", one.feature, number_text(one.noise_level)));
        }
    }
    section.state(
        "numerical.text",
        fmt::format(
            "The run used {}; {} of its gearboxes were computed again with {}. {}",
            frame.numerical->setting, frame.numerical->gearboxes, frame.numerical->finer,
            dominated.empty()
                ? std::string("For every feature and noise level the statistical error is larger "
                              "than the numerical error: finer time steps would not help.")
                : fmt::format("The numerical error is larger than the statistical error for {}.",
                              analysis::joined(dominated))));
    section.add(error_table(contributions));
    return section;
}

std::string numerical_limit(const std::vector<NumericalContribution>& contributions,
                            const std::string& feature, double noise_level) {
    for (const NumericalContribution& one : contributions) {
        if (one.feature == feature && one.noise_level == noise_level && std::isfinite(one.pd) &&
            std::isfinite(one.pd_half_width)) {
            return fmt::format(
                "Error of the detection rate: at most {} numerical and +-{} statistical.",
                number_text(one.pd, 2), number_text(one.pd_half_width, 2));
        }
    }
    return "";
}

std::vector<ContactLossSummary> summarise_contact_loss(const Results& frame,
                                                       const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    std::vector<std::vector<double>> values(shape.meshes);
    if (shape.meshes > 0) {
        for_each_row(rows, [&](const ResultRow& row) {
            const double* own = row.values + shape.contact_loss();
            for (std::size_t m = 0; m < shape.meshes; ++m) {
                if (std::isfinite(own[m])) {
                    values[m].push_back(own[m]);
                }
            }
        });
    }
    std::vector<ContactLossSummary> meshes;
    for (std::size_t m = 0; m < shape.meshes; ++m) {
        std::vector<double>& own = values[m];
        if (own.empty()) {
            continue;
        }
        std::ranges::sort(own);
        const double sum = std::accumulate(own.begin(), own.end(), 0.0);
        meshes.push_back({frame.contact_loss[m].name, sum / static_cast<double>(own.size()),
                          quantile(own, 0.05), quantile(own, 0.5), quantile(own, 0.95),
                          own.size()});
    }
    return meshes;
}

std::string contact_loss_text(const std::vector<ContactLossSummary>& meshes) {
    std::string text;
    for (const ContactLossSummary& mesh : meshes) {
        text += fmt::format("{}{} {:.2g} % ({:.2g} % to {:.2g} %)", text.empty() ? "" : ", ",
                            mesh.mesh, 100.0 * mesh.mean, 100.0 * mesh.lower, 100.0 * mesh.upper);
    }
    return text;
}

analysis::Section contact_section(const std::vector<ContactLossSummary>& meshes) {
    using analysis::percent_text;
    analysis::Section section{"contact", "Contact of the teeth", {}};
    analysis::Table table{"contact_loss",
                          "Share of time out of contact",
                          {"mesh", "mean", "5 % of gearboxes below", "median",
                           "95 % of gearboxes below", "gearboxes"},
                          {}};
    for (const ContactLossSummary& mesh : meshes) {
        table.rows.push_back({mesh.mesh, percent_text(mesh.mean), percent_text(mesh.lower),
                              percent_text(mesh.median), percent_text(mesh.upper),
                              fmt::format("{}", mesh.rows)});
    }
    section.state("contact.how",
                  meshes.empty()
                      ? ""
                      : "Share of its engagement, within the nominal path of contact, in "
                        "which a tooth pair carries no load (contact loss ratio), "
                        "averaged over the tooth pairs of a mesh.");
    section.add(std::move(table));
    return section;
}

analysis::Section feature_values(const Results& frame, const RowSource& rows) {
    analysis::Section section{
        "values", "Feature values (there is no threshold to compare them with)", {}};
    if (frame.features.empty() || any_threshold(frame)) {
        return section;
    }
    const std::vector<ReadRow> test = test_rows(row_shape(frame), rows);
    for (std::size_t n = 0; !test.empty() && n < frame.noise_levels.size(); ++n) {
        analysis::Table table = values_table(frame, test, n);
        if (n == reference_level(frame.noise_levels)) {
            table.shown = analysis::Shown::screen;
        }
        section.add(std::move(table));
    }
    return section;
}

std::vector<OtherFaultAlarms> other_fault_alarms(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const std::size_t variant = other_fault_variant(frame);
    if (variant == shape.variants || frame.detection.size() != shape.features) {
        return {};
    }
    std::vector<OtherFaultAlarms> all;
    for (std::size_t f = 0; f < shape.features; ++f) {
        for (std::size_t n = 0; n < frame.detection[f].levels.size(); ++n) {
            const features::Feature* known = features::find_feature(frame.features[f].name);
            // A bearing does not change the transmission error.
            const bool from_sensor = known == nullptr || known->from_sensor;
            if (from_sensor && !std::isnan(frame.detection[f].levels[n].threshold)) {
                all.push_back({f, n, 0, 0, 0, {}});
            }
        }
    }
    for_each_row(rows, [&](const ResultRow& row) {
        for (OtherFaultAlarms& one : all) {
            const double with =
                             row.values[shape.variant_value_of(variant, one.feature) + one.level],
                         without = row.values[shape.value_of(one.feature, one.level)];
            if (std::isfinite(with) && std::isfinite(without)) {
                const double threshold = frame.detection[one.feature].levels[one.level].threshold;
                const analysis::Alarm alarm = frame.features[one.feature].alarm;
                ++one.tested;
                one.alarms += analysis::is_alarm(with, threshold, alarm);
                one.without += analysis::is_alarm(without, threshold, alarm);
            }
        }
    });
    std::erase_if(all, [](const OtherFaultAlarms& one) { return one.tested == 0; });
    for (OtherFaultAlarms& one : all) {
        one.interval = analysis::wilson_interval(one.alarms, one.tested, frame.request.confidence);
    }
    return all;
}

std::string other_fault_limit(const Results& frame, const std::string& fault,
                              const std::vector<OtherFaultAlarms>& alarms,
                              const std::string& feature, std::size_t level) {
    const auto found = std::ranges::find_if(alarms, [&](const OtherFaultAlarms& one) {
        return frame.features[one.feature].name == feature && one.level == level;
    });
    if (found == alarms.end()) {
        return "";
    }
    return fmt::format(
        "{} raises this alarm in {} of {} healthy gearboxes ({}; {} at {} confidence), against {} "
        "without it.",
        analysis::capitalised(fault), found->alarms, found->tested, share_text(*found),
        bounds_text(*found), analysis::percent_text(frame.request.confidence), found->without);
}

analysis::Section other_fault_section(const Results& frame, const std::string& fault,
                                      const std::vector<OtherFaultAlarms>& alarms) {
    analysis::Section section{"other_fault", "Alarms raised by another fault", {}};
    if (alarms.empty()) {
        section.state("other_fault.none",
                      other_fault_variant(frame) < frame.variants.size()
                          ? "Whether the other fault raises alarms is unknown: no feature of the "
                            "acceleration has a threshold."
                          : "");
        return section;
    }
    section.state("other_fault.how",
                  fmt::format("The healthy gearboxes that set the thresholds, with {}: the same "
                              "records, with its vibration added.",
                              fault));
    analysis::Table table{
        "other_fault",
        "Healthy gearboxes with the other fault that raise an alarm",
        {"feature", "noise", "alarms", "of", "share",
         analysis::percent_text(frame.request.confidence) + " interval", "without it"},
        {}};
    for (const OtherFaultAlarms& one : alarms) {
        table.rows.push_back(
            {frame.features[one.feature].name,
             fmt::format("x {}", analysis::number_text(frame.noise_levels[one.level])),
             fmt::format("{}", one.alarms), fmt::format("{}", one.tested), share_text(one),
             bounds_text(one), fmt::format("{}", one.without)});
    }
    section.add(std::move(table));
    return section;
}

}  // namespace gearpod::mc
