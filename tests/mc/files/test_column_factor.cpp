// Checks which of the unit in the file, --sensor-unit and --sensor-sensitivity counts.
#include <catch2/catch.hpp>

#include "mc/files/column_factor.hpp"

namespace test_column_factor {

using namespace gearpod::mc;

namespace {

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
    CHECK(sensor("parsec", {}).problem.find("--sensor-unit takes precedence") != std::string::npos);
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
    CHECK(assumed.note.find("taken as V") != std::string::npos);
    CHECK(sensor("V", {}).problem.find("give --sensor-sensitivity, for example \"100 mV/g\"") !=
          std::string::npos);
    CHECK(sensor("g", {"", "100 mV/g"}).problem.find("but the unit is g") != std::string::npos);
    CHECK(sensor("V", {"g", "100 mV/g"}).problem.find("but the unit is g") != std::string::npos);
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

}  // namespace

}  // namespace test_column_factor
