#include "mc/results/row_source.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "analysis/detection/clusters.hpp"
#include "features/feature.hpp"

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

// Index of a parameter; the number of parameters if there is none of this name.
std::size_t column_of(const Results& frame, const std::string& name) {
    const auto found = std::find_if(frame.parameters.begin(), frame.parameters.end(),
                                    [&](const auto& p) { return p.name == name; });
    return static_cast<std::size_t>(found - frame.parameters.begin());
}

void add_rows(const RowBlock& block, const RowShape& shape, std::size_t size_at,
              std::size_t weight_at, std::size_t first, Sample& healthy, Sample& graded) {
    for (std::size_t row = 0; row < block.count(); ++row) {
        if (block.group[row] == kUngraded) {
            continue;
        }
        const double* values = block.values.data() + row * shape.values();
        Sample& sample = block.group[row] == static_cast<int>(Group::threshold) ? healthy : graded;
        sample.row.push_back(block.first + row);
        sample.size.push_back(size_at < shape.parameters ? values[size_at] : 0.0);
        if (weight_at < shape.parameters) {
            sample.weight.push_back(values[weight_at]);
        }
        for (std::size_t f = 0; f < sample.values.size(); ++f) {
            const double* feature = values + shape.value_of(first + f, 0);
            sample.values[f].insert(sample.values[f].end(), feature, feature + shape.levels);
        }
    }
}

// Appends a row's values of the features at all noise levels.
void add_levels(const std::vector<FeatureResult>& features, std::size_t row, std::size_t levels,
                std::vector<double>& values) {
    for (const FeatureResult& feature : features) {
        const auto at = feature.values.begin() + static_cast<std::ptrdiff_t>(row * levels);
        values.insert(values.end(), at, at + static_cast<std::ptrdiff_t>(levels));
    }
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
    const std::size_t levels = results_.noise_levels.size();
    for (std::size_t first = 0; first < rows(); first += kBlockRows) {
        RowBlock block;
        block.first = first;
        for (std::size_t row = first; row < std::min(first + kBlockRows, rows()); ++row) {
            block.group.push_back(results_.group[row]);
            block.status.push_back(results_.status[row]);
            for (const ParameterResult& parameter : results_.parameters) {
                block.values.push_back(parameter.values[row]);
            }
            add_levels(results_.features, row, levels, block.values);
            for (const auto* columns : {&results_.contact_loss, &results_.integration}) {
                for (const RowColumn& column : *columns) {
                    block.values.push_back(column.values[row]);
                }
            }
            for (const Variant& variant : results_.variants) {
                add_levels(variant.features, row, levels, block.values);
            }
        }
        use(block);
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

void fill_columns(Results& results, const RowSource& rows) {
    const RowShape shape = row_shape(results);
    rows.visit([&](const RowBlock& block) {
        results.group.insert(results.group.end(), block.group.begin(), block.group.end());
        results.status.insert(results.status.end(), block.status.begin(), block.status.end());
        for (std::size_t row = 0; row < block.count(); ++row) {
            const double* values = block.values.data() + row * shape.values();
            for (std::size_t p = 0; p < shape.parameters; ++p) {
                results.parameters[p].values.push_back(values[p]);
            }
            for (std::size_t f = 0; f < shape.features; ++f) {
                const double* feature = values + shape.value_of(f, 0);
                results.features[f].values.insert(results.features[f].values.end(), feature,
                                                  feature + shape.levels);
            }
            for (std::size_t m = 0; m < shape.meshes; ++m) {
                results.contact_loss[m].values.push_back(values[shape.contact_loss() + m]);
            }
            for (std::size_t i = 0; i < shape.integration; ++i) {
                results.integration[i].values.push_back(values[shape.integration_value() + i]);
            }
            for (std::size_t v = 0; v < shape.variants; ++v) {
                for (std::size_t f = 0; f < shape.features; ++f) {
                    const double* feature = values + shape.variant_value_of(v, f);
                    std::vector<double>& column = results.variants[v].features[f].values;
                    column.insert(column.end(), feature, feature + shape.levels);
                }
            }
        }
    });
}

std::vector<analysis::FeatureDetection> detect_all(const Results& frame, const RowSource& rows) {
    constexpr std::size_t kBytes = std::size_t{64} << 20;
    const RowShape shape = row_shape(frame);
    const std::size_t each = 8 * std::max<std::size_t>(1, rows.rows() * shape.levels);
    const std::size_t at_once = std::max<std::size_t>(1, kBytes / each);
    const std::size_t size_at = column_of(frame, frame.request.size.name);
    const std::size_t weight_at = column_of(frame, kNoiseWeight);
    std::vector<analysis::FeatureDetection> all;
    for (std::size_t first = 0; first < shape.features; first += at_once) {
        const std::size_t count = std::min(at_once, shape.features - first);
        Sample healthy, graded;
        healthy.values.resize(count);
        graded.values.resize(count);
        rows.visit([&](const RowBlock& block) {
            add_rows(block, shape, size_at, weight_at, first, healthy, graded);
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
                                                     {graded.size, graded.values[f]},
                                                     frame.request));
        }
    }
    return all;
}

}  // namespace gearpod::mc
