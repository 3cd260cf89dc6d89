// Universal files of measured functions: dataset 58 of SDRC's I-DEAS, as text or with binary values
// (58b), and the units of dataset 164. Source: University of Cincinnati, SDRL, "Universal File
// Formats for Modal Analysis Testing".
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Kind and unit of an axis.
struct UffAxis {
    int type = 0;      // specific data type, for example 12: acceleration
    std::string unit;  // label of the units; "" if not stated
};

struct UffFunction {
    std::string title;           // first line of the identification
    int function_type = 0;       // 1: time response
    int response_direction = 0;  // 1 to 3: translation, 4 to 6: rotation
    UffAxis abscissa, ordinate, denominator;
    bool complex = false;
    bool even = true;                       // false: `abscissae` has a value for each of `values`
    double first = 0.0, step = 0.0;         // abscissa of an even function
    double step_rounding = 0.0;             // half a unit of the last written digit of the step
    std::vector<double> values, abscissae;  // both empty if `unreadable` is set
    std::vector<double> imaginary;          // of complex values, of which `values` is the real part
    std::string unreadable;                 // reason why the values cannot be interpreted
    // Number of the file's units of length in a metre (dataset 164), if stated before the function,
    // or else anywhere in the file.
    std::optional<double> lengths_per_metre;
};

// Endings of the names of universal files, in lower case.
inline constexpr std::string_view kUffEndings[] = {".uff", ".unv", ".uf58", ".uf", ".ufb"};

// Functions in the order of the file. Throws SignalError (signal_error.hpp) if there are none, or
// if the file is damaged.
std::vector<UffFunction> read_uff(const std::string& path);

// Name of a specific data type, for example "velocity".
std::string uff_quantity(int type);
// Name of a function type, for example "frequency response function".
std::string uff_function_kind(int type);

}  // namespace gearpod::mc
