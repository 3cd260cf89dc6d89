#include "mc/files/formats/uff_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/input/parsed_number.hpp"

namespace gearpod::mc {

std::optional<double> fortran_number(std::string_view text) {
    std::string plain(text);
    std::ranges::replace(plain, 'D', 'E');
    std::ranges::replace(plain, 'd', 'e');
    const std::size_t sign = plain.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 &&
        std::string_view("0123456789.").find(plain[sign - 1]) != std::string_view::npos) {
        plain.insert(sign, "E");
    }
    return parsed_number<double>(std::string_view(plain).substr(plain.starts_with('+') ? 1 : 0));
}

double rounding_of(std::string_view number) {
    const std::size_t end = std::min(number.find_first_not_of("+-0123456789."), number.size());
    const std::size_t point = std::min(number.find('.'), end);
    const std::size_t decimals = end - std::min(point + 1, end);
    // Power of ten of the exponent, which is that of the same number with the digits 1.
    const auto power = fortran_number("1" + std::string(number.substr(end)));
    return 0.5 * power.value_or(1.0) * std::pow(10.0, -static_cast<double>(decimals));
}

double ibm_number(std::uint64_t raw, std::size_t width) {
    const std::size_t fraction_bits = 8 * width - 8;
    const auto fraction = static_cast<double>(raw & ((std::uint64_t{1} << fraction_bits) - 1));
    const int exponent = static_cast<int>(raw >> fraction_bits & 127) - 64;
    const double size = std::ldexp(fraction, 4 * exponent - static_cast<int>(fraction_bits));
    return (raw >> (8 * width - 1) & 1) != 0 ? -size : size;
}

double dec_number(std::string_view bytes, std::size_t at) {
    const std::uint64_t raw = unsigned_at(bytes, at, 2) << 16 | unsigned_at(bytes, at + 2, 2);
    const int exponent = static_cast<int>(raw >> 23 & 255);
    if (exponent == 0) {
        return 0.0;
    }
    const double size =
        std::ldexp(static_cast<double>((raw & 0x7FFFFF) | 0x800000), exponent - 128 - 24);
    return (raw >> 31 & 1) != 0 ? -size : size;
}

}  // namespace gearpod::mc
