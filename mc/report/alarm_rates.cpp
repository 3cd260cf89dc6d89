#include "mc/report/alarm_rates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/wording.hpp"
#include "features/feature.hpp"

namespace gearpod::mc {
namespace {

std::size_t other_fault_variant(const Results& frame) {
    const auto found = std::ranges::find(frame.variants, kOtherFault, &Variant::name);
    return static_cast<std::size_t>(found - frame.variants.begin());
}

std::string share_text(const OtherFaultAlarms& one) {
    return analysis::percent_text(static_cast<double>(one.alarms) /
                                  static_cast<double>(one.tested));
}

std::string bounds_text(const OtherFaultAlarms& one) {
    return fmt::format("{} to {}", analysis::percent_text(one.interval.lower),
                       analysis::percent_text(one.interval.upper));
}

}  // namespace

std::vector<OtherFaultAlarms> other_fault_alarms(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const std::size_t variant = other_fault_variant(frame);
    if (variant == shape.variants || frame.detection.size() != shape.features) {
        return {};
    }
    std::vector<OtherFaultAlarms> all;
    for (std::size_t f = 0; f < shape.features; ++f) {
        for (std::size_t n = 0; n < frame.detection[f].levels.size(); ++n) {
            const features::Feature* known = features::find_feature(frame.features[f].name);
            // A bearing does not change the transmission error.
            const bool from_sensor = known == nullptr || known->from_sensor;
            if (from_sensor && !std::isnan(frame.detection[f].levels[n].threshold)) {
                all.push_back({f, n, 0, 0, 0, {}});
            }
        }
    }
    for_each_row(rows, [&](const ResultRow& row) {
        for (OtherFaultAlarms& one : all) {
            const double with =
                             row.values[shape.variant_value_of(variant, one.feature) + one.level],
                         without = row.values[shape.value_of(one.feature, one.level)];
            if (std::isfinite(with) && std::isfinite(without)) {
                const double threshold = frame.detection[one.feature].levels[one.level].threshold;
                const analysis::Alarm alarm = frame.features[one.feature].alarm;
                ++one.tested;
                one.alarms += analysis::is_alarm(with, threshold, alarm);
                one.without += analysis::is_alarm(without, threshold, alarm);
            }
        }
    });
    std::erase_if(all, [](const OtherFaultAlarms& one) { return one.tested == 0; });
    for (OtherFaultAlarms& one : all) {
        one.interval = analysis::wilson_interval(one.alarms, one.tested, frame.request.confidence);
    }
    return all;
}

std::string other_fault_limit(const Results& frame, const std::string& fault,
                              const std::vector<OtherFaultAlarms>& alarms,
                              const std::string& feature, std::size_t level) {
    const auto found = std::ranges::find_if(alarms, [&](const OtherFaultAlarms& one) {
        return frame.features[one.feature].name == feature && one.level == level;
    });
    if (found == alarms.end()) {
        return "";
    }
    return fmt::format(
        "{} raises this alarm in {} of {} healthy gearboxes ({}; {} at {} confidence), against {} "
        "without it.",
        analysis::capitalised(fault), found->alarms, found->tested, share_text(*found),
        bounds_text(*found), analysis::percent_text(frame.request.confidence), found->without);
}

analysis::Section other_fault_section(const Results& frame, const std::string& fault,
                                      const std::vector<OtherFaultAlarms>& alarms) {
    analysis::Section section{"other_fault", "Alarms raised by another fault", {}};
    if (alarms.empty()) {
        section.state("other_fault.none",
                      other_fault_variant(frame) < frame.variants.size()
                          ? "Whether the other fault raises alarms is unknown: no feature of the "
                            "acceleration has a threshold."
                          : "");
        return section;
    }
    section.state("other_fault.how",
                  fmt::format("The healthy gearboxes that set the thresholds, with {}: the same "
                              "records, with its vibration added.",
                              fault));
    analysis::Table table{
        "other_fault",
        "Healthy gearboxes with the other fault that raise an alarm",
        {"feature", "noise", "alarms", "of", "share",
         analysis::percent_text(frame.request.confidence) + " interval", "without it"},
        {}};
    for (const OtherFaultAlarms& one : alarms) {
        table.rows.push_back(
            {frame.features[one.feature].name,
             fmt::format("x {}", analysis::number_text(frame.noise_levels[one.level])),
             fmt::format("{}", one.alarms), fmt::format("{}", one.tested), share_text(one),
             bounds_text(one), fmt::format("{}", one.without)});
    }
    section.add(std::move(table));
    return section;
}

}  // namespace gearpod::mc
