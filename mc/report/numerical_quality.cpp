#include "mc/report/numerical_quality.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/wording.hpp"
#include "mc/results/layout.hpp"

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

}  // namespace gearpod::mc
