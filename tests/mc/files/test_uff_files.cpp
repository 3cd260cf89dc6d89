// Checks universal files: values, units, and functions other than time histories.
#include "mc/files/signal_units.hpp"
#include "tests/mc/files/recorded.hpp"
#include "tests/mc/recording_bytes.hpp"

namespace test_uff_files {

using namespace gearpod;
using namespace gearpod::test;

namespace {

using Catch::Contains;
using Names = std::vector<std::string>;
using Values = std::vector<double>;

// Dataset 58; `data` are the lines or bytes after the header.
struct Dataset {
    std::string title = "NONE", binary;
    int function = 1, direction = 0, type = 2, count = 4, spacing = 1, abscissa = 17, quantity = 12;
    double start = 0.0, step = 0.5;
    std::string abscissa_unit = "s", unit = "g", denominator = "NONE";
    std::string data = "  1.00000e+00 -2.00000e+00  3.50000e+00  4.00000e+00\n";

    std::string bytes() const {
        const auto axis = [](int kind, const std::string& unit_label) {
            return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", kind, 0, 0, 0, "NONE",
                               unit_label);
        };
        return fmt::format("    -1\n    58{}\n{}\nNONE\nNONE\nNONE\nNONE\n", binary, title) +
               fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}\n", function, 1, 1,
                           0, "NONE", 1, direction, "NONE", 0, 0) +
               fmt::format("{:10}{:10}{:10}{:13.5e}{:13.5e}{:13.5e}\n", type, count, spacing, start,
                           step, 0.0) +
               axis(abscissa, abscissa_unit) + axis(quantity, unit) + axis(0, denominator) +
               axis(0, "NONE") + data + "    -1\n";
    }
};

std::string lengths(double factor, const std::string& name = "5mm (milli newton)") {
    std::string numbers = fmt::format("{:25.17e}{:25.17e}{:25.17e}\n", factor, factor, 1.0);
    std::ranges::replace(numbers, 'e', 'D');
    return fmt::format("    -1\n   164\n{:>10}{:<19}{:10}\n{}{:25.17e}\n    -1\n",
                       name.substr(0, 1), name.substr(1), 2, numbers, 273.15);
}

std::unique_ptr<mc::SignalFile> uff(const Folder& folder, const std::string& bytes) {
    return mc::open_signal_file(file_with(folder, "a.uff", bytes));
}
std::string uff_error(const Folder& folder, const std::string& bytes) {
    return reading_error(file_with(folder, "a.uff", bytes));
}

TEST_CASE("a universal file gives its function, its step and its unit, as text and as bytes") {
    const Folder folder;
    const std::vector<double> values = sine_values(1001, 30.0);
    const std::pair<UffForm, double> forms[] = {{UffForm::text_single, 5e-5},
                                                {UffForm::text_double, 5e-11},
                                                {UffForm::bytes_little, 0.0},
                                                {UffForm::bytes_big, 0.0}};
    for (const auto& [form, rounding] : forms) {
        const auto file = uff(folder, uff_bytes(values, 2e-4, "m/s^2", form));
        REQUIRE(file->names() == Names{"sensor"});
        CHECK(file->sampling_Hz() == Approx(5000.0));
        CHECK(file->unit("sensor") == "m/s^2");
        CHECK(largest_difference(file->read("sensor"), values) <= rounding);
    }
}

TEST_CASE("numbers of universal files may be written as Fortran does") {
    const Folder folder;
    Dataset set;
    set.type = 4;
    set.data = "   1.00000000000D+00  -2.00000000000d+00   3.50000000000-101   4.00000000000+100\n";
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{1, -2, 3.5e-101, 4e100});
    // Without blanks between them.
    set.type = 2;
    set.data = "-1.00000E+000-2.00000E+000-3.50000E+000-4.00000E+000          \r\n";
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{-1, -2, -3.5, -4});
    set.data = "  1.0e+00  2.x\n";
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("a.uff:14: "));
    set.data = "1.0 2.0 3.0 4.0\n5.0 6.0\n";
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("more than the 4 declared values"));
    set.data = "1.0 2.0 3.0\n";
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("only 3 of 4 values are present"));
}

TEST_CASE("binary numbers of IBM and DEC are read, other formats are refused by name") {
    const Folder folder;
    Dataset set;
    const auto head = [](int order, int format, int bytes) {
        return fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", order, format, 11, bytes, 0, 0,
                           0, 0);
    };
    set.count = 3;
    set.binary = head(2, 3, 12);
    // 1, -118.625 and 0.5 of IBM 370.
    set.data = std::string("\x41\x10\0\0\xC2\x76\xA0\0\x40\x80\0\0", 12) + "\n";
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{1, -118.625, 0.5});
    set.binary = head(1, 3, 12);
    set.data = std::string("\0\0\x10\x41\0\xA0\x76\xC2\0\0\x80\x40", 12) + "\n";
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{1, -118.625, 0.5});
    // 1, -2.5 and 0 of DEC VAX.
    set.binary = head(1, 1, 12);
    set.data = std::string("\x80\x40\0\0\x20\xC1\0\0\0\0\0\0", 12);
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{1, -2.5, 0});
    set.binary = head(2, 1, 12);
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("column sensor: its values are DEC VMS"));
    set.binary = head(1, 4, 12);
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("4 is not a valid format of binary"));
    set.binary = head(1, 2, 16);
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("declares 16 bytes, but its 3 values"));
}

TEST_CASE("dataset 164 gives the unit of accelerations without a unit of their own") {
    const Folder folder;
    Dataset set;
    const auto unit = [&](const std::string& before) {
        return uff(folder, before + set.bytes())->unit("sensor");
    };
    set.unit = "NONE";
    CHECK(unit("").empty());
    CHECK(unit(lengths(1.0, "1SI: meter")) == "m/s^2");
    CHECK(unit(lengths(1000.0)) == "mm/s^2");
    CHECK(unit(lengths(39.37007874015748)) == "in/s^2");
    CHECK_THAT(unit(lengths(17.0)), Contains("1/17 of m/s^2, by dataset 164"));
    // The latest one before the function counts; one after all functions counts for all.
    CHECK(unit(lengths(1.0) + lengths(1000.0)) == "mm/s^2");
    CHECK(uff(folder, set.bytes() + lengths(1000.0))->unit("sensor") == "mm/s^2");
    set.direction = 4;
    CHECK(unit(lengths(1000.0)) == "rad/s^2");
    set.direction = 1;
    set.quantity = 0;
    CHECK(unit(lengths(1.0)).empty());
    CHECK_THAT(unit(lengths(1000.0)), Contains("not stated, with 1000 units of length per metre"));
}

TEST_CASE("a label that contradicts dataset 164 is not taken as a unit") {
    const Folder folder;
    Dataset set;
    const auto unit = [&](double factor) {
        return uff(folder, lengths(factor) + set.bytes())->unit("sensor");
    };
    set.unit = "mm/s^2";
    CHECK(unit(1000.0) == "mm/s^2");
    CHECK(unit(1.0) == "mm/s^2 by the function's label, but m/s^2 by dataset 164");
    set.unit = "g";
    CHECK(unit(1.0) == "g");
    CHECK_THAT(unit(1000.0), Contains("g by the function's label, but mm/s^2 by dataset 164"));
    for (const char* label : {"m/s^2", "g", "m/s2 (peak)"}) {
        set.unit = label;
        CHECK_FALSE(mc::unit_factor(mc::Quantity::acceleration, unit(1000.0)));
    }
    set.unit = "NONE";
    for (const int quantity : {0, 1, 12}) {
        set.quantity = quantity;
        CHECK_FALSE(mc::unit_factor(mc::Quantity::acceleration, unit(17.0)));
    }
}

TEST_CASE("quantities other than acceleration are named instead of a unit of acceleration") {
    const Folder folder;
    Dataset set;
    const auto unit = [&](int quantity, const std::string& label) {
        set.quantity = quantity;
        set.unit = label;
        return uff(folder, set.bytes())->unit("sensor");
    };
    CHECK(unit(11, "m/s^2") == "velocity in m/s^2, ordinate data type 11");
    CHECK(unit(11, "NONE") == "velocity, ordinate data type 11");
    CHECK(unit(8, "mm") == "displacement in mm, ordinate data type 8");
    CHECK(unit(13, "N") == "excitation force in N, ordinate data type 13");
    CHECK(unit(21, "Pa") == "sound pressure in Pa, ordinate data type 21");
    CHECK(unit(1, "m/s^2") == "m/s^2");
    CHECK(unit(0, "g") == "g");
    CHECK(unit(8, "rad") == "rad");
    CHECK(unit(11, "rad/s") == "rad/s");
    CHECK(unit(19, "NONE") == "rpm");
    for (const int quantity : {2, 3, 5, 8, 9, 11, 13, 15, 21, 99}) {
        for (const char* label : {"NONE", "m/s^2", "g", "m/s", "N"}) {
            INFO(quantity << " " << label);
            CHECK_FALSE(mc::unit_factor(mc::Quantity::acceleration, unit(quantity, label)));
        }
    }
    set.denominator = "N";
    CHECK(unit(12, "m/s^2") == "m/s^2 per N by the function's denominator");
    CHECK_FALSE(mc::unit_factor(mc::Quantity::acceleration, unit(12, "m/s^2")));
}

TEST_CASE("functions other than time histories do not decide whether a file is accepted") {
    const Folder folder;
    Dataset set, response, spectrum;
    response.function = 4;
    response.type = 5;
    response.count = 2;
    response.abscissa = 18;
    spectrum = response;
    spectrum.function = 9;
    spectrum.binary =
        fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", 1, 2, 11, 16, 0, 0, 0, 0);
    spectrum.data = std::string(4, '\0') + "\n-1\n" + std::string(8, '\0');
    const std::string others = response.bytes() + spectrum.bytes();
    const auto file = uff(folder, others + set.bytes());
    CHECK(file->names() == Names{"sensor"});
    CHECK(file->read("sensor") == Values{1, -2, 3.5, 4});
    CHECK(uff_error(folder, others) ==
          folder.file("a.uff") +
              ": contains no real time history; its functions are: frequency response function, "
              "power spectral density");
    CHECK_THAT(uff_error(folder, "    -1\n    15\n1\n    -1\n    -1\n    82\n    -1\n"),
               Contains("contains no measured function (dataset 58); its datasets are 15, 82"));
    set.type = 5;
    CHECK_THAT(uff_error(folder, set.bytes()), Contains("complex time response"));
}

TEST_CASE("several functions are columns by place and by title") {
    const Folder folder;
    Dataset first, second, third;
    first.title = "sensor";
    second.title = third.title = "Mic";
    second.data = "5 6 7 8\n";
    second.step = 0.25;
    third.start = 3.0;
    const std::string bytes = first.bytes() + second.bytes() + third.bytes();
    const auto file = uff(folder, bytes);
    CHECK(file->names() == Names{"function1", "function2", "function3"});
    CHECK(file->contents() == "function1 (sensor), function2 (Mic), function3 (Mic)");
    CHECK(file->find({"sensor"}) == "function1");
    CHECK(file->find({"Mic", "", false}).empty());
    CHECK_THROWS_WITH(file->find({"Mic"}), Contains("several functions: function2, function3"));
    CHECK(file->read("function1") == Values{1, -2, 3.5, 4});
    CHECK(file->sampling_Hz() == 2.0);
    CHECK_THROWS_WITH(file->read("function2"), Contains("have different time steps"));
    CHECK_THROWS_WITH(file->read("function3"), Contains("start at different times"));
    const auto other = uff(folder, bytes);
    CHECK(other->read("function2") == Values{5, 6, 7, 8});
    CHECK(other->sampling_Hz() == 4.0);
}

TEST_CASE("stored abscissae are the column time, and steps have a unit") {
    const Folder folder;
    Dataset set;
    set.spacing = 0;
    set.count = 3;
    set.data = " 1.00000E+00 5.00000E+00 1.50000E+00 6.00000E+00 2.00000E+00 7.00000E+00\n";
    const auto file = uff(folder, set.bytes());
    CHECK(file->names() == Names{"sensor", "time"});
    CHECK(file->read("sensor") == Values{5, 6, 7});
    CHECK(file->read("time") == Values{1, 1.5, 2});
    CHECK(file->unit("time") == "s");
    // Double precision has abscissae of single precision.
    set.type = 4;
    set.data =
        "  1.00000E+00  5.00000000000E+00  1.50000E+00  6.00000000000E+00\n"
        "  2.00000E+00  7.00000000000E+00\n";
    CHECK(uff(folder, set.bytes())->read("sensor") == Values{5, 6, 7});
    std::string raw;
    for (const double value : {1.0, 5.0, 1.5, 6.0, 2.0, 7.0}) {
        const bool time = value <= 2.0;
        append_number(raw,
                      time ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                           : std::bit_cast<std::uint64_t>(value),
                      time ? 4 : 8);
    }
    set.binary = fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", 1, 2, 11, 36, 0, 0, 0, 0);
    set.data = raw;
    const auto binary = uff(folder, set.bytes());
    CHECK(binary->read("sensor") == Values{5, 6, 7});
    CHECK(binary->read("time") == Values{1, 1.5, 2});
    Dataset even;
    even.abscissa_unit = "ms";
    CHECK(uff(folder, even.bytes())->sampling_Hz() == Approx(2000.0));
    even.abscissa_unit = "furlong";
    CHECK_THAT(uff_error(folder, even.bytes()),
               Contains("furlong is not a known unit of its times"));
    even.abscissa_unit = "NONE";
    even.step = 0.0;
    CHECK_THAT(uff_error(folder, even.bytes()), Contains("0 s is not a valid time step"));
}

TEST_CASE("a rounded step gives the whole rate that it was rounded from") {
    const Folder folder;
    Dataset set;
    const auto rate = [&](double step) {
        set.step = step;
        return uff(folder, set.bytes())->sampling_Hz();
    };
    CHECK(rate(1.95313e-4) == 5120.0);
    const auto file = uff(folder, set.bytes());
    CHECK(file->read("sensor").size() == 4);
    CHECK(file->notes() ==
          Names{"the rate is 5120 Hz, which rounds to the time step 0.000195313 s"});
    CHECK(rate(1.52588e-5) == 65536.0);
    CHECK(rate(3.90625e-5) == 25600.0);
    CHECK(rate(1.23456e-3) == Approx(1.0 / 1.23456e-3).epsilon(1e-14));
    CHECK(rate(1.00000e-6) == Approx(1e6).epsilon(1e-14));
    CHECK(rate(2.5) == Approx(0.4));
}

TEST_CASE("a truncated universal file is refused with the place") {
    const Folder folder;
    const std::vector<double> values = sine_values(100, 0.5);
    for (const UffForm form : {UffForm::text_double, UffForm::bytes_little}) {
        const std::string bytes = uff_bytes(values, 2e-4, "g", form);
        CHECK_THAT(uff_error(folder, bytes.substr(0, bytes.size() / 2)), Contains("of 100"));
    }
}

}  // namespace

}  // namespace test_uff_files
