#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>

#include "analysis/detection_json.hpp"
#include "analysis/detection_text.hpp"
#include "analysis/reliability_json.hpp"
#include "analysis/reliability_text.hpp"
#include "mc/command_support.hpp"
#include "mc/ensemble.hpp"
#include "mc/reliability_of_results.hpp"
#include "mc/results_file.hpp"

namespace gearpod::mc {
namespace {

nlohmann::json json_of(const Results& results, const analysis::Reliability& reliability) {
    nlohmann::json json;
    json["detection"] = analysis::detection_json(results.detection, results.request);
    json["reliability"] = analysis::reliability_json(reliability, results.request);
    for (const auto& [name, value] : results.provenance) {
        json["provenance"][name] = value;
    }
    json["gearboxes"] = results.status.size();
    json["failed"] = std::count_if(results.status.begin(), results.status.end(),
                                   [](int status) { return status != 0; });
    for (const Timing& timing : results.timing) {
        json["timing"][timing.name] = timing.seconds;
    }
    return json;
}

}  // namespace

int report_command(const ReportOptions& options) {
    Results results;
    analysis::Reliability reliability;
    try {
        results = read_results(options.results);
        results.detection = detect_all(results);
        reliability = reliability_of(results, options.condition);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    }
    if (!options.json.empty()) {
        return write_text_to(options.json, json_of(results, reliability).dump(2) + "\n")
                   ? kDone
                   : kBadInput;
    }
    fmt::print("{}\n{}", analysis::detection_text(results.detection, results.request),
               analysis::reliability_text(reliability, results.request));
    return kDone;
}

}  // namespace gearpod::mc
