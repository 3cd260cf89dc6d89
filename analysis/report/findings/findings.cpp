#include "analysis/report/findings/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/false_alarm_text.hpp"

namespace gearpod::analysis {
namespace {

constexpr long kFewestReported =
    10;  // fewest healthy and faulty gearboxes for statements on detection

void count_sample(Findings& findings) {
    for (const FeatureDetection& feature : findings.detection) {
        for (const LevelDetection& level : feature.levels) {
            long sound = level.threshold_sample, test = 0;
            for (const DetectionCell& cell : level.cells) {
                (cell.size.high > 0.0 ? test : sound) += cell.tested;
            }
            findings.healthy = std::max(findings.healthy, sound);
            findings.faulty = std::max(findings.faulty, test);
        }
    }
}

std::string unassessable_text(const Findings& findings) {
    if (findings.detection.empty() || findings.levels() == 0) {
        return "The study computes no feature, so there is nothing to detect a fault with.";
    }
    const std::string rows = singular(findings.subject);
    if (findings.healthy == 0 && findings.faulty == 0) {
        return fmt::format("No {} has a value of any feature, so detection cannot be assessed.",
                           rows);
    }
    if (findings.faulty == 0) {
        return findings.subject == Subject::recordings
                   ? "No recording is labelled faulty, so detection cannot be assessed."
                   : fmt::format(
                         "No {} of this study has a fault, so detection cannot be assessed; "
                         "only healthy {} are shown.",
                         rows, plural(findings.subject));
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
            findings.healthy, findings.faulty, plural(findings.subject), kFewestReported);
    }
    return "";
}

std::string source_text(const Findings& findings, const SmallestFault& found) {
    return findings.subject == Subject::recordings
               ? found.source.feature
               : fmt::format("{} at noise x {}", found.source.feature,
                             number_text(found.source.noise_level));
}

// Cell of the largest faults with a rate; null without one.
const DetectionCell* largest_cell(const LevelDetection& level) {
    const auto last = std::find_if(
        level.cells.rbegin(), level.cells.rend(),
        [](const DetectionCell& cell) { return cell.size.high > 0.0 && !std::isnan(cell.pd); });
    return last == level.cells.rend() ? nullptr : &*last;
}

// Sizes from the largest down of which every fault was found.
struct FoundSizes {
    long found = 0;
    double from = kNan;  // smallest of them
};

FoundSizes sizes_without_miss(const LevelDetection& level) {
    FoundSizes sizes;
    for (auto cell = level.cells.rbegin(); cell != level.cells.rend(); ++cell) {
        if (cell->size.high <= 0.0 || cell->tested == 0 || cell->detected < cell->tested) {
            break;
        }
        sizes.found += cell->tested;
        sizes.from = cell->size.low;
    }
    return sizes;
}

// Most gearboxes with a value of one size.
long most_per_size(const LevelDetection& level) {
    long most = 0;
    for (const DetectionCell& cell : level.cells) {
        most = cell.size.high > 0.0 ? std::max(most, cell.tested) : most;
    }
    return most;
}

// Number of features without a threshold, whose detection is therefore unknown; "" if all have one.
std::string silent_text(const Findings& findings, std::size_t level) {
    const auto silent = std::ranges::count_if(findings.detection, [&](const FeatureDetection& f) {
        return std::isnan(f.levels[level].threshold);
    });
    return silent == 0 ? ""
                       : fmt::format(
                             " {} of the {} features {} no threshold, so their detection is "
                             "unknown.",
                             silent, findings.detection.size(), silent == 1 ? "has" : "have");
}

// "28.3 mm, 70 % of the tooth section,"
std::string size_and_share(const Findings& findings, double size) {
    const std::string share = findings.share ? findings.share(size) : "";
    return with_unit(size, findings.request.size) + (share.empty() ? "" : ", " + share + ",");
}

Table smallest_table(const Findings& findings) {
    const DetectionRequest& request = findings.request;
    const bool noise = findings.subject == Subject::gearboxes;
    Table table{
        "smallest_fault",
        fmt::format("Smallest {} found with {}", findings.fault_name(), findings.probability()),
        {noise ? "noise" : "", in_unit("size", request.size), "feature", "alarm if"},
        {},
        Shown::screen};
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        const std::string label =
            noise ? "x " + number_text(request.noise_levels[n]) : "recordings";
        const auto& found = findings.smallest[n];
        table.rows.push_back(
            found ? std::vector<std::string>{label,
                                             number_text(found->size / request.size.per_unit()) +
                                                 (found->from_curve ? "" : "*") +
                                                 (found->from_itself ? "" : "+"),
                                             found->feature,
                                             findings.alarm_if(findings.feature(found->feature), n,
                                                               4)}
                  : std::vector<std::string>{
                        label, without_threshold(findings.detection, n) ? "no threshold" : "none",
                        "-", "-"});
    }
    return table;
}

// Explanation of the marks in the table.
void add_notes(Section& section, const Findings& findings) {
    std::vector<std::string> carried;
    bool tested = false;
    for (const auto& found : findings.smallest) {
        tested |= found && !found->from_curve;
        if (found && !found->from_itself &&
            std::ranges::count(carried, source_text(findings, *found)) == 0) {
            carried.push_back(source_text(findings, *found));
        }
    }
    section.state("note.tested", tested ? kTestedAlone : "", Shown::screen);
    section.state("note.carried",
                  carried.empty()
                      ? ""
                      : fmt::format("+ Bound of another feature or noise level, which detects no "
                                    "more faults of any tested size: {}.",
                                    joined(carried)),
                  Shown::screen);
}

std::string sample_limit(const Findings& findings, const SmallestFault& found) {
    constexpr const char* kTested = "one of the tested sizes, not a size between them";
    if (findings.reliability == nullptr) {
        return fmt::format("Sizes: the study is too large for detection curves, so this is {}.",
                           kTested);
    }
    const HitMissPod& pod =
        findings.reliable(findings.feature(found.feature), findings.reference).hit_miss;
    if (!found.from_itself) {
        return fmt::format(
            "Sizes: this is the bound of {}, which finds no more faults of any tested size, so it "
            "also holds for {} here{}.",
            source_text(findings, found), found.feature,
            found.from_curve ? "" : fmt::format("; {}", kTested));
    }
    if (!found.from_curve) {
        return fmt::format("Sizes: there is no detection curve for it ({}: {}), so it is {}.",
                           found.feature,
                           !pod.refusal.empty() ? pod.refusal
                           : pod.doubtful       ? "its goodness of fit is rejected"
                                                : "its curve does not reach that far",
                           kTested);
    }
    if (pod.a90.estimate.where != SizeEstimate::Where::reached) {
        return "";
    }
    const SizeUnit& unit = findings.request.size;
    return fmt::format(
        "Sample: {} is the estimate (a90); {} faulty {} leave it uncertain up to {} "
        "({}).",
        with_unit(pod.a90.estimate.size, unit), pod.tests, plural(findings.subject),
        with_unit(found.size, unit), findings.bound());
}

// "cracks", "pitting"
std::string faults(const Findings& findings) {
    return findings.fault.starts_with("a ") ? findings.fault_name() + "s" : findings.fault_name();
}

// States the detection rate of the best feature where 90 % probability is not shown.
std::string best_text(const Findings& findings, std::size_t f, std::size_t level) {
    const LevelDetection& detected = findings.detection[f].levels[level];
    const FoundSizes all = sizes_without_miss(detected);
    const long needed = tests_to_show(kReliablePd, findings.request.confidence);
    const bool sized = has_sizes(findings.request);
    const long most = most_per_size(detected);
    const std::string few = fmt::format(
        "up to {} per size cannot show 90 %: {} without a miss are needed", most, needed);
    if (all.found > 0 && most < needed) {
        return sized
                   ? fmt::format("finds all {} {} of {} or more, but {}", all.found,
                                 faults(findings), with_unit(all.from, findings.request.size), few)
                   : fmt::format("finds all {}, but {} without a miss are needed", all.found,
                                 needed);
    }
    const DetectionCell& cell = *largest_cell(detected);
    return fmt::format("finds {} % of {}{}", percent_rate_text(cell.pd, {cell.lower, cell.upper}),
                       sized ? "those of " + range_text(cell.size, findings.request.size)
                             : "the faulty " + plural(findings.subject),
                       sized && most < needed ? "; " + few : "");
}

// How the smallest fault found depends on noise.
std::string noise_limit(const Findings& findings) {
    const std::size_t reference = findings.reference, last = findings.levels() - 1;
    const auto size = [&](std::size_t n) {
        return with_unit(findings.smallest[n]->size, findings.request.size);
    };
    const auto& here = findings.smallest[reference];
    const std::size_t shown = findings.tabled_level();
    if (shown < reference && !findings.smallest[shown]) {
        const std::size_t best = findings.best(shown);
        return fmt::format("Noise: even at {} no tested size is found; {} {} there.",
                           findings.noise(shown), findings.name(best),
                           best_text(findings, best, shown));
    }
    std::vector<std::string> texts;
    if (reference > 0 && findings.smallest[0]) {
        const std::string low =
            findings.request.noise_levels[0] == 0.0 ? "without noise" : "at " + findings.noise(0);
        if (!here || findings.smallest[0]->size < 0.9 * here->size) {
            texts.push_back(
                fmt::format("{} the smallest fault found would be {}{}", low, size(0),
                            findings.smallest[0]->from_curve ? "" : " (a tested size)"));
        } else {
            texts.push_back(
                fmt::format("{} the smallest fault found is no smaller ({})", low, size(0)));
        }
    }
    if (last > reference) {
        const std::string at_noise = "at " + findings.noise(last);
        if (!findings.smallest[last]) {
            texts.push_back(at_noise + (without_threshold(findings.detection, last)
                                            ? " there is no threshold"
                                            : " no tested size is found"));
        } else if (here && findings.smallest[last]->size > 1.1 * here->size) {
            texts.push_back(fmt::format("{} the smallest fault found is {}", at_noise, size(last)));
        }
    }
    return texts.empty() ? "" : "Noise: " + joined(texts) + ".";
}

std::string assessable_step(const Findings& findings) {
    const DetectionRequest& request = findings.request;
    if (findings.subject == Subject::recordings) {
        return fmt::format(
            "measure at least {} healthy and {} faulty recordings",
            std::max<long>(kFewestReported, std::min(sample_for_threshold(request.false_alarm_rate),
                                                     sample_for_tail(request.false_alarm_rate))),
            kFewestReported);
    }
    if (findings.detection.empty()) {
        return "name features (features.use)";
    }
    if (findings.healthy == 0 && findings.faulty == 0) {
        return "continue the run with --resume, or read why its gearboxes failed (section "
               "failures)";
    }
    if (findings.faulty < kFewestReported) {
        return fmt::format(
            "for detection rates, give the fault's size levels in [random], with "
            "{} gearboxes each (ensemble.instances)",
            tests_to_show(kReliablePd, request.confidence));
    }
    return fmt::format("raise ensemble.threshold_instances to {}",
                       std::max(kFewestReported, sample_for_threshold(request.false_alarm_rate)));
}

// Gearboxes of the study with which each size has enough of them.
std::string more_gearboxes(const Findings& findings, const LevelDetection& detected) {
    const long needed = tests_to_show(kReliablePd, findings.request.confidence);
    if (findings.subject == Subject::recordings) {
        return fmt::format("test at least {} faulty machines of each size", needed);
    }
    const auto sizes = static_cast<long>(detected.cells.size());
    return fmt::format("run it with --resume --instances {}, {} gearboxes for each of {} sizes",
                       needed * sizes, needed, sizes);
}

}  // namespace

std::optional<std::size_t> found_level(const Findings& findings) {
    for (std::size_t n = findings.reference + 1; n-- > 0;) {
        if (findings.smallest[n]) {
            return n;
        }
    }
    return std::nullopt;
}

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
    const auto at = std::ranges::find_if(
        detection, [&](const FeatureDetection& f) { return f.feature == feature_name; });
    return static_cast<std::size_t>(at - detection.begin());
}

std::string Findings::unit(std::size_t feature) const {
    return feature < units.size() ? units[feature] : "";
}

std::size_t Findings::best(std::size_t level) const {
    if (smallest[level]) {
        return feature(smallest[level]->feature);
    }
    std::size_t best = order[level].front();
    double most = -1.0;
    for (const std::size_t f : order[level]) {
        const DetectionCell* largest = largest_cell(detection[f].levels[level]);
        if (largest != nullptr && largest->pd > most) {
            best = f;
            most = largest->pd;
        }
    }
    return best;
}

std::size_t Findings::tabled_level() const {
    if (const auto found = found_level(*this)) {
        return *found;
    }
    std::size_t level = 0;
    while (level < reference && largest_cell(detection[best(level)].levels[level]) == nullptr) {
        ++level;
    }
    return level;
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
    return "a90/" + number_text(100.0 * request.confidence, 6);
}

std::string Findings::percent() const {
    return percent_text(request.confidence);
}

std::string Findings::size(const SizeEstimate& estimate, const HitMissPod& pod) const {
    return size_estimate_text(estimate, pod.smallest, pod.largest, request.size);
}

std::string Findings::alarm_if(std::size_t feature, std::size_t level, int digits) const {
    const LevelDetection& detected = detection[feature].levels[level];
    const std::string shown = unit(feature) == "order" ? "orders" : quantity_unit(unit(feature));
    return std::isnan(detected.threshold)
               ? "none"
               : fmt::format("{} {}{}{}", alarm_symbol(detection[feature].alarm),
                             distinct_text(detected.threshold, detected.healthy_median, digits),
                             shown.empty() ? "" : " ", shown);
}

void add_detection_sections(Report& report, const Findings& findings) {
    if (findings.detection.empty()) {
        return;
    }
    report.add(thresholds_section(findings));
    report.add(rates_section(findings));
    if (findings.has_curves()) {
        report.add(pod_section(findings));
        report.add(ranking_section(findings));
        report.add(false_alarms_section(findings));
        report.add(inputs_section(findings));
    }
    report.add(conditions_section(findings));
}

std::string headline_text(const Findings& findings, std::size_t level) {
    if (!findings.unassessable.empty()) {
        return findings.unassessable;
    }
    const std::string at_noise = findings.at_noise(level);
    const std::string start = at_noise.empty() ? "" : at_noise.substr(1) + " ";
    const bool sized = has_sizes(findings.request);
    const std::size_t best = findings.best(level);
    const LevelDetection& detected = findings.detection[best].levels[level];
    const auto& found = findings.smallest[level];
    const FoundSizes all = sizes_without_miss(detected);
    if (found && !found->from_itself && sized && all.found > 0) {
        return fmt::format(
            "{} finds all {} {} of {} or more{}: up to {} per size, where {} without a miss show "
            "{}. "
            "{} of {} is shown by {}, which finds no more.",
            capitalised(feature_text(found->feature)), all.found, faults(findings),
            with_unit(all.from, findings.request.size), at_noise, most_per_size(detected),
            tests_to_show(kReliablePd, findings.request.confidence), findings.probability(),
            capitalised(findings.fault), size_and_share(findings, found->size),
            source_text(findings, *found));
    }
    if (found) {
        return fmt::format("{} found with {} by {}{}{}.",
                           sized ? fmt::format("{} of {} is", capitalised(findings.fault),
                                               size_and_share(findings, found->size))
                                 : "The faulty " + plural(findings.subject) + " are",
                           findings.probability(), feature_text(found->feature), at_noise,
                           found->from_itself
                               ? ""
                               : fmt::format(": it finds no less than {}, whose size this is",
                                             source_text(findings, *found)));
    }
    if (without_threshold(findings.detection, level)) {
        return capitalised(start + "no feature has a threshold, so detection is unknown.");
    }
    if (largest_cell(detected) == nullptr) {
        return capitalised(start + "no feature has a detection rate.");
    }
    return fmt::format("No tested {} is found with {}{}. The best feature is {}: it {}.{}",
                       findings.fault_name(), findings.probability(), at_noise,
                       feature_text(findings.name(best)), best_text(findings, best, level),
                       silent_text(findings, level));
}

std::string next_step(const Findings& findings) {
    if (!findings.unassessable.empty()) {
        return assessable_step(findings);
    }
    const std::size_t level = findings.reference, best = findings.best(level);
    const LevelDetection& detected = findings.detection[best].levels[level];
    const DetectionCell* largest = largest_cell(detected);
    if (largest == nullptr) {
        return assessable_step(findings);
    }
    const long needed = tests_to_show(kReliablePd, findings.request.confidence);
    const auto& found = findings.smallest[level];
    if (most_per_size(detected) < needed &&
        (found ? !found->from_itself : largest->upper >= kReliablePd)) {
        return more_gearboxes(findings, detected);
    }
    const bool simulated = findings.subject == Subject::gearboxes;
    if (found && !findings.untested.empty()) {
        return findings.untested;
    }
    if (found) {
        const auto first = std::ranges::find_if(
            detected.cells, [](const DetectionCell& cell) { return cell.size.high > 0.0; });
        if (has_sizes(findings.request) && found->size <= first->size.high) {
            return fmt::format("test {} smaller than {}, the smallest tested", faults(findings),
                               with_unit(first->size.high, findings.request.size));
        }
        return !simulated ? "test the alarm on recordings that did not set its threshold"
               : findings.levels() > 1
                   ? "measure the noise at your sensor, and read its row below"
                   : "measure the noise at your sensor, and repeat the study with it";
    }
    if (const auto quieter = found_level(findings)) {
        const SmallestFault& there = *findings.smallest[*quieter];
        return fmt::format("reduce the noise at the sensor: at {} {} finds {}{}",
                           findings.noise(*quieter), there.feature, findings.fault,
                           has_sizes(findings.request)
                               ? " of " + with_unit(there.size, findings.request.size)
                               : "");
    }
    const std::string& name = findings.name(best);
    const bool compared = name.starts_with("own_") || name.starts_with("change_");
    if (compared && !findings.longer.empty()) {
        return findings.longer;
    }
    return fmt::format(
        "test larger {}, {}", faults(findings),
        !simulated ? "another sensor or another feature"
        : compared ? "or records at a torque closer to the baseline's "
                     "(features.baseline_torque_scatter); no tested noise level decides it"
                   : "or features that compare a gearbox with its own healthy record (own_ and "
                     "change_ in features.use)");
}

std::string figure_text(const Findings& findings) {
    if (!findings.unassessable.empty() || !has_sizes(findings.request)) {
        return "";
    }
    const std::size_t level = findings.reference, best = findings.best(level);
    const std::string marks =
        fmt::format("detection rates with their intervals at {}", findings.percent());
    const bool curve =
        findings.has_curves() && findings.reliable(best, level).hit_miss.refusal.empty();
    return fmt::format(
        "Probability of detection by {}{}. {}.", findings.name(best), findings.at_noise(level),
        curve ? fmt::format("Line: fitted curve; shaded: its bounds, each one-sided at "
                            "{}; marks: {}",
                            findings.percent(), marks)
              : "Marks: " + marks);
}

std::string unknown_text(const Findings& findings, std::size_t level) {
    if (!findings.has_curves()) {
        return "";
    }
    const SizeUnit& unit = findings.request.size;
    for (const std::size_t f : findings.order[level]) {
        const LevelReliability& reliability = findings.reliable(f, level);
        if (reliability.uncertain.inputs.empty() || !reliability.uncertain.refusal.empty()) {
            continue;
        }
        std::vector<std::string> inputs;
        for (const std::string& input : reliability.uncertain.inputs) {
            inputs.push_back(input_name(input, ""));
        }
        const std::string shown = unit.shown_unit();
        return fmt::format(
            "Unknown for this machine: {}. Over the middle 90 % of their possible values, the size "
            "that {} finds with 90 % probability ranges from {} to {}{}; more gearboxes do not "
            "narrow this range.",
            joined(inputs), findings.name(f),
            findings.size(reliability.uncertain.a90_low, reliability.hit_miss),
            findings.size(reliability.uncertain.a90_high, reliability.hit_miss),
            shown.empty() ? "" : " " + shown);
    }
    return "";
}

Section headline_section(const Findings& findings, const std::string& assumptions,
                         const std::string& noise, const std::string& facts) {
    const std::size_t reference = findings.reference;
    Section section{"answer", "", {}};
    const std::string shortage =
        sample_shortage(findings.detection, findings.request, findings.subject);
    section.state("headline", headline_text(findings, reference), Shown::screen);
    section.state("figure", figure_text(findings), Shown::page);
    section.state("assumptions", assumptions, Shown::screen);
    section.state("next", "Next step: " + next_step(findings) + ".", Shown::screen);
    section.state("shortage", findings.unassessable.empty() ? shortage : "", Shown::screen);
    if (findings.unassessable.empty()) {
        section.state("unknown", unknown_text(findings, reference), Shown::screen);
        section.state("noise", noise, Shown::screen);
        section.add(noise_table(findings));
        if (has_sizes(findings.request)) {
            section.add(smallest_table(findings));
            add_notes(section, findings);
        }
    }
    section.state("facts", facts);
    return section;
}

Section limits_section(const Findings& findings, const OtherLimits& others) {
    Section section{"limits", "What limits it", {}};
    if (!findings.unassessable.empty() || !has_sizes(findings.request)) {
        return section;
    }
    const auto& found = findings.smallest[findings.reference];
    const bool curves = findings.has_curves();
    constexpr std::size_t kOnScreen = 2;
    // The strongest first.
    for (const auto& [key, text] : std::initializer_list<std::pair<const char*, std::string>>{
             {"limit.other_fault", others.other_fault},
             {"limit.assumption", others.assumption_decides ? others.assumption : ""},
             {"limit.noise", noise_limit(findings)},
             {"limit.sample", found ? sample_limit(findings, *found) : ""},
             {"limit.assumption", others.assumption_decides ? "" : others.assumption},
             {"limit.misses",
              curves ? misses_text(findings, findings.best(findings.reference), findings.reference)
                     : ""},
             {"limit.numerical", found ? others.numerical : ""},
             {"limit.fine_steps", others.fine_steps}}) {
        section.state(key, text, section.blocks.size() < kOnScreen ? Shown::screen : Shown::full);
    }
    return section;
}

}  // namespace gearpod::analysis
