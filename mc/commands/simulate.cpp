#include <fmt/format.h>

#include <exception>
#include <span>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/library/open_study.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {
namespace {

struct SimulateOptions {
    StudyOptions study;
    long instance = 0;   // row of the results file
    long meshes = 0;     // 0: one planet turn
    std::string out;     // .h5 or .csv
    bool force = false;  // replaces outputs of another kind
};

void write_hdf5(const std::string& path, const Simulation& simulation, const EnsemblePlan& plan) {
    const Hdf5Handle file = create_memory_file();
    for (const auto& [name, value] : provenance(plan, 1, 1)) {
        write_text(file.get(), ".", name, value);
    }
    const Hdf5Handle signals = create_group(file.get(), "signals");
    for (const SignalColumn& column : simulation.columns) {
        write_numbers(signals.get(), column.name, {column.values.size()}, column.values);
        write_text(signals.get(), column.name, "unit", column.unit);
    }
    const std::size_t levels = simulation.noise_levels.size();
    write_numbers(file.get(), "noise_levels", {levels}, simulation.noise_levels);
    const Hdf5Handle features = create_group(file.get(), "features");
    for (std::size_t f = 0; f < simulation.feature_names.size(); ++f) {
        const auto first = simulation.features.begin() + static_cast<std::ptrdiff_t>(f * levels);
        write_numbers(features.get(), simulation.feature_names[f], {levels},
                      {first, first + static_cast<std::ptrdiff_t>(levels)});
    }
    if (!simulation.contact_loss.empty()) {
        const Hdf5Handle group = create_group(file.get(), kContactLoss);
        for (const RowColumn& mesh : simulation.contact_loss) {
            write_numbers(group.get(), mesh.name, {1}, mesh.values);
            write_text(group.get(), mesh.name, "unit", "1");
        }
    }
    write_file(path, file_bytes(file));
}

void print_summary(const Simulation& simulation, const std::string& out) {
    fmt::print("{:<16}", "noise level");
    for (const double level : simulation.noise_levels) {
        fmt::print("{:>12g}", level);
    }
    fmt::print("\n");
    const std::size_t levels = simulation.noise_levels.size();
    for (std::size_t f = 0; f < simulation.feature_names.size(); ++f) {
        fmt::print("{:<16}", simulation.feature_names[f]);
        for (std::size_t level = 0; level < levels; ++level) {
            fmt::print("{:>12.6g}", simulation.features[f * levels + level]);
        }
        fmt::print("\n");
    }
    for (const RowColumn& mesh : simulation.contact_loss) {
        fmt::print("contact loss    {:>12.4g} of a tooth pair's time, {}\n", mesh.values[0],
                   mesh.name);
    }
    if (!out.empty()) {
        fmt::print("signals: {}\n", out);
    }
}

int simulate_command(const SimulateOptions& options) {
    const auto scene = load_scene(options.study).scene;
    const bool csv = options.out.ends_with(".csv");
    bool good = scene != nullptr;
    if (!options.out.empty()) {
        if (!csv && !options.out.ends_with(".h5")) {
            fmt::print(stderr, "--out {}: unknown file type; end the name in .h5 or .csv\n",
                       options.out);
            good = false;
        } else {
            good = can_write({"--out", options.out}, {{"the study", options.study.path}},
                             {csv ? text_output("signals of `simulate` (CSV)",
                                                "time [s],mesh_phase [mesh periods],")
                                  : signals_output(),
                              options.force}) &&
                   good;
        }
    }
    if (!good) {
        return kBadInput;
    }
    Simulation simulation;
    try {
        simulation =
            simulate_row(scene->tile(), scene->ensemble(), options.instance, options.meshes);
    } catch (const BadInput&) {
        throw;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kSomeFailed;
    }
    if (csv) {
        const std::string text = columns_csv(simulation.columns, 17, true);
        write_file(options.out, std::as_bytes(std::span(text)));
    } else if (!options.out.empty()) {
        write_hdf5(options.out, simulation, scene->ensemble());
    }
    print_summary(simulation, options.out);
    return kDone;
}

}  // namespace

void add_simulate(CLI::App& app, int& code) {
    const auto [command, options] = add_command<SimulateOptions>(
        app, code, "simulate", "compute the signals and features of one gearbox",
        reporting<simulate_command>);
    add_study(command, options.study);
    add_number(command, "--instance", options.instance, "row of the results file, from 0")
        ->required();
    add_file(command, "--out", options.out, "file for the signals, .h5 or .csv");
    add_number(command, "--meshes", options.meshes,
               "number of mesh periods (default: one planet turn)", at_least(1));
    add_force(command, options.force);
}

}  // namespace gearpod::mc
