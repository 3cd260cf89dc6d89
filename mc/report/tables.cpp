#include "mc/report/tables.hpp"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "mc/files/atomic_file.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/text_table.hpp"

namespace gearpod::mc {
namespace {

using TableJson = nlohmann::json;

std::string field(const TableJson& value) {
    return value.is_null()     ? ""
           : value.is_string() ? csv_field(value.get_ref<const std::string&>())
                               : json_text(value);
}

class Tables {
  public:
    // Starts a table. Fields of the following rows have the order of the columns.
    void begin(const char* name, std::vector<std::string> columns) {
        tables_.push_back({name, std::move(columns), {}});
    }
    void row(std::initializer_list<TableJson> fields) {
        std::string line;
        for (const TableJson& value : fields) {
            line += (&value == fields.begin() ? "" : ",") + field(value);
        }
        tables_.back().rows.push_back(std::move(line));
    }
    std::vector<CsvTable> with_rows() && {
        std::erase_if(tables_, [](const CsvTable& table) { return table.rows.empty(); });
        return std::move(tables_);
    }

  private:
    std::vector<CsvTable> tables_;
};

// Name of a size column with its unit as in the results file, "fault_depth_m". A size that is not a
// length has no unit.
std::string size_column(const TableJson& report, const std::string& what) {
    const TableJson& size = report["detection"]["size"];
    return what + (size["unit"] == "1" ? "" : "_" + size["unit"].get<std::string>());
}

TableJson estimate(const TableJson& bounds, const char* which, const char* part) {
    return bounds.is_null() ? TableJson(nullptr) : bounds[which][part];
}

void add_detection(Tables& tables, const TableJson& report) {
    tables.begin("detection", {"feature", "alarm", "noise_level", "threshold", "threshold_sample",
                               "threshold_alarms", "healthy_rate", size_column(report, "size_low"),
                               size_column(report, "size_high"), "tested", "detected", "failed",
                               "pd", "lower", "upper", "exact_lower", "exact_upper"});
    for (const TableJson& feature : report["detection"]["features"]) {
        for (const TableJson& level : feature["levels"]) {
            for (const TableJson& cell : level["sizes"]) {
                tables.row({feature["name"], feature["alarm"], level["noise_level"],
                            level["threshold"], level["threshold_sample"],
                            level["threshold_alarms"], level["healthy_rate"], cell["size_low"],
                            cell["size_high"], cell["tested"], cell["detected"], cell["failed"],
                            cell["pd"], cell["lower"], cell["upper"], cell["exact"][0],
                            cell["exact"][1]});
            }
        }
    }
}

// Calls `use` with every feature and noise level of the reliability part.
template <typename Use>
void each_level(const TableJson& report, Use use) {
    for (const TableJson& feature : report["reliability"]["features"]) {
        for (const TableJson& level : feature["levels"]) {
            use(feature, level);
        }
    }
}

void add_curves(Tables& tables, const TableJson& report) {
    const auto size = [&](const char* what) { return size_column(report, what); };
    tables.begin("pod", {"feature",         "noise_level",
                         "tests",           "hits",
                         size("a50"),       "a50_where",
                         size("a90"),       "a90_where",
                         size("a90_upper"), "a90_upper_where",
                         "model",           "intercept",
                         "slope",           "floor",
                         "ceiling",         "fit_p_value",
                         "doubtful",        "auc",
                         "auc_lower",       "auc_upper",
                         "no_curve"});
    each_level(report, [&](const TableJson& feature, const TableJson& level) {
        const TableJson &pod = level["hit_miss"], &auc = level["auc"];
        const bool curve = pod["refusal"].is_null();
        const auto of = [&](const char* key) { return curve ? pod[key] : TableJson(nullptr); };
        tables.row({feature["name"],
                    level["noise_level"],
                    pod["tests"],
                    pod["hits"],
                    estimate(pod["a50"], "estimate", "size"),
                    estimate(pod["a50"], "estimate", "where"),
                    estimate(pod["a90"], "estimate", "size"),
                    estimate(pod["a90"], "estimate", "where"),
                    estimate(pod["a90"], "upper", "size"),
                    estimate(pod["a90"], "upper", "where"),
                    of("model"),
                    of("intercept"),
                    of("slope"),
                    of("floor"),
                    of("ceiling"),
                    curve ? pod["fit"]["p_value"] : TableJson(nullptr),
                    pod["doubtful"],
                    auc["auc"],
                    auc["lower"],
                    auc["upper"],
                    pod["refusal"]});
    });
    tables.begin("pod_band", {"feature", "noise_level", size("size"), "pod", "lower", "upper"});
    each_level(report, [&](const TableJson& feature, const TableJson& level) {
        const TableJson& band = level["hit_miss"]["band"];
        for (std::size_t i = 0; i < band["size"].size(); ++i) {
            tables.row({feature["name"], level["noise_level"], band["size"][i], band["pod"][i],
                        band["lower"][i], band["upper"][i]});
        }
    });
    tables.begin("roc", {"feature", "noise_level", "false_alarm_rate", "detection_rate"});
    each_level(report, [&](const TableJson& feature, const TableJson& level) {
        const TableJson& roc = level["roc"];
        for (std::size_t i = 0; i < roc["detection_rate"].size(); ++i) {
            tables.row({feature["name"], level["noise_level"], roc["false_alarm_rate"][i],
                        roc["detection_rate"][i]});
        }
    });
    tables.begin("misses", {"feature", "noise_level", "misses", "hits", "input", "unit",
                            "larger_in_misses", "lower", "upper", "p_value"});
    each_level(report, [&](const TableJson& feature, const TableJson& level) {
        const TableJson& misses = level["misses"];
        for (const TableJson& input : misses["inputs"]) {
            tables.row({feature["name"], level["noise_level"], misses["misses"], misses["hits"],
                        input["name"], input["unit"], input["larger_in_misses"], input["lower"],
                        input["upper"], input["p_value"]});
        }
    });
}

void add_levels(Tables& tables, const TableJson& report) {
    const TableJson& levels = report["reliability"]["levels"];
    tables.begin("smallest_fault", {"noise_level", "feature", size_column(report, "size"),
                                    "from_curve", "source_feature", "source_noise_level"});
    for (const TableJson& level : levels) {
        const TableJson& found = level["smallest_fault"];
        if (found.is_object()) {
            const TableJson& source = found["source"];
            const auto of = [&](const char* key) {
                return source.is_null() ? TableJson(nullptr) : source[key];
            };
            tables.row({level["noise_level"], found["feature"], found["size"], found["from_curve"],
                        of("feature"), of("noise_level")});
        } else {
            tables.row({level["noise_level"], nullptr, nullptr, nullptr, nullptr, nullptr});
        }
    }
    tables.begin("ranking",
                 {"noise_level", "rank", "feature", "auc", "lower", "upper", "p_value_from_first"});
    for (const TableJson& level : levels) {
        int rank = 0;
        for (const TableJson& at : level["ranking"]["ranks"]) {
            tables.row({level["noise_level"], ++rank, at["name"], at["auc"], at["lower"],
                        at["upper"], at["p_values"][0]});
        }
    }
    tables.begin("sensitivity",
                 {"noise_level", "feature", "of", "input", "unit", "first", "first_lower",
                  "first_upper", "total", "total_lower", "total_upper"});
    for (const TableJson& level : levels) {
        for (const char* of : {"misses", "values"}) {
            const TableJson& given = level["sensitivity"];
            for (const TableJson& input :
                 given.is_null() ? TableJson::array() : given[of]["inputs"]) {
                tables.row({level["noise_level"], given["feature"], of, input["name"],
                            input["unit"], input["first"], input["first_lower"],
                            input["first_upper"], input["total"], input["total_lower"],
                            input["total_upper"]});
            }
        }
    }
    tables.begin("combined", {"noise_level", "single", "single_auc", "combined_auc", "gain",
                              "p_value", "refusal"});
    for (const TableJson& level : levels) {
        const TableJson& both = level["combined"];
        const bool graded = both["refusal"].is_null();
        tables.row({level["noise_level"], graded ? both["single"]["name"] : TableJson(nullptr),
                    graded ? both["single"]["auc"]["auc"] : TableJson(nullptr),
                    graded ? both["detector"]["auc"]["auc"] : TableJson(nullptr), both["gain"],
                    both["p_value"], both["refusal"]});
    }
}

void add_inputs(Tables& tables, const TableJson& report) {
    const TableJson& reliability = report["reliability"];
    tables.begin("inputs", {"input", "unit", "feature", "noise_level", "low", "high", "tested",
                            "detected", "pd", "lower", "upper", "p_value"});
    for (const auto& [name, input] : reliability["robustness"].items()) {
        for (const TableJson& feature :
             name == "noise_level" ? TableJson::array() : input["features"]) {
            for (const TableJson& level : feature["levels"]) {
                for (const TableJson& bin : level["bins"]) {
                    tables.row({name, input["unit"], feature["name"], level["noise_level"],
                                bin["low"], bin["high"], bin["tested"], bin["detected"], bin["pd"],
                                bin["lower"], bin["upper"], level["p_value"]});
                }
            }
        }
    }
    tables.begin("a90_by_input",
                 {"input", "unit", "feature", "noise_level", "value", size_column(report, "a90"),
                  size_column(report, "a90_lower"), size_column(report, "a90_upper")});
    for (const auto& [name, input] : reliability["a90_maps"].items()) {
        for (const TableJson& feature : input["features"]) {
            for (std::size_t n = 0; n < feature["levels"].size(); ++n) {
                const TableJson& level = feature["levels"][n];
                for (std::size_t i = 0; i < level["a90"].size(); ++i) {
                    const TableJson& a90 = level["a90"][i];
                    tables.row({name, input["unit"], feature["name"], input["noise_levels"][n],
                                level["values"][i], estimate(a90, "estimate", "size"),
                                estimate(a90, "lower", "size"), estimate(a90, "upper", "size")});
                }
            }
        }
    }
    tables.begin("conditions", {"input", "unit", "feature", "noise_level",
                                size_column(report, "size_low"), size_column(report, "size_high"),
                                "tested", "detected", "failed", "pd", "lower", "upper"});
    for (const TableJson& detection : reliability["conditions"]) {
        for (const TableJson& level : detection["levels"]) {
            for (const TableJson& cell : level["sizes"]) {
                tables.row({detection["input"], detection["unit"], detection["feature"],
                            level["noise_level"], cell["size_low"], cell["size_high"],
                            cell["tested"], cell["detected"], cell["failed"], cell["pd"],
                            cell["lower"], cell["upper"]});
            }
        }
    }
}

void add_facts(Tables& tables, const TableJson& report) {
    tables.begin("numerical", {"feature", "noise_level", "rms", "healthy_spread", "pd",
                               "pd_half_width", size_column(report, "a90"), "larger"});
    for (const TableJson& share :
         report["numerical"].is_null() ? TableJson::array() : report["numerical"]["shares"]) {
        tables.row({share["feature"], share["noise_level"], share["rms"], share["healthy_spread"],
                    share["pd"], share["pd_half_width"], share["a90"], share["larger"]});
    }
    tables.begin("over_time",
                 {"first", "last", "recordings", "feature", "values", "alarms", "median"});
    for (const TableJson& group : report["over_time"]) {
        for (const auto& [feature, alarms] : group["alarms"].items()) {
            tables.row({group["first"], group["last"], group["recordings"], feature,
                        group["values"][feature], alarms,
                        group["medians"].value(feature, TableJson(nullptr))});
        }
    }
    const TableJson& failures = report["failures"];
    tables.begin("failures", {"what", "gearboxes"});
    for (const char* what : {"gearboxes", "diverged", "not_settled"}) {
        tables.row({what, failures[what]});
    }
    tables.begin("provenance", {"name", "value"});
    for (const auto& [name, value] : report["provenance"].items()) {
        tables.row({name, value});
    }
}

}  // namespace

std::vector<CsvTable> report_tables(const nlohmann::json& report) {
    Tables tables;
    add_detection(tables, report);
    if (!report["reliability"].is_null()) {
        add_curves(tables, report);
        add_levels(tables, report);
        add_inputs(tables, report);
    }
    add_facts(tables, report);
    return std::move(tables).with_rows();
}

std::string table_path(const std::string& folder, const CsvTable& table) {
    return (std::filesystem::path(folder) / (table.name + ".csv")).string();
}

std::vector<std::string> write_tables(const std::string& folder,
                                      const std::vector<CsvTable>& tables) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        throw std::runtime_error(folder + ": " + failed.message());
    }
    std::vector<std::string> names;
    for (const CsvTable& table : tables) {
        std::string text;
        for (const std::string& column : table.columns) {
            text += (text.empty() ? "" : ",") + column;
        }
        text += '\n';
        for (const std::string& row : table.rows) {
            text += row + '\n';
        }
        names.push_back(table_path(folder, table));
        write_file(names.back(), std::as_bytes(std::span(text)));
    }
    return names;
}

}  // namespace gearpod::mc
