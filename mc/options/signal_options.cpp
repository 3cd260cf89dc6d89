// Options of the commands that read recordings.
#include "mc/options/options.hpp"

namespace gearpod::mc {
namespace {

void add_signal_reading(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor-unit", columns.sensor_unit,
                       "unit of the acceleration where the file says none (default: m/s^2)");
    command.add_option(
        "--tachometer", columns.tachometer,
        "column of a tachometer's pulses, of the member whose speed the study gives");
    command
        .add_option("--pulses-per-turn", columns.pulses_per_turn, "of the tachometer (default: 1)")
        ->check(CLI::Range(1.0, 1e5));
    command.add_option("--encoder", columns.encoder,
                       "column of an encoder's angle, of that member: rad, or deg, turns, ... in "
                       "brackets behind the name");
    command
        .add_option_function<std::string>(
            "--speed",
            [&columns](const std::string& value) {
                columns.speed = value == "found"    ? SpeedCheck::follow
                                : value == "stated" ? SpeedCheck::ignore
                                                    : SpeedCheck::refuse;
            },
            "check (default): refuse a speed that the mesh lines do not fit; found: take theirs; "
            "stated: do not look")
        ->check(CLI::IsMember({"check", "found", "stated"}));
}

// Adds options for the columns and the sampling of recordings.
void add_columns(CLI::App& command, SignalColumns& columns) {
    command.add_option("--sensor", columns.sensor,
                       "column of the acceleration, m/s^2 (default: sensor)");
    command
        .add_option("--sampling-Hz", columns.sampling_Hz, "sampling rate (default: from the file)")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--samples-per-mesh", columns.samples_per_mesh,
                    "of recordings that were sampled evenly in mesh phase")
        ->check(CLI::Range(2.0, 1e6));
    add_signal_reading(command, columns);
}

}  // namespace

void add_features(CLI::App& app, FeaturesOptions& features, int& code) {
    auto* command = app.add_subcommand(
        "features",
        "the features of measured signals (CSV, HDF5, MAT, WAV, universal files), one or many");
    command->add_option(
        "signal", features.signals,
        "signal files (.csv, .h5, .hdf5, .mat, .wav, .uff, .unv), or patterns of their names");
    add_study_keys(*command, features.study);
    command->add_option("--study", features.study.path, "study file (TOML)")->required();
    command->add_option("--manifest", features.manifest,
                        "table (CSV) of recordings: file, row, gearbox, time, label, size, "
                        "conditions");
    add_columns(*command, features.columns);
    command->add_option("--te", features.columns.te,
                        "column of the transmission error, rad (default: te)");
    command
        ->add_option("--healthy", features.healthy,
                     "recording of a healthy gearbox for na4, nb4 and nsds to compare with, as "
                     "often as there are (default: gearboxes simulated from the study)")
        ->allow_extra_args(false);
    needs_name(command->add_option(
        "--baseline", features.baseline,
        "earlier recording of the same gearbox while it was healthy: own_... compare with it, "
        "change_... look at what has changed since"));
    command->add_option("--noise-level", features.noise_level,
                        "noise level of those simulated gearboxes (default: 1)");
    needs_name(command->add_option("--json", features.json,
                                   "of one signal: write JSON to a file, or to -"));
    needs_name(
        command->add_option("--out", features.out, "of many: results file (HDF5) for `report`"));
    needs_name(command->add_option("--csv", features.csv, "of many: table, to a file, or to -"));
    command->add_flag("--quiet", features.quiet, "no progress");
    needs_name(command->add_option("--against", features.against,
                                   "alarm or not, by the healthy gearboxes of a results file"));
    command->add_option("--feature", features.feature,
                        "the feature that decides it (default: the best ranked there)");
    command->callback([&] { code = features_command(features); });
}

void add_calibrate(CLI::App& app, CalibrateOptions& calibrate, int& code) {
    auto* command = app.add_subcommand(
        "calibrate",
        "what tooth errors, background, tones, gain and path exponent make the study's healthy "
        "gearboxes "
        "look like measured ones: approximate Bayesian computation on the recordings' features, "
        "with regression adjustment, from draws of stated prior ranges");
    add_study(*command, calibrate.study);
    command->add_option("--healthy", calibrate.healthy,
                        "recordings of healthy gearboxes, each of one of its own (as `features` "
                        "reads them), or patterns of their names");
    command->add_option("--manifest", calibrate.manifest,
                        "table (CSV) of recordings instead, as of `features`; column gearbox says "
                        "which are of the same; faulty lines are left out");
    command->add_option("--features", calibrate.features,
                        "table (CSV) of features instead, as `features --csv` writes it");
    add_columns(*command, calibrate.columns);
    command
        ->add_option(
            "--prior", calibrate.priors,
            "KEY=LOW:HIGH or KEY=LOW:HIGH:log, a random input of the study and the range "
            "that its value is drawn from, evenly or evenly in the logarithm; as often as "
            "there are (default: gearbox.tooth_quality=2:11, or pitch_error_um where the "
            "study has one; sensor.noise_m_s2, or the density in its place, from 1 to 105 % of the "
            "recordings' rms, log; "
            "sensor.gain=0.05:20:log; sensor.path_exponent=-0.2:0.4; with tones "
            "sensor.tone_level=0.01:20:log)")
        ->allow_extra_args(false);
    command
        ->add_option("--feature", calibrate.feature,
                     "a feature that is compared, as often as there are (default: all of the "
                     "sensor, but for those of sun and ring)")
        ->allow_extra_args(false);
    command
        ->add_option("--draws", calibrate.draws,
                     "draws that are marched in each of two rounds (default: 200); each costs a "
                     "march a gearbox")
        ->check(CLI::Range(50L, 100000L));
    needs_name(command->add_option("--out", calibrate.out,
                                   "study file (TOML) with what was found in [random], or -"));
    needs_name(command->add_option("--json", calibrate.json, "write JSON to a file, or to -"));
    command->add_flag("--quiet", calibrate.quiet, "say nothing of the cost");
    command->callback([&] { code = calibrate_command(calibrate); });
}

}  // namespace gearpod::mc
