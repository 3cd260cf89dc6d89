// Reads CSV files of signals.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <unordered_set>

#include "mc/files/signal_file.hpp"
#include "mc/files/text_table.hpp"

namespace gearpod::mc {
namespace {

std::vector<std::string_view> fields(std::string_view line, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t end = 0; end != std::string_view::npos; line.remove_prefix(end + 1)) {
        end = line.find(separator);
        parts.push_back(trimmed_field(line.substr(0, end)));
        if (end == std::string_view::npos) {
            break;
        }
    }
    return parts;
}

class SignalCsv : public SignalFile {
  public:
    explicit SignalCsv(const std::string& path) : path_(path) {
        std::ifstream stream(path, std::ios::binary);
        if (!stream) {
            throw SignalError(path + ": cannot be read");
        }
        std::string line;
        for (long number = 1; std::getline(stream, line); ++number) {
            if (number == 1 && line.starts_with("\xEF\xBB\xBF")) {  // byte order mark
                line.erase(0, 3);
            }
            const std::string_view text = trimmed_field(line);
            if (text.empty() || text.front() == '#') {
                continue;
            }
            if (names_.empty()) {
                read_header(line, number);
            } else {
                read_row(line, number);
            }
        }
        if (stream.bad()) {
            throw SignalError(path + ": cannot be read to its end");
        }
        if (names_.empty()) {
            throw SignalError(path + ": is empty; a header line of column names must come first");
        }
    }

    std::vector<std::string> names() const override { return names_; }
    std::vector<double> read(const std::string& name) override {
        const auto at = std::find(names_.begin(), names_.end(), name) - names_.begin();
        return columns_[static_cast<std::size_t>(at)];
    }

    std::string unit(const std::string& name) override {
        const auto at = std::find(names_.begin(), names_.end(), name) - names_.begin();
        return units_[static_cast<std::size_t>(at)];
    }

  private:
    void read_header(std::string_view line, long number) {
        for (const char candidate : {';', '\t', ','}) {
            if (line.find(candidate) != std::string_view::npos) {
                separator_ = candidate;
                break;
            }
        }
        std::unordered_set<std::string> known;
        for (const std::string_view field : fields(line, separator_)) {
            if (field.empty() || number_of(field, true)) {
                throw SignalError(fmt::format(
                    "{}:{}: column {} has no name; the first line must name the columns", path_,
                    number, names_.size() + 1));
            }
            const TableColumn column = column_of(field);
            names_.push_back(column.name);
            units_.push_back(column.unit);
            if (!known.insert(names_.back()).second) {
                throw SignalError(
                    fmt::format("{}:{}: two columns are named {}", path_, number, names_.back()));
            }
        }
        columns_.resize(names_.size());
    }

    void read_row(std::string_view line, long number) {
        const auto parts = fields(line, separator_);
        if (parts.size() != names_.size()) {
            throw SignalError(fmt::format("{}:{}: {} values, but the header names {} columns",
                                          path_, number, parts.size(), names_.size()));
        }
        for (std::size_t c = 0; c < parts.size(); ++c) {
            const auto value = number_of(parts[c], separator_ != ',');
            if (!value) {
                throw SignalError(fmt::format("{}:{}: column {}: \"{}\" is not a number", path_,
                                              number, names_[c], parts[c].substr(0, 40)));
            }
            columns_[c].push_back(*value);
        }
    }

    std::string path_;
    char separator_ = ',';
    std::vector<std::string> names_, units_;
    std::vector<std::vector<double>> columns_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_csv(const std::string& path) {
    return std::make_unique<SignalCsv>(path);
}

}  // namespace gearpod::mc
