#include "peer_runs.hpp"

#include <variant>

namespace gearpod::peers {

Gearbox<double> gearbox_of(const Task& task, int gearbox) {
    const auto& layout =
        std::get<dynamics::PlanetaryLayout>(task.scene.solve().integration().layout);
    const auto& in = std::get<dynamics::PlanetaryInputs>(
        task.gearboxes.inputs[static_cast<std::size_t>(gearbox)]);
    Gearbox<double> g{};
    const double right = std::numbers::pi / 2, alpha = layout.pressure_angle_rad;
    for (int n = 0; n < kPlanets; ++n) {
        const double psi = layout.planet_angle(n);
        g.cos_psi[n] = std::cos(psi);
        g.sin_psi[n] = std::sin(psi);
        g.cos_sun[n] = std::cos(psi + right - alpha);
        g.sin_sun[n] = std::sin(psi + right - alpha);
        g.cos_ring[n] = std::cos(psi + right + alpha);
        g.sin_ring[n] = std::sin(psi + right + alpha);
    }
    g.low_pass_rad_s = task.scene.solve().integration().low_pass_rad_s;
    for (int b = 0; b < 4; ++b) {
        g.inverse_mass[b] = 1.0 / in.mass_kg[b];
        g.inverse_inertia[b] = 1.0 / in.inertia_over_r2_kg[b];
        g.bearing_stiffness[b] = in.bearing_stiffness_N_m[b];
        g.bearing_damping[b] = in.bearing_damping_N_s_m[b];
    }
    for (int b = 0; b < 3; ++b) {
        g.force[b] = in.force_N[b];
    }
    const int held = dynamics::body_index(layout.fixed);
    g.support_stiffness[held] = in.support_stiffness_N_m;
    g.support_damping[held] = in.support_damping_N_s_m;
    g.speed = in.carrier_speed_rad_s;
    g.pull = layout.carrier_radius_m * g.speed * g.speed;
    return g;
}

void copy_start(const Task& task, int gearbox, double* y) {
    for (const auto* part : {&task.start.q, &task.start.v, &task.start.filter}) {
        for (std::size_t i = static_cast<std::size_t>(gearbox); i < part->size(); i += kGearboxes) {
            *y++ = (*part)[i];
        }
    }
}

void record_sample(const Task& task, const double* y, bool sensing, int lane, int sample,
                   lockstep::MeshRecord& record) {
    for (int c = 0; c < kChannels && sensing; ++c) {
        record
            .acceleration[static_cast<std::size_t>((sample * kChannels + c) * kGearboxes + lane)] =
            y[kMotionStates + 4 * c + 2];
    }
    double te = 0.0;
    for (int d = 0; d < kMotions; ++d) {
        te += task.scene.solve().integration().te_weight[static_cast<std::size_t>(d)] * y[d];
    }
    record.te[static_cast<std::size_t>(sample * kGearboxes + lane)] = te;
}

std::vector<lockstep::MeshRecord> empty_records(const Task& task, int meshes) {
    return std::vector<lockstep::MeshRecord>(
        static_cast<std::size_t>(meshes),
        lockstep::make_record(task.scene.solve().integration(), kGearboxes, false));
}

int pattern_mesh(const Task& task, int k) {
    const int length = task.steps.meshes();
    return ((k % length) + length) % length;
}

}  // namespace gearpod::peers
