#include "mc/ensemble/gearbox/tile_random_inputs.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>

#include "gears/tooth_deviations.hpp"

namespace gearpod::mc {
namespace {

// Knots per second (1 / D) of noise whose power spectrum falls to one half at `half_power_Hz`,
// where sinc(0.2275...)^8 = 1/2 (excitation.hpp).
double knots_per_s(double half_power_Hz) {
    constexpr double kHalfPower = 0.2275119577344975;
    return half_power_Hz / kHalfPower;
}

// Standard deviation of the knots that gives noise of rms 1: the mean square of the cubic B-spline
// is 151/315.
const double kKnotDeviation = std::sqrt(315.0 / 151.0);

// Parameters of a random fluctuation.
struct NoiseInputs {
    double rms, band_Hz;
};

// Generates independent normal knot values. Lanes with fewer knots are filled up with zeros.
void draw_noise(std::vector<NoiseInputs> noise, std::span<const double> mesh_period_s,
                double first_mesh, double last_mesh, std::vector<Philox> engines,
                lockstep::Fluctuation& f) {
    const std::size_t lanes = noise.size();
    std::vector<std::size_t> count(lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        boost::random::uniform_real_distribution<double> part(0.0, 1.0);
        const double a_mesh = knots_per_s(noise[l].band_Hz) * mesh_period_s[l];
        f.knots_per_s.push_back(a_mesh / mesh_period_s[l]);
        f.first_knot.push_back(1.0 + part(engines[l]) - first_mesh * a_mesh);
        // The spline uses two further knots.
        count[l] = 4 + static_cast<std::size_t>(std::ceil((last_mesh - first_mesh) * a_mesh));
    }
    f.knot.resize(*std::max_element(count.begin(), count.end()) * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        boost::random::normal_distribution<double> unit;
        for (std::size_t knot = 0; knot < count[l]; ++knot) {
            f.knot[knot * lanes + l] = noise[l].rms * kKnotDeviation * unit(engines[l]);
        }
    }
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

gears::DeviationScales scales_of(const ToothedBody& body, const InstanceInputs& inputs) {
    return gears::combined(gears::scaled(body.grade_5, inputs.bodies[body.member].tooth_scale),
                           {inputs.eccentricity_m, 0.0, inputs.pitch_error_m, 0.0, 0.0});
}

// Fills one lane of the errors of all flanks.
class LaneTeeth {
  public:
    LaneTeeth(LaneId lane, std::size_t lanes, Normals pitch, Normals waves, Normals slopes,
              lockstep::ToothErrors& errors)
        : lane_(lane),
          lanes_(lanes),
          pitch_(std::move(pitch)),
          waves_(std::move(waves)),
          slopes_(std::move(slopes)),
          errors_(errors) {}

    // `shift`: number of teeth by which the gear is turned in its assembly.
    void draw(const ToothedBody& body, const gears::DeviationScales& scales, int shift) {
        const gears::WaveNumbers numbers = wave_numbers(waves_);
        for (const ToothSide& side : body.sides) {
            lockstep::GearErrors& flanks = errors_.gears[side.gear];
            const gears::FlankDeviations wave = gears::wave_deviations(
                flanks.teeth, side.working_angle_rad, scales, numbers, side.direction);
            // The wave is given at the flank a quarter pitch from the tooth's centre, in contact at
            // the pitch point. The deviation is needed at the middle of the engagement.
            const double ahead = 0.25 * side.direction + side.middle;
            const double common = scales.common_slope * slopes_();
            for (int t = 0; t < flanks.teeth; ++t) {
                const int slot = (t + flanks.teeth - shift) % flanks.teeth;
                const auto index = static_cast<std::size_t>(slot) * lanes_ + lane_;
                const auto tooth = static_cast<std::size_t>((t + side.first_tooth) % flanks.teeth);
                const double scatter = scales.pitch * pitch_();
                const double slope = common + scales.slope * slopes_();
                const bool drawn = side.measured_m.empty();
                const double drift = drawn ? wave.drift_m[tooth] : 0.0;
                flanks.error_m[index] =
                    drawn ? wave.index_m[tooth] + ahead * drift + scatter : side.measured_m[tooth];
                flanks.slope_m[index] = slope + side.outwards * drift;
            }
        }
    }

  private:
    std::size_t lane_, lanes_;
    Normals pitch_, waves_, slopes_;
    lockstep::ToothErrors& errors_;
};

}  // namespace

std::optional<lockstep::Excitation> draw_excitation(const GearboxPlan& gearbox, std::uint64_t seed,
                                                    const ExcitedMeshes& meshes,
                                                    std::span<const Realization> realizations) {
    const std::optional<ExcitationModel>& model = gearbox.excitation;
    if (!model) {
        return std::nullopt;
    }
    const Drivetrain& drivetrain = *gearbox.drivetrain;
    const double input_turns = drivetrain.input_turns_per_mesh();
    std::vector<double> mesh_period_s;
    lockstep::Fluctuation speed;
    std::vector<NoiseInputs> torque_noise, speed_noise;
    std::vector<Philox> torque_engines, speed_engines;
    lockstep::Excitation excitation;
    for (const Realization& realization : realizations) {
        const FluctuationInstance& f = realization.inputs.fluctuations;
        mesh_period_s.push_back(dynamics::mesh_period_s(gearbox.inputs(realization.inputs)));
        speed.amplitude.push_back(f.speed);
        speed.turns_per_mesh.push_back(f.speed_order * input_turns);
        speed.turns_per_s.push_back(0.0);
        speed.turns.push_back(f.speed_phase_rad / (2.0 * std::numbers::pi));
        torque_noise.push_back({f.torque_noise, f.torque_noise_Hz});
        speed_noise.push_back({f.speed_noise, f.speed_noise_Hz});
        torque_engines.push_back(record_stream(seed, realization.id, StreamPurpose::torque_noise));
        speed_engines.push_back(record_stream(seed, realization.id, StreamPurpose::speed_noise));
        excitation.rotation_m_s.push_back(drivetrain.rotation_m_s(realization.inputs));
    }
    // When the speed drops, the sensor's time continues: the torque needs additional knots.
    const double first = -meshes.longest_run_in, last = meshes.signal;
    if (model->torque_noise) {
        const double additional = model->speed ? 0.5 * (last - first) : 0.0;
        draw_noise(torque_noise, mesh_period_s, first, last + additional, torque_engines,
                   excitation.torque.emplace());
    }
    if (model->speed) {
        excitation.speed = model->speed->sine ? speed : lockstep::Fluctuation{};
        excitation.input_degree = drivetrain.input_degree_of_freedom(gearbox.bodies.layout);
        if (model->speed->noise) {
            draw_noise(speed_noise, mesh_period_s, first, last, speed_engines, *excitation.speed);
        }
    }
    if (model->gravity) {
        excitation.gravity.emplace();
        excitation.gravity->direction_rad = -1.5707963267948966;  // downwards, away from the sensor
        excitation.gravity->carrier_turns_per_mesh = drivetrain.frame_turns_per_mesh();
    }
    return excitation;
}

signals::Tones draw_tones(std::span<const Tone> requested, const GearboxPlan& gearbox,
                          std::uint64_t seed, std::span<const Realization> realizations) {
    signals::Tones tones;
    if (requested.empty()) {
        return tones;
    }
    const std::size_t lanes = realizations.size();
    tones.phase_rad.resize(requested.size() * lanes);
    for (LaneId lane{0}; lane < lanes; ++lane) {
        tones.mesh_period_s.push_back(
            dynamics::mesh_period_s(gearbox.inputs(realizations[lane].inputs)));
        Philox engine = record_stream(seed, realizations[lane].id, StreamPurpose::tone_phases);
        boost::random::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi);
        for (std::size_t i = 0; i < requested.size(); ++i) {
            tones.phase_rad[i * lanes + lane] = turn(engine);
        }
    }
    for (const Tone& tone : requested) {
        const double turns_per_mesh =
            tone.shaft ? gearbox.drivetrain->shaft_turns_per_mesh(*tone.shaft) : 0.0;
        for (LaneId lane{0}; lane < lanes; ++lane) {
            tones.frequency_Hz.push_back(tone.shaft ? tone.order * turns_per_mesh /
                                                          tones.mesh_period_s[lane]
                                                    : tone.frequency_Hz);
            tones.amplitude_m_s2.push_back(realizations[lane].inputs.tone_level *
                                           tone.amplitude_m_s2);
        }
    }
    return tones;
}

lockstep::ToothErrors draw_tooth_errors(const ToothErrorModel& model, const DrawPlan& draw,
                                        std::span<const Realization> realizations) {
    const std::size_t lanes = realizations.size();
    lockstep::ToothErrors errors;
    errors.pairs = model.pairs;
    for (const ToothedBody& body : model.bodies) {
        const machine::AlignedVector none(static_cast<std::size_t>(body.teeth) * lanes);
        errors.gears.insert(errors.gears.end(), body.sides.size(), {body.teeth, none, none});
    }
    for (LaneId lane{0}; lane < lanes; ++lane) {
        const auto normals = [&](StreamPurpose purpose) {
            return Normals(draw.seed, realizations[lane].id, purpose);
        };
        LaneTeeth teeth(lane, lanes, normals(StreamPurpose::pitch_errors),
                        normals(StreamPurpose::index_waves), normals(StreamPurpose::profile_slopes),
                        errors);
        GearboxId assembly = realizations[lane].id;
        assembly.baseline = 0;  // one assembly for all baseline records
        Philox engine = record_stream(draw.seed, assembly, StreamPurpose::assembled_teeth);
        const bool shifted = assembly.record == Record::baseline && draw.redraws_teeth;
        for (const ToothedBody& body : model.bodies) {
            boost::random::uniform_int_distribution<int> shift(0, body.teeth - 1);
            teeth.draw(body, scales_of(body, realizations[lane].inputs),
                       shifted ? shift(engine) : 0);
        }
    }
    return errors;
}

}  // namespace gearpod::mc
