// Findings on detection as sections of a report: the answer, what limits it, and all rates, curves
// and influences by noise level.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {

// Results that a report is about. References and spans must outlive the findings.
struct AssessedDetection {
    std::span<const FeatureDetection> detection;
    const Reliability* reliability = nullptr;  // null: too many values for curves
    const DetectionRequest& request;
    Subject subject = Subject::gearboxes;
    std::string fault = "a fault";        // with its article, if it has one: "a crack", "pitting"
    std::size_t reference = 0;            // noise level shown first
    std::vector<std::string> units = {};  // of the features; may be empty
    // A size as a share of the tooth in words, or ""; may be empty.
    std::function<std::string(double)> share = {};
    std::string untested = "";  // next step that removes an idealization of the study, or ""
    std::string longer = "";    // next step if records are shorter than by default, or ""
};

// The results with the numbers that several sections need.
struct Findings : AssessedDetection {
    explicit Findings(const AssessedDetection& assessed);

    long healthy = 0, faulty = 0;  // with a value, for the feature and noise level that have most
    std::vector<std::optional<SmallestFault>> smallest;  // by noise level
    std::vector<std::vector<std::size_t>> order;         // features by rank, by noise level
    // Reason why detection cannot be assessed, or "".
    std::string unassessable;

    bool has_curves() const { return reliability != nullptr && unassessable.empty(); }
    const LevelReliability& reliable(std::size_t feature, std::size_t level) const {
        return reliability->features[feature].levels[level];
    }
    std::size_t levels() const { return request.noise_levels.size(); }
    const std::string& name(std::size_t feature) const { return detection[feature].feature; }
    std::size_t feature(const std::string& name) const;
    std::string unit(std::size_t feature) const;
    // Feature of the smallest fault, otherwise the one that finds most of the largest faults, the
    // better ranked of several.
    std::size_t best(std::size_t level) const;
    // Noise level whose best feature the table by noise has: the reference; where nothing is found
    // there, the next quieter one where something is, or else the quietest one with rates.
    std::size_t tabled_level() const;

    std::string fault_name() const;                 // "crack"
    std::string noise(std::size_t level) const;     // "noise x 1"; recordings have none: ""
    std::string at_noise(std::size_t level) const;  // " at noise x 1" or ""
    std::string probability() const;                // "90 % probability at 95 % confidence"
    std::string bound() const;                      // "a90/95"
    std::string percent() const;                    // "95 %": the confidence
    std::string size(const SizeEstimate& estimate, const HitMissPod& pod) const;
    // "> 1.0003": alarm condition, with at least that many digits and as many as distinguish the
    // threshold from the healthy median; "none" without a threshold.
    std::string alarm_if(std::size_t feature, std::size_t level, int digits) const;
};

// Loudest noise up to the reference at which a fault is found.
std::optional<std::size_t> found_level(const Findings& findings);
// Sentence on the smallest fault found at a noise level, or why there is none.
std::string headline_text(const Findings& findings, std::size_t level);
// Step after this answer, without a full stop.
std::string next_step(const Findings& findings);
// Description of the figure next to the answer.
std::string figure_text(const Findings& findings);
// Misses of a feature: number, and the inputs that influence them significantly. "" where they
// cannot be analysed.
std::string misses_text(const Findings& findings, std::size_t feature, std::size_t level);
// Range of a90 over the epistemic inputs, which more gearboxes do not narrow; "" without them.
std::string unknown_text(const Findings& findings, std::size_t level);

// Rates of the best feature by size and noise.
Table noise_table(const Findings& findings);

// The answer at the reference level, `assumptions`, the next step, `noise` (what x 1 is), tables by
// noise, and `facts`.
Section headline_section(const Findings& findings, const std::string& assumptions,
                         const std::string& noise, const std::string& facts);
// Sentences on limits that findings do not have: the assumption that changes the answer most, the
// numerical error of its feature, the answer with fine steps, and the alarms of another fault.
struct OtherLimits {
    std::string assumption, numerical, fine_steps, other_fault;
    bool assumption_decides = true;  // false: the assumption changes the answer by little
};
// Limits of the answer.
Section limits_section(const Findings& findings, const OtherLimits& others = {});
// At every noise level, in order.
Section thresholds_section(const Findings& findings);
Section rates_section(const Findings& findings);
Section pod_section(const Findings& findings);
Section ranking_section(const Findings& findings);
Section false_alarms_section(const Findings& findings);
Section inputs_section(const Findings& findings);
// Thresholds and rates by the values of one input.
Section conditions_section(const Findings& findings);

// Adds the sections on detection other than the answer and its limits.
void add_detection_sections(Report& report, const Findings& findings);

}  // namespace gearpod::analysis
