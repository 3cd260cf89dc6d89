#include "mc/report/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "features/feature.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/plan/gearbox_streams.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/provenance.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

std::size_t split_of(Philox engine) {
    constexpr double kFirstShare = 0.7, kSecondShare = 0.15;
    const double variate = boost::random::uniform_01<double>()(engine);
    return variate < kFirstShare ? 0 : variate < kFirstShare + kSecondShare ? 1 : 2;
}

}  // namespace

RowIdentities::RowIdentities(const Results& frame, const std::optional<RunFacts>& facts) {
    if (facts) {
        seed_ = static_cast<std::uint64_t>(facts->ensemble.seed);
        order_ = facts->rows;
        plan_.emplace(
            facts->ensemble.batches(read_part(frame.provenance_value("part")).value_or(Part{})));
    }
    std::istringstream names(frame.provenance_value("recorded_gearboxes"));
    for (std::string name; std::getline(names, name);) {
        recorded_.push_back(name);
    }
}

RowIdentity RowIdentities::of(std::size_t row) const {
    return plan_ ? of_simulated(row) : of_recorded(row);
}

RowIdentity RowIdentities::of_simulated(std::size_t row) const {
    const Batch batch = plan_->batch(plan_->batch_of_row(row));
    const std::size_t within = row - batch.first_row, record = within % batch.records;
    const GearboxId id{batch.group, batch.first_index + within / batch.records, Record::test,
                       record};
    return {fmt::format("{}-{}", id.group == Group::threshold ? "threshold" : "graded", id.index),
            static_cast<std::size_t>(order_->row_of(id)), record,
            split_of({seed_, id.group, id.index, StreamPurpose::dataset_split})};
}

// The seed is 0, so that a gearbox has the same split in every results file.
RowIdentity RowIdentities::of_recorded(std::size_t row) const {
    const bool named = row < recorded_.size() && !recorded_[row].empty();
    const std::string name = named ? recorded_[row] : fmt::format("recording-{}", row);
    const auto end = recorded_.begin() + static_cast<std::ptrdiff_t>(named ? row : 0);
    return {name, row, static_cast<std::size_t>(std::count(recorded_.begin(), end, name)),
            split_of({seed_, Group::threshold, 0,
                      with_suffix(StreamPurpose::dataset_split, "." + name)})};
}

namespace {

constexpr const char* kDatasetCard = "# Dataset of gearpod\n";
constexpr const char* kDatasetStudy = "# Study of a dataset, with all defaults\n";

struct DatasetColumn {
    std::string name, role, unit, meaning;
};

std::string number_field(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}

const char* group_name(int group) {
    return group == kNoGroup                             ? "neither"
           : group == static_cast<int>(Group::threshold) ? "threshold"
                                                         : "graded";
}

// Meaning of a column of /instances.
std::string input_meaning(const std::string& name) {
    if (name == kNoiseWeight) {
        return "importance weight of the record for features of the accelerometer";
    }
    for (const Key& key : schema()) {
        if (key.may_be_random() && key.column() == name) {
            return fmt::format("{}: {}", key.path(), key.doc);
        }
    }
    return "column of the recordings' list";
}

class Dataset {
  public:
    Dataset(const Results& frame, const std::string& file)
        : frame_(frame),
          file_(file),
          shape_(row_shape(frame)),
          recorded_(frame.provenance_value("kind") == kRecordingsKind),
          study_text_(frame.provenance_value(recorded_ ? "measured_by_study" : "study")),
          facts_(recorded_ ? std::nullopt : run_facts(study_text_, file)),
          identities_(frame, facts_),
          other_fault_(std::ranges::count(frame.variants, kOtherFault, &Variant::name) > 0) {
        if (!facts_ && !recorded_) {
            throw std::runtime_error(file +
                                     ": its study cannot be read by this version; "
                                     "--dataset needs it for the gearboxes' identities");
        }
        add_columns();
        for (CsvTable& table : tables_) {
            for (const DatasetColumn& column : columns_) {
                table.columns.push_back(csv_field(column.name));
            }
        }
    }

    void add_row(const ResultRow& row) {
        const RowIdentity identity = identities_.of(row.index);
        if (row.status != static_cast<int>(Status::ok)) {
            ++failed_;
            return;
        }
        count(identity, is_faulty(row.group, row.values));
        add_signal(identity, row.group, row.values, "first", false,
                   row.values + shape_.value_of(0, 0));
        for (std::size_t v = 0; v < shape_.variants; ++v) {
            const std::string& name = frame_.variants[v].name;
            const bool bearing = name == kOtherFault;
            if (!bearing || row.group == static_cast<int>(Group::threshold)) {
                add_signal(identity, row.group, row.values,
                           bearing ? "first" : name.substr(kSensorVariant.size()), bearing,
                           row.values + shape_.variant_value_of(v, 0));
            }
        }
    }

    std::vector<NamedFile> files() {
        std::vector<NamedFile> signals = signal_files();
        CsvTable columns{"columns", {"column", "role", "unit", "meaning"}, {}};
        for (const DatasetColumn& column : columns_) {
            columns.rows.push_back(fmt::format("{},{},{},{}", csv_field(column.name), column.role,
                                               csv_field(column.unit), csv_field(column.meaning)));
        }
        std::vector<NamedFile> files{{"README.md", card(signals)}};
        for (NamedFile& table : table_files({tables_[0], tables_[1], tables_[2], columns})) {
            files.push_back(std::move(table));
        }
        files.push_back({"study.toml", kDatasetStudy + study_text_});
        std::move(signals.begin(), signals.end(), std::back_inserter(files));
        return files;
    }

  private:
    struct SplitCounts {
        std::set<std::string> gearboxes, faulty;
        std::size_t records = 0;
    };

    void add_columns() {
        columns_ = {
            {"row", "identity", "1",
             recorded_ ? "row of the results file"
                       : "row in the results of the whole study, as in `simulate --instance`"},
            {"gearbox", "identity", "", "specimen; all its rows are in one split"},
            {"group", "identity", "",
             "threshold: sets thresholds in reports, graded: test gearbox, neither: of "
             "unknown state"},
            {"record", "identity", "1", "number of the record of this gearbox, from 0"},
            {"sensor", "condition", "", "accelerometer; transmission error is the same for all"},
            {"noise_level", "condition", "1", "factor on the noise of accelerometer and encoders"}};
        if (other_fault_) {
            columns_.push_back({"other_fault", "condition", "1",
                                "1: the record has the study's faulty bearing in addition"});
        }
        columns_.push_back({"faulty", "label", "1", "1: the gear has the fault, 0: healthy"});
        for (const ParameterResult& input : frame_.parameters) {
            const bool size = input.name == frame_.request.size.name;
            columns_.push_back(
                {unused_name(input.name), size ? "severity" : "input", input.unit,
                 size ? "size of the fault, 0: healthy" : input_meaning(input.name)});
        }
        for (const FeatureResult& result : frame_.features) {
            const features::Feature* known = features::find_feature(result.name);
            columns_.push_back({unused_name(result.name), "feature", result.unit,
                                known == nullptr
                                    ? "feature in Python"
                                    : fmt::format("{} ({})", known->title, known->doc)});
        }
    }

    // The name, with a prefix if another column has it.
    std::string unused_name(std::string name) const {
        while (std::ranges::count(columns_, name, &DatasetColumn::name) > 0) {
            name = "results_" + name;
        }
        return name;
    }

    double size_of(const double* values) const {
        const auto size_at = frame_.parameter_index(frame_.request.size.name);
        return size_at ? values[*size_at] : 0.0;
    }
    bool is_faulty(int group, const double* values) const {
        return group == static_cast<int>(Group::test) && (recorded_ || size_of(values) > 0.0);
    }

    void count(const RowIdentity& identity, bool faulty) {
        SplitCounts& counts = counts_[identity.split];
        counts.gearboxes.insert(identity.gearbox);
        if (faulty) {
            counts.faulty.insert(identity.gearbox);
        }
        ++counts.records;
    }

    // Adds a line per noise level. `values` are the row's, `features` begin at its first feature.
    void add_signal(const RowIdentity& identity, int group, const double* values,
                    const std::string& sensor, bool other_fault, const double* features) {
        for (std::size_t level = 0; level < shape_.levels; ++level) {
            std::string line = fmt::format(
                "{},{},{},{},{},{}", identity.row, csv_field(identity.gearbox), group_name(group),
                identity.record, csv_field(sensor), number_field(frame_.noise_levels[level]));
            if (other_fault_) {
                line += other_fault ? ",1" : ",0";
            }
            line += group == kNoGroup ? "," : is_faulty(group, values) ? ",1" : ",0";
            for (std::size_t p = 0; p < shape_.parameters; ++p) {
                line += "," + number_field(values[p]);
            }
            for (std::size_t f = 0; f < shape_.features; ++f) {
                line += "," + number_field(features[f * shape_.levels + level]);
            }
            tables_[identity.split].rows.push_back(std::move(line));
        }
    }

    std::vector<NamedFile> signal_files() const {
        const SilentHdf5 silent;
        const Hdf5Handle file(H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                              file_ + ": cannot be opened");
        std::vector<NamedFile> files;
        if (std::ranges::count(link_names(file.get()), "signals") == 0) {
            return files;
        }
        const Hdf5Handle all = open_group(file.get(), "signals");
        for (const std::string& row : link_names(all.get())) {
            const Hdf5Handle group = open_group(all.get(), row);
            std::vector<SignalColumn> columns;
            for (const std::string& name : link_names(group.get())) {
                columns.push_back({name, read_text(group.get(), name, "unit"),
                                   read_numbers(group.get(), name, SIZE_MAX).values});
            }
            const RowIdentity identity = identities_.of(std::stoul(row));
            files.push_back({fmt::format("signals_{}.csv", identity.row), signals_csv(columns)});
        }
        return files;
    }

    std::string card(const std::vector<NamedFile>& signals) const;

    const Results& frame_;
    const std::string file_;
    const RowShape shape_;
    const bool recorded_;
    const std::string study_text_;
    const std::optional<RunFacts> facts_;  // of an ensemble
    const RowIdentities identities_;
    const bool other_fault_;
    std::vector<DatasetColumn> columns_;
    CsvTable tables_[kSplitCount] = {
        {kSplitNames[0], {}, {}}, {kSplitNames[1], {}, {}}, {kSplitNames[2], {}, {}}};
    SplitCounts counts_[kSplitCount];
    std::size_t failed_ = 0;
};

std::string Dataset::card(const std::vector<NamedFile>& signals) const {
    std::string text = kDatasetCard;
    const auto add = [&]<class... Values>(fmt::format_string<Values...> format,
                                          Values&&... values) {
        text += fmt::format(format, std::forward<Values>(values)...);
    };
    std::string title;
    if (facts_) {
        title = facts_->ensemble.title;
    } else if (const auto measuring = measuring_facts(study_text_, file_)) {
        title = measuring->title;
    }
    add("\nFeatures of {} with labels, for machine learning.\n",
        recorded_ ? "recordings" : "simulated gearboxes");
    add("\n## Source\n\n| entry | value |\n| --- | --- |\n");
    const std::pair<const char*, std::string> entries[] = {
        {"study", printable(title.empty() ? "without a title" : title) + " (study.toml)"},
        {"conditions", facts_ ? facts_->conditions : ""},
        {"fault", facts_ && facts_->fault.given() ? facts_->fault.words : ""},
        {"results computed by", version_text(frame_.provenance_value("code_version"),
                                             frame_.provenance_value("git_hash"))},
        {"dataset written by", version_text()},
        {"seed", frame_.provenance_value("seed")},
        {"part of the study", frame_.provenance_value("part")},
        {"state of the run", frame_.provenance_value("state")}};
    for (const auto& [name, value] : entries) {
        if (!value.empty()) {
            add("| {} | {} |\n", name, printable(value));
        }
    }
    add("\n## Splits\n\nEach file holds whole gearboxes: every record, noise level and sensor of a "
        "gearbox. {} A line is one record at one noise level and one sensor.\n\n"
        "| file | gearboxes | of these with a fault | records |\n| --- | --- | --- | --- |\n",
        recorded_ ? "The name of the gearbox decides."
                  : "The seed and the number of the gearbox decide, so that a larger ensemble "
                    "keeps the splits.");
    for (std::size_t split = 0; split < kSplitCount; ++split) {
        add("| {}.csv | {} | {} | {} |\n", kSplitNames[split], counts_[split].gearboxes.size(),
            counts_[split].faulty.size(), counts_[split].records);
    }
    add("\n## Columns\n\nAll numbers are in SI units; an empty field has no value. columns.csv "
        "holds "
        "this table.\n\n| column | role | unit | meaning |\n| --- | --- | --- | --- |\n");
    for (const DatasetColumn& column : columns_) {
        add("| {} | {} | {} | {} |\n", printable(column.name), column.role, printable(column.unit),
            printable(column.meaning));
    }
    add("\n## Limits\n\n");
    if (!signals.empty()) {
        add("- Signals of {} rows are in signals_ROW.csv.\n", signals.size());
    }
    add("- {}\n",
        recorded_ ? "The dataset has no signals; they are in the recordings."
                  : "Other signals are not included: `gearpod simulate study.toml --instance ROW "
                    "--out FILE.h5` computes those of a row, bit for bit.");
    add("- Columns with the role `input` are known to the {}; a monitor may not know them.\n",
        recorded_ ? "list of recordings" : "simulation");
    add("- Rows of one gearbox are not independent: noise levels scale the same noise.\n");
    add("- Baseline records are contained in the features own_..., change_... and "
        "baseline_correlation only.\n");
    if (failed_ > 0) {
        add("- {} records failed and are left out.\n", failed_);
    }
    if (!recorded_ && std::ranges::any_of(frame_.features, [](const FeatureResult& feature) {
            return feature.name.ends_with("na4");
        })) {
        add("- na4 compares with the mean of the first eight gearboxes of the threshold sample, "
            "which are in any split.\n");
    }
    add("- {}\n", recorded_ ? "Labels and sizes are those of the list of recordings."
                            : "No gearbox was measured. Values hold for the study's gearboxes and "
                              "assumptions, and for one kind of fault.");
    add("- A gearbox is seen once or a few times, not while its fault grows.\n");
    return text;
}

}  // namespace

std::vector<NamedFile> dataset_files(const Results& frame, const RowSource& rows,
                                     const std::string& file) {
    Dataset dataset(frame, file);
    for_each_row(rows, [&](const ResultRow& row) { dataset.add_row(row); });
    return dataset.files();
}

}  // namespace gearpod::mc
