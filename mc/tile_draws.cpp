#include "mc/tile_draws.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <numbers>

#include "mc/study_gears.hpp"

namespace gearpod::mc {
namespace {

Philox stream_of(const Scene& scene, std::span<const GearboxId> ids, std::size_t lane,
                 std::string_view purpose) {
    const GearboxId& id = ids[std::min(lane, ids.size() - 1)];
    return {static_cast<std::uint64_t>(scene.study().ensemble.seed), id.group, id.index,
            parameter_id(purpose)};
}

// Teeth of the gears in the order of lockstep::planetary_teeth and fixed_shaft_teeth.
std::vector<int> flanks(const Study& study) {
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return {*study.fixed_shaft.pinion_teeth, *study.fixed_shaft.gear_teeth};
    }
    const Gearbox& g = study.gearbox;
    std::vector<int> teeth{*g.sun_teeth, *g.ring_teeth};
    teeth.resize(teeth.size() + 2 * static_cast<std::size_t>(g.planets), *g.planet_teeth);
    return teeth;
}

}  // namespace

signals::Tones draw_tones(const Scene& scene, std::span<const GearboxId> ids,
                          std::span<const InstanceInputs> inputs) {
    signals::Tones tones;
    const std::vector<Tone>& wanted = scene.study().sensor.tones;
    if (wanted.empty()) {
        return tones;
    }
    const std::size_t lanes = inputs.size();
    tones.phase_rad.resize(wanted.size() * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        tones.mesh_period_s.push_back(dynamics::mesh_period_s(scene.inputs(inputs[lane])));
        Philox engine = stream_of(scene, ids, lane, "sensor.tones.phase");
        boost::random::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            tones.phase_rad[i * lanes + lane] = turn(engine);
        }
    }
    for (const Tone& tone : wanted) {
        tones.frequency_Hz.insert(tones.frequency_Hz.end(), lanes, tone.frequency_Hz);
        tones.amplitude_m_s2.insert(tones.amplitude_m_s2.end(), lanes, tone.amplitude_m_s2);
    }
    return tones;
}

std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const GearboxId> ids,
                                                       std::span<const InstanceInputs> inputs) {
    if (scene.load_shares() == nullptr) {
        return std::nullopt;
    }
    const std::size_t lanes = inputs.size();
    lockstep::ToothErrors errors;
    errors.shares = scene.load_shares();
    const auto* planetary = dynamic_cast<const PlanetaryDrive*>(&scene.drive());
    errors.pairs =
        planetary == nullptr
            ? lockstep::fixed_shaft_teeth()
            : lockstep::planetary_teeth(scene.pairs(), planetary->train(), planetary->sense());
    for (const int teeth : flanks(scene.study())) {
        errors.gears.push_back(
            {teeth, machine::AlignedVector(static_cast<std::size_t>(teeth) * lanes)});
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        Philox engine = stream_of(scene, ids, lane, "gearbox.pitch_error.teeth");
        boost::random::normal_distribution<double> unit;
        for (lockstep::GearErrors& gear : errors.gears) {
            for (std::size_t tooth = 0; tooth < static_cast<std::size_t>(gear.teeth); ++tooth) {
                gear.error_m[tooth * lanes + lane] = inputs[lane].pitch_error_m * unit(engine);
            }
        }
    }
    return errors;
}

}  // namespace gearpod::mc
