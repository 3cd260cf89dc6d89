// Units of recorded columns, as files and options state them: the only place that interprets them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearpod::mc {

// The unit in ASCII, except for the degree sign, with one spelling of its operators and without
// brackets around all of it. Bytes that are not UTF-8 are taken as Latin-1.
std::string ascii_unit(std::string_view bytes);

// Position of the bracket that the last character closes; npos if it closes none.
std::size_t opening_of_last(std::string_view text);

// True if `word` is one of the words, which are separated by blanks.
bool is_among(std::string_view word, std::string_view words);

// Quantity that a column must have, and the unit to which it is converted.
enum class Quantity {
    acceleration,  // m/s^2
    angle,         // rad
    time,          // s
    speed,         // rpm
    phase,         // mesh periods
    voltage,       // V
    any,           // not converted, for example pulses of a tachometer
};

// Meaning of a unit for a quantity.
struct UnitReading {
    std::optional<double> factor;  // converts to the unit of the quantity; empty: see `problem`
    std::string remark;            // "peak" in "g (peak)"; the values are taken as instantaneous
    std::string problem;           // why there is no factor, with the known units
};

// Interprets a unit in any usual spelling: "m/s^2", "m/s**2", "m s-2", "M/SEC2", "m·s⁻²", in UTF-8
// or Latin-1, with either micro sign, in brackets. A text "" or "none" states no unit: factor 1.
// Parentheses after the unit are a remark. Remarks that state other values than instantaneous
// ones (rms, peak to peak, decibels) or that contain a number are a problem.
UnitReading read_unit(Quantity quantity, std::string_view unit);

// The factor of read_unit().
std::optional<double> unit_factor(Quantity quantity, std::string_view unit);

// True if the text is a unit of any physical quantity, perhaps with a remark, and not for example a
// place, as in "Accelerometer (rear)".
bool is_unit(std::string_view text);

// One spelling for all spellings of a unit, without remarks: "m/s^2" for "m/s²".
std::string plain_unit(std::string_view unit);

// List of the known units, for example "m/s^2, mm/s^2, g".
std::string known_units(Quantity quantity);

// Sensitivity of an accelerometer, V per m/s^2, from a text such as "100 mV/g" or
// "10.2 mV/(m/s^2)"; empty unless it is a finite number above zero and a voltage per acceleration.
std::optional<double> sensor_sensitivity(std::string_view text);

// Factor of a recorded column, from the unit in the file and from the options.

// Unit of an acceleration as the user states it; "" where nothing is stated.
struct SensorUnit {
    std::string unit;         // takes precedence over the file's: "g", "V"
    std::string sensitivity;  // volts per acceleration, "100 mV/g": the values are voltages
};

struct ColumnFactor {
    double factor = 1.0;  // converts to the unit of the quantity (signal_units.hpp)
    std::string problem;  // why the column cannot be used, else ""
    std::string note;     // statement of the file that is not used, or an assumption, else ""
};

// `stated` is the unit in the file, perhaps "". The sensor unit is used for accelerations only.
ColumnFactor column_factor(const std::string& stated, Quantity quantity, const SensorUnit& sensor);

}  // namespace gearpod::mc
