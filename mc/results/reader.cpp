// Implements read_results() and read_frame().
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <sstream>

#include "mc/files/child_process.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/results/file_checksum.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

[[noreturn]] void refuse_file(const std::string& path, const std::string& why) {
    throw std::runtime_error(path + ": " + why);
}

analysis::Alarm alarm_of(const std::string& text) {
    if (text != "high" && text != "low") {
        throw Hdf5Error("alarm");
    }
    return text == "high" ? analysis::Alarm::high : analysis::Alarm::low;
}

void require_count(std::size_t count, std::size_t expected, const std::string& name) {
    if (count != expected) {
        throw Hdf5Error(name);
    }
}

class ResultsReader {
  public:
    // A dataset with more values than the file has bytes counts as damaged.
    ResultsReader(hid_t root, std::size_t file_size, bool with_columns)
        : root_(root), most_(file_size), with_columns_(with_columns) {}

    Results read() {
        read_provenance();
        read_instances();
        read_features();
        read_columns(kContactLoss, results_.contact_loss);
        read_columns(kIntegration, results_.integration);
        read_variants();
        read_detection();
        read_numerical_groups(root_, most_, results_);
        const Hdf5Handle timing = open_group(root_, "timing");
        for (const std::string& name : link_names(timing.get())) {
            const auto seconds = numbers(timing.get(), name);
            require_count(seconds.size(), 1, name);
            results_.timing.push_back({name, seconds.front()});
        }
        return std::move(results_);
    }

  private:
    std::vector<double> numbers(hid_t parent, const std::string& name) {
        return read_numbers(parent, name, most_).values;
    }

    std::vector<double> column(hid_t parent, const std::string& name) {
        return with_columns_ ? numbers(parent, name) : std::vector<double>{};
    }

    std::vector<int> small_integers(hid_t parent, const std::string& name) {
        const auto values = read_integers(parent, name, most_);
        std::vector<int> result;
        for (const std::int64_t value : values) {
            result.push_back(static_cast<int>(value));
        }
        return result;
    }

    void read_provenance() {
        for (const std::string& name : attribute_names(root_)) {
            if (name != "format" && name != "format_version" && has_text(root_, name)) {
                results_.provenance.emplace_back(name, read_text(root_, ".", name));
                declare_recorded_features(results_.provenance.back().second);
            }
        }
    }

    void read_instances() {
        const Hdf5Handle group = open_group(root_, "instances");
        if (with_columns_) {
            results_.group = small_integers(group.get(), "group");
            results_.status = small_integers(root_, "status");
            require_count(results_.status.size(), results_.group.size(), "status");
        }
        for (const std::string& name : link_names(group.get())) {
            if (name == "group") {
                continue;
            }
            results_.parameters.push_back(
                {name, read_text(group.get(), name, "unit"), column(group.get(), name)});
            require_count(results_.parameters.back().values.size(), results_.group.size(), name);
        }
    }

    std::vector<FeatureResult> features_in(hid_t group) {
        std::vector<FeatureResult> features;
        for (const std::string& name : link_names(group)) {
            features.push_back({name, read_text(group, name, "unit"),
                                alarm_of(read_text(group, name, "alarm")), column(group, name)});
            require_count(features.back().values.size(),
                          results_.group.size() * results_.noise_levels.size(), name);
        }
        return features;
    }

    void read_features() {
        results_.noise_levels = numbers(root_, columns_name(results_));
        results_.features = features_in(open_group(root_, "features").get());
    }

    void read_variants() {
        if (!has_group(kVariants)) {
            return;
        }
        const Hdf5Handle variants = open_group(root_, kVariants);
        for (const std::string& name : link_names(variants.get())) {
            const Hdf5Handle group = open_group(variants.get(), name);
            results_.variants.push_back(
                {name, read_text(variants.get(), name, "description"), features_in(group.get())});
            require_count(results_.variants.back().features.size(), results_.features.size(), name);
        }
    }

    bool has_group(const char* name) const {
        return std::ranges::count(link_names(root_), name) > 0;
    }

    void read_columns(const char* group_name, std::vector<RowColumn>& columns) {
        if (!has_group(group_name)) {
            return;
        }
        const Hdf5Handle group = open_group(root_, group_name);
        for (const std::string& name : link_names(group.get())) {
            columns.push_back({name, column(group.get(), name)});
            require_count(columns.back().values.size(), results_.group.size(), name);
        }
    }

    void read_detection() {
        const Hdf5Handle group = open_group(root_, "detection");
        results_.request.false_alarm_rate = read_number(group.get(), ".", "false_alarm_rate");
        results_.request.confidence = read_number(group.get(), ".", "confidence");
        results_.request.size.name = read_text(group.get(), ".", "size_name");
        results_.request.size.unit = read_text(group.get(), ".", "size_unit");
        results_.request.noise_levels = results_.noise_levels;
        if (std::ranges::count(attribute_names(group.get()), "threshold_records") > 0) {
            results_.request.threshold_records = static_cast<std::size_t>(
                std::clamp(read_number(group.get(), ".", "threshold_records"), 1.0, 1e9));
        }
        results_.request.importance_sampling =
            std::ranges::count(link_names(open_group(root_, "instances").get()), kNoiseWeight) > 0;
        if (std::ranges::count(attribute_names(group.get()), "uncertain_inputs") > 0) {
            std::istringstream names(read_text(group.get(), ".", "uncertain_inputs"));
            for (std::string name; names >> name;) {
                results_.request.uncertain.push_back(name);
            }
        }
        for (const std::string& name : link_names(group.get())) {
            const Hdf5Handle feature = open_group(group.get(), name);
            results_.detection.push_back(feature_detection(feature.get(), name));
        }
    }

    analysis::FeatureDetection feature_detection(hid_t group, const std::string& name) {
        analysis::FeatureDetection detection;
        detection.feature = name;
        detection.alarm = alarm_of(read_text(group, ".", "alarm"));
        std::istringstream warnings(read_text(group, ".", "warnings"));
        for (std::string line; std::getline(warnings, line);) {
            detection.warnings.push_back(line);
        }
        results_.request.groups = sizes(group);
        read_levels(group, detection.levels);
        return detection;
    }

    std::vector<analysis::SizeGroup> sizes(hid_t group) {
        const auto low = numbers(group, "size_low");
        const auto high = numbers(group, "size_high");
        require_count(high.size(), low.size(), "size_high");
        std::vector<analysis::SizeGroup> result;
        for (std::size_t i = 0; i < low.size(); ++i) {
            result.push_back({low[i], high[i]});
        }
        return result;
    }

    // Reads a dataset for each of these members of `count` items, which `item` gives by their
    // index.
    void read_members(hid_t group, std::size_t count, const auto& item, const auto& doubles,
                      const auto& integers) {
        const auto fill = [&](const auto& values, const auto& named) {
            require_count(values.size(), count, named.name);
            for (std::size_t i = 0; i < count; ++i) {
                item(i).*named.member = values[i];
            }
        };
        for (const auto& named : doubles) {
            fill(numbers(group, named.name), named);
        }
        for (const auto& named : integers) {
            fill(read_integers(group, named.name, most_), named);
        }
    }

    void read_levels(hid_t group, std::vector<analysis::LevelDetection>& levels) {
        const auto& groups = results_.request.groups;
        levels.resize(numbers(group, "threshold").size());
        for (analysis::LevelDetection& level : levels) {
            level.cells.resize(groups.size());
            for (std::size_t i = 0; i < groups.size(); ++i) {
                level.cells[i].size = groups[i];
            }
        }
        const auto level = [&](std::size_t i) -> auto& {
            return levels[i];
        };
        const auto cell = [&](std::size_t i) -> auto& {
            return levels[i / groups.size()].cells[i % groups.size()];
        };
        read_members(group, levels.size(), level, kLevelNumbers, kLevelCounts);
        read_members(group, levels.size() * groups.size(), cell, kCellNumbers, kCellCounts);
    }

    hid_t root_;
    std::size_t most_;
    bool with_columns_;
    Results results_;
};

constexpr const char* kRepairHint =
    "; if it was changed on purpose, `gearpod repair` renews its integrity hash";

// Refuses a file that cannot be opened, or whose integrity hash does not fit.
void check_readable(const std::string& path, ChecksumState checksum, bool verified) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        refuse_file(path, why + (why == "is a folder" ? "; name a results file (*.h5)" : ""));
    }
    if (is_open_for_writing(path)) {
        refuse_file(path, "is open for writing in another program; close it there");
    }
    if (verified && checksum == ChecksumState::truncated) {
        refuse_file(path, "is truncated: its end is missing; copy it again, or repeat the run");
    }
    if (verified && checksum == ChecksumState::broken) {
        refuse_file(path, std::string("is damaged, or another program has changed it (wrong "
                                      "integrity hash)") +
                              kRepairHint);
    }
    if (!is_hdf5(path)) {
        refuse_file(path, "is not a results file (it is not HDF5); `run` writes one");
    }
}

// Prints once for each file that its contents cannot be verified.
void print_unverified(const std::string& path) {
    static std::set<std::string> noted;
    if (noted.insert(path).second) {
        fmt::print(stderr,
                   "{}: note: has no integrity hash, because another program opened it for writing "
                   "or wrote it anew; changes of its contents cannot be detected (`gearpod repair` "
                   "adds a hash)\n",
                   path);
    }
}

void check_format(const std::string& path, hid_t root) {
    std::string format, version;
    try {
        format = read_text(root, ".", "format");
        version = read_text(root, ".", "format_version");
    } catch (const Hdf5Error&) {
        format.clear();
    }
    if (format != kResultsFormat) {
        refuse_file(path, "is an HDF5 file, but not a gearpod results file; `run` writes one");
    }
    int number = 0;
    std::from_chars(version.data(), version.data() + version.size(), number);
    if (number < kOldestFormatVersion || number > kResultsFormatVersion) {
        refuse_file(path,
                    fmt::format("has results format version {}, but this program reads "
                                "versions {} to {}; use a matching version of gearpod",
                                printable(version), kOldestFormatVersion, kResultsFormatVersion));
    }
}

Results read_open_file(const std::string& path, bool with_columns) {
    try {
        const Hdf5Handle file = open_file(path, "opening the file");
        const Hdf5Handle root = open_group(file.get(), "/");
        check_format(path, root.get());
        if (has_soft_links(root.get())) {
            refuse_file(path, "has links to other places, as no results file of `run` has");
        }
        return ResultsReader(root.get(), std::filesystem::file_size(path), with_columns).read();
    } catch (const Hdf5Error& error) {
        refuse_file(path, std::string("is damaged or truncated (at \"") + error.what() + "\")");
    }
}

Results read(const std::string& path, bool with_columns, bool verified = true) {
    const ChecksumState checksum = check_file_checksum(path);
    check_readable(path, checksum, verified);
    // Anyone can compute the hash of a changed file, so an intact one is read in a trial, too.
    const bool all = with_columns || checksum != ChecksumState::intact;
    if (!survives_reading(path, [&] {
            const Results trial = read_open_file(path, all);
            if (!all) {
                FileRows(path, trial).visit([](const RowBlock&) {});
            }
        })) {
        refuse_file(path, "is damaged: the HDF5 library crashes on it, or does not finish");
    }
    Results results = read_open_file(path, with_columns);
    if (verified && checksum == ChecksumState::missing) {
        print_unverified(path);
    }
    return results;
}

}  // namespace

Results read_results(const std::string& path) {
    return read(path, true);
}

Results read_frame(const std::string& path) {
    return read(path, false);
}

Results read_unverified_results(const std::string& path) {
    return read(path, true, false);
}

}  // namespace gearpod::mc
