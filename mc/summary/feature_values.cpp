#include "mc/summary/feature_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/text_lines.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostRead = 60;   // gearboxes
constexpr std::size_t kMostInputs = 4;  // columns before the features
constexpr std::size_t kColumnGap = 2;

struct ReadRow {
    std::size_t row = 0;
    std::vector<double> values;  // as in RowShape
};

struct TextColumn {
    std::string head;
    std::vector<std::string> cells;

    std::size_t width() const {
        std::size_t most = head.size();
        for (const std::string& cell : cells) {
            most = std::max(most, cell.size());
        }
        return most + kColumnGap;
    }
};

bool any_threshold(const Results& frame) {
    return std::any_of(frame.detection.begin(), frame.detection.end(), [](const auto& feature) {
        return std::any_of(feature.levels.begin(), feature.levels.end(),
                           [](const auto& level) { return !std::isnan(level.threshold); });
    });
}

// Returns the graded rows, or none if there are more than kMostRead.
std::vector<ReadRow> graded_rows(const RowShape& shape, const RowSource& rows) {
    std::vector<ReadRow> graded;
    std::size_t seen = 0;
    rows.visit([&](const RowBlock& block) {
        for (std::size_t i = 0; i < block.count(); ++i) {
            if (block.group[i] == static_cast<int>(Group::graded) && ++seen <= kMostRead) {
                const auto first =
                    block.values.begin() + static_cast<std::ptrdiff_t>(i * shape.values());
                graded.push_back({block.first + i,
                                  {first, first + static_cast<std::ptrdiff_t>(shape.values())}});
            }
        }
    });
    if (seen > kMostRead) {
        graded.clear();
    }
    return graded;
}

std::string value_text(double value) {
    return std::isnan(value) ? "none" : fmt::format("{:.5g}", value);
}

// Columns with the row number, the fault size and the other inputs that differ between rows.
std::vector<TextColumn> input_columns(const Results& frame, const std::vector<ReadRow>& graded) {
    std::vector<TextColumn> columns(1, {"row", {}});
    for (const ReadRow& row : graded) {
        columns[0].cells.push_back(std::to_string(row.row));
    }
    const analysis::SizeUnit& size = frame.request.size;
    for (std::size_t p = frame.parameters.size(); p-- > 0 && columns.size() <= kMostInputs;) {
        const ParameterResult& parameter = frame.parameters[p];
        const bool differs = std::any_of(graded.begin(), graded.end(), [&](const ReadRow& row) {
            return row.values[p] != graded[0].values[p];
        });
        if (!differs) {
            continue;
        }
        const bool is_size = parameter.name == size.name;
        const std::string unit = size.shown_unit();
        TextColumn column{is_size ? "size" + (unit.empty() ? "" : " " + unit) : parameter.name, {}};
        for (const ReadRow& row : graded) {
            column.cells.push_back(
                fmt::format("{:.5g}", row.values[p] / (is_size ? size.per_unit() : 1.0)));
        }
        columns.push_back(std::move(column));
    }
    return columns;
}

void add_columns(std::string& out, const std::vector<const TextColumn*>& columns) {
    const std::size_t rows = columns[0]->cells.size();
    for (std::size_t r = 0; r <= rows; ++r) {
        for (const TextColumn* column : columns) {
            out += fmt::format("{:>{}}", r == 0 ? column->head : column->cells[r - 1],
                               column->width());
        }
        out += '\n';
    }
}

// Adds blocks of feature columns, as many as fit into the text width next to the inputs.
void add_level(std::string& out, const std::vector<TextColumn>& inputs,
               const std::vector<TextColumn>& features) {
    std::size_t begin = 0;
    for (const TextColumn& column : inputs) {
        begin += column.width();
    }
    for (std::size_t f = 0; f < features.size();) {
        std::vector<const TextColumn*> block;
        for (const TextColumn& column : inputs) {
            block.push_back(&column);
        }
        std::size_t width = begin;
        do {
            width += features[f].width();
            block.push_back(&features[f++]);
        } while (f < features.size() && width + features[f].width() <= analysis::text_width());
        out += '\n';
        add_columns(out, block);
    }
}

}  // namespace

std::string feature_values_text(const Results& frame, const RowSource& rows) {
    if (frame.features.empty() || any_threshold(frame)) {
        return "";
    }
    const RowShape shape = row_shape(frame);
    const std::vector<ReadRow> graded = graded_rows(shape, rows);
    if (graded.empty()) {
        return "";
    }
    const std::vector<TextColumn> inputs = input_columns(frame, graded);
    std::string out = "Feature values (there is no threshold to compare them with)\n";
    for (std::size_t n = 0; n < frame.noise_levels.size(); ++n) {
        std::vector<TextColumn> features;
        for (std::size_t f = 0; f < frame.features.size(); ++f) {
            const FeatureResult& feature = frame.features[f];
            const std::string unit = feature.unit.empty() || feature.unit == "1"
                                         ? ""
                                         : fmt::format(" [{}]", feature.unit);
            TextColumn column{feature.name + unit, {}};
            for (const ReadRow& row : graded) {
                column.cells.push_back(value_text(row.values[shape.value_of(f, n)]));
            }
            features.push_back(std::move(column));
        }
        if (frame.noise_levels.size() > 1 || frame.noise_levels[n] != 0.0) {
            out += fmt::format("\nNoise x {:g}\n", frame.noise_levels[n]);
        }
        add_level(out, inputs, features);
    }
    return out;
}

}  // namespace gearpod::mc
