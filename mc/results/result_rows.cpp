#include "mc/results/result_rows.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include "analysis/detection/detection.hpp"
#include "features/feature.hpp"
#include "machine/contracts.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/results/layout.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kBlockRows = 512;

// Fault sizes and the values of several features, for one of the two groups.
struct Sample {
    std::vector<double> size;
    std::vector<std::vector<double>> values;  // by feature: rows x levels
    std::vector<std::size_t> row;
    std::vector<double> weight;  // importance weights; empty without tilted records
};

constexpr std::size_t kFileBlockRows = 4096;

[[noreturn]] void refuse(const std::string& path, const Hdf5Error& error) {
    throw std::runtime_error(path + ": is damaged or truncated (at \"" + error.what() + "\")");
}

RowBlock read_block(hid_t root, const Results& frame, std::size_t rows, RowRange range) {
    RowBlock block;
    block.first = range.first;
    std::vector<std::int64_t> integers;
    read_rows(root, "instances/group", {rows}, range, integers);
    block.group.assign(integers.begin(), integers.end());
    read_rows(root, "status", {rows}, range, integers);
    block.status.assign(integers.begin(), integers.end());
    block.values.resize(range.count * row_shape(frame).values());
    std::vector<double> values;
    for_each_column(frame, [&](const auto& column) {
        read_rows(root, column.dataset, column.by_level ? Shape{rows, column.width} : Shape{rows},
                  range, values);
        block.put(values.data(), column.first, column.width);
    });
    return block;
}

}  // namespace

void StoredRows::visit(const std::function<void(const RowBlock&)>& use) const {
    for (std::size_t batch = 0; batch < batches_; ++batch) {
        const Batch place = plan_.batch(batch);
        BatchRows rows = store_.read(batch);
        use({place.first_row, std::vector<int>(place.rows(), static_cast<int>(place.group)),
             std::move(rows.status), std::move(rows.values)});
    }
}

void ColumnRows::visit(const std::function<void(const RowBlock&)>& use) const {
    const std::size_t row_values = row_shape(results_).values();
    for (std::size_t first = 0; first < rows(); first += kBlockRows) {
        const std::size_t count = std::min(kBlockRows, rows() - first);
        const auto at = static_cast<std::ptrdiff_t>(first);
        RowBlock block;
        block.first = first;
        std::copy_n(results_.group.begin() + at, count, std::back_inserter(block.group));
        std::copy_n(results_.status.begin() + at, count, std::back_inserter(block.status));
        block.values.resize(count * row_values);
        for_each_column(results_, [&](const auto& column) {
            block.put(column.values.data() + first * column.width, column.first, column.width);
        });
        use(block);
    }
}

void RowBlock::put(const double* column, std::size_t first_value, std::size_t width) {
    const std::size_t all = row_values();
    EXPECTS(values.size() == count() * all && first_value + width <= all);
    for (std::size_t row = 0; row < count(); ++row) {
        std::copy_n(column + row * width, width, values.data() + row * all + first_value);
    }
}

std::vector<std::size_t> gearboxes_of(const Results& frame, const std::vector<std::size_t>& rows) {
    std::vector<std::size_t> first;  // for each row: first row of the same gearbox
    std::istringstream names(frame.provenance_value("recorded_gearboxes"));
    std::map<std::string, std::size_t> numbers;
    for (std::string name; std::getline(names, name);) {
        const std::size_t row = first.size();
        first.push_back(name.empty() ? row : numbers.emplace(name, row).first->second);
    }
    std::vector<std::size_t> gearboxes;
    for (const std::size_t row : rows) {
        gearboxes.push_back(row < first.size() ? first[row]
                                               : row / frame.request.threshold_records);
    }
    return gearboxes;
}

bool uses_noise_weights(const std::string& feature) {
    const features::Feature* found = features::find_feature(feature);
    return found != nullptr && found->from_sensor;
}

RowShape row_shape(const Results& results) {
    return {results.parameters.size(),   results.features.size(), results.noise_levels.size(),
            results.contact_loss.size(), results.variants.size(), results.integration.size()};
}

Results results_frame(const EnsemblePlan& plan) {
    Results results;
    for (const ParameterColumn& column : plan.inputs) {
        results.parameters.push_back({column.name, column.unit, {}});
    }
    results.noise_levels = plan.request.noise_levels;
    results.request = plan.request;
    for (const features::Feature* feature : plan.features) {
        results.features.push_back(
            {std::string(feature->name), std::string(feature->unit), feature->alarm, {}});
    }
    for (const VariantColumns& variant : plan.variants) {
        results.variants.push_back({variant.name, variant.description, results.features});
    }
    for (const std::string& mesh : plan.meshes) {
        results.contact_loss.push_back({mesh, {}});
    }
    for (const std::string& column : plan.integration) {
        results.integration.push_back({column, {}});
    }
    return results;
}

void fill_columns(Results& results, const RowSource& rows) {
    rows.visit([&](const RowBlock& block) {
        results.group.insert(results.group.end(), block.group.begin(), block.group.end());
        results.status.insert(results.status.end(), block.status.begin(), block.status.end());
        const std::size_t row_values = block.row_values();
        for_each_column(results, [&](const auto& column) {
            for (std::size_t row = 0; row < block.count(); ++row) {
                const double* values = block.values.data() + row * row_values + column.first;
                column.values.insert(column.values.end(), values, values + column.width);
            }
        });
    });
}

std::vector<analysis::FeatureDetection> detect_all(const Results& frame, const RowSource& rows) {
    constexpr std::size_t kBytes = std::size_t{64} << 20;
    const RowShape shape = row_shape(frame);
    const std::size_t each = 8 * std::max<std::size_t>(1, rows.rows() * shape.levels);
    const std::size_t at_once = std::max<std::size_t>(1, kBytes / each);
    const auto size_at = frame.parameter_index(frame.request.size.name);
    const auto weight_at = frame.parameter_index(kNoiseWeight);
    std::vector<analysis::FeatureDetection> all;
    for (std::size_t first = 0; first < shape.features; first += at_once) {
        const std::size_t count = std::min(at_once, shape.features - first);
        Sample healthy, test;
        healthy.values.resize(count);
        test.values.resize(count);
        for_each_row(rows, [&](const ResultRow& row) {
            if (row.group == kNoGroup) {
                return;
            }
            Sample& sample = row.group == static_cast<int>(Group::threshold) ? healthy : test;
            sample.row.push_back(row.index);
            sample.size.push_back(size_at ? row.values[*size_at] : 0.0);
            if (weight_at) {
                sample.weight.push_back(row.values[*weight_at]);
            }
            for (std::size_t f = 0; f < count; ++f) {
                const double* feature = row.values + shape.value_of(first + f, 0);
                sample.values[f].insert(sample.values[f].end(), feature, feature + shape.levels);
            }
        });
        const std::vector<std::size_t> numbers = gearboxes_of(frame, healthy.row);
        for (std::size_t f = 0; f < count; ++f) {
            const FeatureResult& feature = frame.features[first + f];
            analysis::FeatureSample sample{healthy.size, healthy.values[f]};
            if (uses_noise_weights(feature.name)) {
                sample.gearbox = numbers;
                sample.weights = healthy.weight;
            }
            all.push_back(analysis::detect_clustered(feature.name, feature.alarm, sample, numbers,
                                                     {test.size, test.values[f]}, frame.request));
        }
    }
    return all;
}

FileRows::FileRows(const std::string& path, const Results& frame) : path_(path), frame_(frame) {
    try {
        const Hdf5Handle file = open_file(path, "opening the file");
        rows_ = row_count(file.get(), "status");
    } catch (const Hdf5Error& error) {
        refuse(path, error);
    }
}

void FileRows::visit(const std::function<void(const RowBlock&)>& use) const {
    try {
        const Hdf5Handle file = open_file(path_, "opening the file");
        for (std::size_t first = 0; first < rows_; first += kFileBlockRows) {
            use(read_block(file.get(), frame_, rows_,
                           {first, std::min(kFileBlockRows, rows_ - first)}));
        }
    } catch (const Hdf5Error& error) {
        refuse(path_, error);
    }
}

}  // namespace gearpod::mc
