#include "mc/library/own_values.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/report/detection_json.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

void check_values(const std::string& path, const Results& results, const OwnValues& given) {
    if (results.provenance_value("kind") == kLivesKind) {
        throw BadInput(path + ": contains lives; values are evaluated for the gearboxes of `run`");
    }
    if (given.values.size() != results.status.size()) {
        throw BadInput(fmt::format("{}: has {} rows, but {} has {} values; give one per row", path,
                                   results.status.size(), given.name, given.values.size()));
    }
    if (results.parameter_index(kNoiseWeight)) {
        throw BadInput(path +
                       ": its threshold records are importance-sampled (ensemble.threshold_tilt), "
                       "so values without weights cannot be evaluated; run the study without it");
    }
}

}  // namespace

nlohmann::json grade_values(const std::string& path, const OwnValues& given) {
    Results results = read_results(path);
    check_values(path, results, given);
    results.features = {{given.name, given.unit, given.alarm, given.values}};
    results.noise_levels = results.request.noise_levels = {given.noise_level};
    results.numerical.reset();
    const ColumnRows rows(results);
    results.detection = detect_all(results, rows);
    const auto reliability = reliability_of(results, rows, "", thread_count());
    const nlohmann::json detection =
        analysis::detection_json(results.detection, results.request, subject_of(results));
    nlohmann::json result;
    result["detection"] = {{"false_alarm_rate", detection["false_alarm_rate"]},
                           {"confidence", detection["confidence"]},
                           {"size", detection["size"]},
                           {"level", detection["features"][0]["levels"][0]}};
    result["reliability"] = nullptr;
    if (reliability) {
        const nlohmann::json all = analysis::reliability_json(*reliability, results.request);
        result["reliability"] = all["features"][0]["levels"][0];
    }
    return result;
}

}  // namespace gearpod::mc
