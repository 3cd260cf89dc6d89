#include "mc/files/formats/uff_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/formats/signal_error.hpp"
#include "mc/files/input/file_text.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/input/terminal_text.hpp"

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

namespace {

constexpr const char* kQuantities[] = {"unknown",
                                       "general",
                                       "stress",
                                       "strain",
                                       "4",
                                       "temperature",
                                       "heat flux",
                                       "7",
                                       "displacement",
                                       "reaction force",
                                       "10",
                                       "velocity",
                                       "acceleration",
                                       "excitation force",
                                       "14",
                                       "pressure",
                                       "mass",
                                       "time",
                                       "frequency",
                                       "rotational speed",
                                       "order",
                                       "sound pressure",
                                       "sound intensity",
                                       "sound power"};
constexpr const char* kFunctionKinds[] = {"general function",
                                          "time response",
                                          "auto spectrum",
                                          "cross spectrum",
                                          "frequency response function",
                                          "transmissibility",
                                          "coherence",
                                          "auto correlation",
                                          "cross correlation",
                                          "power spectral density",
                                          "energy spectral density",
                                          "probability density",
                                          "spectrum",
                                          "cumulative distribution",
                                          "peaks and valleys",
                                          "stress cycles",
                                          "strain cycles",
                                          "orbit",
                                          "mode indicator function",
                                          "force pattern",
                                          "partial power",
                                          "partial coherence",
                                          "eigenvalue",
                                          "eigenvector",
                                          "shock response spectrum",
                                          "impulse response filter",
                                          "multiple coherence",
                                          "order function",
                                          "phase compensation"};

// Formats of the values after the header of a dataset 58b.
enum class Floats { dec = 1, ieee = 2, ibm = 3 };

// Text without surrounding blanks; "NONE" means that a field is not used.
std::string stated_text(std::string_view text) {
    const std::string word(without_outer_blanks(text));
    return word == "NONE" ? "" : word;
}
std::string record_part(const std::string& line, std::size_t at,
                        std::size_t width = std::string::npos) {
    return at < line.size() ? line.substr(at, width) : std::string();
}

class UffReader {
  public:
    explicit UffReader(const std::string& path) : path_(path), stream_(path, std::ios::binary) {}

    std::vector<UffFunction> read() {
        std::vector<UffFunction> all;
        std::optional<double> lengths, first_lengths;
        std::string line, others;
        while (next(line)) {
            if (without_outer_blanks(line) != "-1" || !next(line)) {
                continue;
            }
            const std::string kind(without_outer_blanks(line.substr(0, 7)));
            if (kind == "58" || kind == "58b") {
                all.push_back(read_function(kind == "58b" ? line : ""));
                all.back().lengths_per_metre = lengths;
            } else if (kind == "164") {
                lengths = read_lengths();
                first_lengths = first_lengths ? first_lengths : lengths;
            } else {
                others += (others.empty() ? "" : ", ") + kind;
                skip();
            }
        }
        if (all.empty()) {
            throw SignalError(fmt::format(
                "{}: contains no measured function (dataset 58){}", path_,
                others.empty() ? "" : "; its datasets are " + printable(others.substr(0, 60))));
        }
        for (UffFunction& function : all) {
            if (!function.lengths_per_metre) {
                function.lengths_per_metre = first_lengths;
            }
        }
        return all;
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(fmt::format("{}:{}: {}", path_, line_, printable(why)));
    }
    bool next(std::string& line) {
        ++line_;
        return static_cast<bool>(std::getline(stream_, line));
    }
    void skip() {
        for (std::string line; next(line) && without_outer_blanks(line) != "-1";) {
        }
    }
    // After the last value.
    void end_dataset(std::size_t count) {
        for (std::string line; next(line);) {
            const std::string_view text = without_outer_blanks(line);
            if (text == "-1") {
                return;
            }
            if (!text.empty()) {
                refuse(fmt::format("more than the {} declared values are present", count));
            }
        }
    }
    double number(std::string_view text) const {
        text = without_outer_blanks(text);
        const auto value = fortran_number(text);
        if (!value) {
            refuse(fmt::format("\"{}\" is not a number", text.substr(0, 40)));
        }
        return *value;
    }
    double field(const std::string& line, std::size_t at, std::size_t width) const {
        return number(record_part(line, at, width));
    }
    int small_field(const std::string& line, std::size_t at, std::size_t width) const {
        const double value = field(line, at, width);
        if (!(std::abs(value) <= 1e6) || value != std::trunc(value)) {
            refuse(fmt::format("\"{}\" is not a valid code",
                               without_outer_blanks(record_part(line, at, width))));
        }
        return static_cast<int>(value);
    }

    // Dataset 164: the factors of length, force and temperature that convert SI to the file's
    // units.
    double read_lengths() {
        std::string names, factors;
        if (!next(names) || !next(factors)) {
            refuse("ends within a dataset 164 (units)");
        }
        const double lengths = field(factors, 0, 25);
        if (!(lengths > 0.0 && std::isfinite(lengths))) {
            refuse(fmt::format("{:g} is not a valid factor of length", lengths));
        }
        skip();
        return lengths;
    }

    UffAxis axis_of(const std::string& record) const {
        return {small_field(record, 0, 10), stated_text(record_part(record, 46, 21))};
    }

    // `binary`: first line of the dataset if its values are binary, else "".
    UffFunction read_function(const std::string& binary) {
        std::array<std::string, 11> records;
        for (std::string& record : records) {
            if (!next(record)) {
                refuse("ends within the header of a dataset 58");
            }
        }
        UffFunction function;
        function.title = stated_text(records[0]);
        function.function_type = small_field(records[5], 0, 5);
        const auto direction = fortran_number(without_outer_blanks(record_part(records[5], 51, 4)));
        function.response_direction = std::abs(direction.value_or(0.0)) <= 6.0
                                          ? static_cast<int>(direction.value_or(0.0))
                                          : 0;
        const std::string& form = records[6];
        const int type = small_field(form, 0, 10), spacing = small_field(form, 20, 10);
        const double count = field(form, 10, 10);
        if (type != 2 && type != 4 && type != 5 && type != 6) {
            refuse(fmt::format("{} is not a valid type of values (2, 4, 5 or 6)", type));
        }
        if (spacing != 0 && spacing != 1) {
            refuse(fmt::format("{} is not a valid spacing (0: uneven, 1: even)", spacing));
        }
        if (!(count >= 1.0 && count <= 1e9) || count != std::trunc(count)) {
            refuse(fmt::format("{:g} is not a valid number of values", count));
        }
        function.complex = type >= 5;
        function.even = spacing == 1;
        if (function.even) {
            function.first = field(form, 30, 13);
            function.step = field(form, 43, 13);
            function.step_rounding = rounding_of(without_outer_blanks(record_part(form, 43, 13)));
        }
        function.abscissa = axis_of(records[7]);
        function.ordinate = axis_of(records[8]);
        function.denominator = axis_of(records[9]);
        const auto values = static_cast<std::size_t>(count);
        const std::size_t width = type == 2 || type == 5 ? 4 : 8;
        if (!binary.empty()) {
            read_bytes(values, width, binary, function);
        } else {
            read_text(values, width, function);
        }
        return function;
    }

    // Numbers of a line: separated by blanks, or else in fields of the format's widths.
    std::vector<double> numbers(std::string_view line, std::span<const std::size_t> widths) const {
        std::vector<double> found;
        constexpr std::string_view kBlank = " \t\r";
        for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
            const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
            const auto value = fortran_number(line.substr(at, end - at));
            if (!value) {
                return numbers_by_width(line, widths);
            }
            found.push_back(*value);
            at = line.find_first_not_of(kBlank, end);
        }
        return found;
    }
    std::vector<double> numbers_by_width(std::string_view line,
                                         std::span<const std::size_t> widths) const {
        std::vector<double> found;
        line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t width = widths[found.size() % widths.size()];
            found.push_back(number(line.substr(at, width)));
            at += width;
        }
        return found;
    }

    // E13.5 for single precision and abscissae, E20.12 for double precision.
    void read_text(std::size_t count, std::size_t width, UffFunction& function) {
        std::vector<std::size_t> widths(function.complex ? 2 : 1, width == 4 ? 13 : 20);
        if (!function.even) {
            widths.insert(widths.begin(), 13);
        }
        std::size_t read = 0;
        for (std::string line; read < count * widths.size();) {
            if (!next(line) || without_outer_blanks(line) == "-1") {
                const std::string problem =
                    fmt::format("only {} of {} values are present", read / widths.size(), count);
                if (!function.complex) {
                    refuse(problem);
                }
                // Complex functions do not decide whether time histories are accepted.
                function.unreadable = problem;
                function.values.clear();
                function.abscissae.clear();
                function.imaginary.clear();
                return;
            }
            for (const double value : numbers(line, widths)) {
                if (read < count * widths.size()) {
                    const std::size_t place = read % widths.size() + (function.even ? 1 : 0);
                    (place == 0   ? function.abscissae
                     : place == 1 ? function.values
                                  : function.imaginary)
                        .push_back(value);
                    ++read;
                }
            }
        }
        end_dataset(count);
    }

    void read_bytes(std::size_t count, std::size_t width, const std::string& head,
                    UffFunction& function) {
        const int order = small_field(head, 7, 6), format = small_field(head, 13, 6);
        const double declared = field(head, 31, 12);
        const std::size_t values = function.complex ? 2 : 1;
        // Abscissae are in single precision; some programs write them as the values.
        std::size_t abscissa_width = function.even ? 0 : 4;
        if (!function.even && declared == static_cast<double>(count * width * (values + 1))) {
            abscissa_width = width;
        }
        const std::size_t row = abscissa_width + values * width;
        if (declared != 0.0 && declared != static_cast<double>(count * row)) {
            refuse(fmt::format("declares {:g} bytes, but its {} values take {}", declared, count,
                               count * row));
        }
        const std::string bytes = bytes_of(count, row);
        end_dataset(count);
        if (order != 1 && order != 2) {
            function.unreadable = fmt::format("{} is not a valid byte order (1 or 2)", order);
        } else if (format < 1 || format > 3) {
            function.unreadable = fmt::format("{} is not a valid format of binary numbers", format);
        } else if (format == static_cast<int>(Floats::dec) && (width == 8 || order == 2)) {
            function.unreadable =
                "its values are DEC VMS numbers of double precision or in reverse byte order, "
                "which are not supported";
        }
        if (!function.unreadable.empty()) {
            return;
        }
        const auto value_at = [&](std::size_t at, std::size_t size) {
            switch (static_cast<Floats>(format)) {
                case Floats::dec:
                    return dec_number(bytes, at);
                case Floats::ibm:
                    return ibm_number(unsigned_at(bytes, at, size, order == 2), size);
                case Floats::ieee:
                    break;
            }
            return ieee_at(bytes, at, size, order == 2);
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (abscissa_width > 0) {
                function.abscissae.push_back(value_at(i * row, abscissa_width));
            }
            function.values.push_back(value_at(i * row + abscissa_width, width));
            if (function.complex) {
                function.imaginary.push_back(value_at(i * row + abscissa_width + width, width));
            }
        }
    }

    // Reads in blocks: the count in the file may be wrong, and memory must not exceed the file's
    // size.
    std::string bytes_of(std::size_t count, std::size_t row) {
        std::string bytes;
        std::array<char, 65536> block;
        for (std::size_t left = count * row; left > 0 && stream_;) {
            stream_.read(block.data(), static_cast<std::streamsize>(std::min(left, block.size())));
            bytes.append(block.data(), static_cast<std::size_t>(stream_.gcount()));
            left -= static_cast<std::size_t>(stream_.gcount());
        }
        if (bytes.size() < count * row) {
            refuse(fmt::format("only {} of {} values are present", bytes.size() / row, count));
        }
        return bytes;
    }

    std::string path_;
    std::ifstream stream_;
    long line_ = 0;
};

std::string code_name(std::span<const char* const> names, int code, const char* what) {
    return code >= 0 && static_cast<std::size_t>(code) < names.size()
               ? names[static_cast<std::size_t>(code)]
               : fmt::format("{} {}", what, code);
}

}  // namespace

std::vector<UffFunction> read_uff(const std::string& path) {
    return UffReader(path).read();
}

std::string uff_quantity(int type) {
    return code_name(kQuantities, type, "specific data type");
}
std::string uff_function_kind(int type) {
    return code_name(kFunctionKinds, type, "function type");
}

}  // namespace gearpod::mc
