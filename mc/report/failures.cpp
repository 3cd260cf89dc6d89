#include "mc/report/failures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/report/wording.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/results/failure_text.hpp"
#include "mc/results/layout.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostNamedRows = 20;

// Meaning of a status, from the list "0 ok, 1 diverged, ...".
std::string status_meaning(int status) {
    const std::string all = std::string(", ") + kStatusMeanings + ",";
    const std::string start = fmt::format(", {} ", status);
    const std::size_t at = all.find(start);
    if (at == std::string::npos) {
        return fmt::format("status {}", status);
    }
    const std::size_t first = at + start.size();
    return all.substr(first, all.find(',', first) - first);
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
    analysis::Section section{"failures", "", {}};
    section.state("failures",
                  fmt::format("{} of {} gearboxes failed: {} diverged, {} did not converge to the "
                              "periodic orbit. Failed gearboxes count neither as detected nor as "
                              "missed.",
                              counts.failed(), counts.all, counts.diverged, counts.not_converged),
                  true);
    section.state("failures.rows", rows_text(failures), true);
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
                  true);
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

void print_failures(const RowCounts& rows, int max_meshes) {
    fmt::print("gearboxes: {} of {} failed ({} diverged, {} did not converge)\n", rows.failed(),
               rows.all, rows.diverged, rows.not_converged);
    for (const Status status : {Status::supercritical, Status::parametric, Status::step_too_long,
                                Status::no_equilibrium}) {
        const std::size_t count = rows.with_status[static_cast<std::size_t>(status)];
        if (count > 0) {
            const std::string reason =
                fmt::format("{} of them: each {}", count, failure_text(status));
            fmt::print("  {}\n", wrapped_text(reason, 2));
        }
    }
    if (rows.not_converged > 0) {
        fmt::print(
            "  (no convergence to the periodic orbit within {} mesh periods: raise\n"
            "  numerics.max_meshes or numerics.settle_tolerance)\n",
            max_meshes);
    }
}

}  // namespace gearpod::mc
