// CSV files of signals.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>
#include <unordered_set>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\"";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> fields(std::string_view line, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t end = 0; end != std::string_view::npos; line.remove_prefix(end + 1)) {
        end = line.find(separator);
        parts.push_back(trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) {
            break;
        }
    }
    return parts;
}

// "sensor [m/s^2]" is named sensor.
std::string name_of(std::string_view field) {
    return std::string(trimmed(field.substr(0, field.find('['))));
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
            const std::string_view text = trimmed(line);
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

  private:
    void read_header(std::string_view line, long number) {
        for (const char candidate : {',', ';', '\t'}) {
            if (line.find(candidate) != std::string_view::npos) {
                separator_ = candidate;
                break;
            }
        }
        std::unordered_set<std::string> known;
        for (const std::string_view field : fields(line, separator_)) {
            double value = 0.0;
            const auto end = field.data() + field.size();
            if (field.empty() || std::from_chars(field.data(), end, value).ptr == end) {
                throw SignalError(fmt::format(
                    "{}:{}: column {} has no name; the first line must name the columns", path_,
                    number, names_.size() + 1));
            }
            names_.push_back(name_of(field));
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
            double value = 0.0;
            const auto end = parts[c].data() + parts[c].size();
            const auto result = std::from_chars(parts[c].data(), end, value);
            if (parts[c].empty() || result.ec != std::errc{} || result.ptr != end) {
                throw SignalError(fmt::format("{}:{}: column {}: \"{}\" is no number", path_,
                                              number, names_[c], parts[c].substr(0, 40)));
            }
            columns_[c].push_back(value);
        }
    }

    std::string path_;
    char separator_ = ',';
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_csv(const std::string& path) {
    return std::make_unique<SignalCsv>(path);
}

}  // namespace gearpod::mc
