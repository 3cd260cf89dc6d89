// Reads universal files of measured functions: dataset 58 of SDRC's I-DEAS, as text or with binary
// values (58b). Only real, evenly spaced time histories are supported.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "mc/files/signal_file.hpp"
#include "mc/files/text_table.hpp"

namespace gearpod::mc {
namespace {

struct History {
    std::string unit;
    double step_s = 0.0;
    std::vector<double> values;
};

class UffReader {
  public:
    explicit UffReader(const std::string& path) : path_(path), stream_(path, std::ios::binary) {}

    std::vector<History> read() {
        std::vector<History> all;
        std::string line;
        while (next(line)) {
            if (trimmed_field(line) != "-1" || !next(line)) {
                continue;
            }
            const std::string kind(trimmed_field(line.substr(0, 7)));
            if (kind == "58" || kind == "58b") {
                all.push_back(read_function(kind == "58b" ? line : ""));
            } else {
                skip();
            }
        }
        if (all.empty()) {
            refuse("contains no dataset 58 (a measured function)");
        }
        return all;
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(fmt::format("{}:{}: {}", path_, line_, why));
    }
    bool next(std::string& line) {
        ++line_;
        return static_cast<bool>(std::getline(stream_, line));
    }
    void skip() {
        for (std::string line; next(line) && trimmed_field(line) != "-1";) {
        }
    }
    double field(const std::string& line, std::size_t at, std::size_t width) const {
        const std::string text(
            trimmed_field(at < line.size() ? line.substr(at, width) : std::string()));
        const auto value = number_of(text, false);
        if (!value) {
            refuse(fmt::format("\"{}\" is not a number", text.substr(0, 40)));
        }
        return *value;
    }

    // `binary`: first line of the dataset if its values are binary, else "".
    History read_function(const std::string& binary) {
        std::array<std::string, 11> records;
        for (std::string& record : records) {
            if (!next(record)) {
                refuse("ends within the header of a dataset 58");
            }
        }
        const std::string& form = records[6];
        const double type = field(form, 0, 10), count = field(form, 10, 10);
        if (field(records[5], 0, 5) != 1.0 || field(form, 20, 10) != 1.0 ||
            (type != 2.0 && type != 4.0)) {
            refuse("is not an evenly spaced, real time history");
        }
        if (!(count >= 1.0 && count <= 1e9)) {
            refuse(fmt::format("{:g} is not a valid number of values", count));
        }
        History history;
        history.step_s = field(form, 43, 13);
        if (!(history.step_s > 0.0 && std::isfinite(1.0 / history.step_s))) {
            refuse(fmt::format("{:g} s is not a valid time step", history.step_s));
        }
        if (records[8].size() > 46) {
            history.unit = std::string(trimmed_field(records[8].substr(46, 20)));
            history.unit = history.unit == "NONE" ? "" : history.unit;
        }
        const auto values = static_cast<std::size_t>(count);
        binary.empty() ? read_text(values, type == 2.0 ? 13 : 20, history)
                       : read_bytes(values, type == 2.0 ? 4 : 8, binary, history);
        return history;
    }

    void read_text(std::size_t count, std::size_t width, History& history) {
        for (std::string line; history.values.size() < count;) {
            if (!next(line) || trimmed_field(line) == "-1") {
                refuse(
                    fmt::format("only {} of {} values are present", history.values.size(), count));
            }
            line.erase(line.find_last_not_of(" \r") + 1);
            for (std::size_t at = 0; at < line.size() && history.values.size() < count;
                 at += width) {
                history.values.push_back(field(line, at, width));
            }
        }
        skip();
    }

    void read_bytes(std::size_t count, std::size_t width, const std::string& head,
                    History& history) {
        const bool little = field(head, 7, 6) == 1.0;
        if (field(head, 13, 6) != 2.0) {
            refuse("its binary values are not IEEE numbers");
        }
        // Reads in blocks: the count in the file may be wrong, and memory must not exceed the file
        // size.
        std::string bytes;
        std::array<char, 65536> block;
        for (std::size_t left = count * width; left > 0 && stream_;) {
            stream_.read(block.data(), static_cast<std::streamsize>(std::min(left, block.size())));
            bytes.append(block.data(), static_cast<std::size_t>(stream_.gcount()));
            left -= static_cast<std::size_t>(stream_.gcount());
        }
        if (bytes.size() < count * width) {
            refuse(fmt::format("only {} of {} values are present", bytes.size() / width, count));
        }
        for (std::size_t i = 0; i < count; ++i) {
            std::uint64_t raw = 0;
            for (std::size_t b = 0; b < width; ++b) {
                const std::size_t place = little ? width - 1 - b : b;
                raw = raw << 8 | static_cast<unsigned char>(bytes[i * width + place]);
            }
            history.values.push_back(width == 8
                                         ? std::bit_cast<double>(raw)
                                         : std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
        }
        skip();
    }

    std::string path_;
    std::ifstream stream_;
    long line_ = 0;
};

class SignalUff : public SignalFile {
  public:
    explicit SignalUff(const std::string& path) : path_(path), all_(UffReader(path).read()) {}

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (std::size_t i = 1; i <= all_.size(); ++i) {
            names.push_back(all_.size() == 1 ? "sensor" : fmt::format("function{}", i));
        }
        return names;
    }
    std::vector<double> read(const std::string& name) override { return of(name).values; }
    std::string unit(const std::string& name) override { return of(name).unit; }
    std::optional<double> sampling_Hz() override {
        for (const History& history : all_) {
            if (history.step_s != all_.front().step_s) {
                throw SignalError(path_ + ": its functions have different sampling rates");
            }
        }
        return 1.0 / all_.front().step_s;
    }

  private:
    const History& of(const std::string& name) const {
        const auto all = names();
        return all_[static_cast<std::size_t>(std::find(all.begin(), all.end(), name) -
                                             all.begin())];
    }

    std::string path_;
    std::vector<History> all_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_uff(const std::string& path) {
    return std::make_unique<SignalUff>(path);
}

}  // namespace gearpod::mc
