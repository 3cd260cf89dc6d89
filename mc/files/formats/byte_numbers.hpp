// Numbers in bytes of either byte order, independent of the machine's own.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "machine/contracts.hpp"

namespace gearpod::mc {

// Unsigned integer of `width` bytes from `offset` on.
inline std::uint64_t unsigned_at(std::string_view bytes, std::size_t offset, std::size_t width,
                                 bool big_endian = false) {
    EXPECTS(offset <= bytes.size() && width <= bytes.size() - offset);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t digit = big_endian ? i : width - 1 - i;
        value = value << 8 | static_cast<unsigned char>(bytes[offset + digit]);
    }
    return value;
}

// Two's complement integer of `width` bytes.
inline std::int64_t signed_at(std::string_view bytes, std::size_t at, std::size_t width,
                              bool big_endian = false) {
    const std::size_t unused = 64 - 8 * width;
    return static_cast<std::int64_t>(unsigned_at(bytes, at, width, big_endian) << unused) >> unused;
}

// IEEE 754 number of 4 or 8 bytes.
inline double ieee_at(std::string_view bytes, std::size_t at, std::size_t width,
                      bool big_endian = false) {
    const std::uint64_t raw = unsigned_at(bytes, at, width, big_endian);
    return width == 8 ? std::bit_cast<double>(raw)
                      : std::bit_cast<float>(static_cast<std::uint32_t>(raw));
}

}  // namespace gearpod::mc
