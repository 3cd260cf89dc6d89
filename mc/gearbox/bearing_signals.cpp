#include "mc/gearbox/bearing_signals.hpp"

#include <numbers>
#include <string>

#include "machine/cancellation.hpp"
#include "mc/gearbox/record_samples.hpp"

namespace gearpod::mc {

signals::BearingImpulses bearing_impulses(const Scene& scene, const InstanceInputs& inputs,
                                          const Bearing& bearing) {
    const double shaft_Hz = bearing.shaft
                                ? scene.drivetrain().shaft_turns_per_mesh(*bearing.shaft) /
                                      dynamics::mesh_period_s(scene.inputs(inputs))
                                : bearing.shaft_Hz;
    const double load_turns = load_turns_per_turn(bearing);
    return {
        .rate_Hz = impulses_per_turn(bearing) * shaft_Hz,
        .slip = bearing.slip,
        .load_turns_Hz = load_turns * shaft_Hz,
        .load_zone_rad = load_turns > 0.0 ? bearing.load_zone_deg * std::numbers::pi / 180.0 : 0.0,
        .amplitude_m_s2 = inputs.bearing_level * bearing.amplitude_m_s2,
        .resonance_Hz = bearing.resonance_Hz,
        .damping = bearing.damping};
}

void add_bearings(const Scene& scene, const Realization& realization, BearingRole role,
                  LaneSignals& record) {
    const Study& study = scene.study();
    if (record.sensor.empty() || !has_bearings(study, role)) {
        return;
    }
    for (std::size_t i = 0; i < study.sensor.bearings.size(); ++i) {
        const Bearing& bearing = study.sensor.bearings[i];
        if (bearing.role != role) {
            continue;
        }
        machine::throw_if_cancelled();
        Philox engine = record_stream(
            study, realization.id, with_suffix(StreamPurpose::bearing_impulses, std::to_string(i)));
        signals::add_bearing_vibration(bearing_impulses(scene, realization.inputs, bearing),
                                       study.sensor.low_pass_Hz,
                                       sample_s(scene, realization.inputs), engine, record.sensor);
    }
    fold_again(scene, record);
}

}  // namespace gearpod::mc
