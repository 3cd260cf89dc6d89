#include <fmt/format.h>

#include <cmath>

#include "mc/commands/commands.hpp"
#include "mc/run/support.hpp"
#include "mc/scene/stiffness_curves.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

// CSV column of a faulty tooth pair over one mesh period.
struct FaultColumn {
    std::string name;
    int pair = 0;
    int period = 0;  // mesh periods after the one in which the tooth engages
    std::shared_ptr<const stiffness::FaultyMesh> mesh;
};

// "3mm", or "0.1" for a pure number.
std::string size_name(const Study& study, double size) {
    const Unit& unit = fault_size_key(study).unit;
    return fmt::format("{:g}{}", size / unit.to_si, unit.suffix);
}

std::vector<FaultColumn> fault_columns(const Scene& scene) {
    std::vector<FaultColumn> columns;
    const std::vector<int> pairs = faulty_pairs(scene);
    for (int curve = 0; curve < scene.fault().curves(); ++curve) {
        const int pair = pairs[static_cast<std::size_t>(curve)];
        const double start = scene.pairs().start[static_cast<std::size_t>(pair)];
        for (const double size : fault_sizes(scene.study())) {
            const auto mesh = scene.fault().mesh(curve, size);
            const int periods = static_cast<int>(std::ceil(start + mesh->duration()));
            for (int period = 0; period < periods; ++period) {
                columns.push_back(
                    {fmt::format("{}_{}_{}_period{}", scene.drivetrain().pair_name(pair),
                                 choice_text(scene.study(), "fault", "kind"),
                                 size_name(scene.study(), size), period + 1),
                     pair, period, mesh});
            }
        }
    }
    return columns;
}

std::string csv_text(const Scene& scene, int points) {
    const auto columns = fault_columns(scene);
    std::string text = "phase";
    for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
        text += fmt::format(",{}", scene.drivetrain().pair_name(pair));
    }
    for (const FaultColumn& column : columns) {
        text += fmt::format(",{}", column.name);
    }
    text += "\n";
    for (int i = 0; i < points; ++i) {
        const double phase = static_cast<double>(i) / points;
        text += fmt::format("{:.9g}", phase);
        for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
            text += fmt::format(",{:.9g}", scene.pairs().total(pair, phase));
        }
        for (const FaultColumn& column : columns) {
            const double since =
                phase + column.period - scene.pairs().start[static_cast<std::size_t>(column.pair)];
            text += fmt::format(",{:.9g}", faulty_total(scene, column.pair, *column.mesh, since));
        }
        text += "\n";
    }
    return text;
}

std::string te_text(const Scene& scene, int points) {
    std::string text = "phase";
    for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
        text += fmt::format(",{}_te_um", scene.drivetrain().pair_name(pair));
    }
    text += "\n";
    for (int i = 0; i < points; ++i) {
        const double phase = static_cast<double>(i) / points;
        text += fmt::format("{:.9g}", phase);
        for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
            text += fmt::format(",{:.9g}", 1e6 * loaded_approach(scene, pair, phase));
        }
        text += "\n";
    }
    return text;
}

void print_te(const Scene& scene) {
    for (const SceneMesh& mesh : scene.meshes()) {
        const stiffness::LoadedMesh::Range te = mesh.loaded->range();
        fmt::print(
            "{:<11}: {:.6g} N, transmission error {:.4f} um mean,\n"
            "{:<11}  {:.4f} um peak to peak\n",
            mesh_name(mesh.members), mesh.loaded->force_N(), 1e6 * te.mean, "",
            1e6 * te.peak_to_peak());
    }
    fmt::print("curves: --csv FILE, or --csv - for standard output\n");
}

void print_summary(const Scene& scene) {
    for (const SceneMesh& mesh : scene.meshes()) {
        fmt::print(
            "{:<11}: contact ratio {:.4f}, mean stiffness {:.4e} N/m,\n"
            "{:<11}  pitch point {:.4f} mesh periods after engagement\n",
            mesh_name(mesh.members), mesh.stiffness->contact_ratio(), mean_total(*mesh.stiffness),
            "", mesh.stiffness->pitch_position());
    }
    const std::vector<int> pairs = faulty_pairs(scene);
    if (!pairs.empty()) {
        const Unit& unit = fault_size_key(scene.study()).unit;
        std::string names;
        for (const int pair : pairs) {
            names += (names.empty() ? "" : " and ") + scene.drivetrain().pair_name(pair);
        }
        fmt::print("faulty tooth in pair {}; largest possible {} {:.3f}{}\n", names,
                   fault_size_key(scene.study()).stem(), scene.fault().largest_size() / unit.to_si,
                   unit.suffix.empty() ? "" : " " + std::string(unit.name));
    }
    fmt::print("curves: --csv FILE, or --csv - for standard output\n");
}

}  // namespace

int stiffness_command(const StiffnessOptions& options) {
    const bool writable = can_write({"--csv", options.csv}, {{"the study", options.study.path}});
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    if (options.csv.empty()) {
        options.te ? print_te(*scene) : print_summary(*scene);
        return kDone;
    }
    const std::string text =
        options.te ? te_text(*scene, options.points) : csv_text(*scene, options.points);
    return write_text_to(options.csv, text) ? kDone : kBadInput;
}

}  // namespace gearpod::mc
