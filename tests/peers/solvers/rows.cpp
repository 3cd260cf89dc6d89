#include "rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace gearpod::peers {

namespace {

// The basic features except window_z, which without noise divides by the differences of equal
// teeth. A solver whose steps differ between mesh periods changes its value until its error is far
// below any measurable difference.
constexpr const char* kFeatures =
    R"(features.use=["te_rms","te_kurtosis","te_fc","te_fm0","sensor_rms","window_ratio"])";

}  // namespace

ResolvedStudy study_of(const Options& options, std::vector<std::string> overrides) {
    overrides.emplace_back(kFeatures);
    const mc::StudyReading reading = mc::read_study(options.study, overrides);
    if (!reading.study) {
        throw std::runtime_error(mc::format(reading.problems));
    }
    ResolvedStudy resolved{*reading.study, std::nullopt};
    mc::ResolvedNumerics numerics =
        mc::resolve_numerics(mc::Planner(resolved.study), resolved.study.numerics);
    resolved.study.numerics = numerics.numerics;
    resolved.choice = std::move(numerics.choice);
    return resolved;
}

namespace {

template <class Value>
void keep(std::vector<Value>& all, int first, int last) {
    all = std::vector<Value>(all.begin() + first, all.begin() + last);
}

// A record reduced to those gearboxes.
mc::PilotRecord some_of(const mc::PilotRecord& all, int first, int last) {
    mc::PilotRecord some = all;
    keep(some.ok, first, last);
    keep(some.sensor, first, last);
    keep(some.te, first, last);
    keep(some.features, first, last);
    return some;
}

// Ratios of the rounds, ascending.
std::vector<double> ratios(const Row& row, const Row& to, double scale) {
    std::vector<double> all;
    for (std::size_t i = 0; i < row.times.size(); ++i) {
        all.push_back(scale * row.times[i] / to.times[i]);
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

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

nlohmann::ordered_json ratio_json(const Row& row, const Row& to, double scale) {
    const std::vector<double> all = ratios(row, to, scale);
    return {{"median", median(all)},
            {"low", all.front()},
            {"high", all.back()},
            {"rounds", all.size()}};
}

}  // namespace gearpod::peers
