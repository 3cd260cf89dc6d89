#include "mc/gearbox/tile_random_inputs.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>

#include "lockstep/integrators/sensor_filter.hpp"
#include "mc/scene/stepping.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

namespace {

// Parameters of a sinusoidal fluctuation; next, of a random one.
struct SineInputs {
    double amplitude, turns_per_mesh, turns_per_s, phase_rad;
};
struct NoiseInputs {
    double rms, band_Hz;
};

void add_sine(const SineInputs& in, lockstep::Fluctuation& f) {
    f.amplitude.push_back(in.amplitude);
    f.turns_per_mesh.push_back(in.turns_per_mesh);
    f.turns_per_s.push_back(in.turns_per_s);
    f.turns.push_back(in.phase_rad / (2.0 * std::numbers::pi));
}

// Generates independent normal knot values. Lanes with fewer knots are filled up with zeros.
void draw_noise(std::vector<NoiseInputs> noise, std::span<const double> mesh_period_s,
                double first_mesh, double last_mesh, std::vector<Philox> engines,
                lockstep::Fluctuation& f) {
    const std::size_t lanes = noise.size();
    std::vector<std::size_t> count(lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        boost::random::uniform_real_distribution<double> part(0.0, 1.0);
        const double a_mesh = lockstep::knots_per_s(noise[l].band_Hz) * mesh_period_s[l];
        f.knots_per_s.push_back(a_mesh / mesh_period_s[l]);
        f.first_knot.push_back(1.0 + part(engines[l]) - first_mesh * a_mesh);
        // The spline uses two further knots.
        count[l] = 4 + static_cast<std::size_t>(std::ceil((last_mesh - first_mesh) * a_mesh));
    }
    f.knot.resize(*std::max_element(count.begin(), count.end()) * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        boost::random::normal_distribution<double> unit;
        for (std::size_t knot = 0; knot < count[l]; ++knot) {
            f.knot[knot * lanes + l] = noise[l].rms * lockstep::knot_deviation() * unit(engines[l]);
        }
    }
}

// Upper limit of the run-in, in mesh periods. Fluctuations always begin this long before the first
// recorded mesh period, so that they do not depend on the actual run-in.
int most_run_in(const Scene& scene) {
    return scene.max_meshes() / 2;
}

// Mesh periods in which the slowest mode of the sensor's low-pass filter decays to 1/e.
double filter_decay_meshes(const Scene& scene) {
    const double rate = 0.5 * lockstep::kFilterDamping[1] * scene.plan().low_pass_rad_s;
    return scene.nominal_mesh_frequency_Hz() / rate;
}

}  // namespace

int run_in_meshes(const Scene& scene) {
    constexpr double kFewest = 10.0;
    const Study& study = scene.study();
    if (reason_not_periodic(study).empty() || study.effects.quasi_static()) {
        return 0;
    }
    // Twice the decay time of the nominal gearbox and its sensor, because other gearboxes decay
    // more slowly.
    const double decays = -2.0 * std::log(convergence_tolerance(study));
    const double meshes = decays * std::max(scene.decay_meshes(), filter_decay_meshes(scene));
    return static_cast<int>(
        std::min(std::ceil(std::max(kFewest, meshes)), static_cast<double>(most_run_in(scene))));
}

std::optional<lockstep::Excitation> draw_excitation(const Scene& scene,
                                                    std::span<const Realization> realizations) {
    const Study& study = scene.study();
    if (!has_variable_excitation(study)) {
        return std::nullopt;
    }
    const Drivetrain& drivetrain = scene.drivetrain();
    const double input_turns = drivetrain.input_turns_per_mesh();
    std::vector<double> mesh_period_s;
    lockstep::Fluctuation torque, speed;
    std::vector<NoiseInputs> torque_noise, speed_noise;
    std::vector<Philox> torque_engines, speed_engines;
    lockstep::Excitation excitation;
    for (const Realization& one : realizations) {
        const FluctuationInstance& f = one.inputs.fluctuations;
        mesh_period_s.push_back(dynamics::mesh_period_s(scene.inputs(one.inputs)));
        add_sine({f.torque, f.torque_order * input_turns, f.torque_Hz, f.torque_phase_rad}, torque);
        add_sine({f.speed, f.speed_order * input_turns, 0.0, f.speed_phase_rad}, speed);
        torque_noise.push_back({f.torque_noise, f.torque_noise_Hz});
        speed_noise.push_back({f.speed_noise, f.speed_noise_Hz});
        torque_engines.push_back(record_stream(study, one.id, StreamPurpose::torque_noise));
        speed_engines.push_back(record_stream(study, one.id, StreamPurpose::speed_noise));
        excitation.rotation_m_s.push_back(drivetrain.rotation_m_s(one.inputs));
    }
    // When the speed drops, the sensor's time continues: the torque needs additional knots.
    const double first = -most_run_in(scene), last = scene.signal_meshes();
    if (torque_fluctuates(study)) {
        excitation.torque = torque_has_sine(study) ? torque : lockstep::Fluctuation{};
        if (torque_has_noise(study)) {
            const double additional = speed_fluctuates(study) ? 0.5 * (last - first) : 0.0;
            draw_noise(torque_noise, mesh_period_s, first, last + additional, torque_engines,
                       *excitation.torque);
        }
    }
    if (speed_fluctuates(study)) {
        excitation.speed = speed_has_sine(study) ? speed : lockstep::Fluctuation{};
        excitation.input_degree = drivetrain.input_degree_of_freedom(scene.plan().layout);
        if (speed_has_noise(study)) {
            draw_noise(speed_noise, mesh_period_s, first, last, speed_engines, *excitation.speed);
        }
    }
    if (study.effects.gravity) {
        excitation.gravity.emplace();
        excitation.gravity->direction_rad = study.effects.gravity_direction_rad;
        excitation.gravity->carrier_turns_per_mesh = drivetrain.frame_turns_per_mesh();
    }
    return excitation;
}

signals::Tones draw_tones(const Scene& scene, std::span<const Realization> realizations) {
    signals::Tones tones;
    const std::vector<Tone>& requested = scene.study().sensor.tones;
    if (requested.empty()) {
        return tones;
    }
    const std::size_t lanes = realizations.size();
    tones.phase_rad.resize(requested.size() * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        tones.mesh_period_s.push_back(
            dynamics::mesh_period_s(scene.inputs(realizations[lane].inputs)));
        Philox engine =
            record_stream(scene.study(), realizations[lane].id, StreamPurpose::tone_phases);
        boost::random::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi);
        for (std::size_t i = 0; i < requested.size(); ++i) {
            tones.phase_rad[i * lanes + lane] = turn(engine);
        }
    }
    for (const Tone& tone : requested) {
        const double turns_per_mesh =
            tone.shaft ? scene.drivetrain().shaft_turns_per_mesh(*tone.shaft) : 0.0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            tones.frequency_Hz.push_back(tone.shaft ? tone.order * turns_per_mesh /
                                                          tones.mesh_period_s[lane]
                                                    : tone.frequency_Hz);
            tones.amplitude_m_s2.push_back(realizations[lane].inputs.tone_level *
                                           tone.amplitude_m_s2);
        }
    }
    return tones;
}

}  // namespace gearpod::mc
