#include "mc/files/formats/tdms_values.hpp"

#include <cmath>

#include "mc/files/formats/byte_numbers.hpp"

namespace gearpod::mc {

double TdmsTime::since(const TdmsTime& earlier) const {
    const double whole = static_cast<double>(seconds) - static_cast<double>(earlier.seconds);
    const double parts = fraction >= earlier.fraction
                             ? static_cast<double>(fraction - earlier.fraction)
                             : -static_cast<double>(earlier.fraction - fraction);
    return whole + std::ldexp(parts, -64);
}

std::uint64_t tdms_width(TdmsType type) {
    switch (type) {
        case TdmsType::int8:
        case TdmsType::uint8:
        case TdmsType::boolean:
            return 1;
        case TdmsType::int16:
        case TdmsType::uint16:
            return 2;
        case TdmsType::int32:
        case TdmsType::uint32:
        case TdmsType::float32:
        case TdmsType::float32_with_unit:
            return 4;
        case TdmsType::int64:
        case TdmsType::uint64:
        case TdmsType::float64:
        case TdmsType::float64_with_unit:
        case TdmsType::complex64:
            return 8;
        case TdmsType::timestamp:
        case TdmsType::complex128:
            return 16;
        case TdmsType::none:
        case TdmsType::string:
            break;
    }
    return 0;
}

double tdms_number(std::string_view bytes, std::size_t at, TdmsType type, bool big_endian) {
    const std::size_t width = tdms_width(type);
    switch (type) {
        case TdmsType::float32:
        case TdmsType::float64:
        case TdmsType::float32_with_unit:
        case TdmsType::float64_with_unit:
            return ieee_at(bytes, at, width, big_endian);
        case TdmsType::int8:
        case TdmsType::int16:
        case TdmsType::int32:
        case TdmsType::int64:
            return static_cast<double>(signed_at(bytes, at, width, big_endian));
        case TdmsType::uint8:
        case TdmsType::uint16:
        case TdmsType::uint32:
        case TdmsType::uint64:
        case TdmsType::boolean:
        case TdmsType::none:
        case TdmsType::string:
        case TdmsType::timestamp:
        case TdmsType::complex64:
        case TdmsType::complex128:
            break;
    }
    return static_cast<double>(unsigned_at(bytes, at, width, big_endian));
}

TdmsTime tdms_time(std::string_view bytes, std::size_t at, bool big_endian) {
    const std::uint64_t first = unsigned_at(bytes, at, 8, big_endian);
    const std::uint64_t second = unsigned_at(bytes, at + 8, 8, big_endian);
    return big_endian ? TdmsTime{static_cast<std::int64_t>(first), second}
                      : TdmsTime{static_cast<std::int64_t>(second), first};
}

bool is_tdms_number(TdmsType type) {
    return tdms_width(type) > 0 && type != TdmsType::timestamp && type != TdmsType::complex64 &&
           type != TdmsType::complex128;
}

}  // namespace gearpod::mc
