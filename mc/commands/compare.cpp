// Command `compare A.h5 B.h5 ...`: the effect of a change of sensor, feature, noise or design on
// detection.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "analysis/comparison/comparison_report.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "mc/commands/commands.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/json_text.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/random/philox.hpp"
#include "mc/report/page.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/run/support.hpp"
#include "mc/summary/failures.hpp"

namespace gearpod::mc {
namespace {

// Results file with the rows of its two groups.
struct Side {
    std::string path;
    Results frame;                               // includes the columns
    std::vector<std::size_t> threshold, graded;  // rows
    std::size_t gearboxes = 0;
    std::vector<std::optional<analysis::SmallestFault>> smallest;
    std::vector<bool> without_threshold;
    std::string title;
    SamplingKind sampling = SamplingKind::plain;
};

// Describes an incomplete file (part of a study, interrupted run); "" if it is complete.
std::string incomplete_text(const Results& frame, std::size_t gearboxes) {
    const std::string part = frame.provenance_value("part");
    const std::string state = frame.provenance_value("state");
    const bool stopped = state == "running" || state.starts_with("interrupted");
    return (part.empty() ? "" : fmt::format(", part {} only", printable(part))) +
           (stopped ? fmt::format(", {} of {} gearboxes ({})", gearboxes,
                                  printable(frame.provenance_value("gearboxes_asked_for")),
                                  printable(state))
                    : "");
}

Side read_side(const std::string& path) {
    Side side;
    side.path = path;
    side.frame = read_results(path);
    const ColumnRows rows(side.frame);
    check_results(path, side.frame, rows);
    side.frame.detection = detect_all(side.frame, rows);
    const auto reliability = reliability_of(side.frame, rows, "", thread_count());
    for (std::size_t n = 0; reliability && n < side.frame.noise_levels.size(); ++n) {
        side.smallest.push_back(analysis::smallest_fault(*reliability, n));
        side.without_threshold.push_back(analysis::without_threshold(side.frame.detection, n));
    }
    for (std::size_t row = 0; row < side.frame.group.size(); ++row) {
        const bool threshold = side.frame.group[row] == static_cast<int>(Group::threshold);
        // The bootstrap resamples gearboxes, so only the first record of each threshold gearbox is
        // used.
        const bool repeats = threshold && row % side.frame.request.threshold_records != 0;
        if (side.frame.group[row] != kUngraded && !repeats) {
            (threshold ? side.threshold : side.graded).push_back(row);
        }
    }
    side.gearboxes = count_rows(rows, side.frame.request.threshold_records).all;
    const auto study = read_study_text(side.frame.provenance_value("study"), "").study;
    side.title =
        (study ? printable(study->title) : "") + incomplete_text(side.frame, side.gearboxes);
    side.sampling = study ? study->ensemble.sampling : SamplingKind::plain;
    return side;
}

const ParameterResult* find(const Results& frame, const std::string& name) {
    const auto at = std::find_if(frame.parameters.begin(), frame.parameters.end(),
                                 [&](const ParameterResult& p) { return p.name == name; });
    return at == frame.parameters.end() ? nullptr : &*at;
}

double size_of(const Results& frame, std::size_t row) {
    const ParameterResult* size = find(frame, frame.request.size.name);
    return size != nullptr ? size->values[row] : 0.0;
}

// Rows of both files to be compared, paired or not.
struct Rows {
    std::vector<std::size_t> threshold_a, graded_a, threshold_b, graded_b;
    std::string unpaired;  // why the rows are not paired; "": they are
};

Rows rows_of(const Side& a, const Side& b) {
    Rows rows{a.threshold, a.graded, b.threshold, b.graded, ""};
    const std::string seed = a.frame.provenance_value("seed");
    if (a.frame.provenance_value("kind") == kRecordingsKind ||
        b.frame.provenance_value("kind") == kRecordingsKind || seed.empty()) {
        rows.unpaired = "recordings";
        return rows;
    }
    if (seed != b.frame.provenance_value("seed")) {
        rows.unpaired = fmt::format("seed {} and {}", printable(seed),
                                    printable(b.frame.provenance_value("seed")));
        return rows;
    }
    if (a.sampling != b.sampling) {
        rows.unpaired = "ensemble.sampling differs";
        return rows;
    }
    // With the same seed, rows at the same position of a group have the same random inputs.
    const std::size_t graded = std::min(a.graded.size(), b.graded.size());
    for (std::size_t i = 0; i < graded; ++i) {
        if (size_of(a.frame, a.graded[i]) != size_of(b.frame, b.graded[i])) {
            rows.unpaired = "their fault sizes differ";
            return rows;
        }
    }
    const std::size_t healthy = std::min(a.threshold.size(), b.threshold.size());
    // Pairing would discard more than half of the larger file.
    if (2 * graded < std::max(a.graded.size(), b.graded.size()) ||
        2 * healthy < std::max(a.threshold.size(), b.threshold.size())) {
        rows.unpaired = "one has more than twice as many as the other";
        return rows;
    }
    for (auto* group : {&rows.threshold_a, &rows.threshold_b}) {
        group->resize(healthy);
    }
    for (auto* group : {&rows.graded_a, &rows.graded_b}) {
        group->resize(graded);
    }
    return rows;
}

// Lines such as "torque_N_m differs in 500 of them", one for each input that differs in some pair.
std::vector<std::string> differing_inputs(const Side& a, const Side& b, const Rows& rows) {
    std::vector<std::string> lines;
    for (const ParameterResult& parameter : a.frame.parameters) {
        const ParameterResult* other = find(b.frame, parameter.name);
        std::size_t differ = 0;
        for (std::size_t i = 0; other != nullptr && i < rows.graded_a.size(); ++i) {
            differ += parameter.values[rows.graded_a[i]] != other->values[rows.graded_b[i]];
        }
        if (differ > 0) {
            lines.push_back(fmt::format("{} differs in {} of them", parameter.name, differ));
        }
    }
    return lines;
}

std::vector<double> values(const FeatureResult& feature, const std::vector<std::size_t>& rows,
                           std::size_t level, std::size_t levels) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        out.push_back(feature.values[row * levels + level]);
    }
    return out;
}

std::vector<double> sizes(const Results& frame, const std::vector<std::size_t>& rows) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        out.push_back(size_of(frame, row));
    }
    return out;
}

const FeatureResult* find_feature(const Results& frame, const std::string& name) {
    const auto at = std::find_if(frame.features.begin(), frame.features.end(),
                                 [&](const FeatureResult& f) { return f.name == name; });
    return at == frame.features.end() ? nullptr : &*at;
}

// Compares values; NaN equals NaN, because a gearbox may fail in both files.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return x == y || (std::isnan(x) && std::isnan(y));
    });
}

void add_features(analysis::ComparedFile& file, const Side& a, const Side& b, const Rows& rows,
                  analysis::ComparisonRequest request) {
    const auto& levels_a = a.frame.noise_levels;
    const auto& levels_b = b.frame.noise_levels;
    for (const analysis::SizeGroup& group : a.frame.request.groups) {
        for (const analysis::SizeGroup& other : b.frame.request.groups) {
            if (group.low == other.low && group.high == other.high) {
                request.groups.push_back(group);
            }
        }
    }
    const auto sizes_a = sizes(a.frame, rows.graded_a), sizes_b = sizes(b.frame, rows.graded_b);
    for (const FeatureResult& feature : a.frame.features) {
        const FeatureResult* other = find_feature(b.frame, feature.name);
        for (std::size_t n = 0; other != nullptr && n < levels_a.size(); ++n) {
            const auto at = std::find(levels_b.begin(), levels_b.end(), levels_a[n]);
            if (at == levels_b.end()) {
                continue;
            }
            const auto m = static_cast<std::size_t>(at - levels_b.begin());
            const auto column_a = [&](const auto& of) {
                return values(feature, of, n, levels_a.size());
            };
            const auto column_b = [&](const auto& of) {
                return values(*other, of, m, levels_b.size());
            };
            const auto healthy_a = column_a(rows.threshold_a), graded_a = column_a(rows.graded_a);
            const auto healthy_b = column_b(rows.threshold_b), graded_b = column_b(rows.graded_b);
            file.features.push_back(
                {feature.name, levels_a[n],
                 request.paired && same(healthy_a, healthy_b) && same(graded_a, graded_b),
                 compare_detection({feature.alarm, healthy_a, sizes_a, graded_a},
                                   {other->alarm, healthy_b, sizes_b, graded_b}, request,
                                   thread_count())});
        }
    }
    const auto missing = [&](const Side& has, const Side& lacks) {
        std::string names;
        for (const FeatureResult& feature : has.frame.features) {
            if (find_feature(lacks.frame, feature.name) == nullptr) {
                names += (names.empty() ? "" : ", ") + feature.name;
            }
        }
        if (!names.empty()) {
            file.left_out.push_back(fmt::format("{} (only in {})", names, has.path));
        }
    };
    missing(a, b);
    missing(b, a);
}

// Reasons why two files cannot be compared, one line each; "" if they can.
std::string mismatch(const Side& a, const Side& b) {
    std::string text;
    const analysis::DetectionRequest &one = a.frame.request, &two = b.frame.request;
    if (one.size.name != two.size.name || one.size.unit != two.size.unit) {
        text += fmt::format(
            "{}: its fault size is {}, that of {} is {}; compare results with the same kind of "
            "fault\n",
            b.path, two.size.name, a.path, one.size.name);
    }
    if (one.false_alarm_rate != two.false_alarm_rate) {
        text += fmt::format(
            "{}: its false-alarm rate is {:g}, that of {} is {:g}; run both at the same "
            "detection.false_alarm_rate\n",
            b.path, two.false_alarm_rate, a.path, one.false_alarm_rate);
    }
    const auto common = [](const auto& first, const auto& second, auto same) {
        return std::any_of(first.begin(), first.end(), [&](const auto& x) {
            return std::any_of(second.begin(), second.end(),
                               [&](const auto& y) { return same(x, y); });
        });
    };
    if (!common(a.frame.features, b.frame.features,
                [](const auto& x, const auto& y) { return x.name == y.name; })) {
        text += fmt::format("{}: has no feature in common with {}\n", b.path, a.path);
    }
    if (!common(a.frame.noise_levels, b.frame.noise_levels, std::equal_to<>())) {
        text += fmt::format("{}: has no noise level in common with {}\n", b.path, a.path);
    }
    return text;
}

// Noise level to show: the reference level among those that all files have, else the first file's.
double shown_level(const std::vector<Side>& sides) {
    const auto everywhere = [&](double level) {
        return std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
            const auto& levels = side.frame.noise_levels;
            return std::find(levels.begin(), levels.end(), level) != levels.end();
        });
    };
    const auto& levels = sides.front().frame.noise_levels;
    std::vector<double> common;
    std::copy_if(levels.begin(), levels.end(), std::back_inserter(common), everywhere);
    return common.empty() ? levels[reference_level(levels)] : common[reference_level(common)];
}

analysis::ComparedResults compare_sides(const std::vector<Side>& sides) {
    analysis::ComparedResults results;
    const Side& first = sides.front();
    results.size = first.frame.request.size;
    results.confidence = first.frame.request.confidence;
    results.noise_level = shown_level(sides);
    for (const Side& side : sides) {
        results.first_records = results.first_records || side.frame.request.threshold_records > 1;
        analysis::ComparedFile file;
        file.path = side.path;
        file.title = side.title;
        file.gearboxes = static_cast<long>(side.gearboxes);
        file.noise_levels = side.frame.noise_levels;
        file.smallest = side.smallest;
        file.without_threshold = side.without_threshold;
        file.shortage = analysis::sample_shortage(side.frame.detection, side.frame.request,
                                                  subject_of(side.frame));
        if (&side != &first) {
            const Rows rows = rows_of(first, side);
            file.unpaired = rows.unpaired;
            analysis::ComparisonRequest request;
            request.false_alarm_rate = first.frame.request.false_alarm_rate;
            request.confidence = results.confidence;
            request.paired = rows.unpaired.empty();
            if (request.paired) {
                file.pairs = static_cast<long>(rows.graded_a.size());
                file.differing = differing_inputs(first, side, rows);
            }
            add_features(file, first, side, rows, request);
        }
        results.files.push_back(std::move(file));
    }
    return results;
}

// Reads all files. If some cannot be read, or cannot be compared with the first, it prints every
// problem and returns none.
std::vector<Side> read_sides(const std::vector<std::string>& paths) {
    std::vector<Side> sides;
    std::set<std::string> problems;  // a file may be named twice
    std::string printed;
    const auto say = [&](const std::string& problem) {
        printed += problems.insert(problem).second ? problem : "";
    };
    bool first_read = false;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        try {
            sides.push_back(read_side(paths[i]));
            first_read = first_read || i == 0;
            if (i > 0 && first_read) {
                say(mismatch(sides.front(), sides.back()));
            }
        } catch (const std::exception& error) {
            say(exception_text(error) + "\n");
        }
    }
    fmt::print(stderr, "{}", printed);
    return printed.empty() ? std::move(sides) : std::vector<Side>{};
}

}  // namespace

int compare_command(const CompareOptions& options) {
    std::vector<FileRole> read;
    for (const std::string& path : options.results) {
        read.push_back({"the results file", path});
    }
    std::vector<FileRole> with_json = read;
    const FileRole json_role{"--json", options.json};
    with_json.push_back(json_role);
    const bool json_good = can_write(json_role, read, {json_output(), options.force});
    if (!can_write({"--html", options.html}, with_json, {page_output(), options.force}) ||
        !json_good) {
        return kBadInput;
    }
    if (options.results.size() < 2) {
        fmt::print(stderr,
                   "compare: only one results file; give two or more, the first is the "
                   "reference\n");
        return kBadInput;
    }
    try {
        const std::vector<Side> sides = read_sides(options.results);
        if (sides.empty()) {
            return kBadInput;
        }
        const analysis::ComparedResults results = compare_sides(sides);
        const nlohmann::json json = comparison_json(results);
        if (!options.json.empty() && !write_text_to(options.json, json_text(json, 2) + "\n")) {
            return kBadInput;
        }
        if (!options.html.empty()) {
            const std::string page = report_page(json_text(json));
            write_file(options.html, std::as_bytes(std::span(page)));
        }
        if (options.json != "-") {
            fmt::print("{}", analysis::report_text(comparison_report(results)));
        }
        if (!options.html.empty() && options.json != "-") {
            fmt::print("\npage: {}\n", options.html);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
    return kDone;
}

}  // namespace gearpod::mc
