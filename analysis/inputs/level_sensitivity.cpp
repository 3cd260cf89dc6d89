#include "analysis/inputs/level_sensitivity.hpp"

#include <cmath>

#include "analysis/inputs/input_effects.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/midranks.hpp"

namespace gearpod::analysis {
namespace {

std::vector<double> normal_scores(const std::vector<double>& values) {
    std::vector<double> scores = midranks(values);
    for (double& score : scores) {
        score = link_quantile(Link::probit, (score - 0.5) / static_cast<double>(values.size()));
    }
    return scores;
}

}  // namespace

LevelSensitivity level_sensitivity(const std::string& feature, std::span<const double> values,
                                   const std::vector<int>& hit, const InputColumn& size,
                                   const std::vector<InputColumn>& inputs,
                                   const LevelDetection& detection, double confidence) {
    LevelSensitivity result{feature, transition_sizes(detection.cells), {}, {}};
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i] >= 0 && in_range(size.values[i], result.sizes)) {
            rows.push_back(i);
        }
    }
    std::vector<InputColumn> columns{size};
    columns.insert(columns.end(), inputs.begin(), inputs.end());
    std::vector<std::vector<double>> picked;
    picked.reserve(columns.size());
    for (InputColumn& column : columns) {
        std::vector<double>& values_of = picked.emplace_back();
        for (const std::size_t row : rows) {
            values_of.push_back(column.values[row]);
        }
        column.values = values_of;
    }
    std::vector<double> misses, value;
    for (const std::size_t row : rows) {
        misses.push_back(hit[row] == 0 ? 1.0 : 0.0);
        value.push_back(values[row]);
    }
    if (std::isnan(detection.threshold)) {
        result.misses.refusal = result.values.refusal = "no threshold";
        return result;
    }
    result.misses = sobol_indices(misses, columns, confidence);
    result.values = sobol_indices(normal_scores(value), columns, confidence);
    return result;
}

}  // namespace gearpod::analysis
