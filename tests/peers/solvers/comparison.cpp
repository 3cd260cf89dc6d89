#include "comparison.hpp"

#include <algorithm>
#include <numeric>

#include "mc/gearbox_tile.hpp"
#include "mc/healthy_reference.hpp"
#include "mc/instance_features.hpp"
#include "signals/sensor.hpp"

namespace gearpod::peers {
namespace {

template <class Value>
void keep(std::vector<Value>& all, int first, int last) {
    all = std::vector<Value>(all.begin() + first, all.begin() + last);
}

// As in mc/accuracy_pilot.cpp: without its mean.
std::vector<double> te_of(const std::vector<lockstep::MeshRecord>& records, int lane, int meshes) {
    std::vector<double> te;
    for (int k = 0; k < meshes; ++k) {
        const auto& all = records[static_cast<std::size_t>(k)].te;
        for (std::size_t i = static_cast<std::size_t>(lane); i < all.size(); i += kGearboxes) {
            te.push_back(all[i]);
        }
    }
    const double mean = std::accumulate(te.begin(), te.end(), 0.0) / static_cast<double>(te.size());
    for (double& value : te) {
        value -= mean;
    }
    return te;
}

}  // namespace

mc::PilotRecord some_of(const mc::PilotRecord& all, int first, int last) {
    mc::PilotRecord some = all;
    keep(some.ok, first, last);
    keep(some.sensor, first, last);
    keep(some.te, first, last);
    keep(some.features, first, last);
    return some;
}

mc::PilotError error_of(const mc::Scene& scene, const Boxes& boxes,
                        const std::vector<lockstep::MeshRecord>& records, int first, int last,
                        const mc::PilotRecord& reference) {
    const signals::PathGrid path = mc::path_grid(scene);
    const mc::Sampler sampler(scene.study());
    const std::vector<mc::GearboxId> ids = mc::pilot_gearboxes();
    lockstep::TileResult march;
    march.records = records;
    march.content.resize(records.size());
    std::iota(march.content.begin(), march.content.end(), 0);
    march.status.assign(kGearboxes, lockstep::LaneStatus::ok);
    const mc::GearboxTile tile = mc::tile_of_march(scene, sampler, path, ids, std::move(march));

    const mc::HealthyReference healthy = mc::healthy_reference(scene, sampler, path);
    mc::InstanceFeatures features(scene, &healthy);
    const int meshes = std::clamp(scene.pattern().length, 1, mc::kMostSignalMeshes);
    mc::PilotRecord record;
    for (int g = first; g < last; ++g) {
        const auto at = static_cast<std::size_t>(g);
        record.ok.push_back(true);
        record.features.push_back(
            features.compute(mc::lane_signals(scene, path, tile, g, features.meshes()),
                             boxes.instances[at], ids[at]));
        record.sensor.push_back(signals::synthesize(tile.views, g, tile.march.content, scene.span(),
                                                    path, boxes.instances[at].path_exponent, 0,
                                                    meshes));
        record.te.push_back(te_of(records, g, meshes));
    }
    return mc::pilot_error(record, some_of(reference, first, last));
}

}  // namespace gearpod::peers
