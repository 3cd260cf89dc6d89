#include "mc/ensemble/gearbox/tile_random_inputs.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>

#include "gears/tooth_deviations.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "mc/plan/stepping.hpp"
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
        torque_engines.push_back(
            record_stream(scene.draw().seed, one.id, StreamPurpose::torque_noise));
        speed_engines.push_back(
            record_stream(scene.draw().seed, one.id, StreamPurpose::speed_noise));
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
            record_stream(scene.draw().seed, realizations[lane].id, StreamPurpose::tone_phases);
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

namespace {

// Gear with one working side, or planet with two.
struct ToothedBody {
    Member member;
    int which;                       // planet number
    std::vector<std::size_t> sides;  // indices into lockstep::ToothErrors
    std::vector<int> first;          // tooth that each side counts as 0
};

// Tooth of planet n that its ring side counts as 0. This tooth meshes with the ring half a planet
// turn after its mesh with the sun (lockstep::planet_fault_pattern).
int first_on_ring(const lockstep::PairSet& pairs, int n, int teeth) {
    const int ring_pair = pairs.pairs() / 2 + n;
    const double half_turn = 0.5 * (teeth + (pairs.reversed ? 1 : -1));
    const long later = std::lround(pairs.pitch_phase(n) + half_turn - pairs.pitch_phase(ring_pair));
    return static_cast<int>((teeth - later % teeth) % teeth);
}

// Bodies in the order of lockstep::planetary_teeth and fixed_shaft_teeth.
std::vector<ToothedBody> toothed_bodies(const Scene& scene) {
    const Study& study = scene.study();
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return {{Member::pinion, 0, {0}, {0}}, {Member::gear, 0, {1}, {0}}};
    }
    std::vector<ToothedBody> bodies{{Member::sun, 0, {0}, {0}}, {Member::ring, 0, {1}, {0}}};
    const int teeth = teeth_of(study, Member::planet).value();
    for (int n = 0; n < study.gearbox.planets; ++n) {
        const auto side = 2 + 2 * static_cast<std::size_t>(n);
        bodies.push_back(
            {Member::planet, n, {side, side + 1}, {0, first_on_ring(scene.pairs(), n, teeth)}});
    }
    return bodies;
}

MeshKind mesh_of_side(const ToothedBody& body, std::size_t side) {
    switch (body.member) {
        case Member::sun:
            return MeshKind::sun_planet;
        case Member::planet:
            return side == 0 ? MeshKind::sun_planet : MeshKind::ring_planet;
        case Member::ring:
        case Member::carrier:
            return MeshKind::ring_planet;
        case Member::pinion:
        case Member::gear:
            return MeshKind::pinion_gear;
    }
    return MeshKind::pinion_gear;
}

gears::WaveNumbers wave_numbers(Normals& normal) {
    gears::WaveNumbers numbers;
    for (double& number : numbers.centre) {
        number = normal();
    }
    for (int h = 0; h < gears::WaveNumbers::kHarmonics; ++h) {
        numbers.cosine[h] = normal();
        numbers.sine[h] = normal();
    }
    return numbers;
}

gears::DeviationScales scales_of_member(const Scene& scene, Member member,
                                        const InstanceInputs& inputs) {
    return gears::combined(
        gears::scaled(scene.tooth_scales()[member], inputs.bodies[member].tooth_scale),
        {inputs.eccentricity_m, inputs.index_wave_m, inputs.pitch_error_m, 0.0,
         inputs.profile_slope_m});
}

// Fills one lane of the errors of all flanks.
class LaneTeeth {
  public:
    LaneTeeth(const Scene& scene, std::size_t lane, std::size_t lanes, Normals pitch, Normals waves,
              Normals slopes, lockstep::ToothErrors& errors)
        : scene_(scene),
          lane_(lane),
          lanes_(lanes),
          pitch_(std::move(pitch)),
          waves_(std::move(waves)),
          slopes_(std::move(slopes)),
          errors_(errors) {}

    // `shift`: number of teeth by which the gear is turned in its assembly.
    void draw(const ToothedBody& body, const gears::DeviationScales& scales, int shift) {
        const gears::WaveNumbers numbers = wave_numbers(waves_);
        for (std::size_t s = 0; s < body.sides.size(); ++s) {
            lockstep::GearErrors& flanks = errors_.gears[body.sides[s]];
            // Teeth are numbered in order of engagement: against the direction of rotation if the
            // gear turns backwards.
            const int direction = (s == 0) != scene_.pairs().reversed ? 1 : -1;
            const gears::FlankDeviations wave = gears::wave_deviations(
                flanks.teeth, working_angle_rad(scene_.study(), mesh_of_side(body, s)), scales,
                numbers, direction);
            const Engagement engagement = engagement_of(body.sides[s]);
            // The wave is given at the flank a quarter pitch from the tooth's centre, in contact at
            // the pitch point. The deviation is needed at the middle of the engagement.
            const double ahead = 0.25 * direction + engagement.from_pitch;
            const double common = scales.common_slope * slopes_();
            const std::span<const double> measured = measured_index(body, s, flanks.teeth);
            for (int t = 0; t < flanks.teeth; ++t) {
                const int slot = (t + flanks.teeth - shift) % flanks.teeth;
                const auto at = static_cast<std::size_t>(slot) * lanes_ + lane_;
                const auto tooth = static_cast<std::size_t>((t + body.first[s]) % flanks.teeth);
                const double scatter = scales.pitch * pitch_();
                const double own_slope = common + scales.slope * slopes_();
                const bool drawn = measured.empty();
                const double drift = drawn ? wave.drift_m[tooth] : 0.0;
                flanks.error_m[at] =
                    drawn ? wave.index_m[tooth] + ahead * drift + scatter : measured[tooth];
                flanks.slope_m[at] = own_slope + engagement.outwards * drift;
            }
        }
    }

  private:
    // Measured index deviations of one side of a gear; empty if they are random.
    std::span<const double> measured_index(const ToothedBody& body, std::size_t side,
                                           int teeth) const {
        const MemberValues& given = scene_.study().gearbox.bodies[body.member];
        const std::span<const double> all = side == 0 ? given.index_m : given.ring_side_index_m;
        return all.empty() ? all
                           : all.subspan(static_cast<std::size_t>(body.which * teeth),
                                         static_cast<std::size_t>(teeth));
    }

    // Mesh periods from contact at the pitch point to the middle of the engagement, and duration of
    // the engagement from root to tip. The duration is negative if contact moves from tip to root.
    struct Engagement {
        double from_pitch = 0.0, outwards = 0.0;
    };
    Engagement engagement_of(std::size_t side) const {
        for (std::size_t p = 0; p < errors_.pairs.size(); ++p) {
            const lockstep::PairTeeth& teeth = errors_.pairs[p];
            const int pair = static_cast<int>(p);
            const lockstep::PairSet& pairs = scene_.pairs();
            for (const int which : {0, 1}) {
                if (static_cast<std::size_t>(teeth.gear[which]) == side) {
                    const stiffness::MeshStiffness& mesh = pairs.curve(pair);
                    const double ratio = mesh.slice().contact_ratio();
                    const bool outwards = (which == teeth.driver) != pairs.reversed;
                    const double middle = 0.5 * (mesh.path_begin() + mesh.path_end());
                    const double since = pairs.reversed ? mesh.contact_ratio() - middle : middle;
                    return {since - (pairs.pitch_phase(pair) - pairs.start[p]),
                            outwards ? ratio : -ratio};
                }
            }
        }
        return {};
    }

    const Scene& scene_;
    std::size_t lane_, lanes_;
    Normals pitch_, waves_, slopes_;
    lockstep::ToothErrors& errors_;
};

}  // namespace

std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const Realization> realizations) {
    if (!has_tooth_errors(scene.study())) {
        return std::nullopt;
    }
    const std::size_t lanes = realizations.size();
    const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(&scene.drivetrain());
    lockstep::ToothErrors errors;
    errors.pairs =
        planetary == nullptr
            ? lockstep::fixed_shaft_teeth()
            : lockstep::planetary_teeth(scene.pairs(), planetary->train(), planetary->sense());
    const std::vector<ToothedBody> bodies = toothed_bodies(scene);
    for (const ToothedBody& body : bodies) {
        const int teeth = teeth_of(scene.study(), body.member).value();
        const machine::AlignedVector none(static_cast<std::size_t>(teeth) * lanes);
        errors.gears.insert(errors.gears.end(), body.sides.size(), {teeth, none, none});
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto normals = [&](StreamPurpose purpose) {
            return Normals(scene.draw().seed, realizations[lane].id, purpose);
        };
        LaneTeeth teeth(scene, lane, lanes, normals(StreamPurpose::pitch_errors),
                        normals(StreamPurpose::index_waves), normals(StreamPurpose::profile_slopes),
                        errors);
        GearboxId assembly = realizations[lane].id;
        assembly.baseline = 0;  // one assembly for all baseline records
        Philox engine = record_stream(scene.draw().seed, assembly, StreamPurpose::assembled_teeth);
        const bool shifted = assembly.record == Record::baseline && redraws(scene.study(), "teeth");
        for (const ToothedBody& body : bodies) {
            const int last = teeth_of(scene.study(), body.member).value() - 1;
            boost::random::uniform_int_distribution<int> shift(0, last);
            teeth.draw(body, scales_of_member(scene, body.member, realizations[lane].inputs),
                       shifted ? shift(engine) : 0);
        }
    }
    return errors;
}

}  // namespace gearpod::mc
