#include "mc/results/reliability_of_results.hpp"

#include <algorithm>
#include <stdexcept>

namespace gearpod::mc {
namespace {

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

void ResultColumns::add(const double* values, const RowShape& shape) {
    for (std::size_t p = 0; p < shape.parameters; ++p) {
        parameters[p].push_back(values[p]);
    }
    for (std::size_t f = 0; f < shape.features; ++f) {
        const double* first = values + shape.value_of(f, 0);
        features[f].insert(features[f].end(), first, first + shape.levels);
    }
    ++rows;
}

std::optional<AssessedColumns> assessed_columns(const Results& frame, const RowSource& rows,
                                                std::size_t most_values) {
    const RowShape shape = row_shape(frame);
    // Areas and curves use one record per gearbox, the first.
    const std::size_t records = frame.request.threshold_records;
    if (rows.rows() / records * shape.features * shape.levels > most_values) {
        return std::nullopt;
    }
    // Thresholds use all records if they fit into memory.
    const bool repeated = records > 1 && rows.rows() * shape.features * shape.levels <= most_values;
    AssessedColumns columns{
        ResultColumns(shape), ResultColumns(shape), ResultColumns(shape), {}, {}};
    std::vector<std::size_t> repeated_rows, healthy_rows;
    for_each_row(rows, [&](const ResultRow& row) {
        const bool sets_threshold = row.group == static_cast<int>(Group::threshold);
        if (row.group == kNoGroup) {
            return;
        }
        if (sets_threshold && repeated) {
            columns.repeats.add(row.values, shape);
            repeated_rows.push_back(row.index);
        }
        if (!sets_threshold || row.index % records == 0) {
            (sets_threshold ? columns.healthy : columns.test).add(row.values, shape);
            if (sets_threshold) {
                healthy_rows.push_back(row.index);
            }
        }
    });
    columns.healthy_gearbox = gearboxes_of(frame, healthy_rows);
    columns.record_gearbox =
        repeated ? gearboxes_of(frame, repeated_rows) : columns.healthy_gearbox;
    return columns;
}

AssessedData::AssessedData(const Results& frame, const AssessedColumns& columns,
                           const std::string& condition)
    : no_fault_(std::max(columns.healthy.rows, columns.test.rows), 0.0) {
    const auto& [healthy, test, repeats, healthy_gearbox, record_gearbox] = columns;
    data_.record_gearbox = record_gearbox;
    std::span<const double> weights;
    data_.healthy_size = {no_fault_.data(), healthy.rows};
    data_.test_size = {no_fault_.data(), test.rows};
    for (std::size_t p = 0; p < frame.parameters.size(); ++p) {
        const ParameterResult& parameter = frame.parameters[p];
        if (parameter.name == frame.request.size.name) {
            data_.healthy_size = healthy.parameters[p];
            data_.test_size = test.parameters[p];
            continue;
        }
        if (parameter.name == kNoiseWeight) {
            weights = repeats.parameters[p];
            continue;
        }
        data_.inputs.push_back({parameter.name, parameter.unit, test.parameters[p]});
        if (std::ranges::count(frame.request.uncertain, parameter.name) > 0) {
            data_.uncertain.push_back(data_.inputs.back());
        }
        if (parameter.name == condition) {
            data_.condition.push_back({parameter.name, parameter.unit, healthy.parameters[p],
                                       test.parameters[p], healthy_gearbox});
        }
    }
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        const std::string& name = frame.features[f].name;
        data_.features.push_back({name, frame.features[f].alarm, healthy.features[f],
                                  test.features[f], repeats.features[f],
                                  uses_noise_weights(name) ? weights : std::span<const double>()});
    }
}

std::optional<analysis::Reliability> reliability_of(const Results& frame, const RowSource& rows,
                                                    const std::string& condition, int threads,
                                                    std::size_t most_values) {
    check_condition(frame, condition);
    const auto columns = assessed_columns(frame, rows, most_values);
    if (!columns) {
        return std::nullopt;
    }
    const AssessedData data(frame, *columns, condition);
    return analysis::assess_reliability(*data, frame.detection, frame.request, threads);
}

analysis::Subject subject_of(const Results& frame) {
    return frame.provenance_value("kind") == kRecordingsKind ? analysis::Subject::recordings
                                                             : analysis::Subject::gearboxes;
}

std::size_t reference_level(const std::vector<double>& noise_levels) {
    const auto one = std::ranges::find(noise_levels, 1.0);
    const auto above = std::ranges::find_if(noise_levels, [](double level) { return level > 0.0; });
    const auto found = one != noise_levels.end() ? one : above;
    return found == noise_levels.end() ? 0 : static_cast<std::size_t>(found - noise_levels.begin());
}

}  // namespace gearpod::mc
