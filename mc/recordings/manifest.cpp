#include "mc/recordings/manifest.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "mc/files/input/input_file.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kKnown[] = {"file",  "row",  "gearbox", "time",
                                       "label", "size", "baseline"};

class Reading {
  public:
    Reading(const std::string& path, Problems& problems)
        : table_(read_text_table(path)), problems_(problems) {
        for (TableColumn& column : table_.columns) {
            const std::string name = lower_case(column.name);
            column.name = std::ranges::count(kKnown, name) > 0 ? name : column.name;
        }
    }

    RecordingList read() {
        const auto file = table_.find("file");
        if (!file) {
            problems_.push_back(
                {table_.path, 0, "", "has no column file", "its columns are " + table_.names()});
            return {};
        }
        choose_inputs();
        for (std::size_t r = 0; r < table_.rows.size(); ++r) {
            row_ = r;
            Recording recording;
            const std::filesystem::path name = table_.rows[r][*file];
            if (name.empty()) {
                reject("file", "is empty", "give the file name of the recording");
            }
            recording.file =
                name.is_absolute()
                    ? name.string()
                    : (std::filesystem::path(table_.path).parent_path() / name).string();
            if (std::error_code error;
                std::filesystem::is_other(std::filesystem::status(recording.file, error))) {
                reject("file", "is not a regular file", "name a file that can be read to its end");
            }
            read_known(recording);
            list_.recordings.push_back(std::move(recording));
        }
        if (list_.recordings.empty()) {
            problems_.push_back(
                {table_.path, 0, "", "lists no recording", "give one line for each recording"});
        }
        return std::move(list_);
    }

  private:
    void choose_inputs() {
        for (std::size_t c = 0; c < table_.columns.size(); ++c) {
            const TableColumn& column = table_.columns[c];
            if (column.name == "time") {
                list_.time = column;
            } else if (column.name == "size") {
                list_.size = column;
            } else if (!column.name.empty() && std::ranges::count(kKnown, column.name) == 0) {
                if (std::ranges::count(list_.inputs, column.name, &TableColumn::name) > 0) {
                    problems_.push_back({table_.path, 0, column.name, "is the name of two columns",
                                         "give each condition a name"});
                }
                list_.inputs.push_back(column);
                input_columns_.push_back(c);
            }
        }
    }

    void read_known(Recording& recording) {
        if (const std::string* text = field("row")) {
            const auto value = number_of(*text);
            if (!value || !(*value >= 0.0) || *value != std::floor(*value) || *value > 1e15) {
                reject("row", fmt::format("\"{}\" is not a row number", *text),
                       "rows are numbered from 0");
            } else {
                recording.row = static_cast<std::size_t>(*value);
            }
        }
        if (const std::string* text = field("gearbox")) {
            recording.gearbox = *text;
        }
        if (list_.time) {
            recording.time = number("time");
        }
        for (const std::size_t c : input_columns_) {
            recording.inputs.push_back(number(c));
        }
        if (field("size") != nullptr) {
            const double size = number("size");
            if (size < 0.0) {
                reject("size", "is negative", "use 0 for a healthy gearbox");
            }
            recording.size = list_.size->unit == "mm" ? 1e-3 * size : size;
            recording.condition = size > 0.0 ? Condition::faulty : Condition::healthy;
        }
        read_label(recording);
        read_mark(recording);
    }

    void read_mark(Recording& recording) {
        const std::string* mark = field("baseline");
        if (mark == nullptr) {
            return;
        }
        recording.in_baseline = *mark == "yes";
        if (!recording.in_baseline && *mark != "no") {
            reject("baseline", fmt::format("\"{}\" is neither yes nor no", *mark),
                   "leave it empty for recordings that are not of the baseline");
        } else if (recording.in_baseline && recording.condition == Condition::faulty) {
            reject("baseline", "is yes for a faulty recording", "choose healthy recordings");
        }
    }

    void read_label(Recording& recording) {
        const std::string* label = field("label");
        if (label == nullptr) {
            return;
        }
        const bool healthy = *label == "healthy";
        if (!healthy && *label != "faulty") {
            reject("label", fmt::format("\"{}\" is neither healthy nor faulty", *label),
                   "leave it empty if it is unknown");
        } else if (recording.size && healthy != (*recording.size == 0.0)) {
            reject("label", *label + " contradicts the size",
                   "healthy recordings have size 0, faulty ones a size > 0");
        }
        recording.condition = healthy ? Condition::healthy : Condition::faulty;
    }

    // Field of the current row; null if the column does not exist or the field has no value.
    const std::string* field(const std::string& name) const {
        const auto column = table_.find(name);
        return column && !is_missing(table_.rows[row_][*column]) ? &table_.rows[row_][*column]
                                                                 : nullptr;
    }
    double number(const std::string& name) { return number(*table_.find(name)); }
    double number(std::size_t column) {
        const auto value = table_.number(row_, column);
        if (!value || !std::isfinite(*value)) {
            reject(table_.columns[column].name, table_.no_number_text(row_, column), "");
        }
        return value.value_or(0.0);
    }
    void reject(const std::string& key, const std::string& what, const std::string& remedy) {
        problems_.push_back({table_.path, static_cast<int>(table_.lines[row_]), key, what, remedy});
    }

    TextTable table_;
    Problems& problems_;
    RecordingList list_;
    std::vector<std::size_t> input_columns_;
    std::size_t row_ = 0;
};

bool is_pattern(const std::string& file) {
    return file.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(file);
}

}  // namespace

std::string Recording::name() const {
    return row ? fmt::format("{} row {}", file, *row) : file;
}

RecordingList read_manifest(const std::string& path, Problems& problems) {
    return Reading(path, problems).read();
}

RecordingList recordings_of(const std::vector<std::string>& files, Problems& problems) {
    RecordingList list;
    for (const std::string& file : files) {
        if (!is_pattern(file)) {
            list.recordings.push_back({});
            list.recordings.back().file = file;
            continue;
        }
        glob_t found{};
        if (::glob(file.c_str(), 0, nullptr, &found) != 0) {
            problems.push_back({file, 0, "", "no file matches this pattern", ""});
        }
        for (std::size_t i = 0; i < found.gl_pathc; ++i) {
            list.recordings.push_back({});
            list.recordings.back().file = found.gl_pathv[i];
        }
        ::globfree(&found);
    }
    return list;
}

}  // namespace gearpod::mc
