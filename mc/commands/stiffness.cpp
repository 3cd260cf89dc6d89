#include <fmt/format.h>

#include <string>
#include <vector>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/stiffness_modes.hpp"
#include "mc/plan/description.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

struct StiffnessOptions {
    StudyOptions study;
    std::string csv;  // "": a summary; "-": standard output
    int points = 1000;
    bool te = false;     // loaded static transmission error instead of the stiffness
    bool force = false;  // replaces outputs of another kind
};

void print_te(const GearboxPlan& gearbox) {
    for (const SceneMesh& mesh : gearbox.stiffness->meshes()) {
        const stiffness::LoadedMesh::Range te = mesh.loaded->range();
        fmt::print(
            "{:<11}: {:.6g} N, transmission error {:.4f} um mean,\n"
            "{:<11}  {:.4f} um peak to peak\n",
            mesh_name(mesh.members), mesh.loaded->force_N(), 1e6 * te.mean, "",
            1e6 * te.peak_to_peak());
    }
    fmt::print("curves: --csv FILE, or --csv - for standard output\n");
}

void print_summary(const GearboxPlan& gearbox) {
    for (const SceneMesh& mesh : gearbox.stiffness->meshes()) {
        fmt::print(
            "{:<11}: contact ratio {},\n"
            "{:<11}  mean stiffness {:.4e} N/m,\n"
            "{:<11}  pitch point {:.4f} mesh periods after engagement\n",
            mesh_name(mesh.members), contact_ratio_text(*mesh.stiffness), "",
            mean_total(*mesh.stiffness), "", mesh.stiffness->pitch_position());
    }
    const std::vector<PairId> pairs = faulty_pairs(gearbox.fault());
    if (!pairs.empty()) {
        const Key& size = *gearbox.fault().plan().size_key;
        std::string names;
        for (const PairId pair : pairs) {
            names += fmt::format("{}{} ({})", names.empty() ? "" : " and of ",
                                 gearbox.drivetrain->pair_members(pair),
                                 gearbox.drivetrain->pair_name(pair));
        }
        fmt::print("faulty tooth in the mesh of {}; largest possible {} {:.3f}{}\n", names,
                   size.stem(), gearbox.fault().largest_size() / size.unit.to_si,
                   size.unit.suffix.empty() ? "" : " " + std::string(size.unit.name));
    }
    fmt::print("curves: --csv FILE, or --csv - for standard output\n");
}

int stiffness_command(const StiffnessOptions& options) {
    const bool writable =
        can_write({"--csv", options.csv}, {{"the study", options.study.path}},
                  {text_output("a table of `stiffness` (CSV)", "phase,"), options.force});
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    const GearboxPlan& gearbox = scene->gearbox();
    if (options.te && gearbox.fault().plan().given()) {
        fmt::print(stderr,
                   "{}: note: transmission errors are those of healthy teeth; only the stiffness "
                   "(without --te) shows the fault\n",
                   printable(options.study.path));
    }
    if (options.csv.empty()) {
        options.te ? print_te(gearbox) : print_summary(gearbox);
        return kDone;
    }
    const std::vector<SignalColumn> columns =
        options.te ? transmission_error_columns(gearbox, options.points)
                   : stiffness_columns(gearbox, options.points);
    return write_text_to(options.csv, columns_csv(columns, 9, false)) ? kDone : kBadInput;
}

}  // namespace

void add_stiffness(CLI::App& app, int& code) {
    const auto [command, options] = add_command<StiffnessOptions>(
        app, code, "stiffness", "print the mesh stiffness over one mesh period", stiffness_command);
    add_study(command, options.study);
    add_file(command, "--csv", options.csv, "write the curves to a file, or - for standard output");
    add_number(command, "--points", options.points, "phases of the curves (default: 1000)",
               from_to(2, 1e6));
    add_force(command, options.force);
    command.add_flag(
        "--te", options.te,
        "print the static transmission error under nominal load, including tooth relief, instead "
        "of the stiffness");
}

}  // namespace gearpod::mc
