#include "tests/golden/golden.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "mc/files/hdf5_data.hpp"

namespace gearpod::golden {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostValues = 100'000'000;

std::string output_of(const std::string& arguments) {
    const std::string command = "cd '" GEARPOD_SOURCE_DIR "' && '" GEARPOD_PROGRAM "' " + arguments;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        throw std::runtime_error("cannot start " + command);
    }
    std::string output;
    std::array<char, 4096> buffer;
    while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe)) {
        output.append(buffer.data(), count);
    }
    if (const int status = pclose(pipe); status != 0) {
        throw std::runtime_error(fmt::format("{} exits with {}", command, WEXITSTATUS(status)));
    }
    return output;
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) {
        found.push_back(cell);
    }
    return found;
}

Curves parse_csv(std::istream& in) {
    Curves curves;
    std::string line;
    while (std::getline(in, line)) {
        if (line.starts_with('#')) {
            continue;
        }
        const auto row = cells(line);
        if (curves.names.empty()) {
            curves.names = row;
            curves.columns.resize(row.size());
            continue;
        }
        if (row.size() != curves.names.size()) {
            throw std::runtime_error("a row of another length than the header: " + line);
        }
        for (std::size_t i = 0; i < row.size(); ++i) {
            curves.columns[i].push_back(std::stod(row[i]));
        }
    }
    return curves;
}

Curves chosen(const Curves& all, const std::vector<std::string>& names) {
    if (names.empty()) {
        return all;
    }
    Curves some;
    for (const std::string& name : names) {
        const auto at = std::find(all.names.begin(), all.names.end(), name);
        if (at == all.names.end()) {
            throw std::runtime_error("no column " + name);
        }
        some.names.push_back(name);
        some.columns.push_back(all.columns[static_cast<std::size_t>(at - all.names.begin())]);
    }
    return some;
}

Curves from_json(const Golden& golden) {
    const auto parsed = nlohmann::json::parse(output_of(golden.command));
    Curves curves;
    for (const std::string& key : golden.columns) {
        curves.names.push_back(key);
        curves.columns.push_back(parsed.at(key).get<std::vector<double>>());
    }
    return curves;
}

mc::Hdf5Handle opened(const std::string& path) {
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + path};
}

// A column is named as the last part of the path of its dataset.
Curves read_datasets(const mc::Hdf5Handle& file, const std::vector<std::string>& paths) {
    Curves curves;
    for (const std::string& path : paths) {
        curves.names.push_back(path.substr(path.rfind('/') + 1));
        curves.columns.push_back(mc::read_numbers(file.get(), path, kMostValues).values);
    }
    return curves;
}

// The program's results file; the destructor removes it.
class ResultsFile {
  public:
    explicit ResultsFile(const Golden& golden)
        : path_(fs::temp_directory_path() / fmt::format("golden-{}-{}.h5", golden.name, getpid())) {
        output_of(golden.command + " --out '" + path_.string() + "'");
    }
    ~ResultsFile() { fs::remove(path_); }
    ResultsFile(const ResultsFile&) = delete;
    ResultsFile& operator=(const ResultsFile&) = delete;

    Curves datasets(const std::vector<std::string>& names) const {
        return read_datasets(opened(path_), names);
    }

  private:
    fs::path path_;
};

Curves from_program(const Golden& golden) {
    switch (golden.source) {
        case Source::json:
            return from_json(golden);
        case Source::results:
            return ResultsFile(golden).datasets(golden.columns);
        case Source::csv:
            break;
    }
    std::istringstream text(output_of(golden.command));
    return chosen(parse_csv(text), golden.columns);
}

std::vector<double> every(const std::vector<double>& values, int stride) {
    std::vector<double> some;
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(stride)) {
        some.push_back(values[i]);
    }
    return some;
}

// Largest minus smallest finite value, or the magnitude where all are equal.
double spread(const std::vector<double>& values) {
    double low = INFINITY, high = -INFINITY;
    for (const double value : values) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    return high > low ? high - low : high == low ? std::abs(low) : 0.0;
}

bool agree(double kept, double now, double allowed) {
    return kept == now || std::abs(kept - now) <= allowed || (std::isnan(kept) && std::isnan(now));
}

}  // namespace

Curves compute(const Golden& golden) {
    Curves curves = from_program(golden);
    for (auto& column : curves.columns) {
        column = every(column, golden.stride);
        if (column.size() != curves.columns.front().size()) {
            throw std::runtime_error(golden.name + ": columns of different lengths");
        }
    }
    return curves;
}

std::string curves_path(const Golden& golden) {
    return std::string(GEARPOD_SOURCE_DIR) + "/tests/golden/curves/" + golden.name + ".h5";
}

Curves read_curves(const Golden& golden) {
    const std::string path = curves_path(golden);
    if (!fs::exists(path)) {
        throw std::runtime_error(path + " does not exist: make_golden " + golden.name +
                                 " writes it");
    }
    const mc::Hdf5Handle file = opened(path);
    return read_datasets(file, mc::link_names(file.get()));
}

void write_curves(const Golden& golden, const Curves& curves) {
    const mc::Hdf5Handle file = mc::create_file(curves_path(golden));
    mc::write_text(file.get(), ".", "source", "output of gearpod (tests/golden/table.cpp)");
    mc::write_text(file.get(), ".", "command", "gearpod " + golden.command);
    for (std::size_t c = 0; c < curves.names.size(); ++c) {
        const std::vector<double>& values = curves.columns[c];
        mc::write_numbers(file.get(), curves.names[c], {values.size()}, values);
    }
}

std::string differences(const Curves& kept, const Curves& now, double tolerance) {
    if (kept.names != now.names) {
        return "other columns than the kept ones\n";
    }
    std::string text;
    for (std::size_t c = 0; c < kept.names.size(); ++c) {
        const auto &before = kept.columns[c], &after = now.columns[c];
        if (before.size() != after.size()) {
            text += fmt::format("{}: {} values, kept are {}\n", kept.names[c], after.size(),
                                before.size());
            continue;
        }
        const double allowed = tolerance * spread(before);
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (!agree(before[i], after[i], allowed)) {
                text += fmt::format("{}: value {} is {:.10g}, kept is {:.10g}, allowed +- {:.2g}\n",
                                    kept.names[c], i, after[i], before[i], allowed);
                break;
            }
        }
    }
    return text;
}

}  // namespace gearpod::golden
