// Numbers and MAT files as bytes, written from the formats' specifications.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gearpod::test {

inline void append_number(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 255);
    }
}

using Named = std::vector<std::pair<std::string, std::vector<double>>>;

// Variables of MATLAB 4, columns or rows: type, rows, columns, no imaginary part, length of the
// name.
inline std::string mat_bytes(const Named& variables, bool rows) {
    std::string bytes;
    for (const auto& [name, values] : variables) {
        const std::size_t count = values.size();
        for (const std::uint64_t number : {std::size_t{0}, rows ? 1 : count, rows ? count : 1,
                                           std::size_t{0}, name.size() + 1}) {
            append_number(bytes, number, 4);
        }
        bytes += name + '\0';
        for (const double value : values) {
            append_number(bytes, std::bit_cast<std::uint64_t>(value), 8);
        }
    }
    return bytes;
}

}  // namespace gearpod::test
