// Values and properties in TDMS files (tdms_file.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

namespace gearpod::mc {

// Types of values; the numbers are those of the format.
enum class TdmsType : std::uint32_t {
    none = 0,
    int8 = 1,
    int16 = 2,
    int32 = 3,
    int64 = 4,
    uint8 = 5,
    uint16 = 6,
    uint32 = 7,
    uint64 = 8,
    float32 = 9,
    float64 = 10,
    float32_with_unit = 0x19,
    float64_with_unit = 0x1A,
    string = 0x20,
    boolean = 0x21,
    timestamp = 0x44,
    complex64 = 0x08000C,
    complex128 = 0x10000D,
};

// Point in time: seconds since 1904-01-01 00:00 UTC and 2^-64 of a second.
struct TdmsTime {
    std::int64_t seconds = 0;
    std::uint64_t fraction = 0;

    // Seconds from `earlier` to this time.
    double since(const TdmsTime& earlier) const;
};

using TdmsProperty = std::variant<double, std::string, TdmsTime>;
using TdmsProperties = std::map<std::string, TdmsProperty>;

// Bytes of a value in the file; 0 if values have no fixed size.
std::uint64_t tdms_width(TdmsType type);

// Integer, floating-point or boolean value.
double tdms_number(std::string_view bytes, std::size_t at, TdmsType type, bool big_endian);

TdmsTime tdms_time(std::string_view bytes, std::size_t at, bool big_endian);

// True for integers, floating-point numbers and booleans.
bool is_tdms_number(TdmsType type);

}  // namespace gearpod::mc
