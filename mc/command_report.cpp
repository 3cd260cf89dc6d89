#include <fmt/core.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/detection_json.hpp"
#include "analysis/detection_text.hpp"
#include "analysis/reliability_json.hpp"
#include "mc/command_support.hpp"
#include "mc/ranks.hpp"
#include "mc/reliability_of_results.hpp"
#include "mc/results_rows.hpp"
#include "mc/run_report.hpp"

namespace gearpod::mc {
namespace {

nlohmann::json json_of(const Results& results, const RowCounts& rows,
                       const std::optional<analysis::Reliability>& reliability) {
    nlohmann::json json;
    json["detection"] = analysis::detection_json(results.detection, results.request);
    json["reliability"] = reliability ? analysis::reliability_json(*reliability, results.request)
                                      : nlohmann::json(nullptr);
    for (const auto& [name, value] : results.provenance) {
        json["provenance"][name] = value;
    }
    json["gearboxes"] = rows.all;
    json["failed"] = rows.failed();
    for (const Timing& timing : results.timing) {
        json["timing"][timing.name] = timing.seconds;
    }
    return json;
}

}  // namespace

int report_command(const ReportOptions& options) {
    Results results;
    RowCounts counts;
    std::optional<analysis::Reliability> reliability;
    try {
        results = read_frame(options.results);
        const FileRows rows(options.results, results);
        results.detection = detect_all(results, rows);
        reliability = reliability_of(results, rows, options.condition, processors());
        counts = count_rows(rows);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    }
    if (!options.json.empty()) {
        return write_text_to(options.json, json_of(results, counts, reliability).dump(2) + "\n")
                   ? kDone
                   : kBadInput;
    }
    const std::string state = results.provenance_value("state");
    if (state == "running" || state.starts_with("interrupted")) {
        fmt::print(stderr, "{}: holds {} of {} gearboxes ({})\n", options.results, counts.all,
                   results.provenance_value("gearboxes_asked_for"), state);
    }
    fmt::print("{}\n{}", analysis::detection_text(results.detection, results.request),
               reliability_text(reliability, results));
    return kDone;
}

}  // namespace gearpod::mc
