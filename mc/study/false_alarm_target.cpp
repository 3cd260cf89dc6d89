#include "mc/study/false_alarm_target.hpp"

#include <fmt/format.h>

#include "machine/contracts.hpp"

namespace gearpod::mc {
namespace {

constexpr double kYear_h = 8760.0;

std::string alarms_text(double count) {
    return fmt::format("{:.3g} false alarm{}", count, count == 1.0 ? "" : "s");
}

std::string machines_text(int machines) {
    return machines == 1 ? "of a machine" : fmt::format("of {} machines together", machines);
}

}  // namespace

bool has_alarm_target(const Study& study) {
    return study.detection.false_alarms_per_1000_h.has_value();
}

double alarm_target_per_hour(const Study& study) {
    EXPECTS(has_alarm_target(study));
    return *study.detection.false_alarms_per_1000_h / 1000.0;
}

std::optional<double> record_interval_h(const Study& study) {
    return study.detection.record_interval_h ? study.detection.record_interval_h
                                             : study.life.interval_h;
}

std::string false_alarm_target_text(const Study& study) {
    const std::optional<double> interval_h = record_interval_h(study);
    if (!interval_h) {
        return "";
    }
    const Detection& d = study.detection;
    const double per_year = d.false_alarm_rate * kYear_h / *interval_h;
    if (!has_alarm_target(study)) {
        return fmt::format(
            "With a record every {:g} h, a false-alarm rate of {:.3g} is {} a year of a machine "
            "for "
            "each feature.",
            *interval_h, d.false_alarm_rate, alarms_text(per_year));
    }
    const std::string alarms = alarms_text(*d.false_alarms_per_1000_h);
    return fmt::format(
        "{} in 1000 h {}, with a record of each every {:g} h, {} a rate of {:.3g} in a record for "
        "each feature{}.",
        alarms, machines_text(d.machines), *interval_h, alarms.ends_with('s') ? "are" : "is",
        d.false_alarm_rate,
        d.machines > 1 ? fmt::format(" ({} a year of one machine)", alarms_text(per_year)) : "");
}

}  // namespace gearpod::mc
