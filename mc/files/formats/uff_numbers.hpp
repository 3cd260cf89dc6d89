// Numbers as universal files write them (uff_file.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace gearpod::mc {

// Number as Fortran writes it: exponents begin with E or D, or have no letter if they have three
// digits.
std::optional<double> fortran_number(std::string_view text);

// Half a unit of the last written digit of a number, for example 5e-10 of "1.95313E-04".
double rounding_of(std::string_view number);

// Hexadecimal number of IBM 370 of 4 or 8 bytes: an exponent to the base 16 and a fraction.
double ibm_number(std::uint64_t raw, std::size_t width);

// F_floating number of DEC VAX, 4 bytes: two little-endian words, the more significant one first.
double dec_number(std::string_view bytes, std::size_t at);

}  // namespace gearpod::mc
