#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/command_support.hpp"
#include "mc/study_gears.hpp"
#include "mc/study_sizes.hpp"

namespace gearpod::mc {
namespace {

std::string pair_name(const Scene& scene, int pair) {
    const int n = scene.train().planets;
    return pair < n ? fmt::format("sp{}", pair + 1) : fmt::format("rp{}", pair - n + 1);
}

// Columns of the faulty pair: the mesh period in which the faulty tooth engages, the next one, ...
struct FaultColumn {
    std::string name;
    int period = 0;  // after the one in which the tooth engages
    std::shared_ptr<const stiffness::FaultyMesh> mesh;
};

std::vector<FaultColumn> fault_columns(const Scene& scene) {
    std::vector<FaultColumn> columns;
    const int pair = scene.faulty_pair();
    if (pair < 0) {
        return columns;
    }
    const double start = scene.pairs().start[static_cast<std::size_t>(pair)];
    const int periods =
        static_cast<int>(std::ceil(start + scene.pairs().curve(pair).contact_ratio()));
    for (const double depth : fault_depths_m(scene.study())) {
        for (int period = 0; period < periods; ++period) {
            columns.push_back({fmt::format("{}_crack_{:g}mm_period{}", pair_name(scene, pair),
                                           1e3 * depth, period + 1),
                               period, scene.faulty_mesh(depth)});
        }
    }
    return columns;
}

// The faulty pair's stiffness so many mesh periods after its faulty tooth engaged.
double faulty_total(const Scene& scene, const stiffness::FaultyMesh& mesh, double since) {
    const int pair = scene.faulty_pair();
    const lockstep::PairSet& pairs = scene.pairs();
    if (since < 0.0 || since >= mesh.duration()) {
        return pairs.total(pair, pairs.start[static_cast<std::size_t>(pair)] + since);
    }
    const double tau = pairs.reversed ? mesh.duration() - since : since;
    const auto limit = pairs.reversed ? stiffness::Limit::from_below : stiffness::Limit::from_above;
    return total_at(mesh, pairs.curve(pair).transitions(), tau, limit);
}

std::string csv_text(const Scene& scene, int points) {
    const auto columns = fault_columns(scene);
    std::string text = "phase";
    for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
        text += fmt::format(",{}", pair_name(scene, pair));
    }
    for (const FaultColumn& column : columns) {
        text += fmt::format(",{}", column.name);
    }
    text += "\n";
    const auto faulty = static_cast<std::size_t>(std::max(scene.faulty_pair(), 0));
    for (int i = 0; i < points; ++i) {
        const double phase = static_cast<double>(i) / points;
        text += fmt::format("{:.9g}", phase);
        for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
            text += fmt::format(",{:.9g}", scene.pairs().total(pair, phase));
        }
        for (const FaultColumn& column : columns) {
            const double since = phase + column.period - scene.pairs().start[faulty];
            text += fmt::format(",{:.9g}", faulty_total(scene, *column.mesh, since));
        }
        text += "\n";
    }
    return text;
}

void print_summary(const Scene& scene) {
    const auto show = [](const char* name, const stiffness::MeshStiffness& curve) {
        fmt::print(
            "{}: contact ratio {:.4f}, mean {:.4e} N/m, pitch point {:.4f} mesh periods after "
            "engagement\n",
            name, curve.contact_ratio(), mean_total(curve), curve.pitch_position());
    };
    show("sun-planet ", scene.sun_planet());
    show("ring-planet", scene.ring_planet());
    if (scene.faulty_pair() >= 0) {
        fmt::print("faulty tooth on pair {}; it breaks off at a crack of {:.3f} mm\n",
                   pair_name(scene, scene.faulty_pair()), 1e3 * max_fault_depth_m(scene.study()));
    }
    fmt::print("curves: --csv FILE, or --csv - for standard output\n");
}

}  // namespace

int stiffness_command(const StiffnessOptions& options) {
    const auto scene = load_scene(options.study);
    if (!scene) {
        return kBadInput;
    }
    if (options.csv.empty()) {
        print_summary(*scene);
        return kDone;
    }
    return write_text_to(options.csv, csv_text(*scene, options.points)) ? kDone : kBadInput;
}

}  // namespace gearpod::mc
