// misses F.h5: how often a fault is missed where that is rare.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "analysis/report/json_values.hpp"
#include "analysis/report/text_lines.hpp"
#include "mc/commands/support.hpp"
#include "mc/ensemble/missed_faults.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/json_text.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/report/example_gearboxes.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"
#include "signals/windowing/noise_tilt.hpp"

namespace gearpod::mc {
namespace {

constexpr long kMostRows = 100'000'000;
constexpr int kMostRecords = 10'000;  // as of ensemble.threshold_records

// Every option that is wrong, a line each.
class Complaints {
  public:
    void add(const std::string& option, const std::string& what) {
        text_ += fmt::format("{}: {}\n", option, what);
    }
    void end() const {
        if (!text_.empty()) {
            throw std::runtime_error(text_.substr(0, text_.size() - 1));
        }
    }

  private:
    std::string text_;
};

template <class List, class Name>
std::string joined(const List& list, Name name) {
    std::string text;
    for (const auto& item : list) {
        text += (text.empty() ? "" : ", ") + name(item);
    }
    return text;
}

// The threshold that the file's healthy sample sets.
void find_threshold(const Results& frame, const MissesOptions& options, Complaints& complaints,
                    MissQuestion& question) {
    const auto feature =
        std::ranges::find(frame.detection, options.feature, &analysis::FeatureDetection::feature);
    if (feature == frame.detection.end()) {
        complaints.add(
            "--feature",
            fmt::format("\"{}\" is not in {}, which has {}", options.feature, options.results,
                        joined(frame.features, [](const FeatureResult& f) { return f.name; })));
        return;
    }
    const features::Feature* known = features::find_feature(options.feature);
    if (known == nullptr || !known->from_sensor) {
        complaints.add("--feature",
                       fmt::format("\"{}\" does not look at the accelerometer, whose noise is "
                                   "tilted; take one that does",
                                   options.feature));
    }
    const double wanted =
        options.noise_level.value_or(frame.noise_levels[reference_level(frame.noise_levels)]);
    const auto level = std::ranges::find(frame.noise_levels, wanted);
    if (level == frame.noise_levels.end() || wanted == 0.0) {
        complaints.add("--noise-level",
                       fmt::format("{:g} is none of the file's levels above 0: {}", wanted,
                                   joined(frame.noise_levels,
                                          [](double one) { return fmt::format("{:g}", one); })));
        return;
    }
    const auto at = static_cast<std::size_t>(level - frame.noise_levels.begin());
    question.feature = options.feature;
    question.noise_level = wanted;
    question.threshold = feature->levels[at].threshold;
    if (std::isnan(question.threshold)) {
        complaints.add("--feature",
                       fmt::format("\"{}\" has no threshold at noise x {:g}: too few healthy "
                                   "gearboxes for the false-alarm rate",
                                   options.feature, wanted));
    }
}

void check_numbers(const Study& study, const MissesOptions& options, Complaints& complaints) {
    constexpr auto kKinds = static_cast<int>(signals::NoiseTilt::kKinds);
    if (noise_by_density(study)) {
        complaints.add(options.results,
                       "its study gives the noise by density, which colours it; only white noise, "
                       "sensor.noise_m_s2, is tilted");
    }
    if (options.records < kKinds || options.records % kKinds != 0 ||
        options.records > kMostRecords) {
        complaints.add("--records", fmt::format("{} is no multiple of {} up to {}", options.records,
                                                kKinds, kMostRecords));
    }
    const int records = std::clamp(options.records, kKinds, kMostRecords);
    if (options.gearboxes < 2 || options.gearboxes > kMostRows / records) {
        complaints.add("--gearboxes", fmt::format("{} is not between 2 and {}", options.gearboxes,
                                                  kMostRows / records));
    }
    if (!(options.size > 0.0) || std::isinf(options.size)) {
        complaints.add("--size", fmt::format("{:g} is no fault", options.size));
    }
}

// What is wrong with the study of the misses: with the fault's size, or with what the file holds.
[[noreturn]] void refuse(const MissesOptions& options, const std::string& size_key,
                         Problems problems) {
    for (Problem& problem : problems) {
        const bool of_size = problem.key == size_key;
        problem.file = of_size ? "--size" : options.results;
        problem.line = 0;
        problem.key = of_size ? "" : problem.key;
    }
    const std::string text = format(problems);
    throw std::runtime_error(text.substr(0, text.size() - 1));
}

struct Prepared {
    MissQuestion question;
    Study study;  // of the misses
    std::string unit;
    StudyScene made;
};

Prepared prepare(const MissesOptions& options) {
    Results frame = read_frame(options.results);
    const FileRows rows(options.results, frame);
    check_results(options.results, frame, rows);
    StudyReading reading = read_study_text(frame.provenance_value("study"), options.results);
    if (!reading.study) {
        throw std::runtime_error(options.results + ": its study cannot be read");
    }
    const Study& study = *reading.study;
    if (study.fault.kind == nullptr) {
        throw std::runtime_error(options.results + ": its study has no fault to miss");
    }
    frame.detection = detect_all(frame, rows);
    Complaints complaints;
    Prepared prepared;
    check_numbers(study, options, complaints);
    find_threshold(frame, options, complaints, prepared.question);
    complaints.end();
    const Unit& unit = fault_size_key(study).unit;
    prepared.unit = unit.suffix.empty() ? "" : " " + std::string(unit.name);
    prepared.question.size = options.size * unit.to_si;
    prepared.question.gearboxes = options.gearboxes;
    prepared.question.records = options.records;
    prepared.study = study_of_misses(study, prepared.question);
    prepared.made = make_scene(options.results,
                               read_study_text(resolved_text(prepared.study), options.results));
    if (!prepared.made) {
        refuse(options, fault_size_key(study).path(), prepared.made.problems);
    }
    return prepared;
}

std::string rate_text(const Prepared& prepared, const MissAnswer& answer) {
    const MissQuestion& q = prepared.question;
    const std::string records =
        fmt::format("{} tilted records of each of {} gearboxes", q.records, answer.gearboxes);
    if (!answer.misses) {
        return fmt::format(
            "not known from {}: too few of them have the misses. It takes more records or "
            "gearboxes; where noise is not what makes the misses, records do not help",
            records);
    }
    return fmt::format("{:.3g} [{:.3g}, {:.3g}] at {:g} %, from {}, {:.0f} of which carry it",
                       answer.misses->expected, answer.misses->rate.lower,
                       answer.misses->rate.upper, 100.0 * prepared.study.detection.confidence,
                       records, answer.misses->carrying);
}

// What counting would have taken.
std::string counting_text(const MissAnswer& answer) {
    const double times = answer.counted / static_cast<double>(answer.records);
    const std::string error =
        fmt::format("relative error {:.2g}; ", std::sqrt(answer.misses->variance));
    return times > 1.0 ? error + fmt::format(
                                     "counting misses of single records takes {:.3g} of "
                                     "them for the same, {:.3g} times as many",
                                     answer.counted, times)
                       : error +
                             "not so rare that tilting pays: `run` counts them with fewer "
                             "records";
}

std::string answer_text(const MissesOptions& options, const Prepared& prepared,
                        const MissAnswer& answer) {
    const MissQuestion& q = prepared.question;
    const bool high = features::find_feature(q.feature)->alarm == features::AlarmSide::high;
    std::string text;
    analysis::add_wrapped(
        text,
        fmt::format("faults of {:g}{} that {} misses at noise x {:g} (alarm if {} {:.5g}): {}",
                    options.size, prepared.unit, q.feature, q.noise_level, high ? ">" : "<",
                    q.threshold, rate_text(prepared, answer)),
        2);
    if (answer.misses) {
        analysis::add_wrapped(text, counting_text(answer), 2);
    }
    if (answer.failed > 0) {
        text += fmt::format("{} of the gearboxes failed, and do not count\n", answer.failed);
    }
    return text;
}

nlohmann::json answer_json(const MissesOptions& options, const Prepared& prepared,
                           const MissAnswer& answer) {
    const MissQuestion& q = prepared.question;
    nlohmann::json json{{"kind", "misses"},
                        {"results", options.results},
                        {"feature", q.feature},
                        {"noise_level", q.noise_level},
                        {"threshold", q.threshold},
                        {"size", options.size},
                        {"size_unit", prepared.unit.empty() ? "" : prepared.unit.substr(1)},
                        {"gearboxes", answer.gearboxes},
                        {"failed", answer.failed},
                        {"records", q.records},
                        {"confidence", prepared.study.detection.confidence},
                        {"miss_rate", nullptr},
                        {"lower", nullptr},
                        {"upper", nullptr},
                        {"carrying", nullptr},
                        {"relative_error", nullptr},
                        {"counted_records", nullptr}};
    if (answer.misses) {
        json["miss_rate"] = answer.misses->expected;
        json["lower"] = answer.misses->rate.lower;
        json["upper"] = answer.misses->rate.upper;
        json["carrying"] = answer.misses->carrying;
        json["relative_error"] = std::sqrt(answer.misses->variance);
        json["counted_records"] = analysis::number(answer.counted);
    }
    return json;
}

}  // namespace

int misses_command(const MissesOptions& options) {
    const Ranks ranks;
    const Interruption interruption({});
    std::optional<Prepared> prepared;
    std::string problem;
    if (ranks.leads() &&
        !can_write({"--json", options.json}, {{"the results file", options.results}})) {
        problem = "-";  // which has said why
    } else {
        try {
            prepared = prepare(options);
        } catch (const std::exception& error) {
            problem = exception_text(error);
        }
    }
    for (const std::string& one : ranks.gather(problem)) {
        if (!one.empty()) {
            if (ranks.leads() && one != "-") {
                fmt::print(stderr, "{}\n", one);
            }
            return kBadInput;
        }
    }
    try {
        Progress progress(options.gearboxes * options.records, options.quiet || !ranks.leads());
        const MissAnswer answer = missed_faults(*prepared->made.scene, prepared->question, ranks,
                                                progress, &interruption);
        progress.finish();
        if (!ranks.leads()) {
            return kDone;
        }
        if (options.json != "-") {
            fmt::print("{}", answer_text(options, *prepared, answer));
        }
        if (!options.json.empty() &&
            !write_text_to(options.json,
                           json_text(answer_json(options, *prepared, answer), 2) + "\n")) {
            return kBadInput;
        }
        return answer.failed == 0 ? kDone : kSomeFailed;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;  // nothing is kept
    }
}

}  // namespace gearpod::mc
