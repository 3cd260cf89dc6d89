// write_results().
#include <algorithm>

#include "mc/hdf5_data.hpp"
#include "mc/results_layout.hpp"
#include "mc/results_seal.hpp"

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
    for (const ParameterResult& parameter : results.parameters) {
        require(parameter.values.size() == rows, parameter.name + " has another number of rows");
    }
    for (const FeatureResult& feature : results.features) {
        require(feature.values.size() == rows * results.noise_levels.size(),
                feature.name + " is not rows x noise levels");
    }
    for (const analysis::FeatureDetection& detection : results.detection) {
        for (const analysis::LevelDetection& level : detection.levels) {
            require(level.cells.size() == results.request.groups.size(),
                    detection.feature + " has another number of sizes than asked for");
        }
    }
}

std::vector<std::int64_t> as_int64(const std::vector<int>& values) {
    return {values.begin(), values.end()};
}

void write_instances(hid_t root, const Results& results) {
    const Hdf5Handle group = create_group(root, "instances");
    const hsize_t rows = results.group.size();
    write_integers(group.get(), "group", {rows}, as_int64(results.group));
    write_text(group.get(), "group", "meanings", kGroupMeanings);
    for (const ParameterResult& parameter : results.parameters) {
        write_numbers(group.get(), parameter.name, {rows}, parameter.values);
        write_text(group.get(), parameter.name, "unit", parameter.unit);
    }
    write_integers(root, "status", {rows}, as_int64(results.status));
    write_text(root, "status", "meanings", kStatusMeanings);
}

void write_features(hid_t root, const Results& results) {
    const hsize_t levels = results.noise_levels.size();
    write_numbers(root, "noise_levels", {levels}, results.noise_levels);
    const Hdf5Handle group = create_group(root, "features");
    for (const FeatureResult& feature : results.features) {
        write_numbers(group.get(), feature.name, {results.group.size(), levels}, feature.values);
        write_text(group.get(), feature.name, "unit", feature.unit);
        write_text(group.get(), feature.name, "alarm", alarm_text(feature.alarm));
    }
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

// One member of every cell (levels x sizes) or of every level.
template <class Value, class Member>
std::vector<Value> cell_values(const analysis::FeatureDetection& detection, Member member) {
    std::vector<Value> values;
    for (const analysis::LevelDetection& level : detection.levels) {
        for (const analysis::DetectionCell& cell : level.cells) {
            values.push_back(cell.*member);
        }
    }
    return values;
}
template <class Value, class Member>
std::vector<Value> level_values(const analysis::FeatureDetection& detection, Member member) {
    std::vector<Value> values;
    for (const analysis::LevelDetection& level : detection.levels) {
        values.push_back(level.*member);
    }
    return values;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        text += (text.empty() ? "" : "\n") + line;
    }
    return text;
}

void write_feature_detection(hid_t parent, const analysis::FeatureDetection& detection,
                             const std::vector<analysis::SizeGroup>& sizes) {
    const Hdf5Handle group = create_group(parent, detection.feature);
    const hsize_t levels = detection.levels.size();
    write_text(group.get(), ".", "alarm", alarm_text(detection.alarm));
    write_text(group.get(), ".", "warnings", joined(detection.warnings));
    write_sizes(group.get(), sizes);
    for (const LevelNumber& number : kLevelNumbers) {
        write_numbers(group.get(), number.name, {levels},
                      level_values<double>(detection, number.member));
    }
    for (const LevelCount& count : kLevelCounts) {
        write_integers(group.get(), count.name, {levels},
                       level_values<std::int64_t>(detection, count.member));
    }
    const Shape shape{levels, sizes.size()};
    for (const CellNumber& number : kCellNumbers) {
        write_numbers(group.get(), number.name, shape,
                      cell_values<double>(detection, number.member));
    }
    for (const CellCount& count : kCellCounts) {
        write_integers(group.get(), count.name, shape,
                       cell_values<std::int64_t>(detection, count.member));
    }
}

void write_detection(hid_t root, const Results& results) {
    const Hdf5Handle group = create_group(root, "detection");
    write_number(group.get(), ".", "false_alarm_rate", results.request.false_alarm_rate);
    write_number(group.get(), ".", "confidence", results.request.confidence);
    write_text(group.get(), ".", "size_name", results.request.size_name);
    write_text(group.get(), ".", "size_unit", results.request.size_unit);
    for (const analysis::FeatureDetection& detection : results.detection) {
        write_feature_detection(group.get(), detection, results.request.groups);
    }
}

std::vector<std::byte> image(const Results& results) {
    const Hdf5Handle file = create_memory_file();
    const Hdf5Handle root = open_group(file.get(), "/");
    write_text(root.get(), ".", "format", kResultsFormat);
    write_text(root.get(), ".", "format_version", std::to_string(kResultsFormatVersion));
    for (const auto& [name, value] : results.provenance) {
        write_text(root.get(), ".", name, value);
    }
    write_instances(root.get(), results);
    write_features(root.get(), results);
    write_detection(root.get(), results);
    const Hdf5Handle timing = create_group(root.get(), "timing");
    for (const Timing& entry : results.timing) {
        write_numbers(timing.get(), entry.name, {}, {entry.seconds});
        write_text(timing.get(), entry.name, "unit", "s");
    }
    return file_bytes(file);
}

}  // namespace

std::string Results::provenance_value(const std::string& name) const {
    const auto found = std::find_if(provenance.begin(), provenance.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found == provenance.end() ? "" : found->second;
}

void write_results(const std::string& path, const Results& results) {
    check_shapes(results);
    const SilentHdf5 silent;
    std::vector<std::byte> bytes;
    try {
        bytes = image(results);
    } catch (const Hdf5Error& error) {
        throw std::runtime_error(path + ": the results could not be laid out (HDF5 failed at \"" +
                                 error.what() + "\")");
    }
    append_seal(bytes);
    write_file(path, bytes);
}

}  // namespace gearpod::mc
