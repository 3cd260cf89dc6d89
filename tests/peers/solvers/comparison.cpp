#include "comparison.hpp"

#include <numeric>

namespace gearpod::peers {
namespace {

template <class Value>
void keep(std::vector<Value>& all, int first, int last) {
    all = std::vector<Value>(all.begin() + first, all.begin() + last);
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

mc::PilotError error_of(const mc::Study& study, const std::vector<lockstep::MeshRecord>& records,
                        int first, int last, const mc::PilotRecord& reference) {
    const mc::PilotRecord all = mc::Pilot(mc::Planner(study)).record_of_integration([&](auto) {
        lockstep::TileResult integration;
        integration.records = records;
        integration.content.resize(records.size());
        std::iota(integration.content.begin(), integration.content.end(), 0);
        integration.status.assign(kGearboxes, lockstep::LaneStatus::ok);
        return integration;
    });
    return mc::pilot_error(some_of(all, first, last), some_of(reference, first, last));
}

}  // namespace gearpod::peers
