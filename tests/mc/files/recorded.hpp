// Helpers for tests that read recordings.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test {

inline std::vector<double> sine_values(std::size_t count, double size) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(size * std::sin(0.37 * static_cast<double>(i)));
    }
    return values;
}

inline std::string file_with(const Folder& folder, const std::string& name,
                             const std::string& bytes) {
    std::ofstream(folder.file(name), std::ios::binary) << bytes;
    return folder.file(name);
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(a[i] - b[i]));
    }
    return most;
}

// Message of the error in reading all columns of a file, or "".
inline std::string reading_error(const std::string& path) {
    try {
        const auto file = mc::open_signal_file(path);
        for (const std::string& name : file->names()) {
            static_cast<void>(file->read(name));
        }
        static_cast<void>(file->sampling_Hz());
    } catch (const mc::SignalError& error) {
        return error.what();
    }
    return "";
}

}  // namespace gearpod::test
