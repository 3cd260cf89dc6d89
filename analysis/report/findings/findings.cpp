#include "analysis/report/findings/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

constexpr long kFewestReported =
    10;  // fewest healthy and faulty gearboxes for statements on detection

void count_sample(Findings& findings) {
    for (const FeatureDetection& feature : findings.detection) {
        for (const LevelDetection& level : feature.levels) {
            long sound = level.threshold_sample, graded = 0;
            for (const DetectionCell& cell : level.cells) {
                (cell.size.high > 0.0 ? graded : sound) += cell.tested;
            }
            findings.healthy = std::max(findings.healthy, sound);
            findings.faulty = std::max(findings.faulty, graded);
        }
    }
}

std::string unassessable_text(const Findings& findings) {
    if (findings.detection.empty() || findings.levels() == 0) {
        return "The study computes no feature, so there is nothing to detect a fault with.";
    }
    const std::string rows = one(findings.subject);
    if (findings.healthy == 0 && findings.faulty == 0) {
        return fmt::format("No {} has a value of any feature, so detection cannot be assessed.",
                           rows);
    }
    if (findings.faulty == 0) {
        return fmt::format(
            "No {} of this study has a fault, so detection cannot be assessed; only healthy {} are "
            "shown.",
            rows, many(findings.subject));
    }
    if (findings.healthy == 0) {
        return fmt::format(
            "No healthy {} has a value, so no alarm threshold can be set and detection cannot be "
            "assessed.",
            rows);
    }
    bool any = false;
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        any |= !without_threshold(findings.detection, n);
    }
    if (!any) {
        return sample_shortage(findings.detection, findings.request, findings.subject);
    }
    if (std::min(findings.healthy, findings.faulty) < kFewestReported) {
        return fmt::format(
            "Only {} healthy and {} faulty {} have values; at least {} of each are needed to "
            "assess "
            "detection.",
            findings.healthy, findings.faulty, many(findings.subject), kFewestReported);
    }
    return "";
}

}  // namespace

Findings::Findings(const AssessedDetection& assessed) : AssessedDetection(assessed) {
    count_sample(*this);
    unassessable = unassessable_text(*this);
    for (std::size_t n = 0; n < levels(); ++n) {
        if (reliability != nullptr && !reliability->features.empty()) {
            smallest.push_back(smallest_fault(*reliability, n));
            order.push_back(in_rank_order(*reliability, n));
        } else {
            smallest.push_back(smallest_fault(detection, n));
            order.emplace_back(detection.size());
            std::iota(order.back().begin(), order.back().end(), std::size_t{0});
        }
    }
}

std::size_t Findings::feature(const std::string& feature_name) const {
    const auto at =
        std::find_if(detection.begin(), detection.end(),
                     [&](const FeatureDetection& f) { return f.feature == feature_name; });
    return static_cast<std::size_t>(at - detection.begin());
}

std::string Findings::unit(std::size_t feature) const {
    return feature < units.size() ? units[feature] : "";
}

std::size_t Findings::best(std::size_t level) const {
    return smallest[level] ? feature(smallest[level]->feature) : order[level].front();
}

std::string Findings::fault_name() const {
    return fault.starts_with("a ") ? fault.substr(2) : fault;
}

std::string Findings::noise(std::size_t level) const {
    return subject == Subject::recordings ? ""
                                          : "noise x " + number_text(request.noise_levels[level]);
}

std::string Findings::at_noise(std::size_t level) const {
    return subject == Subject::recordings ? "" : " at " + noise(level);
}

std::string Findings::probability() const {
    return fmt::format("90 % probability at {} confidence", percent());
}

std::string Findings::bound() const {
    return "a90/" + number_text(100.0 * request.confidence);
}

std::string Findings::percent() const {
    return percent_text(request.confidence);
}

std::string Findings::size(const SizeEstimate& estimate, const HitMissPod& pod) const {
    return size_estimate_text(estimate, pod.smallest, pod.largest, request.size);
}

std::string Findings::alarm_if(std::size_t feature, std::size_t level, int digits) const {
    const LevelDetection& at = detection[feature].levels[level];
    const std::string shown = quantity_unit(unit(feature));
    return std::isnan(at.threshold)
               ? "none"
               : fmt::format("{} {}{}{}", alarm_symbol(detection[feature].alarm),
                             distinct_text(at.threshold, at.healthy_median, digits),
                             shown.empty() ? "" : " ", shown);
}

Section level_section(const Findings& findings, std::size_t level) {
    Section section{fmt::format("level.{}", level), capitalised(findings.noise(level)), {}};
    add_detection(section, findings, level);
    if (findings.has_curves()) {
        add_curves(section, findings, level);
        add_influences(section, findings, level);
    }
    return section;
}

void add_detection_sections(Report& report, const Findings& findings) {
    if (findings.detection.empty()) {
        return;
    }
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        report.add(level_section(findings, n));
    }
    report.add(rates_section(findings));
    report.add(combined_section(findings));
    report.add(conditions_section(findings));
}

}  // namespace gearpod::analysis
