// Checks frequency responses of universal files as lists of numbers: text and binary, even and
// uneven, units, and what is refused.
#include <fmt/format.h>

#include "mc/files/input/problems.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/recording_bytes.hpp"
#include "tests/test.hpp"

namespace gearpod::test_uff_response {

using Catch::Contains;
using namespace gearpod::test;

// Response of one mode at the sensor, as an acceleration ratio.
std::complex<double> response_at(double frequency_Hz) {
    const double r = frequency_Hz / 200.0;
    return 1.0 + 2.0 * r * r / std::complex<double>(1.0 - r * r, 2.0 * 0.05 * r);
}

struct Form {
    bool even = true, binary = false;
    int above = 12, below = 12;  // data types
    std::string above_unit = "m/s^2", below_unit = "m/s^2";
    int function_type = 4, abscissa = 18;
};

constexpr int kPoints = 5;
constexpr double kStep_Hz = 80.0;

std::string dataset(const Form& form) {
    std::string text = "    -1\n    58";
    const std::size_t row = form.even ? 16 : 20;
    if (form.binary) {
        text += fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", 1, 2, 11, row * kPoints, 0, 0,
                            0, 0);
    }
    text += "\nhammer test\nNONE\n22-Nov-26 12:00:00\nNONE\nNONE\n";
    text += fmt::format("{:5}{:10}{:5}{:10} {:>10}{:10}{:4} {:>10}{:10}{:4}\n", form.function_type,
                        1, 1, 0, "NONE", 1, 1, "NONE", 0, 0);
    text += fmt::format("{:10}{:10}{:10}{:13.5e}{:13.5e}{:13.5e}\n", 6, kPoints, form.even ? 1 : 0,
                        0.0, kStep_Hz, 0.0);
    const auto axis = [](int kind, const std::string& name, const std::string& unit) {
        return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", kind, 0, 0, 0, name, unit);
    };
    text += axis(form.abscissa, "Frequency", "Hz") + axis(form.above, "Response", form.above_unit) +
            axis(form.below, "Reference", form.below_unit) + axis(0, "NONE", "NONE");
    for (int i = 0; i < kPoints; ++i) {
        const std::complex<double> value = response_at(kStep_Hz * i);
        if (form.binary) {
            if (!form.even) {
                append_number(text, std::bit_cast<std::uint32_t>(float(kStep_Hz * i)), 4);
            }
            append_number(text, std::bit_cast<std::uint64_t>(value.real()), 8);
            append_number(text, std::bit_cast<std::uint64_t>(value.imag()), 8);
        } else {
            text += (form.even ? "" : fmt::format("{:13.5e}", kStep_Hz * i)) +
                    fmt::format("{:20.11e}{:20.11e}", value.real(), value.imag());
            text += form.even && i % 2 == 0 && i + 1 < kPoints ? "" : "\n";
        }
    }
    return text + (form.binary ? "\n" : "") + "    -1\n";
}

std::string file_of(const Folder& folder, const std::string& text) {
    const std::string path = folder.file("hammer.unv");
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

TEST_CASE("Responses of universal files have frequency, gain and phase") {
    const Folder folder;
    for (const bool even : {true, false}) {
        for (const bool binary : {false, true}) {
            INFO(even << " " << binary);
            const std::string path = file_of(folder, dataset({.even = even, .binary = binary}));
            const auto frequency = mc::uff_response_column(path, "frequency"),
                       gain = mc::uff_response_column(path, "gain"),
                       phase = mc::uff_response_column(path, "phase");
            REQUIRE(gain.size() == kPoints);
            for (std::size_t i = 0; i < kPoints; ++i) {
                const auto expected = response_at(kStep_Hz * static_cast<double>(i));
                CHECK(frequency[i] == Approx(kStep_Hz * static_cast<double>(i)));
                CHECK(gain[i] == Approx(std::abs(expected)).epsilon(1e-9));
                CHECK(phase[i] ==
                      Approx(std::arg(expected) * 180.0 / std::numbers::pi).margin(1e-7));
            }
        }
    }
}

TEST_CASE("Units above and below the fraction line are converted") {
    const Folder folder;
    const std::string path = file_of(folder, dataset({.above_unit = "g", .below_unit = "m/s^2"}));
    CHECK(mc::uff_response_column(path, "gain")[1] ==
          Approx(9.80665 * std::abs(response_at(kStep_Hz))).epsilon(1e-9));
}

TEST_CASE("Responses of bearings are accelerations over forces") {
    const Folder folder;
    const auto gain = [&](const std::string& text) {
        return mc::uff_response_column(file_of(folder, text), "gain", mc::ResponseTo::force);
    };
    const double expected = std::abs(response_at(kStep_Hz));
    CHECK(gain(dataset({.below = 13, .below_unit = "N"}))[1] == Approx(expected).epsilon(1e-9));
    CHECK(gain(dataset({.below = 13, .above_unit = "g", .below_unit = "kN"}))[1] ==
          Approx(9.80665e-3 * expected).epsilon(1e-9));
    CHECK_THROWS_WITH(gain(dataset({})), Contains("a bearing needs acceleration over force"));
    CHECK_THROWS_WITH(gain(dataset({.below = 13, .below_unit = "lbf"})),
                      Contains("excitation force in lbf"));
    const std::string path = file_of(folder, dataset({.below = 13, .below_unit = "N"}));
    const auto column = [&](const std::string& name) {
        return "{file='" + path + "', column='" + name + "'}";
    };
    const auto reading =
        mc::read_study(kSmall, {"sensor.response_Hz=" + column("frequency"),
                                "sensor.response_gain=" + column("gain"),
                                "sensor.sun_response_gain=" + column("gain"),
                                "sensor.sun_response_phase_deg=" + column("phase")});
    // Only the response of the housing needs a ratio of accelerations.
    CHECK(contains(mc::format(reading.problems), "the housing needs"));
    CHECK_FALSE(contains(mc::format(reading.problems), "a bearing needs"));
}

TEST_CASE("Responses that are no ratio of accelerations are refused with the reason") {
    const Folder folder;
    const auto refused = [&](const std::string& text, const std::string& column,
                             const std::string& reason) {
        CHECK_THROWS_WITH(mc::uff_response_column(file_of(folder, text), column), Contains(reason));
    };
    refused(dataset({.below = 13, .below_unit = "N"}), "gain",
            "acceleration in m/s^2 over excitation force in N");
    refused(dataset({.above_unit = "counts"}), "gain", "needs acceleration over acceleration");
    refused(dataset({.abscissa = 17}), "frequency", "must be a frequency in Hz");
    refused(dataset({.function_type = 6}), "gain", "contains no frequency response");
    refused(dataset({}), "amplitude", "its columns are frequency, gain, phase");
    refused(dataset({}) + dataset({}), "gain", "frequency 1, gain 1, phase 1, frequency 2");
    CHECK(mc::uff_response_column(file_of(folder, dataset({}) + dataset({})), "gain 2").size() ==
          kPoints);
}

TEST_CASE("A study reads its housing from a universal file") {
    const Folder folder;
    const std::string path = file_of(folder, dataset({}));
    const auto column = [&](const std::string& name) {
        return "={file=\"" + path + "\", column=\"" + name + "\"}' ";
    };
    check_mentions(
        require_success("describe " + kSmall + " --set 'sensor.response_Hz" + column("frequency") +
                        "--set 'sensor.response_gain" + column("gain") +
                        "--set 'sensor.response_phase_deg" + column("phase")),
        {"measured at 5 frequencies from 0 to 320 Hz"});
    check_refused("describe " + kSmall + " --set 'sensor.background_Hz" + column("frequency"),
                  {"only frequency responses are read"});
}

}  // namespace gearpod::test_uff_response
