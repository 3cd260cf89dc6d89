#include "mc/report/gearbox_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/report/wording.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

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

}  // namespace

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

}  // namespace gearpod::mc
