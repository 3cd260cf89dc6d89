#include "mc/scene/stiffness_curves.hpp"

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

}  // namespace gearpod::mc
