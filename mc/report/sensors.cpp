#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/wording.hpp"
#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "features/feature.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

// Results with one noise level, the fault's size as the only parameter, and features of the
// acceleration.
struct OneSensor {
    std::string name;
    Results results;
};

bool measures_acceleration(const std::string& feature) {
    const features::Feature* known = features::find_feature(feature);
    return known != nullptr && known->from_sensor;
}

// The first sensor's results and those of the additional ones.
std::vector<OneSensor> sensors_of(const Results& frame, const RowSource& rows, std::size_t level) {
    const RowShape shape = row_shape(frame);
    std::vector<std::size_t> features;
    for (std::size_t f = 0; f < shape.features; ++f) {
        if (measures_acceleration(frame.features[f].name)) {
            features.push_back(f);
        }
    }
    const auto size_at = frame.parameter_index(frame.request.size.name);
    std::vector<OneSensor> all;
    std::vector<std::size_t> variants;
    const auto add = [&](const std::string& name) {
        Results own;
        const ParameterResult& size = frame.parameters[*size_at];
        own.parameters.push_back({size.name, size.unit, {}});
        own.noise_levels = {frame.noise_levels[level]};
        own.request = frame.request;
        own.request.noise_levels = own.noise_levels;
        own.request.uncertain.clear();
        for (const std::size_t f : features) {
            const FeatureResult& feature = frame.features[f];
            own.features.push_back({feature.name, feature.unit, feature.alarm, {}});
        }
        all.push_back({name, std::move(own)});
    };
    if (features.empty() || !size_at) {
        return all;
    }
    add("first");
    for (std::size_t v = 0; v < shape.variants; ++v) {
        if (frame.variants[v].name.starts_with(kSensorVariant)) {
            variants.push_back(v);
            add(frame.variants[v].name.substr(kSensorVariant.size()));
        }
    }
    for_each_row(rows, [&](const ResultRow& row) {
        for (std::size_t s = 0; s < all.size(); ++s) {
            Results& own = all[s].results;
            own.group.push_back(row.group);
            own.status.push_back(row.status);
            own.parameters[0].values.push_back(row.values[*size_at]);
            for (std::size_t f = 0; f < features.size(); ++f) {
                const std::size_t at =
                    s == 0 ? shape.value_of(features[f], level)
                           : shape.variant_value_of(variants[s - 1], features[f]) + level;
                own.features[f].values.push_back(row.values[at]);
            }
        }
    });
    return all;
}

// Deviations of a feature's values from those of the threshold sample, positive towards the alarm.
std::vector<double> deviations(const Results& results, const FeatureResult& feature) {
    std::vector<double> healthy;
    for (std::size_t row = 0; row < results.group.size(); ++row) {
        if (results.group[row] == static_cast<int>(Group::threshold) &&
            std::isfinite(feature.values[row])) {
            healthy.push_back(feature.values[row]);
        }
    }
    constexpr double kNormal = 1.4826;  // standard deviation over median absolute deviation
    const double centre = features::median(healthy);
    for (double& value : healthy) {
        value = std::abs(value - centre);
    }
    const double scale =
        kNormal * features::median(healthy) * (feature.alarm == analysis::Alarm::high ? 1.0 : -1.0);
    std::vector<double> all;
    for (const double value : feature.values) {
        all.push_back(scale != 0.0 ? (value - centre) / scale : kNan);
    }
    return all;
}

// All sensors in one value: their mean deviation or the largest.
OneSensor all_sensors(const std::vector<OneSensor>& sensors, bool largest) {
    OneSensor all{largest ? "largest of all" : "mean of all", sensors.front().results};
    for (std::size_t f = 0; f < all.results.features.size(); ++f) {
        FeatureResult& feature = all.results.features[f];
        std::vector<double> joint(all.results.group.size(),
                                  largest ? -std::numeric_limits<double>::infinity() : 0.0);
        for (const OneSensor& sensor : sensors) {
            const std::vector<double> own = deviations(sensor.results, sensor.results.features[f]);
            for (std::size_t row = 0; row < own.size(); ++row) {
                const double n = static_cast<double>(sensors.size());
                // A missing value stays missing.
                joint[row] = std::isnan(own[row]) || std::isnan(joint[row]) ? kNan
                             : largest ? std::max(joint[row], own[row])
                                       : joint[row] + own[row] / n;
            }
        }
        feature.values = std::move(joint);
        feature.unit = "1";
        feature.alarm = analysis::Alarm::high;  // positive towards the alarm
    }
    return all;
}

// Values of one feature by group, for a comparison.
struct Columns {
    explicit Columns(const Results& results, const std::string& name) {
        const auto feature = std::ranges::find(results.features, name, &FeatureResult::name);
        alarm = feature->alarm;
        for (std::size_t row = 0; row < results.group.size(); ++row) {
            if (results.group[row] == static_cast<int>(Group::threshold)) {
                // Resamples draw gearboxes, so only the first record of each counts.
                if (row % results.request.threshold_records == 0) {
                    healthy.push_back(feature->values[row]);
                }
            } else {
                test.push_back(feature->values[row]);
                size.push_back(results.parameters[0].values[row]);
            }
        }
    }
    analysis::ComparedSample sample() const { return {alarm, healthy, size, test}; }

    analysis::Alarm alarm;
    std::vector<double> healthy, test, size;
};

// Difference between the sensors in the area under the ROC, each with its best feature.
double spread_of(const std::vector<OneSensor>& sensors) {
    std::vector<double> best;
    for (const OneSensor& sensor : sensors) {
        best.push_back(0.0);
        for (const FeatureResult& feature : sensor.results.features) {
            const Columns columns(sensor.results, feature.name);
            std::vector<double> faulty;
            for (std::size_t i = 0; i < columns.test.size(); ++i) {
                if (columns.size[i] > 0.0) {
                    faulty.push_back(columns.test[i]);
                }
            }
            best.back() = std::fmax(
                best.back(),
                analysis::auc(columns.healthy, faulty, columns.alarm == analysis::Alarm::high, 0.95)
                    .auc);
        }
    }
    return best.empty() ? 0.0 : std::ranges::max(best) - std::ranges::min(best);
}

// The sensors at the noise level where they differ most.
std::vector<OneSensor> most_different_sensors(const Results& frame, const RowSource& rows) {
    const std::size_t reference = reference_level(frame.noise_levels);
    std::vector<OneSensor> most = sensors_of(frame, rows, reference);
    double largest = spread_of(most);
    for (std::size_t level = 0; level < frame.noise_levels.size(); ++level) {
        if (level == reference) {
            continue;
        }
        std::vector<OneSensor> sensors = sensors_of(frame, rows, level);
        if (const double spread = spread_of(sensors); spread > largest) {
            largest = spread;
            most = std::move(sensors);
        }
    }
    return most;
}

SensorDetection detection_of(OneSensor& sensor) {
    Results& results = sensor.results;
    const ColumnRows rows(results);
    results.detection = detect_all(results, rows);
    SensorDetection found{results.noise_levels.front(), sensor.name, {}, "", {}};
    if (const auto reliability = reliability_of(results, rows, "", thread_count())) {
        found.smallest = analysis::smallest_fault(*reliability, 0);
        found.feature =
            found.smallest
                ? found.smallest->feature
                : results.features[analysis::in_rank_order(*reliability, 0).front()].name;
    }
    return found;
}

std::string size_text(const SensorDetection& sensor, const analysis::SizeUnit& unit) {
    return sensor.smallest ? analysis::with_unit(sensor.smallest->size, unit) +
                                 (sensor.smallest->from_curve ? "" : " *")
                           : "none";
}

std::string bounds_text(const analysis::Interval& bounds, double factor) {
    const auto text = [&](double bound, const char* open) {
        return std::isfinite(bound) ? analysis::number_text(bound / factor) : std::string(open);
    };
    return text(bounds.lower, "below") + " to " + text(bounds.upper, "above");
}

// Change of a90 with its interval, or "-" where one of the two has no curve.
std::string a90_change_text(const analysis::Comparison& change, const analysis::SizeUnit& unit) {
    return !change.a90.refusal.empty()
               ? "-"
               : fmt::format("{:+.3g} ({})", change.a90.difference() / unit.per_unit(),
                             bounds_text(change.a90.bounds, unit.per_unit()));
}

std::string auc_change_text(const analysis::Comparison& change) {
    return change.auc.refusal.empty() ? fmt::format("{:+.3f} ({})", change.auc.difference(),
                                                    bounds_text(change.auc.bounds, 1.0))
                                      : "-";
}

// Names of those whose area under the ROC is larger than the first sensor's. `levels`: number of
// noise levels of which the one with the largest difference was taken.
std::vector<std::string> better_than_first(const std::vector<SensorDetection>& sensors,
                                           std::size_t levels) {
    std::vector<double> p_values;
    std::vector<const SensorDetection*> compared;
    for (const SensorDetection& sensor : sensors) {
        if (sensor.change && sensor.change->auc.refusal.empty()) {
            compared.push_back(&sensor);
            p_values.push_back(sensor.change->auc.p_value);
        }
    }
    const std::vector<double> corrected = analysis::holm_adjusted(p_values);
    std::vector<std::string> better;
    for (std::size_t i = 0; i < compared.size(); ++i) {
        if (corrected[i] * static_cast<double>(levels) < analysis::kTestLevel &&
            compared[i]->change->auc.difference() > 0.0) {
            better.push_back(compared[i]->name);
        }
    }
    return better;
}

// Least change of the area under the ROC that the least certain comparison finds with 80 %
// probability; 0 without a comparison. The interval's half width is the normal quantile times the
// standard error.
double detectable_change(const std::vector<SensorDetection>& sensors, double confidence) {
    double largest = 0.0;
    for (const SensorDetection& sensor : sensors) {
        if (sensor.change && sensor.change->auc.refusal.empty()) {
            const analysis::Interval& bounds = sensor.change->auc.bounds;
            largest = std::fmax(largest, bounds.upper - bounds.lower);
        }
    }
    const double quantile = analysis::normal_quantile(0.5 + 0.5 * confidence);
    return 0.5 * largest * (1.0 + analysis::normal_quantile(0.8) / quantile);
}

}  // namespace

std::vector<SensorDetection> sensor_detections(const Results& frame, const RowSource& rows) {
    const bool several = std::ranges::any_of(frame.variants, [](const Variant& variant) {
        return variant.name.starts_with(kSensorVariant);
    });
    const std::size_t values = rows.rows() * frame.features.size() * (2 + frame.variants.size());
    if (!several || values > kMostAssessedValues) {
        return {};
    }
    std::vector<OneSensor> sensors = most_different_sensors(frame, rows);
    if (sensors.empty()) {
        return {};
    }
    const std::vector<OneSensor> alone = sensors;
    sensors.push_back(all_sensors(alone, false));
    sensors.push_back(all_sensors(alone, true));
    std::vector<SensorDetection> found;
    for (OneSensor& sensor : sensors) {
        found.push_back(detection_of(sensor));
    }
    analysis::ComparisonRequest request;
    request.false_alarm_rate = frame.request.false_alarm_rate;
    request.confidence = frame.request.confidence;
    request.groups = frame.request.groups;
    request.paired = true;
    for (std::size_t s = 1; s < found.size() && !found[0].feature.empty(); ++s) {
        if (!found[s].feature.empty()) {
            const Columns first(sensors[0].results, found[0].feature),
                other(sensors[s].results, found[s].feature);
            found[s].change = analysis::compare_detection(first.sample(), other.sample(), request,
                                                          thread_count());
        }
    }
    return found;
}

analysis::Section sensors_section(const Results& frame,
                                  const std::vector<SensorDetection>& sensors) {
    analysis::Section section{"sensors", "Sensors", {}};
    if (sensors.empty()) {
        return section;
    }
    const analysis::SizeUnit& unit = frame.request.size;
    const std::size_t levels = frame.noise_levels.size();
    const std::string noise =
        analysis::number_text(sensors.front().noise_level) +
        (levels > 1 ? fmt::format(", of {} levels the one where the sensors differ most", levels)
                    : "");
    section.state(
        "sensors.how",
        fmt::format(
            "Each sensor alone, and all together, at noise x {}, with features of the "
            "acceleration. Values of all sensors are the mean and the largest of their "
            "deviations from healthy gearboxes. The noise of the sensors is independent. Changes "
            "are those from the first sensor, in the same gearboxes, each with its own best "
            "feature; a dash where one of both has no curve.",
            noise));
    analysis::Table table{
        "sensors",
        fmt::format("Smallest fault found with 90 % probability at {} "
                    "confidence, by sensor",
                    analysis::percent_text(frame.request.confidence)),
        {"sensor", "size", "feature", analysis::in_unit("change of a90", unit), "change of AUC"},
        {}};
    bool tested = false;
    for (const SensorDetection& sensor : sensors) {
        tested |= sensor.smallest && !sensor.smallest->from_curve;
        table.rows.push_back({sensor.name, size_text(sensor, unit), sensor.feature,
                              sensor.change ? a90_change_text(*sensor.change, unit) : "",
                              sensor.change ? auc_change_text(*sensor.change) : ""});
    }
    section.add(std::move(table));
    section.state("sensors.tested", tested ? analysis::kTestedAlone : "");
    const std::vector<std::string> better = better_than_first(sensors, levels);
    const double detectable = detectable_change(sensors, frame.request.confidence);
    section.state(
        "sensors.verdict",
        (better.empty() ? "No sensor and no value of all sensors separates faulty from healthy "
                          "gearboxes better than the first sensor, beyond scatter (area under the "
                          "ROC)."
                        : fmt::format("Better than the first sensor beyond scatter (area under the "
                                      "ROC, DeLong's test with Holm's correction{}): {}.",
                                      levels > 1 ? ", and Bonferroni's for the levels" : "",
                                      analysis::joined(better))) +
            (detectable > 0.0
                 ? fmt::format(" A change of {:.2g} is found with 80 % probability, smaller ones "
                               "with less.",
                               detectable)
                 : ""));
    return section;
}

}  // namespace gearpod::mc
