#include "mc/gearbox/random_tooth_errors.hpp"

#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>

#include "gears/tooth_deviations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
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
            return Normals(scene.study(), realizations[lane].id, purpose);
        };
        LaneTeeth teeth(scene, lane, lanes, normals(StreamPurpose::pitch_errors),
                        normals(StreamPurpose::index_waves), normals(StreamPurpose::profile_slopes),
                        errors);
        GearboxId assembly = realizations[lane].id;
        assembly.baseline = 0;  // one assembly for all baseline records
        Philox engine = record_stream(scene.study(), assembly, StreamPurpose::assembled_teeth);
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
