// read_peers(): reads a table of other programs' results.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "mc/accuracy/report.hpp"
#include "mc/input/input_file.hpp"
#include "mc/input/parsed_number.hpp"

namespace gearpod::mc {
namespace {

// Cells of a CSV line; a quoted cell may contain commas.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    return cells;
}

double number_in(const std::string& cell, const std::string& where, const std::string& column) {
    const auto value = parsed_number<double>(cell);
    if (!value || !(*value >= 0.0)) {
        throw std::runtime_error(
            fmt::format("{}: {}: \"{}\" is not a number >= 0", where, column, cell));
    }
    return *value;
}

}  // namespace

std::vector<PeerResult> read_peers(const std::string& path) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw std::runtime_error(path + ": " + why);
    }
    std::ifstream file(path);
    std::string line;
    if (!file || !std::getline(file, line)) {
        throw std::runtime_error(path + ": cannot be read or is empty");
    }
    std::vector<std::string> head = cells_of(line);
    std::ranges::replace(head, "march_s", "integration_s");  // name in earlier versions
    const std::vector<std::string> first{"name",   "command", "integration_s",
                                         "mesh_s", "sensor",  "te"};
    if (head.size() < first.size() || !std::equal(first.begin(), first.end(), head.begin())) {
        throw std::runtime_error(path +
                                 ":1: must begin with name,command,integration_s,mesh_s,sensor,te");
    }
    std::vector<PeerResult> peers;
    for (int number = 2; std::getline(file, line); ++number) {
        const std::string where = fmt::format("{}:{}", path, number);
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() != head.size()) {
            throw std::runtime_error(fmt::format("{}: has {} cells, but the first line has {}",
                                                 where, cells.size(), head.size()));
        }
        PeerResult peer{cells[0], cells[1], 0.0, 0.0, 0.0, 0.0, {}};
        double* const into[] = {&peer.integration_s, &peer.mesh_s, &peer.sensor, &peer.te};
        for (std::size_t i = 2; i < cells.size(); ++i) {
            const double value = number_in(cells[i], where, head[i]);
            if (i < first.size()) {
                *into[i - 2] = value;
            } else {
                peer.features.emplace_back(head[i], value);
            }
        }
        peers.push_back(peer);
    }
    return peers;
}

}  // namespace gearpod::mc
