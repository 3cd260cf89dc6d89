#include "mc/recordings/calibration/healthy_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "machine/no_value.hpp"
#include "mc/files/input/find_in.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/signal_units.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {
namespace {

using features::Feature;

// True for features of a single sensor record that need no healthy reference.
bool is_plain_sensor_feature(const Feature& feature) {
    return feature.from_sensor && !feature.needs.has<features::HealthyRecords>();
}

std::vector<std::string_view> usable_names() {
    std::vector<std::string_view> names;
    for (const Feature& feature : features::record_features()) {
        if (is_plain_sensor_feature(feature)) {
            names.push_back(feature.name);
        }
    }
    return names;
}

const Feature* record_feature(std::string_view name) {
    const auto all = features::record_features();
    return find_in(all, name, &Feature::name);
}

// Index of a feature in features::record_features().
std::size_t index_of(const Feature& feature) {
    return static_cast<std::size_t>(&feature - features::record_features().data());
}

class TableReading {
  public:
    TableReading(const std::string& path, const signals::SpanLayout& span, Problems& problems)
        : table_(read_text_table(path)), span_(span), problems_(problems) {}

    std::vector<HealthyRecord> read() {
        std::vector<HealthyRecord> records;
        for (row_ = 0; row_ < table_.rows.size(); ++row_) {
            if (text("label") == "faulty" || !text("problem").empty()) {
                continue;
            }
            records.push_back({text("gearbox"), meshes(), values()});
        }
        return records;
    }

  private:
    std::string text(const std::string& name) const {
        const auto column = table_.find(name);
        return column ? table_.rows[row_][*column] : "";
    }
    void reject(const std::string& key, const std::string& what, const std::string& remedy) {
        problems_.push_back({table_.path, static_cast<int>(table_.lines[row_]), key, what, remedy});
    }
    int meshes() {
        const std::string turns = text("planet_turns");
        if (turns.empty()) {
            return span_.meshes();
        }
        const auto number = number_of(turns);
        if (!number || !(*number >= 1.0) || *number > 1e6) {
            reject("planet_turns", fmt::format("\"{}\" is not a number of turns", turns),
                   "give 1 or more");
            return span_.meshes();
        }
        return std::min(span_.meshes(), static_cast<int>(*number) * span_.planet_teeth);
    }
    std::vector<double> values() {
        std::vector<double> all;
        for (const Feature& feature : features::record_features()) {
            const std::string name(feature.name), field = text(name);
            all.push_back(kNan);
            if (is_missing(field) || !is_plain_sensor_feature(feature)) {
                continue;
            }
            const std::size_t column = *table_.find(name);
            const auto number = table_.number(row_, column);
            const std::string unit = table_.columns[column].unit;
            const auto factor = feature.unit == "m/s^2" ? unit_factor(Quantity::acceleration, unit)
                                                        : std::optional<double>(1.0);
            if (!number || !std::isfinite(*number)) {
                reject(name, table_.no_number_text(row_, column), "");
            } else if (!factor) {
                reject(name, "unknown unit " + unit, known_units(Quantity::acceleration));
            } else {
                all.back() = *number * *factor;
            }
        }
        return all;
    }

    TextTable table_;
    const signals::SpanLayout span_;
    Problems& problems_;
    std::size_t row_ = 0;
};

bool all_have(const std::vector<HealthyRecord>& records, const Feature& feature) {
    return std::ranges::all_of(records, [&](const HealthyRecord& record) {
        return std::isfinite(record.values[index_of(feature)]);
    });
}

std::vector<const Feature*> select_features(const std::vector<HealthyRecord>& records,
                                            const std::vector<std::string>& requested,
                                            Problems& problems) {
    std::vector<const Feature*> chosen;
    for (const std::string& name : requested) {
        const auto known = usable_names();
        const Feature* feature = record_feature(name);
        if (features::find_feature(name) != nullptr && feature == nullptr) {
            problems.push_back({"--feature", 0, name,
                                "needs a baseline record, which calibration does not simulate",
                                "use a feature of one record, for example window_ratio"});
        } else if (std::ranges::find(known, name) == known.end()) {
            problems.push_back({"--feature", 0, name, "is not a feature of a single sensor record",
                                suggest(name, known)});
        } else if (!all_have(records, *feature)) {
            problems.push_back({"--feature", 0, name, "is missing from some records", ""});
        } else {
            chosen.push_back(feature);
        }
    }
    if (!requested.empty()) {
        return chosen;
    }
    // Features that transform the whole record would take most of the time.
    constexpr auto kSlow =
        features::SignalSet::of<features::SensorSamples, features::WhitenedToothRms>();
    for (const Feature& feature : features::record_features()) {
        const bool left_out =
            feature.needs.overlaps(features::kCentralGears) || feature.needs.overlaps(kSlow);
        if (is_plain_sensor_feature(feature) && !left_out && all_have(records, feature)) {
            chosen.push_back(&feature);
        }
    }
    if (chosen.empty()) {
        problems.push_back({"calibrate", 0, "", "no feature is present in all records", ""});
    }
    return chosen;
}

// At most `most` of the elements, at even distances.
template <class Value>
std::vector<Value> thinned(std::vector<Value> all, std::size_t most) {
    if (all.size() <= most) {
        return all;
    }
    std::vector<Value> some;
    for (std::size_t i = 0; i < most; ++i) {
        some.push_back(std::move(all[i * all.size() / most]));
    }
    return some;
}

}  // namespace

void check_feature_table(const std::string& path, const std::vector<std::string>& requested,
                         Problems& problems) {
    const TextTable table = read_text_table(path);
    const auto known = usable_names();
    if (std::ranges::none_of(table.columns, [&](const TableColumn& column) {
            return std::ranges::count(known, column.name) > 0;
        })) {
        problems.push_back({path, 0, "", "has no column with the name of a sensor feature",
                            "its columns are " + table.names()});
    }
    for (const std::string& name : requested) {
        if (std::ranges::count(known, name) > 0 && !table.find(name)) {
            problems.push_back({"--feature", 0, name, "is missing from some records", ""});
        }
    }
}

std::vector<HealthyRecord> read_feature_table(const std::string& path,
                                              const signals::SpanLayout& span, Problems& problems) {
    return TableReading(path, span, problems).read();
}

HealthySet healthy_set(const std::vector<HealthyRecord>& records,
                       const std::vector<std::string>& requested, Problems& problems) {
    HealthySet set;
    set.features = select_features(records, requested, problems);
    std::vector<std::vector<const HealthyRecord*>> gearboxes;
    std::map<std::string, std::size_t> indices;
    for (const HealthyRecord& record : records) {
        const auto [known, is_new] = indices.try_emplace(record.gearbox, gearboxes.size());
        if (is_new || record.gearbox.empty()) {
            gearboxes.emplace_back();
        }
        gearboxes[record.gearbox.empty() ? gearboxes.size() - 1 : known->second].push_back(&record);
    }
    for (auto& gearbox : thinned(std::move(gearboxes), kMostGearboxes)) {
        set.lengths.emplace_back();
        set.values.emplace_back();
        for (const HealthyRecord* record : thinned(std::move(gearbox), kMostRecords)) {
            set.lengths.back().push_back(record->meshes);
            set.values.back().emplace_back();
            for (const Feature* feature : set.features) {
                set.values.back().back().push_back(record->values[index_of(*feature)]);
            }
            ++set.records;
        }
    }
    set.left_out = records.size() - set.records;
    return set;
}

double HealthySet::mean_of(const std::string& feature) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t f = 0; f < features.size(); ++f) {
        for (const auto& gearbox : values) {
            for (const auto& record : gearbox) {
                sum += features[f]->name == feature ? record[f] : 0.0;
                count += features[f]->name == feature ? 1.0 : 0.0;
            }
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

}  // namespace gearpod::mc
