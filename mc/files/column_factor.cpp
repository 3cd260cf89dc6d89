#include "mc/files/column_factor.hpp"

#include <fmt/format.h>

#include "mc/input/printable.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kSensitivityExample = "\"100 mV/g\" or \"10 mV/(m/s^2)\"";

// Factor and remark of a unit; a remark is reported.
ColumnFactor factor_of(const std::string& unit, Quantity quantity) {
    const UnitReading reading = read_unit(quantity, unit);
    return {reading.factor.value_or(1.0), reading.problem,
            reading.remark.empty() ? ""
                                   : fmt::format("unit {}: taken as {}, without its remark",
                                                 printable(unit), plain_unit(unit))};
}

ColumnFactor voltage_factor(const std::string& unit, const std::string& sensitivity) {
    const auto per_acceleration = sensor_sensitivity(sensitivity);
    if (!per_acceleration) {
        return {1.0,
                fmt::format("--sensor-sensitivity {}: is not a voltage per acceleration; give for "
                            "example {}",
                            printable(sensitivity), kSensitivityExample),
                ""};
    }
    if (plain_unit(unit).empty()) {
        return {1.0 / *per_acceleration, "",
                "no unit is stated; taken as V, because --sensor-sensitivity is given"};
    }
    ColumnFactor voltage = factor_of(unit, Quantity::voltage);
    if (!voltage.problem.empty()) {
        voltage.problem = fmt::format(
            "--sensor-sensitivity is for voltages, but the unit is {}; omit it, or "
            "give --sensor-unit V",
            printable(unit));
    }
    voltage.factor /= *per_acceleration;
    return voltage;
}

}  // namespace

ColumnFactor column_factor(const std::string& stated, Quantity quantity, const SensorUnit& sensor) {
    if (quantity != Quantity::acceleration) {
        return factor_of(stated, quantity);
    }
    const std::string& unit = sensor.unit.empty() ? stated : sensor.unit;
    ColumnFactor used = sensor.sensitivity.empty() ? factor_of(unit, quantity)
                                                   : voltage_factor(unit, sensor.sensitivity);
    if (sensor.unit.empty()) {
        const bool converted = used.problem.empty() || !sensor.sensitivity.empty();
        if (!converted && unit_factor(Quantity::voltage, unit)) {
            used.problem = fmt::format(
                "unit {} is that of a voltage; give --sensor-sensitivity, for example {}, or "
                "--sensor-unit if it is wrong",
                printable(unit), kSensitivityExample);
        } else if (!converted) {
            used.problem += "; --sensor-unit takes precedence over the file";
        }
        return used;
    }
    if (!used.problem.empty() && sensor.sensitivity.empty()) {
        used.problem = "--sensor-unit: " + used.problem;
    }
    const UnitReading in_file = read_unit(Quantity::acceleration, stated);
    if (!stated.empty() && (in_file.factor != used.factor || !in_file.remark.empty())) {
        used.note = fmt::format("the file states {}; taken as {} (--sensor-unit)",
                                printable(stated), printable(sensor.unit));
    }
    return used;
}

}  // namespace gearpod::mc
