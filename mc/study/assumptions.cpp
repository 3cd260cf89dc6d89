#include "mc/study/assumptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "machine/contracts.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

std::string teeth(const Study& study) {
    if (!has_tooth_errors(study)) {
        return "identical teeth";
    }
    if (study.find_random("gearbox.tooth_quality") != nullptr) {
        return "teeth of random ISO 1328 grades";
    }
    return study.errors.tooth_quality
               ? fmt::format("teeth of ISO 1328 grade {:g}", *study.errors.tooth_quality) +
                     chosen_mark(study, "gearbox.tooth_quality")
               : "teeth with individual errors";
}

// Keys of the random inputs that the baseline does not share with the test record, and redrawn
// properties.
std::string baseline_differences(const Study& study) {
    std::vector<std::string> names;
    for (const RandomInput& input : study.random) {
        if (input.distribution.per() != DrawnPer::gearbox) {
            names.push_back(input.key +
                            (input.distribution.per_record() ? " (in each record)" : ""));
        }
    }
    for (const std::string& property : study.features.baseline_redraws) {
        names.push_back(property == "pins" ? "pin positions" : "teeth in mesh");
    }
    constexpr std::size_t kMostNamed = 2;
    if (names.size() > kMostNamed + 1) {
        names.push_back(fmt::format("{} other inputs", names.size() - kMostNamed));
        names.erase(names.begin() + kMostNamed, names.end() - 1);
    }
    return names.empty() ? "that has the same assembly, path and sensor mounting"
                         : fmt::format("that differs in {}", fmt::join(names, ", "));
}

constexpr double kYear_h = 8760.0;

std::string alarms_text(double count) {
    return fmt::format("{:.3g} false alarm{}", count, count == 1.0 ? "" : "s");
}

std::string machines_text(int machines) {
    return machines == 1 ? "of a machine" : fmt::format("of {} machines together", machines);
}

}  // namespace

std::string chosen_mark(const Study& study, const std::string& key) {
    return std::ranges::count(study.detection.chosen_values, key) > 0 ? " (chosen)" : "";
}

std::string assumptions(const Study& study, bool lives, const std::string& fault) {
    if (!has_gears(study)) {
        return "";
    }
    std::vector<std::string> all{teeth(study)};
    if (study.gearbox.kind == GearboxKind::planetary && !has_unequal_planets(study)) {
        all.push_back("identical planets and pins");
    }
    if (study.effects.foundation == Foundation::none && !stiffness_given(study)) {
        all.push_back("rigid gear bodies");
    }
    if (!torque_fluctuates(study) && !speed_fluctuates(study)) {
        all.push_back(lives ? "torque and speed steady in each record" : "steady torque and speed");
    }
    if (lives) {
        all.push_back(study.life.curve_h.empty() ? "cracks that grow by Paris' law"
                                                 : "cracks that grow along the given curve");
    }
    std::string text =
        fmt::format("These results hold for {}{}, with thresholds from {} gearboxes.",
                    fault.empty() ? "" : fault + "; ", fmt::join(all, ", "),
                    lives ? "the lives of other" : "other");
    if (compares_records(study) && !lives) {
        const int records = study.features.baseline_records;
        text += fmt::format(
            " own_ and change_ features also need {} of the same gearbox, taken at a torque that "
            "differs by {:g} % (rms){}, {}.",
            records > 1 ? fmt::format("the mean of {} healthy records", records)
                        : "a healthy record",
            100.0 * study.features.baseline_torque_scatter,
            chosen_mark(study, "features.baseline_torque_scatter"), baseline_differences(study));
    }
    const bool alike = std::ranges::all_of(
        study.random, [](const RandomInput& input) { return input.kind == InputKind::fault_size; });
    if (alike) {
        text += " Only the fault and the noise vary.";
    }
    if (!has_tooth_errors(study)) {
        text += " Real teeth can hide faults.";
    }
    return text;
}

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
