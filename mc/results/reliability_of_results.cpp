#include "mc/results/reliability_of_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "analysis/report/reliability_text.hpp"

namespace gearpod::mc {
namespace {

// ResultColumns of one group of gearboxes.
struct ResultColumns {
    std::vector<std::vector<double>> parameters;
    std::vector<std::vector<double>> features;  // gearboxes x noise levels
    std::size_t rows = 0;

    explicit ResultColumns(const RowShape& shape)
        : parameters(shape.parameters), features(shape.features) {}

    void add(const double* values, const RowShape& shape) {
        for (std::size_t p = 0; p < shape.parameters; ++p) {
            parameters[p].push_back(values[p]);
        }
        for (std::size_t f = 0; f < shape.features; ++f) {
            const double* first = values + shape.value_of(f, 0);
            features[f].insert(features[f].end(), first, first + shape.levels);
        }
        ++rows;
    }
};

void check_condition(const Results& frame, const std::string& condition) {
    std::string names;
    for (const ParameterResult& parameter : frame.parameters) {
        if (parameter.name == frame.request.size.name || parameter.name == kNoiseWeight) {
            continue;
        }
        if (parameter.name == condition) {
            return;
        }
        names += (names.empty() ? "" : ", ") + parameter.name;
    }
    if (!condition.empty()) {
        throw std::runtime_error("\"" + condition +
                                 "\" is not a random input of this file; it has " +
                                 (names.empty() ? "none" : names));
    }
}

}  // namespace

std::optional<analysis::Reliability> reliability_of(const Results& frame, const RowSource& rows,
                                                    const std::string& condition, int threads,
                                                    std::size_t most_values,
                                                    std::optional<analysis::Costs> costs) {
    check_condition(frame, condition);
    const RowShape shape = row_shape(frame);
    // Areas and curves use one record per gearbox, the first.
    const std::size_t records = frame.request.threshold_records;
    if (rows.rows() / records * shape.features * shape.levels > most_values) {
        return std::nullopt;
    }
    // Thresholds use all records if they fit into memory.
    const bool repeated = records > 1 && rows.rows() * shape.features * shape.levels <= most_values;
    ResultColumns healthy(shape), graded(shape), repeats(shape);
    std::vector<std::size_t> repeated_rows, healthy_rows;
    rows.visit([&](const RowBlock& block) {
        for (std::size_t row = 0; row < block.count(); ++row) {
            const bool sets_threshold = block.group[row] == static_cast<int>(Group::threshold);
            const double* values = block.values.data() + row * shape.values();
            if (block.group[row] == kUngraded) {
                continue;
            }
            if (sets_threshold && repeated) {
                repeats.add(values, shape);
                repeated_rows.push_back(block.first + row);
            }
            if (!sets_threshold || (block.first + row) % records == 0) {
                (sets_threshold ? healthy : graded).add(values, shape);
                if (sets_threshold) {
                    healthy_rows.push_back(block.first + row);
                }
            }
        }
    });
    const std::vector<double> no_fault(std::max(healthy.rows, graded.rows), 0.0);
    analysis::ReliabilityData data;
    data.costs = costs;
    const std::vector<std::size_t> gearbox = gearboxes_of(frame, healthy_rows);
    data.record_gearbox = repeated ? gearboxes_of(frame, repeated_rows) : gearbox;
    std::span<const double> weights;
    data.healthy_size = {no_fault.data(), healthy.rows};
    data.graded_size = {no_fault.data(), graded.rows};
    for (std::size_t p = 0; p < shape.parameters; ++p) {
        const ParameterResult& parameter = frame.parameters[p];
        if (parameter.name == frame.request.size.name) {
            data.healthy_size = healthy.parameters[p];
            data.graded_size = graded.parameters[p];
            continue;
        }
        if (parameter.name == kNoiseWeight) {
            weights = repeats.parameters[p];
            continue;
        }
        data.inputs.push_back({parameter.name, parameter.unit, graded.parameters[p]});
        if (std::ranges::count(frame.request.uncertain, parameter.name) > 0) {
            data.uncertain.push_back(data.inputs.back());
        }
        if (parameter.name == condition) {
            data.condition.push_back({parameter.name, parameter.unit, healthy.parameters[p],
                                      graded.parameters[p], gearbox});
        }
    }
    for (std::size_t f = 0; f < shape.features; ++f) {
        const std::string& name = frame.features[f].name;
        data.features.push_back({name, frame.features[f].alarm, healthy.features[f],
                                 graded.features[f], repeats.features[f],
                                 uses_noise_weights(name) ? weights : std::span<const double>()});
    }
    return analysis::assess_reliability(data, frame.detection, frame.request, threads);
}

analysis::Subject subject_of(const Results& frame) {
    return frame.provenance_value("kind") == kRecordingsKind ? analysis::Subject::recordings
                                                             : analysis::Subject::gearboxes;
}

std::string reliability_text(const std::optional<analysis::Reliability>& reliability,
                             const Results& frame) {
    if (reliability) {
        return analysis::reliability_text(*reliability, frame.request, subject_of(frame));
    }
    const std::size_t each =
        std::max<std::size_t>(1, frame.features.size() * frame.noise_levels.size());
    return fmt::format(
        "no POD curves, areas and ranking: they need all values at once, and the number of {}\nis "
        "limited to {} with these features and noise levels\n",
        analysis::many(subject_of(frame)), kMostAssessedValues / each);
}

}  // namespace gearpod::mc
