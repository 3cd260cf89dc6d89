// Recordings in the formats of other programs, written from the formats' specifications.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>

namespace gearpod::test {

inline void append_number(std::string& bytes, std::uint64_t value, int count, bool big = false) {
    for (int i = 0; i < count; ++i) {
        bytes += static_cast<char>(value >> (8 * (big ? count - 1 - i : i)) & 255);
    }
}

enum class WavForm { whole_8, whole_16, whole_24, whole_32, floating_32, floating_64 };

// RIFF WAVE file: the values of all `channels` at one time are adjacent, each from -1 to 1; integer
// formats round.
inline std::string wav_bytes(std::span<const double> values, int channels, std::uint32_t rate_Hz,
                             WavForm form) {
    constexpr int kBits[] = {8, 16, 24, 32, 32, 64};
    const int bits = kBits[static_cast<int>(form)], width = bits / 8;
    const bool whole = form < WavForm::floating_32;
    std::string data;
    for (const double value : values) {
        if (form == WavForm::floating_32) {
            append_number(data, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
        } else if (form == WavForm::floating_64) {
            append_number(data, std::bit_cast<std::uint64_t>(value), 8);
        } else {
            const long long scaled = std::llround(value * std::ldexp(1.0, bits - 1));
            append_number(data, static_cast<std::uint64_t>(bits == 8 ? scaled + 128 : scaled),
                          width);
        }
    }
    std::string format = "fmt ";
    append_number(format, 16, 4);
    append_number(format, whole ? 1 : 3, 2);
    append_number(format, static_cast<std::uint64_t>(channels), 2);
    append_number(format, rate_Hz, 4);
    append_number(format, std::uint64_t{rate_Hz} * static_cast<std::uint64_t>(channels * width), 4);
    append_number(format, static_cast<std::uint64_t>(channels * width), 2);
    append_number(format, static_cast<std::uint64_t>(bits), 2);
    std::string head = "RIFF";
    append_number(head, 4 + format.size() + 8 + data.size(), 4);
    head += "WAVE" + format + "data";
    append_number(head, data.size(), 4);
    return head + data;
}

enum class UffForm { text_single, text_double, bytes_little, bytes_big };

// Universal file with one dataset 58 (58b for binary values): an evenly spaced real time history.
inline std::string uff_bytes(std::span<const double> values, double step_s, const std::string& unit,
                             UffForm form) {
    const bool binary = form == UffForm::bytes_little || form == UffForm::bytes_big;
    const bool big = form == UffForm::bytes_big;
    const int type = form == UffForm::text_single ? 2 : 4;
    std::string text = "    -1\n    58";
    if (binary) {
        text += fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", big ? 2 : 1, 2, 11,
                            8 * values.size(), 0, 0, 0, 0);
    }
    text += "\ntitle\nNONE\n22-Nov-26 12:00:00\nNONE\nNONE\n";
    text += fmt::format("{:5}{:10}{:5}{:10} {:>10}{:10}{:4} {:>10}{:10}{:4}\n", 1, 1, 1, 0, "NONE",
                        1, 1, "NONE", 0, 0);
    text += fmt::format("{:10}{:10}{:10}{:13.5e}{:13.5e}{:13.5e}\n", type, values.size(), 1, 0.0,
                        step_s, 0.0);
    const auto axis = [](int kind, const std::string& name, const std::string& of) {
        return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", kind, 0, 0, 0, name, of);
    };
    text += axis(17, "Time", "s") + axis(12, "Acceleration", unit) + axis(0, "NONE", "NONE") +
            axis(0, "NONE", "NONE");
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (binary) {
            append_number(text, std::bit_cast<std::uint64_t>(values[i]), 8, big);
        } else {
            text += type == 2 ? fmt::format("{:13.5e}", values[i])
                              : fmt::format("{:20.11e}", values[i]);
            const std::size_t a_line = type == 2 ? 6 : 4;
            text += i % a_line + 1 == a_line || i + 1 == values.size() ? "\n" : "";
        }
    }
    return text + (binary ? "\n" : "") + "    -1\n";
}

}  // namespace gearpod::test
