// Checks that every usual spelling of a unit is converted, and that other units are refused.
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_units.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_signal_units {

// Checks spellings that are separated by bars.
void check_spellings(Quantity quantity, double factor, const std::string& spellings) {
    std::istringstream stream(spellings);
    for (std::string unit; std::getline(stream, unit, '|');) {
        INFO(unit);
        const UnitReading reading = read_unit(quantity, unit);
        INFO(reading.problem);
        REQUIRE(reading.factor.has_value());
        CHECK(*reading.factor == factor);
        CHECK(reading.remark.empty());
        CHECK(is_unit(unit));
    }
}

TEST_CASE("Spellings of acceleration units are read") {
    check_spellings(Quantity::acceleration, 1.0,
                    "m/s^2|m/s**2|m/s2|m/s²|m s^-2|m s-2|m·s⁻²|m*s^-2|m.s-2|m/s/s|m/sec^2|m/sec2|"
                    "M/S**2|m / s^2|m/(s^2)|m/(s*s)|m/s^{2}|m s^{-2}|[m/s^2]|(m/s²)|m/s\xB2|"
                    "m\xB7s^-2|m/sÂ²|m∕s²|m\xC2\xA0s⁻²|m s⁻²|m s**-2| m/s^2 |meter/sec²|"
                    "meters per second squared|metre per second^2|m⋅s⁻²");
}

TEST_CASE("Factors of units are exact") {
    check_spellings(Quantity::acceleration, 1e-3, "mm/s^2|mm/s**2|mm/s²|MM/SEC2");
    check_spellings(Quantity::acceleration, 9.80665, "g|G|gn|g_n|g0");
    check_spellings(Quantity::acceleration, 9.80665e-3, "mg");
    check_spellings(Quantity::acceleration, 0.3048, "ft/s^2|ft/sec²");
    check_spellings(Quantity::time, 1.0, "s|sec|Sec|seconds|S|sec.|Second");
    check_spellings(Quantity::time, 1e-3, "ms|msec|milliseconds");
    check_spellings(Quantity::time, 1e-6, "us|µs|μs|\xB5s|usec");
    check_spellings(Quantity::time, 60.0, "min");
    check_spellings(Quantity::speed, 1.0,
                    "rpm|RPM|1/min|min^-1|min-1|min⁻¹|r/min|rev/min|U/min|/min|turns/"
                    "min|revolutions per minute");
    check_spellings(Quantity::speed, 60.0, "Hz|HZ|rev/s|rps");
    check_spellings(Quantity::speed, 60e3, "kHz");
    check_spellings(Quantity::speed, 30.0 / std::numbers::pi, "rad/s|rad s^-1|rad·s⁻¹");
    check_spellings(Quantity::angle, 1.0, "rad|radians|RAD");
    check_spellings(Quantity::angle, 1e-6, "urad|µrad|μrad");
    check_spellings(Quantity::angle, std::numbers::pi / 180.0, "deg|degrees|Degree|°|\xB0|º|Â°");
    check_spellings(Quantity::angle, 2.0 * std::numbers::pi, "turns|rev|revolutions");
    check_spellings(Quantity::voltage, 1e-3, "mV|millivolts");
    check_spellings(Quantity::voltage, 1.0, "V|volts|Volt");
    CHECK(unit_factor(Quantity::phase, "mesh periods") == 1.0);
    CHECK(unit_factor(Quantity::phase, "1") == 1.0);
    CHECK(unit_factor(Quantity::time, "seconds since 1970-01-01 00:00:00") == 1.0);
    for (const char* none : {"", "none", "NONE", "n/a"}) {
        CHECK(unit_factor(Quantity::acceleration, none) == 1.0);
    }
}

TEST_CASE("Units of other quantities and unknown units are refused by name") {
    const auto problem = [](Quantity quantity, const char* unit) {
        const UnitReading reading = read_unit(quantity, unit);
        CHECK(!reading.factor);
        return reading.problem;
    };
    CHECK(test::contains(problem(Quantity::acceleration, "mm/s"),
                         "mm/s is not that of an acceleration"));
    CHECK(
        problem(Quantity::acceleration, "rear") ==
        "unknown unit rear; known units are m/s^2, mm/s^2, cm/s^2, um/s^2, ft/s^2, in/s^2, g, mg");
    CHECK(test::contains(problem(Quantity::acceleration, "V"), "not that of an acceleration"));
    // One per second may be turns or radians per second; an M before V is not that of mV.
    CHECK(!problem(Quantity::speed, "1/s").empty());
    CHECK(!problem(Quantity::voltage, "MV").empty());
    for (const char* unit :
         {"m/s^", "m//s", "m^-2/s", "nm/s^2", "ug", "m/s^2)", "(m/s", "m/s^99", "2 m/s^2", "1", "*",
          "g g", "m^2/s^2", "\xFF\xFE", "((((((((((m))))))))))/s^2 x"}) {
        INFO(unit);
        CHECK(!problem(Quantity::acceleration, unit).empty());
    }
    // The message is UTF-8 whatever the file contains.
    const std::string text = problem(Quantity::acceleration, "m/s\xB3");
    CHECK(test::contains(text, "m/s³"));
    CHECK(utf8_text(text) == text);
}

TEST_CASE("A remark after a unit is named, or refused if it changes the values") {
    for (const char* unit : {"g (peak)", "g [peak]", "g pk", "g (0-pk)", "G_peak", "g, peak"}) {
        INFO(unit);
        const UnitReading reading = read_unit(Quantity::acceleration, unit);
        CHECK(reading.factor == 9.80665);
        CHECK(!reading.remark.empty());
        CHECK(is_unit(unit));
        CHECK((plain_unit(unit) == "g" || plain_unit(unit) == "G"));
    }
    CHECK(read_unit(Quantity::time, "ms (rel)").factor == 1e-3);
    CHECK(read_unit(Quantity::speed, "Hz (shaft)").remark == "shaft");
    for (const char* unit : {"g (rms)", "g rms", "g RMS", "m/s^2 (pk-pk)", "g p-p",
                             "g (peak to peak)", "g (dB)", "g (x10)", "g (1e-3)"}) {
        INFO(unit);
        const UnitReading reading = read_unit(Quantity::acceleration, unit);
        CHECK(!reading.factor);
        CHECK(test::contains(reading.problem, "instantaneous"));
    }
    for (const char* place : {"rear", "gearbox", "front left", "sensor 1", "x", ""}) {
        INFO(place);
        CHECK(!is_unit(place));
    }
    for (const char* other : {"mm", "N", "°C", "%", "kN m", "bar"}) {
        INFO(other);
        CHECK(is_unit(other));
    }
}

TEST_CASE("A sensitivity is a voltage per acceleration") {
    CHECK(*sensor_sensitivity("100 mV/g") == Approx(0.1 / 9.80665).epsilon(1e-15));
    CHECK(*sensor_sensitivity("100mV/g") == Approx(0.1 / 9.80665).epsilon(1e-15));
    CHECK(*sensor_sensitivity("10.2 mV/(m/s^2)") == Approx(0.0102).epsilon(1e-15));
    CHECK(*sensor_sensitivity("10.2 mV/m/s²") == Approx(0.0102).epsilon(1e-15));
    CHECK(*sensor_sensitivity("1 V/(m/s**2)") == 1.0);
    CHECK(*sensor_sensitivity("2 mV s^2/m") == Approx(0.002).epsilon(1e-15));
    for (const char* text : {"", "100", "mV/g", "100 mV", "100 g/V", "-100 mV/g", "0 mV/g",
                             "nan mV/g", "inf mV/g", "1e-320 mV/g", "100 mV/g extra"}) {
        INFO(text);
        CHECK(!sensor_sensitivity(text));
    }
}

TEST_CASE("Text of any bytes becomes UTF-8, and UTF-8 stays") {
    CHECK(utf8_text("m/s²") == "m/s²");
    CHECK(utf8_text("m/s\xB2") == "m/s²");
    CHECK(utf8_text("\xED\xA0\x80") == "í\u00a0\u0080");  // a surrogate is not a character
    CHECK(utf8_text("\xC0\xAF\xF0\x9F\x98\x80") == "À¯😀");
    CHECK(printable("a\xB2\x1b[2J\n") == "a²?[2J ");
}

}  // namespace gearpod::mc::test_signal_units

// Checks which of the unit in the file, --sensor-unit and --sensor-sensitivity counts.

namespace gearpod::mc::test_column_factor {

constexpr double kStandardGravity = 9.80665;  // m/s^2

ColumnFactor sensor(const std::string& stated, const SensorUnit& options) {
    return column_factor(stated, Quantity::acceleration, options);
}

TEST_CASE("--sensor-unit takes precedence over the file, which is reported") {
    CHECK(sensor("", {}).factor == 1.0);
    CHECK(sensor("", {"g", ""}).factor == kStandardGravity);
    CHECK(sensor("", {"g", ""}).note.empty());
    const ColumnFactor overruled = sensor("V", {"m/s^2", ""});
    CHECK(overruled.factor == 1.0);
    CHECK(overruled.problem.empty());
    CHECK(overruled.note == "the file states V; taken as m/s^2 (--sensor-unit)");
    CHECK(sensor("m/s\xB3", {"g", ""}).note == "the file states m/s³; taken as g (--sensor-unit)");
    CHECK(sensor("m/s**2", {"m/s²", ""}).note.empty());  // the same unit
    CHECK(sensor("g", {"parsec", ""}).problem.find("--sensor-unit: unknown unit parsec") == 0);
    CHECK(test::contains(sensor("parsec", {}).problem, "--sensor-unit takes precedence"));
    CHECK(column_factor("ms", Quantity::time, {"g", "100 mV/g"}).factor == 1e-3);
}

TEST_CASE("Voltages are converted by the sensitivity") {
    const double expected = kStandardGravity / 0.1;
    CHECK(sensor("V", {"", "100 mV/g"}).factor == Approx(expected).epsilon(1e-14));
    CHECK(sensor("V", {"", "100 mV/g"}).note.empty());
    CHECK(sensor("mV", {"", "100 mV/g"}).factor == Approx(1e-3 * expected).epsilon(1e-14));
    CHECK(sensor("V", {"mV", "0.1 V/g"}).factor == Approx(1e-3 * expected).epsilon(1e-14));
    CHECK(sensor("V", {"mV", "0.1 V/g"}).note.find("the file states V") == 0);
    const ColumnFactor assumed = sensor("", {"", "100 mV/g"});
    CHECK(assumed.factor == Approx(expected).epsilon(1e-14));
    CHECK(test::contains(assumed.note, "taken as V"));
    CHECK(test::contains(sensor("V", {}).problem,
                         "give --sensor-sensitivity, for example \"100 mV/g\""));
    CHECK(test::contains(sensor("g", {"", "100 mV/g"}).problem, "but the unit is g"));
    CHECK(test::contains(sensor("V", {"g", "100 mV/g"}).problem, "but the unit is g"));
    CHECK(sensor("V", {"", "100"}).problem.find("--sensor-sensitivity 100: is not a voltage") == 0);
}

TEST_CASE("A remark after the unit is reported") {
    const ColumnFactor peak = sensor("g (peak)", {});
    CHECK(peak.factor == kStandardGravity);
    CHECK(peak.note == "unit g (peak): taken as g, without its remark");
    CHECK(!sensor("g (rms)", {}).problem.empty());
    CHECK(sensor("g (rms)", {"g", ""}).problem.empty());
    CHECK(sensor("g (rms)", {"g", ""}).factor == kStandardGravity);
    CHECK(sensor("g (rms)", {"g", ""}).note ==
          "the file states g (rms); taken as g (--sensor-unit)");
}

}  // namespace gearpod::mc::test_column_factor
