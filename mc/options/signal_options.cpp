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

// Adds options for the columns and the sampling of recordings.
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

}  // namespace

void add_features(CLI::App& app, FeaturesOptions& features, int& code) {
    auto* command = app.add_subcommand(
        "features",
        "compute the features of measured signals (CSV, HDF5, MAT, TDMS, sound, universal files)");
    command->add_option("signal", features.signals,
                        "signal files (.csv, .h5, .hdf5, .mat, .tdms, .uff, .wav and others), or "
                        "name patterns with "
                        "* and ?");
    add_study_keys(*command, features.study);
    command->add_option("--study", features.study.path, "study file (TOML)")->required();
    command->add_option("--manifest", features.manifest,
                        "table (CSV) of recordings with columns file, row, gearbox, time, label, "
                        "size, and operating conditions");
    add_columns(*command, features.columns);
    command->add_option("--te", features.columns.te,
                        "column of the transmission error, rad (default: te)");
    command
        ->add_option("--healthy", features.healthy,
                     "recording of a healthy gearbox, the reference of na4, nb4 and nsds; may be "
                     "repeated (default: gearboxes simulated from the study)")
        ->allow_extra_args(false)
        ->option_text("FILE");  // one for each --healthy, because the signals are files, too
    require_file_name(command->add_option(
        "--baseline", features.baseline,
        "earlier recording of the same gearbox in healthy condition, the reference of own_... and "
        "change_... features"));
    add_number(*command, "--baseline-records", features.baselines.records,
               "instead, many signals: the baseline of each gearbox is the mean of its first N "
               "healthy recordings, aligned by circular correlation (or of those with yes in the "
               "manifest's column baseline)",
               from_to(1, 1000000));
    command
        ->add_option("--baseline-by", features.baselines.conditions,
                     "operating condition of the manifest; recordings with equal values share a "
                     "baseline; may be repeated")
        ->allow_extra_args(false)
        ->type_name("COLUMN");
    command
        ->add_option_function<std::string>(
            "--baseline-scale",
            [&features](const std::string& value) { features.baselines.scaled = value == "fit"; },
            "fit: scale the baseline to each recording before it is subtracted (least squares), so "
            "that a drifting gain leaves no change; the part of a fault that resembles the "
            "baseline is then lost, too (default: none)")
        ->check(CLI::IsMember({"none", "fit"}));
    add_number(*command, "--average", features.baselines.average,
               "number of consecutive recordings of a gearbox, aligned with its baseline, that are "
               "averaged before features (default: monitoring.average_records)",
               from_to(1, 1000));
    add_number(*command, "--noise-level", features.noise_level,
               "noise level of the simulated gearboxes (default: 1)", at_least(0.0));
    require_file_name(command->add_option(
        "--json", features.json, "one signal: write JSON to a file, or - for standard output"));
    require_file_name(command->add_option(
        "--out", features.out, "many signals: write a results file (HDF5) for `report`"));
    require_file_name(command->add_option(
        "--csv", features.csv, "many signals: write a table to a file, or - for standard output"));
    command->add_flag("--quiet", features.quiet, "show no progress");
    require_file_name(command->add_option(
        "--against", features.against,
        "results file of healthy gearboxes; decide with its threshold: alarm or not"));
    command->add_option("--feature", features.feature,
                        "feature that decides the alarm (default: the best ranked in the "
                        "results file)");
    add_force(*command, features.force);
    command->callback([&] { code = features_command(features); });
}

void add_calibrate(CLI::App& app, CalibrateOptions& calibrate, int& code) {
    auto* command = app.add_subcommand(
        "calibrate",
        "fit tooth errors, background noise, tones, gain and path exponent of a study to "
        "recordings of healthy gearboxes: approximate Bayesian computation with regression "
        "adjustment");
    add_study(*command, calibrate.study);
    command
        ->add_option("--healthy", calibrate.healthy,
                     "recordings of healthy gearboxes, each of a different gearbox, or name "
                     "patterns; same formats as for `features`")
        ->allow_extra_args(false);
    command->add_option("--manifest", calibrate.manifest,
                        "instead: table (CSV) of recordings as for `features`; column gearbox "
                        "names the gearbox; faulty recordings are ignored");
    command->add_option("--features", calibrate.features,
                        "instead: table (CSV) of features as written by `features --csv`");
    add_columns(*command, calibrate.columns);
    command
        ->add_option(
            "--prior", calibrate.priors,
            "KEY=LOW:HIGH or KEY=LOW:HIGH:log: uniform or log-uniform prior of a study key; may "
            "be repeated (default: gearbox.tooth_quality=2:11, or pitch_error_um if the study has "
            "it; sensor.noise_m_s2 or its density, 1 to 105 % of the recordings' rms, log; "
            "sensor.gain=0.05:20:log; sensor.path_exponent=-0.2:0.4; with tones "
            "sensor.tone_level=0.01:20:log)")
        ->type_name("KEY=LOW:HIGH")
        ->allow_extra_args(false);
    command
        ->add_option("--feature", calibrate.feature,
                     "feature to compare; may be repeated (default: all features of the "
                     "acceleration except those of sun and ring and those that transform the "
                     "whole record)")
        ->allow_extra_args(false);
    add_number(*command, "--draws", calibrate.sets,
               "parameter sets simulated in each of two rounds (default: 200); each set integrates "
               "every gearbox once",
               from_to(50, 100000));
    require_file_name(command->add_option("--out", calibrate.out,
                                          "write a study file (TOML) with the calibrated inputs in "
                                          "[random], or - for standard output"));
    require_file_name(command->add_option("--json", calibrate.json,
                                          "write JSON to a file, or - for standard output"));
    command->add_flag("--quiet", calibrate.quiet, "do not print the computing time");
    add_force(*command, calibrate.force);
    command->callback([&] { code = calibrate_command(calibrate); });
}

}  // namespace gearpod::mc
