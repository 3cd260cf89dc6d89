#include "mc/report/feature_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/report/wording.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostRead = 60;   // gearboxes
constexpr std::size_t kMostInputs = 4;  // columns before the features

using analysis::number_text;

struct ReadRow {
    std::size_t row = 0;
    std::vector<double> values;  // as in RowShape
};

bool any_threshold(const Results& frame) {
    return std::any_of(frame.detection.begin(), frame.detection.end(), [](const auto& feature) {
        return std::any_of(feature.levels.begin(), feature.levels.end(),
                           [](const auto& level) { return !std::isnan(level.threshold); });
    });
}

// Returns the test rows, or none if there are more than kMostRead.
std::vector<ReadRow> graded_rows(const RowShape& shape, const RowSource& rows) {
    std::vector<ReadRow> graded;
    std::size_t seen = 0;
    for_each_row(rows, [&](const ResultRow& row) {
        if (row.group == static_cast<int>(Group::graded) && ++seen <= kMostRead) {
            graded.push_back({row.index, {row.values, row.values + shape.values()}});
        }
    });
    if (seen > kMostRead) {
        graded.clear();
    }
    return graded;
}

// Inputs that differ between the rows, at most kMostInputs, the last first.
std::vector<std::size_t> differing_inputs(const Results& frame,
                                          const std::vector<ReadRow>& graded) {
    std::vector<std::size_t> inputs;
    for (std::size_t p = frame.parameters.size(); p-- > 0 && inputs.size() < kMostInputs;) {
        if (std::any_of(graded.begin(), graded.end(),
                        [&](const ReadRow& row) { return row.values[p] != graded[0].values[p]; })) {
            inputs.push_back(p);
        }
    }
    return inputs;
}

analysis::Table values_table(const Results& frame, const std::vector<ReadRow>& graded,
                             std::size_t level) {
    const RowShape shape = row_shape(frame);
    const analysis::SizeUnit& size = frame.request.size;
    const std::string unit = size.shown_unit(), noise = number_text(frame.noise_levels[level]);
    const bool levels = frame.noise_levels.size() > 1 || frame.noise_levels[level] != 0.0;
    analysis::Table table{
        fmt::format("values.{}", level), levels ? "Noise x " + noise : "", {"row"}, {}};
    const std::vector<std::size_t> inputs = differing_inputs(frame, graded);
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
    for (const ReadRow& row : graded) {
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

analysis::Section feature_values(const Results& frame, const RowSource& rows) {
    analysis::Section section{
        "values", "Feature values (there is no threshold to compare them with)", {}};
    if (frame.features.empty() || any_threshold(frame)) {
        return section;
    }
    const std::vector<ReadRow> graded = graded_rows(row_shape(frame), rows);
    for (std::size_t n = 0; !graded.empty() && n < frame.noise_levels.size(); ++n) {
        section.add(values_table(frame, graded, n));
    }
    return section;
}

}  // namespace gearpod::mc
