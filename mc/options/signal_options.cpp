// Options of the commands that read recordings.
#include "mc/options/options.hpp"

namespace gearpod::mc {
namespace {

void add_signal_reading(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor-unit", columns.sensor_unit.unit,
                       "unit of the acceleration, for example g; takes precedence over the file's "
                       "(default: the file's, or m/s^2 if it gives none)");
    command.add_option("--sensor-sensitivity", columns.sensor_unit.sensitivity,
                       "sensitivity of the accelerometer if its values are voltages, with its "
                       "unit: \"100 mV/g\", \"10.2 mV/(m/s^2)\"");
    command.add_option("--tachometer", columns.tachometer,
                       "column of tachometer pulses, of the member whose speed the study gives");
    add_number(command, "--pulses-per-turn", columns.pulses_per_turn,
               "pulses of the tachometer per turn (default: 1)", from_to(1.0, 1e5));
    command.add_option("--encoder", columns.encoder,
                       "column of the encoder angle of that member; rad, or the unit in brackets "
                       "after the name: deg, turns, ...");
    command
        .add_option_function<std::string>(
            "--speed",
            [&columns](const std::string& value) {
                columns.speed = value == "found"    ? SpeedCheck::follow
                                : value == "stated" ? SpeedCheck::ignore
                                                    : SpeedCheck::refuse;
            },
            "check (default): refuse the study's speed if the mesh lines do not match it; found: "
            "use the speed of the mesh lines; stated: use the study's speed unchecked")
        ->check(CLI::IsMember({"check", "found", "stated"}));
}

}  // namespace

void add_columns(CLI::App& command, SignalColumns& columns) {
    command.add_option(
        "--sensor", columns.sensor,
        "column of the acceleration (default: sensor); in HDF5 and MAT files a name or path, "
        "and data:2 for the second column of a matrix");
    add_number(command, "--sampling-Hz", columns.sampling_Hz,
               "sampling rate (default: from the file)", above(0.0, "Hz"));
    add_number(command, "--samples-per-mesh", columns.samples_per_mesh,
               "samples per mesh period, for recordings sampled evenly in mesh phase",
               from_to(2.0, 1e6));
    add_signal_reading(command, columns);
}

}  // namespace gearpod::mc
