// Implements write_results().
#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <span>

#include "mc/files/atomic_file.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/results/file_checksum.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

void require(bool condition, const std::string& what) {
    if (!condition) {
        throw std::invalid_argument("results: " + what);
    }
}

void check_shapes(const Results& results) {
    const std::size_t rows = results.group.size();
    require(results.status.size() == rows, "status and group differ in length");
    for_each_column(results, [&](const auto& column) {
        require(column.values.size() == rows * column.width,
                column.dataset + (column.by_level ? " is not rows x noise levels"
                                                  : " has another number of rows"));
    });
    for (const Variant& variant : results.variants) {
        require(variant.features.size() == results.features.size(),
                variant.name + " has another number of features");
    }
    for (const analysis::FeatureDetection& detection : results.detection) {
        for (const analysis::LevelDetection& level : detection.levels) {
            require(level.cells.size() == results.request.groups.size(),
                    detection.feature + " has another number of sizes than requested");
        }
    }
}

// Position of a column's values in the file.
struct Place {
    std::uint64_t begin;  // byte of its first row
    std::size_t at;       // index of its first value in a row
    std::size_t width;    // values per row
};

// Positions of all columns.
struct Places {
    std::vector<Place> numbers;
    std::uint64_t group = 0, status = 0;
};

void describe(hid_t root, const std::string& dataset, const ParameterResult& parameter) {
    write_text(root, dataset, "unit", parameter.unit);
}
void describe(hid_t root, const std::string& dataset, const FeatureResult& feature) {
    write_text(root, dataset, "unit", feature.unit);
    write_text(root, dataset, "alarm", analysis::alarm_name(feature.alarm));
}
void describe(hid_t root, const std::string& dataset, const RowColumn&) {
    write_text(root, dataset, "unit", "1");
    write_text(root, dataset, "description",
               dataset.starts_with(kContactLoss) ? kContactLossMeaning : kSuperposedMeaning);
}

// Reserves space for the rows.
Places create_columns(hid_t root, const Results& frame, hsize_t rows) {
    Places places;
    create_group(root, "instances");
    places.group = create_column(root, "instances/group", {rows}, ColumnKind::integers);
    write_text(root, "instances/group", "meanings", kGroupMeanings);
    places.status = create_column(root, "status", {rows}, ColumnKind::integers);
    write_text(root, "status", "meanings", kStatusMeanings);
    write_numbers(root, columns_name(frame), {frame.noise_levels.size()}, frame.noise_levels);
    create_group(root, "features");
    if (!frame.contact_loss.empty()) {
        create_group(root, kContactLoss);
    }
    if (!frame.integration.empty()) {
        create_group(root, kIntegration);
    }
    if (!frame.variants.empty()) {
        create_group(root, kVariants);
    }
    for (const Variant& variant : frame.variants) {
        const std::string name = std::string(kVariants) + "/" + variant.name;
        create_group(root, name);
        write_text(root, name, "description", variant.description);
    }
    for_each_column(frame, [&](const auto& column) {
        const Shape shape = column.by_level ? Shape{rows, column.width} : Shape{rows};
        places.numbers.push_back({create_column(root, column.dataset, shape, ColumnKind::numbers),
                                  column.first, column.width});
        describe(root, column.dataset, column.object);
    });
    return places;
}

void write_sizes(hid_t group, const std::vector<analysis::SizeGroup>& sizes) {
    std::vector<double> low, high;
    for (const analysis::SizeGroup& size : sizes) {
        low.push_back(size.low);
        high.push_back(size.high);
    }
    write_numbers(group, "size_low", {sizes.size()}, low);
    write_numbers(group, "size_high", {sizes.size()}, high);
}

// Writes a dataset for each of these members of the items: levels, or cells (levels x sizes).
template <class Item>
void write_members(hid_t group, const Shape& shape, const std::vector<Item>& items,
                   const auto& numbers, const auto& counts) {
    for (const auto& number : numbers) {
        std::vector<double> values;
        std::ranges::transform(items, std::back_inserter(values), number.member);
        write_numbers(group, number.name, shape, values);
    }
    for (const auto& count : counts) {
        std::vector<std::int64_t> values;
        std::ranges::transform(items, std::back_inserter(values), count.member);
        write_integers(group, count.name, shape, values);
    }
}

void write_feature_detection(hid_t parent, const analysis::FeatureDetection& detection,
                             const std::vector<analysis::SizeGroup>& sizes) {
    const Hdf5Handle group = create_group(parent, detection.feature);
    const hsize_t levels = detection.levels.size();
    write_text(group.get(), ".", "alarm", analysis::alarm_name(detection.alarm));
    write_text(group.get(), ".", "warnings",
               fmt::format("{}", fmt::join(detection.warnings, "\n")));
    write_sizes(group.get(), sizes);
    write_members(group.get(), {levels}, detection.levels, kLevelNumbers, kLevelCounts);
    std::vector<analysis::DetectionCell> cells;
    for (const analysis::LevelDetection& level : detection.levels) {
        cells.insert(cells.end(), level.cells.begin(), level.cells.end());
    }
    write_members(group.get(), {levels, sizes.size()}, cells, kCellNumbers, kCellCounts);
}

void write_detection(hid_t root, const Results& results) {
    const Hdf5Handle group = create_group(root, "detection");
    write_number(group.get(), ".", "false_alarm_rate", results.request.false_alarm_rate);
    write_number(group.get(), ".", "confidence", results.request.confidence);
    write_text(group.get(), ".", "size_name", results.request.size.name);
    write_text(group.get(), ".", "size_unit", results.request.size.unit);
    if (!results.request.uncertain.empty()) {
        write_text(group.get(), ".", "uncertain_inputs",
                   fmt::format("{}", fmt::join(results.request.uncertain, " ")));
    }
    if (results.request.threshold_records > 1) {
        write_number(group.get(), ".", "threshold_records",
                     static_cast<double>(results.request.threshold_records));
    }
    for (const analysis::FeatureDetection& detection : results.detection) {
        write_feature_detection(group.get(), detection, results.request.groups);
    }
}

void write_all_signals(hid_t root, const Results& frame) {
    if (frame.signals.empty()) {
        return;
    }
    const Hdf5Handle group = create_group(root, "signals");
    for (const RowSignals& signals : frame.signals) {
        const Hdf5Handle row = create_group(group.get(), std::to_string(signals.row));
        for (const SignalColumn& column : signals.columns) {
            write_numbers(row.get(), column.name, {column.values.size()}, column.values);
            write_text(row.get(), column.name, "unit", column.unit);
        }
    }
}

// Writes everything except the rows and reserves space for these.
Places write_frame(const std::string& path, const Results& frame, std::size_t rows) {
    Hdf5Handle file = create_file(path, kUserBlockBytes);
    Places places;
    {
        const Hdf5Handle root = open_group(file.get(), "/");
        write_text(root.get(), ".", "format", kResultsFormat);
        write_text(root.get(), ".", "format_version", std::to_string(kResultsFormatVersion));
        for (const auto& [name, value] : frame.provenance) {
            write_text(root.get(), ".", name, value);
        }
        places = create_columns(root.get(), frame, rows);
        write_detection(root.get(), frame);
        write_numerical_groups(root.get(), frame);
        write_all_signals(root.get(), frame);
        const Hdf5Handle timing = create_group(root.get(), "timing");
        for (const Timing& entry : frame.timing) {
            write_numbers(timing.get(), entry.name, {}, {entry.seconds});
            write_text(timing.get(), entry.name, "unit", entry.unit);
        }
    }
    file.close_now("file");
    return places;
}

// Writes rows to their positions in the file, in blocks of several thousand.
class RowWriter {
  public:
    RowWriter(const PendingFile& file, int fd, const Places& places, const RowShape& shape)
        : file_(file), fd_(fd), places_(places), shape_(shape) {}

    void add(const RowBlock& block) {
        pending_.group.insert(pending_.group.end(), block.group.begin(), block.group.end());
        pending_.status.insert(pending_.status.end(), block.status.begin(), block.status.end());
        pending_.values.insert(pending_.values.end(), block.values.begin(), block.values.end());
        constexpr std::size_t kRows = 4096;
        if (pending_.count() >= kRows) {
            flush();
        }
    }

    void flush() {
        const std::size_t rows = pending_.count();
        for (const Place& place : places_.numbers) {
            std::vector<double> column;
            for (std::size_t row = 0; row < rows; ++row) {
                const auto from = pending_.values.begin() +
                                  static_cast<std::ptrdiff_t>(row * shape_.values() + place.at);
                column.insert(column.end(), from, from + static_cast<std::ptrdiff_t>(place.width));
            }
            write(column, place.begin, place.width);
        }
        write(std::vector<std::int64_t>(pending_.group.begin(), pending_.group.end()),
              places_.group, 1);
        write(std::vector<std::int64_t>(pending_.status.begin(), pending_.status.end()),
              places_.status, 1);
        const std::size_t next = pending_.first + rows;
        pending_ = {};
        pending_.first = next;
    }

  private:
    template <class Value>
    void write(const std::vector<Value>& column, std::uint64_t begin, std::size_t width) {
        const auto at = static_cast<off_t>(begin + 8 * pending_.first * width);
        if (!write_at(fd_, std::as_bytes(std::span(column)), at)) {
            file_.fail(errno);
        }
    }

    const PendingFile& file_;
    int fd_;
    const Places& places_;
    const RowShape shape_;
    RowBlock pending_;
};

// Reserves disk space first, because HDF5 handles a full disk badly. Some file systems do not
// support this.
void require_room(const PendingFile& file, const RowShape& shape, std::size_t rows) {
    constexpr std::size_t kFrame = std::size_t{1} << 20;
    const Descriptor trial(
        ::open(file.name().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (trial.get() < 0) {
        file.fail(errno);
    }
    const auto bytes = static_cast<off_t>(kFrame + 8 * rows * (shape.values() + 2));
    if (::fallocate(trial.get(), 0, 0, bytes) != 0 && errno != EOPNOTSUPP && errno != ENOSYS &&
        errno != EINVAL) {
        file.fail(errno);
    }
}

}  // namespace

std::string Results::provenance_value(const std::string& name) const {
    const auto found = std::find_if(provenance.begin(), provenance.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found == provenance.end() ? "" : found->second;
}

std::optional<std::size_t> Results::parameter_index(const std::string& name) const {
    const auto found = std::ranges::find(parameters, name, &ParameterResult::name);
    return found == parameters.end() ? std::nullopt
                                     : std::optional<std::size_t>(found - parameters.begin());
}

void write_results(const std::string& path, const Results& frame, const RowSource& rows) {
    PendingFile file(path);
    const RowShape shape = row_shape(frame);
    require_room(file, shape, rows.rows());
    Places places;
    try {
        places = write_frame(file.name(), frame, rows.rows());
    } catch (const Hdf5Error& error) {
        throw std::runtime_error(path + ": cannot be written (HDF5 failed at \"" + error.what() +
                                 "\")");
    }
    const Descriptor opened(::open(file.name().c_str(), O_RDWR | O_CLOEXEC));
    if (opened.get() < 0) {
        file.fail(errno);
    }
    RowWriter writer(file, opened.get(), places, shape);
    rows.visit([&](const RowBlock& block) { writer.add(block); });
    writer.flush();
    if (!write_checksum(opened.get())) {
        file.fail(errno);
    }
    file.commit(opened.get());
}

void write_results(const std::string& path, const Results& results) {
    check_shapes(results);
    write_results(path, results, ColumnRows(results));
}

}  // namespace gearpod::mc
