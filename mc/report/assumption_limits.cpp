#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/comparison/predicted_detection.hpp"
#include "machine/team.hpp"
#include "mc/report/run_sections.hpp"

namespace gearpod::mc {
namespace {

using analysis::PredictedDetection;

// Values of the feature that is best at a noise level, from which detection is predicted.
class Answer {
  public:
    Answer(const Results& frame, const RowSource& rows, std::size_t feature, std::size_t level)
        : frame_(frame), request_(frame.request), feature_(feature), level_(level) {
        request_.noise_levels = {frame.noise_levels[level]};
        const std::size_t size = *frame.parameter_index(frame.request.size.name);
        const RowShape shape = row_shape(frame);
        std::vector<std::size_t> healthy_rows;
        for_each_row(rows, [&](const ResultRow& row) {
            const bool test = row.group == static_cast<int>(Group::test);
            const double value = row.values[shape.value_of(feature, level)];
            own_.push_back({test ? row.values[size] : 0.0, value, kNan});
            (test ? test_ : healthy_).push_back(value);
            if (test) {
                test_size_.push_back(row.values[size]);
            } else {
                healthy_rows.push_back(row.index);
            }
        });
        gearbox_ = gearboxes_of(frame, healthy_rows);
    }

    PredictedDetection as_is() const { return analysis::detection_as_is(values(), request_); }
    PredictedDetection predicted(const std::vector<std::int64_t>& rows,
                                 const std::vector<double>& changed) const {
        std::vector<analysis::ValuePair> pairs;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            pairs.push_back(own_.at(static_cast<std::size_t>(rows[i])));
            pairs.back().changed =
                changed[(i * frame_.features.size() + feature_) * frame_.noise_levels.size() +
                        level_];
        }
        return analysis::predicted_detection(values(), pairs, request_, machine::processors());
    }

  private:
    analysis::FeatureValues values() const {
        return {frame_.features[feature_].alarm, healthy_, gearbox_, test_size_, test_};
    }

    const Results& frame_;
    analysis::DetectionRequest request_;
    std::size_t feature_, level_;
    std::vector<double> healthy_, test_size_, test_;
    std::vector<std::size_t> gearbox_;      // of each healthy value
    std::vector<analysis::ValuePair> own_;  // by row, without changed values
};

struct Effect {
    std::string name;
    PredictedDetection half, as_is, twice;

    bool reached() const {
        return std::isfinite(half.size) || std::isfinite(as_is.size) || std::isfinite(twice.size);
    }
    // By which the answer changes: the logarithm of the size, or of the detection rate.
    double strength(bool by_size) const {
        const auto change = [&](const PredictedDetection& other) {
            if (!by_size) {
                return std::abs(other.pd - as_is.pd);
            }
            constexpr double kNone = 10.0;
            return other.size == as_is.size ? 0.0
                   : std::isinf(other.size) || std::isinf(as_is.size)
                       ? kNone + std::abs(other.pd - as_is.pd)
                       : std::abs(std::log(other.size / as_is.size));
        };
        return std::max(change(half), change(twice));
    }
};

std::string name_of(const std::string& key) {
    return key == "features.baseline_torque_scatter" ? "torque scatter of the baseline"
           : key == "gearbox.tooth_quality"          ? "errors of the teeth"
                                                     : "noise";
}

// "2.41 [2.2, none]", a rate "55 [42, 67]", or "none" alone.
std::string cell(const PredictedDetection& detection, bool by_size, const analysis::SizeUnit& unit,
                 bool interval = true) {
    const auto shown = [&](double value) {
        return !by_size            ? fmt::format("{:.0f}", 100.0 * value)
               : std::isinf(value) ? "none"
                                   : analysis::number_text(value / unit.per_unit());
    };
    const double value = by_size ? detection.size : detection.pd,
                 low = by_size ? detection.size_low : detection.pd_low,
                 high = by_size ? detection.size_high : detection.pd_high;
    return interval && !std::isinf(low)
               ? fmt::format("{} [{}, {}]", shown(value), shown(low), shown(high))
               : shown(value);
}

}  // namespace

AssumptionLimits assumption_limits(const Results& frame, const RowSource& rows,
                                   const analysis::Findings& findings) {
    static const AssumptionRows kNone;
    const AssumptionRows& fine = frame.numerical ? frame.numerical->pairs : kNone;
    const auto& [pair_rows, changed] = frame.assumptions;
    AssumptionLimits limits;
    if ((changed.empty() && fine.changed.empty()) || !findings.has_curves() ||
        !has_sizes(findings.request)) {
        return limits;
    }
    const std::size_t level = found_level(findings).value_or(findings.reference),
                      best = findings.best(level);
    const Answer answer(frame, rows, best, level);
    const PredictedDetection as_is = answer.as_is();
    const analysis::SizeUnit& unit = findings.request.size;
    const std::string shown_unit = unit.shown_unit().empty() ? "" : " " + unit.shown_unit();
    const std::string& feature = findings.name(best);
    const std::string largest = with_unit(findings.request.groups.back().high, unit),
                      at = findings.at_noise(level), fault = findings.fault_name();
    for (const ChangedAssumption& steps : fine.changed) {
        const PredictedDetection exact = answer.predicted(fine.rows, steps.values);
        if (std::isfinite(as_is.size) && !std::isnan(exact.pd)) {
            limits.fine_steps = fmt::format(
                "With fine steps, predicted from {} gearboxes, {} finds a {} of {} instead of "
                "{}{}{}.",
                fine.rows.size(), feature, fault, cell(exact, true, unit),
                cell(as_is, true, unit, false), shown_unit, at);
        }
    }
    std::vector<Effect> effects;
    for (const ChangedAssumption& assumption : changed) {
        const std::string name = name_of(assumption.key);
        if (effects.empty() || effects.back().name != name) {
            effects.push_back({name, as_is, as_is, as_is});
        }
        (assumption.factor < 1.0 ? effects.back().half : effects.back().twice) =
            answer.predicted(pair_rows, assumption.values);
    }
    std::erase_if(effects, [](const Effect& effect) {
        return std::isnan(effect.half.pd) || std::isnan(effect.twice.pd);
    });
    if (effects.empty()) {
        return limits;
    }
    const bool by_size = std::ranges::any_of(effects, &Effect::reached);
    std::ranges::stable_sort(effects, std::greater(),
                             [&](const Effect& effect) { return effect.strength(by_size); });
    const Effect& first = effects.front();
    const std::string half = cell(first.half, by_size, unit),
                      twice = cell(first.twice, by_size, unit),
                      present = cell(as_is, by_size, unit, false);
    limits.strongest = by_size ? fmt::format(
                                     "Assumed {}: if half as large, {} would find a {} of {}, if "
                                     "twice as large {}, instead of {}{}{}.",
                                     first.name, feature, fault, half, twice, present,
                                     std::isinf(as_is.size) ? "" : shown_unit, at)
                               : fmt::format(
                                     "Assumed {}: if half as large, {} would find {} % of those of "
                                     "{}, if twice as large {} %, instead of {} %{}.",
                                     first.name, feature, half, largest, twice, present, at);
    constexpr double kLittle = 0.1;  // of the size, or of all faults
    limits.decides = first.strength(by_size) > kLittle;
    limits.table = {
        "limit.assumptions",
        fmt::format("{}{} if an assumption is half or twice as large, predicted with its 95 % "
                    "interval from {} gearboxes computed with both",
                    by_size ? fmt::format("Smallest {} found by {}", fault, feature)
                            : fmt::format("Alarms of {} in % of those of {}", feature, largest),
                    at, pair_rows.size()),
        {"assumption", by_size ? in_unit("half", unit) : "half", "as it is", "twice"},
        {}};
    for (const Effect& effect : effects) {
        limits.table.rows.push_back({effect.name, cell(effect.half, by_size, unit), present,
                                     cell(effect.twice, by_size, unit)});
    }
    return limits;
}

}  // namespace gearpod::mc
