// Factor of a recorded column, from the unit in the file and from the options.
#pragma once

#include <string>

#include "mc/files/signal_units.hpp"

namespace gearpod::mc {

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
