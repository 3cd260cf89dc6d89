#include "mc/library/inspection_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "machine/no_value.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

using analysis::InspectionNames;
using analysis::InspectionRequest;
using analysis::Inspections;

constexpr const char* kUsualSizes[] = {"size", "a"};
constexpr const char* kUsualHits[] = {"hit", "hit.miss", "hit_miss", "hitmiss", "hits"};
constexpr const char* kUsualValues[] = {"response", "ahat", "a-hat", "a_hat", "a.hat", "value"};

// `line`: of the table, or 0.
template <class... Args>
void reject(Problems& problems, int line, fmt::format_string<Args...> form, Args&&... args) {
    problems.push_back({.line = line, .what = fmt::format(form, std::forward<Args>(args)...)});
}

// Finds the named columns, or else the first column with a usual name. Reports named columns that
// do not exist.
std::vector<std::size_t> columns(const TextTable& table, const std::vector<std::string>& named,
                                 std::span<const char* const> usual, Problems& problems) {
    std::vector<std::size_t> found;
    for (const std::string& name : named) {
        if (const auto at = table.find(name)) {
            found.push_back(*at);
        } else {
            reject(problems, 0, "no column {}; its columns are {}", name, table.names());
        }
    }
    for (const char* name : usual) {
        if (const auto at = table.find(name); at && named.empty() && found.empty()) {
            found.push_back(*at);
        }
    }
    return found;
}

constexpr const char* kUsualTrials[] = {"n", "trials", "inspections"};

struct Columns {
    std::optional<std::size_t> trials;  // numbers of inspections, of which the values are hits
    std::size_t size = 0;
    std::vector<std::size_t> values;
    std::optional<std::size_t> specimen;
    bool responses = false;
};

Columns choose_columns(const TextTable& table, const InspectionOptions& options,
                       Problems& problems) {
    Columns chosen;
    const auto named = [](const std::string& name) {
        return name.empty() ? std::vector<std::string>() : std::vector{name};
    };
    const auto sizes = columns(table, named(options.size), kUsualSizes, problems);
    if (!sizes.empty()) {
        chosen.size = sizes.front();
    } else if (options.size.empty()) {
        reject(problems, 0,
               "has no column named size; name the column of the "
               "flaw sizes with --size; its columns are {}",
               table.names());
    }
    if (!options.hits.empty() && !options.values.empty()) {
        reject(problems, 0, "--hit and --response cannot be used together; give one of them");
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
            reject(problems, 0,
                   "no column hit or response; its columns are {}; choose with --hit "
                   "or --response",
                   table.names());
        }
    }
    // A table of counts has a column of trials, and its hits are above 1 or called so.
    const auto trials = columns(table, {}, kUsualTrials, problems);
    if (!trials.empty() && !chosen.responses && chosen.values.size() == 1) {
        const std::size_t hits = chosen.values.front();
        bool counts = lower_case(table.columns[hits].name) == "hits";
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            counts = counts || table.number(r, hits).value_or(0.0) > 1.0;
        }
        chosen.trials = counts ? std::optional(trials.front()) : std::nullopt;
    }
    for (const std::size_t found : columns(table, named(options.specimen), {}, problems)) {
        chosen.specimen = found;
    }
    return chosen;
}

// A hit or miss in words; empty if the text is neither.
std::optional<double> hit_of_word(const std::string& text) {
    const std::string word = lower_case(text);
    if (is_among(word, "hit true yes y t found detected")) {
        return 1.0;
    }
    return is_among(word, "miss false no n f missed undetected") ? std::optional(0.0)
                                                                 : std::nullopt;
}

Inspections read_inspections(const TextTable& table, const Columns& chosen, Problems& problems,
                             long& without_value) {
    Inspections data;
    std::map<std::string, long> specimens;
    long counted = 0;  // inspections of a table of counts
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const auto& row = table.rows[r];
        const int line = static_cast<int>(table.lines[r]);
        const auto number = [&](std::size_t c) {
            const auto value = table.number(r, c);
            if (!value || !std::isfinite(*value)) {
                reject(problems, line, "column {}: {}", table.columns[c].name,
                       table.no_number_text(r, c));
            }
            return value.value_or(0.0);
        };
        const double size = number(chosen.size);
        if (size < 0.0) {
            reject(problems, line, "column {}: {:g} is negative; use 0 for no flaw",
                   table.columns[chosen.size].name, size);
        }
        const long specimen =
            chosen.specimen
                ? specimens.try_emplace(row[*chosen.specimen], static_cast<long>(specimens.size()))
                      .first->second
                : static_cast<long>(r);
        for (const std::size_t c : chosen.values) {
            if (is_missing(row[c])) {
                ++without_value;
                continue;
            }
            const auto word = chosen.responses ? std::nullopt : hit_of_word(row[c]);
            const double value = word ? *word : number(c);
            if (chosen.trials) {
                const double trials = number(*chosen.trials);
                constexpr double kMostTrials = 1e5;
                if (value < 0.0 || value > trials || value != std::floor(value) ||
                    trials != std::floor(trials) || trials > kMostTrials) {
                    reject(problems, line, "{:g} hits in {:g} inspections are no counts", value,
                           trials);
                    continue;
                }
                for (long trial = 0; trial < static_cast<long>(trials); ++trial) {
                    data.size.push_back(size);
                    data.value.push_back(static_cast<double>(trial) < value ? 1.0 : 0.0);
                    data.specimen.push_back(chosen.specimen ? specimen : counted++);
                }
                continue;
            }
            if (!chosen.responses && value != 0.0 && value != 1.0) {
                reject(problems, line,
                       "column {}: {:g} is neither 1 (hit) nor 0 (miss); counts of hits need a "
                       "column n of "
                       "the inspections",
                       table.columns[c].name, value);
            }
            data.size.push_back(size);
            data.value.push_back(value);
            data.specimen.push_back(specimen);
        }
    }
    if (data.size.empty() && problems.empty()) {
        reject(problems, 0, "no line has a value");
    }
    return data;
}

std::vector<double> powers(const std::string& scale, Problems& problems) {
    if (scale.empty()) {
        return {1.0, 0.0};
    }
    if (scale == "linear" || scale == "log" || scale == "box-cox") {
        return {scale == "linear" ? 1.0 : scale == "log" ? 0.0 : kNan};
    }
    const auto power = number_of(scale);
    if (!power || !(std::abs(*power) <= 10.0)) {
        reject(problems, 0,
               "--response-scale {}: must be linear, log, box-cox or a power "
               "between -10 and 10",
               scale);
    }
    return {power.value_or(1.0)};
}

// Rejects values of options that have no meaning.
void check_options(const InspectionOptions& options, Problems& problems) {
    const auto choice = [&](const char* name, const std::string& given,
                            const std::vector<std::string>& known) {
        if (!given.empty() && std::ranges::count(known, given) == 0) {
            reject(problems, 0, "{}: must be {}, but is {}", name, fmt::join(known, " or "), given);
        }
    };
    const auto within = [&](const char* name, std::optional<double> given, double low,
                            double high) {
        if (given && !(*given >= low && *given <= high)) {
            reject(problems, 0, "{}: must be {:g} to {:g}, but is {:g}", name, low, high, *given);
        }
    };
    choice("--size-scale", options.size_scale, {"linear", "log"});
    choice("--convention", options.convention,
           {"calibrated", "handbook", "one-sided", "two-sided", "joint"});
    if (options.convention == "calibrated" && !options.bounds.empty()) {
        reject(problems, 0,
               "--bounds and --convention calibrated cannot be used together; "
               "calibrated bounds have a method of their own");
    }
    choice("--bounds", options.bounds, {"likelihood-ratio", "wald"});
    choice("--alarm", options.alarm, {"high", "low"});
    for (const std::string& link : options.links) {
        choice("--link", link, {"logit", "probit", "cloglog", "loglog"});
    }
    within("--confidence", options.confidence, 0.5, 0.9999);
    within("--false-call-rate", options.false_call_rate, 1e-6, 0.5);
    within("--floor", options.floor, 0.0, 0.999);
    const auto finite = [&](const char* name, std::optional<double> given) {
        if (given && !std::isfinite(*given)) {
            reject(problems, 0, "{}: {:g} is not a finite number", name, *given);
        }
    };
    finite("--threshold", options.threshold);
    finite("--left", options.left);
    finite("--right", options.right);
    finite("--target", options.target);
    if (options.target && *options.target <= 0.0) {
        reject(problems, 0, "--target: must be > 0, but is {:g}", *options.target);
    }
}

InspectionRequest request_of(const InspectionOptions& options, const Columns& chosen,
                             Problems& problems) {
    using analysis::BoundConvention;
    InspectionRequest request;
    request.responses = chosen.responses;
    request.confidence = options.confidence;
    request.convention = options.convention == "one-sided"   ? BoundConvention::one_sided
                         : options.convention == "two-sided" ? BoundConvention::two_sided
                         : options.convention == "joint"     ? BoundConvention::joint
                         : options.convention == "handbook" || !options.bounds.empty()
                             ? BoundConvention::handbook
                             : BoundConvention::calibrated;
    if (!options.bounds.empty()) {
        request.method = options.bounds == "wald" ? analysis::BoundMethod::wald
                                                  : analysis::BoundMethod::likelihood_ratio;
    }
    if (!options.size_scale.empty()) {
        request.log_sizes = {options.size_scale == "log"};
    }
    request.target = options.target;
    if (!options.links.empty()) {
        request.links.clear();
        for (const analysis::Link link : analysis::kLinks) {
            if (std::ranges::find(options.links, link_name(link)) != options.links.end()) {
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
        reject(problems, 0, "--left must be less than --right");
    }
    request.powers = powers(options.response_scale, problems);
    request.accept_failed_checks = !options.size_scale.empty() && !options.response_scale.empty();
    return request;
}

// Reports options that have no effect on this kind of data.
void refuse_misplaced(const InspectionOptions& options, const Columns& chosen, Problems& problems) {
    const auto refuse = [&](bool given, const char* name) {
        if (given) {
            reject(problems, 0, "{} is only for {}, but the table has {}", name,
                   chosen.responses ? "hits and misses" : "responses",
                   chosen.responses ? "responses" : "hits and misses");
        }
    };
    if (chosen.responses) {
        refuse(!options.links.empty(), "--link");
        refuse(options.floor.has_value(), "--floor");
        refuse(options.fit_ceiling, "--fit-ceiling");
        refuse(options.firth, "--firth");
        if (options.threshold && options.false_call_rate) {
            reject(problems, 0,
                   "--threshold and --false-call-rate cannot be used "
                   "together; give one of them");
        }
    } else {
        refuse(options.threshold.has_value(), "--threshold");
        refuse(options.false_call_rate.has_value(), "--false-call-rate");
        refuse(options.left.has_value(), "--left");
        refuse(options.right.has_value(), "--right");
        refuse(!options.response_scale.empty(), "--response-scale");
        refuse(options.alarm != "high", "--alarm");
        if (options.fit_ceiling && options.bounds == "wald") {
            reject(problems, 0, "--fit-ceiling needs --bounds likelihood-ratio");
        }
        if (options.fit_ceiling && options.firth) {
            reject(problems, 0,
                   "--firth and --fit-ceiling cannot be used together; give one of them");
        }
    }
}

// Throws BadInput with the first problems, if there are any.
void refuse(const TextTable& table, Problems& problems) {
    constexpr std::size_t kShown = 20;
    if (problems.empty()) {
        return;
    }
    for (Problem& problem : problems) {
        problem.file = table.path;
    }
    std::string text = format(problems, kShown);
    text.pop_back();
    throw BadInput(text);
}

// Statements on the table: fields without a value, and responses that may have been cut off.
std::vector<std::string> remarks_on(const Inspections& data, const InspectionRequest& request,
                                    long without_value) {
    std::vector<std::string> remarks;
    if (without_value > 0) {
        remarks.push_back(fmt::format(
            "Not used: {} field(s) without a value, taken as inspections that were not made.",
            without_value));
    }
    constexpr long kFewest = 3;
    constexpr double kFraction = 0.05;  // of the responses
    if (request.responses) {
        const double largest = *std::ranges::max_element(data.value);
        const long equal = std::ranges::count(data.value, largest);
        if (equal >= kFewest &&
            static_cast<double>(equal) >= kFraction * static_cast<double>(data.value.size()) &&
            largest < request.limits.right) {
            remarks.push_back(fmt::format(
                "Warning: {} of {} responses are equal to the largest, {:g}: give --right {:g} if "
                "the instrument ends there. Sizes below are wrong then.",
                equal, data.value.size(), largest, largest));
        }
    }
    return remarks;
}

InspectionNames names_of(const TextTable& table, const Columns& chosen) {
    InspectionNames names;
    names.table = printable(table.path);
    const TableColumn& size = table.columns[chosen.size];
    names.size = {printable(size.name), size.unit.empty() ? "1" : printable(size.unit)};
    // The report scales "m" to mm; "metres" keeps the table's own unit, like every other unit.
    if (names.size.unit == "m") {
        names.size.unit = "metres";
    }
    names.value = printable(table.columns[chosen.values.front()].name);
    names.unit = printable(table.columns[chosen.values.front()].unit);
    return names;
}

}  // namespace

InspectedTable inspect_table(const TextTable& table, const InspectionOptions& options) {
    InspectedTable inspected;
    Problems problems;
    check_options(options, problems);
    const Columns chosen = choose_columns(table, options, problems);
    inspected.request = request_of(options, chosen, problems);
    refuse_misplaced(options, chosen, problems);
    refuse(table, problems);
    long without_value = 0;
    inspected.data = read_inspections(table, chosen, problems, without_value);
    refuse(table, problems);
    inspected.result = analysis::inspect(inspected.data, inspected.request);
    if (!inspected.result.refusal.empty()) {
        throw BadInput(fmt::format("{}: {}", table.path, inspected.result.refusal));
    }
    inspected.names = names_of(table, chosen);
    inspected.names.remarks = remarks_on(inspected.data, inspected.request, without_value);
    return inspected;
}

std::string inspection_text(const InspectedTable& inspected) {
    return report_text(
        analysis::inspection_report(inspected.request, inspected.result, inspected.names));
}

nlohmann::json inspection_json(const InspectedTable& inspected) {
    return analysis::inspection_json(inspected.data, inspected.request, inspected.result,
                                     inspected.names);
}

}  // namespace gearpod::mc
