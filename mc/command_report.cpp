#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>

#include "analysis/detection_json.hpp"
#include "analysis/detection_text.hpp"
#include "mc/command_support.hpp"
#include "mc/ensemble.hpp"
#include "mc/results_file.hpp"

namespace gearpod::mc {
namespace {

nlohmann::json json_of(const Results& results) {
    nlohmann::json json;
    json["detection"] = analysis::detection_json(results.detection, results.request);
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
    try {
        results = read_results(options.results);
        results.detection = detect_all(results);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    }
    if (!options.json.empty()) {
        return write_text_to(options.json, json_of(results).dump(2) + "\n") ? kDone : kBadInput;
    }
    fmt::print("{}", analysis::detection_text(results.detection, results.request));
    return kDone;
}

}  // namespace gearpod::mc
