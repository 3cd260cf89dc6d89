#include "mc/scene/stiffness_curves.hpp"

#include <cmath>

namespace gearpod::mc {

std::vector<int> faulty_pairs(const Scene& scene) {
    std::vector<int> pairs(static_cast<std::size_t>(scene.fault().curves()), -1);
    for (const lockstep::FaultPassage& passage : scene.pattern().passages) {
        int& pair = pairs[static_cast<std::size_t>(passage.curve)];
        pair = pair < 0 ? passage.pair : pair;
    }
    return pairs;
}

double faulty_total(const Scene& scene, int pair, const stiffness::FaultyMesh& mesh, double since) {
    const lockstep::PairSet& pairs = scene.pairs();
    if (since < 0.0 || since >= mesh.duration()) {
        return pairs.total(pair, pairs.start[static_cast<std::size_t>(pair)] + since);
    }
    const double tau = pairs.reversed ? mesh.duration() - since : since;
    const auto limit = pairs.reversed ? stiffness::Limit::from_below : stiffness::Limit::from_above;
    return total_at(mesh, pairs.curve(pair).transitions(), tau, limit);
}

double loaded_approach(const Scene& scene, int pair, double phase) {
    constexpr double kInside = 1e-9;  // mesh periods, towards later phases
    const lockstep::PairSet& pairs = scene.pairs();
    const double since = phase - pairs.start[static_cast<std::size_t>(pair)];
    const double tau = pairs.reversed ? pairs.curve(pair).contact_ratio() - since : since;
    const double inside = pairs.reversed ? tau - kInside : tau + kInside;
    const double period = std::floor(inside);
    const SceneMesh& mesh =
        scene.meshes()[static_cast<std::size_t>(pair / scene.drivetrain().pairs_per_mesh())];
    return mesh.loaded->approach(tau - period, inside - period);
}

}  // namespace gearpod::mc
