#include "mc/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "mc/files/atomic_file.hpp"
#include "mc/files/input/document.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {
namespace {

using TableJson = nlohmann::json;

// A table over nested lists of the JSON. Each path leads from an element of the list before (first:
// from the report) to the next list: an array, or an object whose entries are meant. "/a#b,c" takes
// the entries b and c of the object a only.
//
// A column is "name=N/path": the value at the path from the element of list N (0: the report, 1:
// the first list); {N} in the path stands for the place or key of that element. "name=N" is that
// place or key itself, counted from 1. An @ stands for the unit of the sizes.
struct TableSource {
    const char* name;
    std::vector<const char*> lists;
    const char* columns;
};

const std::vector<TableSource>& table_sources() {
    static const std::vector<TableSource> all{
        {"features",
         {"/features"},
         "feature=1/name title=1/title unit=1/unit alarm=1/alarm definition=1/doc"},
        {"detection",
         {"/detection/features", "/levels", "/sizes"},
         "feature=1/name alarm=1/alarm noise_level=2/noise_level threshold=2/threshold "
         "threshold_sample=2/threshold_sample threshold_alarms=2/threshold_alarms "
         "healthy_rate=2/healthy_rate size_low@=3/size_low size_high@=3/size_high tested=3/tested "
         "detected=3/detected failed=3/failed pd=3/pd lower=3/lower upper=3/upper "
         "exact_lower=3/exact/0 exact_upper=3/exact/1"},
        {"pod",
         {"/reliability/features", "/levels"},
         "feature=1/name noise_level=2/noise_level tests=2/hit_miss/tests hits=2/hit_miss/hits "
         "a50@=2/hit_miss/a50/estimate/size a50_where=2/hit_miss/a50/estimate/where "
         "a90@=2/hit_miss/a90/estimate/size a90_where=2/hit_miss/a90/estimate/where "
         "a90_upper@=2/hit_miss/a90/upper/size a90_upper_where=2/hit_miss/a90/upper/where "
         "model=2/hit_miss/model intercept=2/hit_miss/intercept slope=2/hit_miss/slope "
         "floor=2/hit_miss/floor ceiling=2/hit_miss/ceiling fit_p_value=2/hit_miss/fit/p_value "
         "doubtful=2/hit_miss/doubtful auc=2/auc/auc auc_lower=2/auc/lower auc_upper=2/auc/upper "
         "no_curve=2/hit_miss/refusal"},
        {"pod_band",
         {"/reliability/features", "/levels", "/hit_miss/band/size"},
         "feature=1/name noise_level=2/noise_level size@=3/ pod=2/hit_miss/band/pod/{3} "
         "lower=2/hit_miss/band/lower/{3} upper=2/hit_miss/band/upper/{3}"},
        {"roc",
         {"/reliability/features", "/levels", "/roc/detection_rate"},
         "feature=1/name noise_level=2/noise_level false_alarm_rate=2/roc/false_alarm_rate/{3} "
         "detection_rate=3/"},
        {"misses",
         {"/reliability/features", "/levels", "/misses/inputs"},
         "feature=1/name noise_level=2/noise_level misses=2/misses/misses hits=2/misses/hits "
         "input=3/name unit=3/unit larger_in_misses=3/larger_in_misses lower=3/lower upper=3/upper "
         "p_value=3/p_value"},
        {"smallest_fault",
         {"/smallest_fault"},
         "noise_level=0/noise/levels/{1} feature=1/feature size@=1/size from_curve=1/from_curve "
         "source_feature=1/source/feature source_noise_level=1/source/noise_level"},
        {"ranking",
         {"/reliability/levels", "/ranking/ranks"},
         "noise_level=1/noise_level rank=2 feature=2/name auc=2/auc lower=2/lower upper=2/upper "
         "p_value_from_first=2/p_values/0"},
        {"inputs",
         {"/reliability/robustness", "/features", "/levels", "/bins"},
         "input=1 unit=1/unit feature=2/name noise_level=3/noise_level low=4/low high=4/high "
         "tested=4/tested detected=4/detected pd=4/pd lower=4/lower upper=4/upper "
         "p_value=3/p_value"},
        {"a90_by_input",
         {"/reliability/a90_maps", "/features", "/levels", "/a90"},
         "input=1 unit=1/unit feature=2/name noise_level=1/noise_levels/{3} value=3/values/{4} "
         "a90@=4/estimate/size a90_lower@=4/lower/size a90_upper@=4/upper/size"},
        {"conditions",
         {"/reliability/conditions", "/levels", "/sizes"},
         "input=1/input unit=1/unit feature=1/feature noise_level=2/noise_level "
         "size_low@=3/size_low size_high@=3/size_high tested=3/tested detected=3/detected "
         "failed=3/failed pd=3/pd lower=3/lower upper=3/upper"},
        {"numerical",
         {"/numerical/shares"},
         "feature=1/feature noise_level=1/noise_level rms=1/rms healthy_spread=1/healthy_spread "
         "pd=1/pd pd_half_width=1/pd_half_width a90@=1/a90 larger=1/larger"},
        {"over_time",
         {"/over_time", "/alarms"},
         "first=1/first last=1/last recordings=1/recordings feature=2 values=1/values/{2} "
         "alarms=2/ "
         "median=1/medians/{2}"},
        {"monitoring",
         {"/monitoring/watched", "/gearboxes"},
         "feature=1/feature detector=1/detector threshold=1/threshold "
         "healthy_recordings=1/healthy/recordings healthy_alarms=1/healthy/alarms "
         "healthy_sustained=1/healthy/sustained rate=1/healthy/rate rate_lower=1/healthy/lower "
         "rate_upper=1/healthy/upper held_out_recordings=1/held_out/recordings "
         "held_out_alarms=1/held_out/alarms held_out_lower=1/held_out/lower "
         "held_out_upper=1/held_out/upper gearbox=2/name recordings=2/recordings alarms=2/alarms "
         "first_time=2/first/time first_recording=2/first/recording "
         "sustained_time=2/sustained/time sustained_recording=2/sustained/recording "
         "confirmed_by=2/sustained/confirmed_by recordings_left=2/sustained/recordings_left "
         "time_left=2/sustained/time_left tooth=2/tooth/number tooth_same=2/tooth/same "
         "tooth_recordings=2/tooth/recordings"},
        {"lives",
         {"/monitored"},
         "feature=1/feature detector=1/detector threshold=1/threshold "
         "threshold_hours=1/threshold_hours false_alarms=1/false_alarms/count "
         "healthy_hours=1/false_alarms/hours per_1000_h=1/false_alarms/per_1000_h "
         "per_1000_h_lower=1/false_alarms/bounds/0 per_1000_h_upper=1/false_alarms/bounds/1 "
         "ended=1/ended found=1/found share=1/share share_lower=1/share_bounds/0 "
         "share_upper=1/share_bounds/1 share_by_chance=1/share_by_chance net_share=1/net_share "
         "depth_50_m=1/depth_50_m depth_50_bound_m=1/depth_50_bound_m depth_90_m=1/depth_90_m "
         "depth_90_bound_m=1/depth_90_bound_m warning_50_h=1/warning_50_h "
         "warning_90_h=1/warning_90_h unranked=1/unranked"},
        {"trade_offs",
         {"/trade_offs", "/points"},
         "feature=1/feature detector=1/detector stated_per_1000_h=2/stated_per_1000_h "
         "per_1000_h=2/per_1000_h share=2/share depth_50_m=2/depth_50_m depth_90_m=2/depth_90_m"},
        {"inspections", {"/data/size"}, "size@=1/ value=0/data/value/{1}"},
        {"thresholds",
         {"/trade_off"},
         "threshold=1/threshold false_calls=1/false_calls a50@=1/a50/estimate/size "
         "a90@=1/a90/estimate/size a90_upper@=1/a90/upper/size"},
        {"failures", {"/failures#gearboxes,diverged,not_settled"}, "what=1 gearboxes=1/"},
        {"provenance", {"/provenance"}, "name=1 value=1/"}};
    return all;
}

// An element of a list, with its place or key.
struct Element {
    const TableJson* value;
    std::string key;
};

// Value at a path such as "/fit/p_value"; null if there is none.
const TableJson& value_at(const TableJson& from, const std::string& path) {
    static const TableJson none;
    const TableJson* at = &from;
    for (const std::string& step : split(path, '/')) {
        if (step.empty()) {
            continue;
        }
        if (at->is_object() && at->contains(step)) {
            at = &(*at)[step];
        } else if (at->is_array() && std::stoul(step) < at->size()) {
            at = &(*at)[std::stoul(step)];
        } else {
            return none;
        }
    }
    return *at;
}

std::vector<Element> elements_of(const TableJson& from, const std::string& path) {
    const std::size_t chosen = path.find('#');
    const TableJson& list = value_at(from, path.substr(0, chosen));
    std::vector<Element> elements;
    if (chosen != std::string::npos) {
        for (const std::string& key : split(path.substr(chosen + 1), ',')) {
            elements.push_back({&value_at(list, key), key});
        }
    } else {
        for (const auto& [key, value] : list.items()) {
            elements.push_back({&value, key});
        }
    }
    return elements;
}

std::string field(const TableJson& value) {
    return value.is_null()     ? ""
           : value.is_string() ? csv_field(value.get_ref<const std::string&>())
                               : json_text(value);
}

std::string field(const std::string& source, const std::vector<Element>& elements) {
    const std::size_t slash = source.find('/');
    const Element& element = elements[std::stoul(source.substr(0, slash))];
    if (slash == std::string::npos) {
        const bool place = element.key.find_first_not_of("0123456789") == std::string::npos;
        return place ? std::to_string(std::stoul(element.key) + 1) : csv_field(element.key);
    }
    std::string path = source.substr(slash);
    if (const std::size_t open = path.find('{'); open != std::string::npos) {
        path.replace(open, 3, elements[std::stoul(path.substr(open + 1, 1))].key);
    }
    return field(value_at(*element.value, path));
}

void add_rows(CsvTable& table, const TableSource& source, const std::vector<std::string>& columns,
              std::vector<Element>& elements) {
    if (elements.size() <= source.lists.size()) {
        for (const Element& next :
             elements_of(*elements.back().value, source.lists[elements.size() - 1])) {
            elements.push_back(next);
            add_rows(table, source, columns, elements);
            elements.pop_back();
        }
        return;
    }
    std::string row;
    for (const std::string& column : columns) {
        row += (row.empty() && &column == &columns.front() ? "" : ",") + field(column, elements);
    }
    table.rows.push_back(std::move(row));
}

}  // namespace

std::vector<CsvTable> report_tables(const nlohmann::json& report) {
    // Size columns have the unit as in the results file, "fault_depth_m".
    std::string unit = "1";
    for (const char* path : {"/detection/size/unit", "/size/unit"}) {
        const TableJson& found = value_at(report, path);
        unit = found.is_string() ? found.get<std::string>() : unit;
    }
    std::vector<CsvTable> tables;
    for (const TableSource& source : table_sources()) {
        CsvTable table{source.name, {}, {}};
        std::vector<std::string> columns;
        for (const std::string& column : split(source.columns, ' ')) {
            std::string name = column.substr(0, column.find('='));
            if (name.back() == '@') {
                name.replace(name.size() - 1, 1, unit == "1" ? "" : "_" + unit);
            }
            table.columns.push_back(std::move(name));
            columns.push_back(column.substr(column.find('=') + 1));
        }
        std::vector<Element> elements{{&report, ""}};
        add_rows(table, source, columns, elements);
        if (!table.rows.empty()) {
            tables.push_back(std::move(table));
        }
    }
    return tables;
}

std::vector<NamedFile> table_files(const std::vector<CsvTable>& tables) {
    std::vector<NamedFile> files;
    for (const CsvTable& table : tables) {
        std::string text;
        for (const std::string& column : table.columns) {
            text += (text.empty() ? "" : ",") + column;
        }
        text += '\n';
        for (const std::string& row : table.rows) {
            text += row + '\n';
        }
        files.push_back({table.name + ".csv", std::move(text)});
    }
    return files;
}

std::string signals_csv(const std::vector<SignalColumn>& columns) {
    std::string text;
    for (const SignalColumn& column : columns) {
        text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", column.name, column.unit);
    }
    text += "\n";
    for (std::size_t row = 0; row < columns[0].values.size(); ++row) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            fmt::format_to(std::back_inserter(text), "{}{:.17g}", c == 0 ? "" : ",",
                           columns[c].values[row]);
        }
        text += "\n";
    }
    return text;
}

std::string path_in(const std::string& folder, const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
}

std::vector<std::string> write_files(const std::string& folder,
                                     const std::vector<NamedFile>& files) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        throw std::runtime_error(folder + ": " + failed.message());
    }
    std::vector<std::string> paths;
    for (const NamedFile& file : files) {
        paths.push_back(path_in(folder, file.name));
        write_file(paths.back(), std::as_bytes(std::span(file.bytes)));
    }
    return paths;
}

}  // namespace gearpod::mc
