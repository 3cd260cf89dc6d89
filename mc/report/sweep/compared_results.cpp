#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mc/ensemble/ranks.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/input/find_in.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {
namespace {

const ParameterResult* find_parameter(const Results& frame, const std::string& name) {
    return find_in(frame.parameters, name, &ParameterResult::name);
}

double compared_size(const Results& frame, std::size_t row) {
    const ParameterResult* size = find_parameter(frame, frame.request.size.name);
    return size != nullptr ? size->values[row] : 0.0;
}

struct ComparedRows {
    std::vector<std::size_t> threshold_a, test_a, threshold_b, test_b;
    std::string unpaired;  // why the rows are not paired; "": they are
};

ComparedRows compared_rows(const ComparedSide& a, const ComparedSide& b) {
    ComparedRows rows{a.threshold, a.test, b.threshold, b.test, ""};
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
    // With the same seed, rows at the same position of a group have the same random inputs.
    const std::size_t test = std::min(a.test.size(), b.test.size());
    for (std::size_t i = 0; i < test; ++i) {
        if (compared_size(a.frame, a.test[i]) != compared_size(b.frame, b.test[i])) {
            rows.unpaired = "their fault sizes differ";
            return rows;
        }
    }
    const std::size_t healthy = std::min(a.threshold.size(), b.threshold.size());
    // Pairing would discard more than half of the larger file.
    if (2 * test < std::max(a.test.size(), b.test.size()) ||
        2 * healthy < std::max(a.threshold.size(), b.threshold.size())) {
        rows.unpaired = "one has more than twice as many as the other";
        return rows;
    }
    for (auto* group : {&rows.threshold_a, &rows.threshold_b}) {
        group->resize(healthy);
    }
    for (auto* group : {&rows.test_a, &rows.test_b}) {
        group->resize(test);
    }
    return rows;
}

// Lines such as "torque_N_m differs in 500 of them", one for each input that differs in some pair.
std::vector<std::string> differing_inputs(const ComparedSide& a, const ComparedSide& b,
                                          const ComparedRows& rows) {
    std::vector<std::string> lines;
    for (const ParameterResult& parameter : a.frame.parameters) {
        const ParameterResult* other = find_parameter(b.frame, parameter.name);
        std::size_t differ = 0;
        for (std::size_t i = 0; other != nullptr && i < rows.test_a.size(); ++i) {
            differ += parameter.values[rows.test_a[i]] != other->values[rows.test_b[i]];
        }
        if (differ > 0) {
            lines.push_back(fmt::format("{} differs in {} of them", parameter.name, differ));
        }
    }
    return lines;
}

template <typename Value>
std::vector<double> column_of(const std::vector<std::size_t>& rows, Value value) {
    std::vector<double> out;
    for (const std::size_t row : rows) {
        out.push_back(value(row));
    }
    return out;
}

// Compares values; NaN equals NaN, because a gearbox may fail in both files.
bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(
        a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

void add_features(analysis::ComparedFile& file, const ComparedSide& a, const ComparedSide& b,
                  const ComparedRows& rows, analysis::ComparisonRequest request,
                  const ComparedSelection& selection) {
    const auto& levels_a = a.frame.noise_levels;
    const auto& levels_b = b.frame.noise_levels;
    for (const analysis::SizeGroup& group : a.frame.request.groups) {
        for (const analysis::SizeGroup& other : b.frame.request.groups) {
            if (group.low == other.low && group.high == other.high) {
                request.groups.push_back(group);
            }
        }
    }
    const auto sizes_a =
                   column_of(rows.test_a, [&](auto row) { return compared_size(a.frame, row); }),
               sizes_b =
                   column_of(rows.test_b, [&](auto row) { return compared_size(b.frame, row); });
    for (const FeatureResult& feature : a.frame.features) {
        const FeatureResult* other = find_in(b.frame.features, feature.name, &FeatureResult::name);
        for (std::size_t n = 0; other != nullptr && n < levels_a.size(); ++n) {
            const auto at = std::ranges::find(levels_b, levels_a[n]);
            if (at == levels_b.end() || !selection.holds(feature.name, levels_a[n])) {
                continue;
            }
            const auto m = static_cast<std::size_t>(at - levels_b.begin());
            const auto of_a = [&](std::size_t row) {
                return feature.values[row * levels_a.size() + n];
            };
            const auto of_b = [&](std::size_t row) {
                return other->values[row * levels_b.size() + m];
            };
            const auto healthy_a = column_of(rows.threshold_a, of_a),
                       healthy_b = column_of(rows.threshold_b, of_b),
                       test_a = column_of(rows.test_a, of_a), test_b = column_of(rows.test_b, of_b);
            file.features.push_back(
                {feature.name, levels_a[n],
                 request.paired && same_values(healthy_a, healthy_b) && same_values(test_a, test_b),
                 compare_detection({feature.alarm, healthy_a, sizes_a, test_a},
                                   {other->alarm, healthy_b, sizes_b, test_b}, request,
                                   thread_count())});
        }
    }
    const auto missing = [&](const ComparedSide& has, const ComparedSide& lacks) {
        std::vector<std::string> names;
        for (const FeatureResult& feature : has.frame.features) {
            if (std::ranges::count(lacks.frame.features, feature.name, &FeatureResult::name) == 0) {
                names.push_back(feature.name);
            }
        }
        if (!names.empty()) {
            file.left_out.push_back(
                fmt::format("{} (only in {})", fmt::join(names, ", "), has.path));
        }
    };
    missing(a, b);
    missing(b, a);
}

}  // namespace

ComparedSide read_compared(const std::string& path) {
    ComparedSide side;
    side.path = path;
    side.frame = read_results(path);
    const ColumnRows rows(side.frame);
    check_results(path, side.frame, rows);
    side.frame.detection = detect_all(side.frame, rows);
    for (std::size_t row = 0; row < side.frame.group.size(); ++row) {
        const bool threshold = side.frame.group[row] == static_cast<int>(Group::threshold);
        // The bootstrap resamples gearboxes, so only the first record of each threshold gearbox is
        // used.
        const bool repeats = threshold && row % side.frame.request.threshold_records != 0;
        if (side.frame.group[row] != kNoGroup && !repeats) {
            (threshold ? side.threshold : side.test).push_back(row);
        }
    }
    side.facts = run_facts(side.frame.provenance_value("study"));
    return side;
}

// Reasons why two files cannot be compared, one line each; "" if they can.
std::string mismatch(const ComparedSide& a, const ComparedSide& b) {
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
    const auto common = [](const auto& first, const auto& second, auto name) {
        return std::ranges::find_first_of(first, second, {}, name, name) != first.end();
    };
    if (!common(a.frame.features, b.frame.features, &FeatureResult::name)) {
        text += fmt::format("{}: has no feature in common with {}\n", b.path, a.path);
    }
    if (!common(a.frame.noise_levels, b.frame.noise_levels, std::identity())) {
        text += fmt::format("{}: has no noise level in common with {}\n", b.path, a.path);
    }
    return text;
}

void compare_with(const ComparedSide& a, const ComparedSide& b, analysis::ComparisonRequest request,
                  const ComparedSelection& selection, analysis::ComparedFile& file) {
    const ComparedRows rows = compared_rows(a, b);
    file.unpaired = rows.unpaired;
    request.false_alarm_rate = a.frame.request.false_alarm_rate;
    request.paired = rows.unpaired.empty();
    if (request.paired) {
        file.pairs = static_cast<long>(rows.test_a.size());
        file.differing = differing_inputs(a, b, rows);
    }
    add_features(file, a, b, rows, request, selection);
}

}  // namespace gearpod::mc
