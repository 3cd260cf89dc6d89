// Command `pod TABLE`: probability of detection (POD) from a table of inspections.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report/inspection_text.hpp"
#include "mc/commands/commands.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text_table.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/report/page.hpp"
#include "mc/run/support.hpp"

namespace gearpod::mc {
namespace {

using analysis::InspectionNames;
using analysis::InspectionRequest;
using analysis::Inspections;

constexpr const char* kUsualSizes[] = {"size", "a", "Size"};
constexpr const char* kUsualHits[] = {"hit", "hit.miss", "hit_miss", "hitmiss", "Hit"};
constexpr const char* kUsualValues[] = {"response", "ahat", "a-hat", "a_hat", "a.hat", "value"};

// Finds the named columns, or else the first column with a usual name. Reports named columns that
// do not exist.
std::vector<std::size_t> columns(const TextTable& table, const std::vector<std::string>& named,
                                 std::span<const char* const> usual, Problems& problems) {
    std::vector<std::size_t> found;
    for (const std::string& name : named) {
        if (const auto at = table.find(name)) {
            found.push_back(*at);
        } else {
            problems.push_back(
                {.what = fmt::format("no column {}; its columns are {}", name, table.names())});
        }
    }
    for (const char* name : usual) {
        if (const auto at = table.find(name); at && named.empty() && found.empty()) {
            found.push_back(*at);
        }
    }
    return found;
}

struct Columns {
    std::size_t size = 0;
    std::vector<std::size_t> values;
    std::optional<std::size_t> specimen;
    bool responses = false;
};

Columns choose_columns(const TextTable& table, const PodOptions& options, Problems& problems) {
    Columns chosen;
    std::vector<std::string> size;
    if (!options.size.empty()) {
        size.push_back(options.size);
    }
    const auto sizes = columns(table, size, kUsualSizes, problems);
    if (!sizes.empty()) {
        chosen.size = sizes.front();
    } else if (size.empty()) {
        problems.push_back(
            {.what = fmt::format("no column size; its columns are {}; choose with --size",
                                 table.names())});
    }
    if (!options.hits.empty() && !options.values.empty()) {
        problems.push_back({.what = "--hit and --response exclude each other"});
    }
    chosen.responses = !options.values.empty();
    chosen.values = columns(table, chosen.responses ? options.values : options.hits,
                            chosen.responses ? std::span<const char* const>()
                                             : std::span<const char* const>(kUsualHits),
                            problems);
    if (chosen.values.empty() && options.hits.empty() && !chosen.responses) {
        chosen.values = columns(table, {}, kUsualValues, problems);
        chosen.responses = true;
        if (chosen.values.empty()) {
            problems.push_back(
                {.what =
                     fmt::format("no column hit or response; its columns are {}; choose with --hit "
                                 "or --response",
                                 table.names())});
        }
    }
    if (!options.specimen.empty()) {
        const auto found = columns(table, {options.specimen}, {}, problems);
        if (!found.empty()) {
            chosen.specimen = found.front();
        }
    }
    return chosen;
}

bool is_missing(const std::string& field) {
    return field.empty() || field == "NA" || field == "-";
}

Inspections read_inspections(const TextTable& table, const Columns& chosen, Problems& problems) {
    Inspections data;
    const bool comma = table.separator != ',';
    std::map<std::string, long> specimens;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const auto& row = table.rows[r];
        const int line = static_cast<int>(table.lines[r]);
        const auto number = [&](std::size_t c) {
            const auto value = number_of(row[c], comma);
            if (!value || !std::isfinite(*value)) {
                problems.push_back(
                    {.line = line,
                     .what = fmt::format("column {}: \"{}\" is not a finite number",
                                         table.columns[c].name, row[c].substr(0, 40))});
            }
            return value.value_or(0.0);
        };
        const double size = number(chosen.size);
        if (size < 0.0) {
            problems.push_back(
                {.line = line,
                 .what = fmt::format("column {}: {:g} is negative; use 0 for no flaw",
                                     table.columns[chosen.size].name, size)});
        }
        const long specimen =
            chosen.specimen
                ? specimens.try_emplace(row[*chosen.specimen], static_cast<long>(specimens.size()))
                      .first->second
                : static_cast<long>(r);
        for (const std::size_t c : chosen.values) {
            if (is_missing(row[c])) {
                continue;
            }
            const double value = number(c);
            if (!chosen.responses && value != 0.0 && value != 1.0) {
                problems.push_back(
                    {.line = line,
                     .what = fmt::format("column {}: {:g} is neither 1 (hit) nor 0 (miss)",
                                         table.columns[c].name, value)});
            }
            data.size.push_back(size);
            data.value.push_back(value);
            data.specimen.push_back(specimen);
        }
    }
    if (data.size.empty() && problems.empty()) {
        problems.push_back({.what = "no line has a value"});
    }
    return data;
}

std::vector<bool> log_sizes(const std::string& scale) {
    return scale == "linear" ? std::vector<bool>{false}
           : scale == "log"  ? std::vector<bool>{true}
                             : std::vector<bool>{false, true};
}

std::vector<double> powers(const std::string& scale, Problems& problems) {
    if (scale.empty()) {
        return {1.0, 0.0};
    }
    if (scale == "linear" || scale == "log" || scale == "box-cox") {
        return {scale == "linear" ? 1.0
                : scale == "log"  ? 0.0
                                  : std::numeric_limits<double>::quiet_NaN()};
    }
    const auto power = number_of(scale, false);
    if (!power || !(std::abs(*power) <= 10.0)) {
        problems.push_back(
            {.what = fmt::format("--response-scale {}: must be linear, log, box-cox or a power "
                                 "between -10 and 10",
                                 scale)});
    }
    return {power.value_or(1.0)};
}

InspectionRequest request_of(const PodOptions& options, const Columns& chosen, Problems& problems) {
    using analysis::BoundConvention;
    InspectionRequest request;
    request.responses = chosen.responses;
    request.confidence = options.confidence;
    request.convention = options.convention == "one-sided"   ? BoundConvention::one_sided
                         : options.convention == "two-sided" ? BoundConvention::two_sided
                         : options.convention == "joint"     ? BoundConvention::joint
                                                             : BoundConvention::handbook;
    if (!options.bounds.empty()) {
        request.method = options.bounds == "wald" ? analysis::BoundMethod::wald
                                                  : analysis::BoundMethod::likelihood_ratio;
    }
    request.log_sizes = log_sizes(options.size_scale);
    request.target = options.target;
    if (!options.links.empty()) {
        request.links.clear();
        for (const analysis::Link link : analysis::kLinks) {
            if (std::find(options.links.begin(), options.links.end(), link_name(link)) !=
                options.links.end()) {
                request.links.push_back(link);
            }
        }
    }
    request.floor = options.floor;
    request.fit_ceiling = options.fit_ceiling;
    request.firth = options.firth;
    request.alarm = options.alarm == "low" ? analysis::Alarm::low : analysis::Alarm::high;
    request.threshold = options.threshold;
    request.false_call_rate = options.false_call_rate;
    request.limits = {options.left.value_or(request.limits.left),
                      options.right.value_or(request.limits.right)};
    if (!(request.limits.left < request.limits.right)) {
        problems.push_back({.what = "--left must be less than --right"});
    }
    request.powers = powers(options.response_scale, problems);
    request.accept_failed_checks = !options.size_scale.empty() && !options.response_scale.empty();
    return request;
}

// Reports options that have no effect on this kind of data.
void refuse_misplaced(const PodOptions& options, const Columns& chosen, Problems& problems) {
    const auto refuse = [&](bool given, const char* name) {
        if (given) {
            problems.push_back(
                {.what = fmt::format("{} is only for {}, but the table has {}", name,
                                     chosen.responses ? "hits and misses" : "responses",
                                     chosen.responses ? "responses" : "hits and misses")});
        }
    };
    if (chosen.responses) {
        refuse(!options.links.empty(), "--link");
        refuse(options.floor.has_value(), "--floor");
        refuse(options.fit_ceiling, "--fit-ceiling");
        refuse(options.firth, "--firth");
        if (options.threshold && options.false_call_rate) {
            problems.push_back({.what = "--threshold and --false-call-rate exclude each other"});
        }
    } else {
        refuse(options.threshold.has_value(), "--threshold");
        refuse(options.false_call_rate.has_value(), "--false-call-rate");
        refuse(options.left.has_value(), "--left");
        refuse(options.right.has_value(), "--right");
        refuse(!options.response_scale.empty(), "--response-scale");
        refuse(options.alarm != "high", "--alarm");
        if (options.fit_ceiling && options.bounds == "wald") {
            problems.push_back({.what = "--fit-ceiling needs --bounds likelihood-ratio"});
        }
        if (options.fit_ceiling && options.firth) {
            problems.push_back({.what = "--firth and --fit-ceiling exclude each other"});
        }
    }
}

InspectionNames words_of(const TextTable& table, const Columns& chosen) {
    InspectionNames words;
    words.table = printable(table.path);
    const TableColumn& size = table.columns[chosen.size];
    words.size = {printable(size.name), size.unit.empty() ? "1" : printable(size.unit)};
    // The report scales "m" to mm; "metres" keeps the table's own unit, like every other unit.
    if (words.size.unit == "m") {
        words.size.unit = "metres";
    }
    words.value = printable(table.columns[chosen.values.front()].name);
    words.unit = printable(table.columns[chosen.values.front()].unit);
    return words;
}

}  // namespace

int pod_command(const PodOptions& options) {
    const FileRole read{"the table", options.table}, json{"--json", options.json};
    const bool json_good = can_write(json, {read});
    if (!can_write({"--html", options.html}, {read, json}) || !json_good) {
        return kBadInput;
    }
    try {
        const TextTable table = read_text_table(options.table);
        Problems problems;
        const Columns chosen = choose_columns(table, options, problems);
        const InspectionRequest request = request_of(options, chosen, problems);
        refuse_misplaced(options, chosen, problems);
        Inspections data;
        if (problems.empty()) {
            data = read_inspections(table, chosen, problems);
        }
        if (!problems.empty()) {
            constexpr std::size_t kShown = 20;
            for (Problem& problem : problems) {
                problem.file = options.table;
            }
            fmt::print(stderr, "{}", format(problems, kShown));
            return kBadInput;
        }
        const analysis::InspectionResult result = analysis::inspect(data, request);
        if (!result.refusal.empty()) {
            fmt::print(stderr, "{}: {}\n", options.table, result.refusal);
            return kBadInput;
        }
        const InspectionNames words = words_of(table, chosen);
        const nlohmann::json all = inspection_json(data, request, result, words);
        if (!options.html.empty() && !write_text_to(options.html, report_page(json_text(all)))) {
            return kBadInput;
        }
        if (!options.json.empty()) {
            return write_text_to(options.json, json_text(all, 2) + "\n") ? kDone : kBadInput;
        }
        fmt::print("{}", inspection_text(request, result, words));
        if (!options.html.empty()) {
            fmt::print("\npage: {}\n", options.html);
        }
    } catch (const SignalError& error) {
        fmt::print(stderr, "{}\n", printable(error.what()));
        return kBadInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
    return kDone;
}

}  // namespace gearpod::mc
