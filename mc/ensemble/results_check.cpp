#include "mc/ensemble/results_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mc/plan/sampling.hpp"
#include "mc/results/layout.hpp"

namespace gearpod::mc {
namespace {

bool share(double value) {
    return value > 0.0 && value < 1.0;
}

bool group_after(const analysis::SizeGroup& group, double before) {
    return std::isfinite(group.high) && group.low >= before && group.high >= group.low;
}

// Finds values that no run writes for any study; returns "" if there are none.
std::string invalid_values(const Results& frame) {
    double before = -1.0;
    for (const double level : frame.noise_levels) {
        if (!std::isfinite(level) || level < 0.0 || level <= before) {
            return fmt::format(
                "/{} contains {:g}, but its values must be finite, not negative and ascending",
                columns_name(frame), level);
        }
        before = level;
    }
    if (!share(frame.request.false_alarm_rate) || !share(frame.request.confidence)) {
        return "/detection: false_alarm_rate and confidence must lie between 0 and 1";
    }
    double end = 0.0;
    for (const analysis::SizeGroup& group : frame.request.groups) {
        if (!group_after(group, end)) {
            return "/detection: the sizes must be finite, not negative and ascending";
        }
        end = group.high;
    }
    return "";
}

// Describes the first column whose name or unit differs from the study's.
std::string column_difference(const std::string& where, const auto& columns, const auto& expected) {
    const auto text = [](const auto& list, std::size_t i) {
        return i < list.size() ? list[i].name + " (" + list[i].unit + ")" : "none";
    };
    for (std::size_t i = 0; i < std::max(columns.size(), expected.size()); ++i) {
        if (text(columns, i) != text(expected, i)) {
            return fmt::format("{}: column {} is {}, but in the study it is {}", where, i + 1,
                               text(columns, i), text(expected, i));
        }
    }
    return "";
}

// Describes the first difference from the frame that the study's run writes.
std::string study_difference(const Results& frame, Results expected) {
    if (!frame.parameter_index(kBaselineTorque)) {  // files of versions before 0.3
        std::erase_if(expected.parameters,
                      [](const ParameterResult& column) { return column.name == kBaselineTorque; });
    }
    std::string why = column_difference("/instances", frame.parameters, expected.parameters);
    if (why.empty()) {
        why = column_difference("/features", frame.features, expected.features);
    }
    if (why.empty() && frame.variants.size() != expected.variants.size()) {
        why = fmt::format("/variants has {} members, but in the study there are {}",
                          frame.variants.size(), expected.variants.size());
    }
    for (std::size_t v = 0; v < expected.variants.size() && why.empty(); ++v) {
        if (frame.variants[v].name != expected.variants[v].name) {
            why = fmt::format("/variants: member {} is {}, but in the study it is {}", v + 1,
                              frame.variants[v].name, expected.variants[v].name);
            break;
        }
        why = column_difference("/variants/" + expected.variants[v].name,
                                frame.variants[v].features, expected.variants[v].features);
    }
    if (why.empty() && frame.noise_levels != expected.noise_levels) {
        why = fmt::format("/noise_levels has {} levels that differ from the study's {}",
                          frame.noise_levels.size(), expected.noise_levels.size());
    }
    const auto same = [](const analysis::SizeGroup& a, const analysis::SizeGroup& b) {
        return a.low == b.low && a.high == b.high;
    };
    const auto& request = frame.request;
    if (why.empty() && (!std::ranges::equal(request.groups, expected.request.groups, same) &&
                        !frame.features.empty())) {
        why = "/detection: the sizes differ from the study's";
    }
    if (why.empty() && (request.false_alarm_rate != expected.request.false_alarm_rate ||
                        request.confidence != expected.request.confidence ||
                        request.size.name != expected.request.size.name)) {
        why = "/detection: false_alarm_rate, confidence or size_name differs from the study's";
    }
    if (why.empty() && request.threshold_records != expected.request.threshold_records) {
        why = fmt::format("/detection has threshold_records = {}, but the study has {}",
                          request.threshold_records, expected.request.threshold_records);
    }
    return why;
}

class RowCheck {
  public:
    // `healthy`: number of rows of the threshold group, if the study is known.
    RowCheck(const RowShape& shape, std::optional<std::size_t> healthy, bool nan_parameters_allowed)
        : shape_(shape), healthy_(healthy), nan_allowed_(nan_parameters_allowed) {}

    // Finds the reason in the first invalid row.
    void check_row(const ResultRow& row) {
        if (!why_.empty()) {
            return;
        }
        if (row.status < 0 || row.status >= kStatuses) {
            why_ = fmt::format("/status of row {} has the invalid value {}", row.index, row.status);
        } else if (row.group != 0 && row.group != 1 && (healthy_ || row.group != kNoGroup)) {
            why_ = fmt::format("/instances/group of row {} has the invalid value {}", row.index,
                               row.group);
        } else if (healthy_ && (row.index < *healthy_) != (row.group == 0)) {
            why_ = fmt::format("/instances/group of row {} differs from the study's", row.index);
        }
        const double* const parameters_end = row.values + shape_.parameters;
        if (!std::all_of(row.values, parameters_end, [&](double value) {
                return std::isfinite(value) || (nan_allowed_ && std::isnan(value));
            })) {
            why_ =
                fmt::format("/instances of row {} contains a number that is not finite", row.index);
        }
        if (std::any_of(parameters_end, row.values + shape_.values(),
                        [](double value) { return std::isinf(value); })) {
            why_ = fmt::format("/features of row {} contains an infinite number", row.index);
        }
    }
    const std::string& why() const { return why_; }

  private:
    const RowShape shape_;
    const std::optional<std::size_t> healthy_;
    const bool nan_allowed_;
    std::string why_;
};

}  // namespace

void check_against(const std::string& path, const Results& frame, const RowSource& rows,
                   const std::optional<ExpectedResults>& expected) {
    std::string why = invalid_values(frame);
    std::optional<std::size_t> healthy;
    if (why.empty() && expected) {
        why = study_difference(frame, expected->frame);
        const auto part = read_part(frame.provenance_value("part"));
        healthy = expected->plan.threshold_rows();
        const std::size_t most = expected->plan.rows();
        if (why.empty() && !part) {
            why = "its attribute part is invalid";
        }
        if (why.empty() && rows.rows() > most) {
            why = fmt::format("it has {} {}, but the study{} has {}", rows.rows(),
                              expected->plan.counted(),
                              part && !part->whole() ? "'s part " + part->text() : "", most);
        }
    }
    if (why.empty()) {
        RowCheck check(row_shape(frame), healthy, expected && expected->nan_parameters_allowed);
        for_each_row(rows, [&](const ResultRow& row) { check.check_row(row); });
        why = check.why();
    }
    if (!why.empty()) {
        throw std::runtime_error(fmt::format("{}: is not a results file of `{}`: {}", path,
                                             expected ? expected->command : "run", why));
    }
}

void check_results(const std::string& path, const Results& frame, const RowSource& rows) {
    if (frame.provenance_value("kind") == kLivesKind) {
        throw std::runtime_error(path + ": holds lives, which only `report` can read");
    }
    std::optional<ExpectedResults> expected;
    if (const auto plan = recorded_plan(frame.provenance_value("study"), path)) {
        const auto part = read_part(frame.provenance_value("part"));
        expected = {results_frame(*plan), plan->batches(part.value_or(Part{}))};
    }
    check_against(path, frame, rows, expected);
}

}  // namespace gearpod::mc
