// Command `misses F.h5`: probability of a rare miss, by importance sampling with exponentially
// tilted noise.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/report/json_values.hpp"
#include "mc/commands/asked_results.hpp"
#include "mc/commands/commands.hpp"
#include "mc/ensemble/missed_faults.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"
#include "signals/windowing/noise_tilt.hpp"

namespace gearpod::mc {
namespace {

constexpr long kMostRows = 100'000'000;
constexpr int kMostRecords = 10'000;  // the limit of ensemble.threshold_records

// Finds the threshold set by the file's healthy gearboxes.
void find_threshold(const AskedResults& results, const MissesOptions& options,
                    Complaints& complaints, MissQuestion& question) {
    const features::Feature* feature = features::find_feature(options.feature);
    if (feature != nullptr && !feature->from_sensor) {
        complaints.add("--feature",
                       fmt::format("\"{}\" does not use the acceleration signal, but `misses` "
                                   "varies its noise; choose a feature of the acceleration",
                                   options.feature));
    }
    const auto asked = find_asked(results, options.feature, options.noise_level, complaints);
    if (!asked) {
        return;
    }
    question.feature = options.feature;
    question.noise_level = asked->detection->noise_level;
    question.threshold = asked->detection->threshold;
    if (question.noise_level == 0.0) {
        complaints.add("--noise-level",
                       "0 has no noise; use `rare` for misses due to variation between gearboxes");
    }
    needs_threshold(*asked, complaints);
}

void check_numbers(const Study& study, const MissesOptions& options, Complaints& complaints) {
    constexpr auto kKinds = static_cast<int>(signals::NoiseTilt::kKinds);
    if (noise_by_density(study)) {
        complaints.add(options.results,
                       "its study gives the noise by density, which is not white after the "
                       "low-pass; `misses` needs white noise (sensor.noise_m_s2)");
    }
    if (options.records < kKinds || options.records % kKinds != 0 ||
        options.records > kMostRecords) {
        complaints.add("--records", fmt::format("must be a multiple of {} up to {}, but is {}",
                                                kKinds, kMostRecords, options.records));
    }
    const int records = std::clamp(options.records, kKinds, kMostRecords);
    if (options.gearboxes < 2 || options.gearboxes > kMostRows / records) {
        complaints.add("--gearboxes", fmt::format("must be between 2 and {}, but is {}",
                                                  kMostRows / records, options.gearboxes));
    }
}

struct Prepared {
    MissQuestion question;
    double confidence = 0.0;
    AskedSize size;
    StudyScene made;
};

Prepared prepare(const MissesOptions& options) {
    const AskedResults results = read_asked(options.results);
    const Study& study = results.study;
    if (study.fault.kind == nullptr) {
        throw std::runtime_error(options.results + ": its study has no fault");
    }
    Complaints complaints;
    Prepared prepared;
    check_numbers(study, options, complaints);
    prepared.size = ask_size(study, options.size, complaints);
    find_threshold(results, options, complaints, prepared.question);
    complaints.end();
    prepared.confidence = study.detection.confidence;
    prepared.question.size = prepared.size.si;
    prepared.question.gearboxes = options.gearboxes;
    prepared.question.records = options.records;
    prepared.made = scene_of_asked(results, study_of_misses(study, prepared.question));
    return prepared;
}

std::string rate_text(const Prepared& prepared, const MissAnswer& answer) {
    const MissQuestion& q = prepared.question;
    const std::string records = fmt::format(
        "{} exponentially tilted records of each of {} gearboxes", q.records, answer.gearboxes);
    if (!answer.misses) {
        return fmt::format(
            "unknown from {}: too few of them contribute misses. Use more records or gearboxes; "
            "if the misses are due to variation between gearboxes, use `rare`",
            records);
    }
    return fmt::format(
        "{:.3g} [{:.3g}, {:.3g}] at {:g} % confidence, from {}, of which effectively {:.0f} "
        "contribute",
        answer.misses->expected, answer.misses->rate.lower, answer.misses->rate.upper,
        100.0 * prepared.confidence, records, answer.misses->carrying);
}

// Relative error, and how many records plain counting would need for the same error.
std::string counting_text(const MissAnswer& answer) {
    const double times = answer.counted / static_cast<double>(answer.records);
    const std::string error =
        fmt::format("relative error {:.2g}; ", std::sqrt(answer.misses->variance));
    return times > 1.0 ? error + fmt::format(
                                     "simple counting needs {:.3g} records for the same "
                                     "error, {:.3g} times as many",
                                     answer.counted, times)
                       : error +
                             "misses are not rare enough for this method: counting with `run` "
                             "needs fewer records";
}

std::string answer_text(const Prepared& prepared, const MissAnswer& answer) {
    const MissQuestion& q = prepared.question;
    std::string text =
        wrapped_text(asked_misses(prepared.size, q.feature, q.noise_level, q.threshold) +
                         rate_text(prepared, answer),
                     2) +
        "\n";
    if (answer.misses) {
        text += wrapped_text(counting_text(answer), 2) + "\n";
    }
    if (answer.failed > 0) {
        text += fmt::format("{} of the gearboxes failed and are not counted\n", answer.failed);
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
                        {"size_unit", prepared.size.unit},
                        {"gearboxes", answer.gearboxes},
                        {"failed", answer.failed},
                        {"records", q.records},
                        {"confidence", prepared.confidence},
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
    if (!prepare_together(ranks, options.results, options.json,
                          [&] { prepared = prepare(options); })) {
        return kBadInput;
    }
    Progress progress(options.gearboxes * options.records, options.quiet || !ranks.leads());
    return answer_together(ranks, progress, options.json, [&] {
        const MissAnswer answer = missed_faults(*prepared->made.scene, prepared->question, ranks,
                                                progress, &interruption);
        return Answered{answer_text(*prepared, answer), answer_json(options, *prepared, answer),
                        answer.failed};
    });
}

}  // namespace gearpod::mc
