// Command `pod TABLE`: probability of detection (POD) from a table of inspections.
#include <fmt/core.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "analysis/report/inspection_report.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/bad_input.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/library/inspection_table.hpp"
#include "mc/report/evidence.hpp"
#include "mc/report/page.hpp"
#include "mc/run/support.hpp"

namespace gearpod::mc {

int pod_command(const PodOptions& options) {
    const FileRole read{"the table", options.table}, json{"--json", options.json};
    const bool json_good = can_write(json, {read}, {json_output(), options.force});
    if (!can_write({"--html", options.html}, {read, json}, {page_output(), options.force}) ||
        !json_good) {
        return kBadInput;
    }
    try {
        const InspectedTable inspected = inspect_table(read_text_table(options.table), options);
        nlohmann::json all = inspection_json(inspected);
        if (!options.evidence.empty()) {
            all["evidence"] = evidence_json(
                analysis::EvidenceKind::inspections,
                inspection_report(inspected.request, inspected.result, inspected.names), {},
                options.table, nullptr);
            const auto evidence = evidence_files(all);
            if (!can_write_folder({"--evidence", options.evidence}, evidence,
                                  {read, json, {"--html", options.html}}, options.force)) {
                return kBadInput;
            }
            write_files(options.evidence, evidence);
        }
        if (!options.html.empty() && !write_text_to(options.html, report_page(json_text(all)))) {
            return kBadInput;
        }
        if (!options.json.empty()) {
            return write_text_to(options.json, json_text(all, 2) + "\n") ? kDone : kBadInput;
        }
        fmt::print("{}", inspection_text(inspected));
        if (!options.html.empty()) {
            fmt::print("\npage: {}\n", options.html);
        }
        if (!options.evidence.empty()) {
            fmt::print("\nevidence: {}\n", options.evidence);
        }
    } catch (const SignalError& error) {
        fmt::print(stderr, "{}\n", printable(error.what()));
        return kBadInput;
    } catch (const BadInput& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
    return kDone;
}

}  // namespace gearpod::mc
