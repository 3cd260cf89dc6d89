#include "mc/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gears/mesh_geometry.hpp"
#include "lockstep/step_limit.hpp"
#include "mc/study_gears.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/square_wave_mesh.hpp"

namespace gearpod::mc {
namespace {

using gears::FixedMember;
using std::numbers::pi;

FixedMember fixed_member(Member member) {
    switch (member) {
        case Member::sun:
            return FixedMember::sun;
        case Member::carrier:
            return FixedMember::carrier;
        default:
            return FixedMember::ring;
    }
}

gears::Member turning_member(Member member) {
    switch (member) {
        case Member::sun:
            return gears::Member::sun;
        case Member::carrier:
            return gears::Member::carrier;
        default:
            return gears::Member::ring;
    }
}

constexpr int kMostSteps = 1'000'000;  // and samples, in a mesh period
constexpr int kFewestSamples = 4;

// The smallest number >= least whose only prime factors are 2, 3 and 5: Fourier transforms of a
// whole planet turn stay fast.
int round_up_to_smooth(int least) {
    for (int n = std::max(least, 1);; ++n) {
        int rest = n;
        for (const int prime : {2, 3, 5}) {
            while (rest % prime == 0) {
                rest /= prime;
            }
        }
        if (rest == 1) {
            return n;
        }
    }
}

}  // namespace

dynamics::PlanetaryLayout layout(const Study& study) {
    dynamics::PlanetaryLayout result;
    const Gearbox& g = study.gearbox;
    result.planets = g.planets;
    result.pressure_angle_rad = g.pressure_angle_rad;
    result.fixed = fixed_member(study.operation.fixed);
    result.motion = study.effects.motion == Motion::torsional
                        ? dynamics::Motion::torsional
                        : dynamics::Motion::translational_torsional;
    result.inertial_terms = study.effects.inertial_terms;
    switch (study.effects.mesh_damping) {
        case MeshDamping::ratio:
            result.mesh_damping = dynamics::MeshDamping::ratio;
            break;
        case MeshDamping::proportional:
            result.mesh_damping = dynamics::MeshDamping::proportional;
            break;
        case MeshDamping::constant:
            result.mesh_damping = dynamics::MeshDamping::constant;
            break;
    }
    if (g.has_teeth() && g.module_m) {
        result.carrier_radius_m = 0.5 * *g.module_m * (*g.sun_teeth + *g.planet_teeth);
    }
    return result;
}

dynamics::PlanetaryInputs body_inputs(const InstanceInputs& in) {
    using namespace dynamics;
    PlanetaryInputs out;
    const auto set = [&](Body body, double mass, double inertia, double k, double c) {
        out.mass_kg[body] = mass;
        out.inertia_over_r2_kg[body] = inertia;
        out.bearing_stiffness_N_m[body] = k;
        out.bearing_damping_N_s_m[body] = c;
    };
    set(sun, in.sun_mass_kg, in.sun_inertia_over_r2_kg, in.sun_bearing_stiffness_N_m,
        in.sun_bearing_damping_N_s_m);
    set(planet, in.planet_mass_kg, in.planet_inertia_over_r2_kg, in.planet_bearing_stiffness_N_m,
        in.planet_bearing_damping_N_s_m);
    set(ring, in.ring_mass_kg, in.ring_inertia_over_r2_kg, in.ring_bearing_stiffness_N_m,
        in.ring_bearing_damping_N_s_m);
    set(carrier, in.carrier_mass_kg, in.carrier_inertia_over_r2_kg,
        in.carrier_bearing_stiffness_N_m, in.carrier_bearing_damping_N_s_m);
    out.support_stiffness_N_m = in.support_stiffness_N_m;
    out.support_damping_N_s_m = in.support_damping_N_s_m;
    out.mesh_damping = in.mesh_damping;
    return out;
}

Scene::Scene(const Study& study) : study_(study), speed_member_(Sampler(study).speed_member()) {
    const Gearbox& g = study_.gearbox;
    if (!g.has_teeth() || !g.module_m) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    train_ = {*g.sun_teeth, *g.planet_teeth, *g.ring_teeth, g.planets};
    sun_radius_ = gear_of(g, Member::sun).base_radius();
    ring_radius_ = gear_of(g, Member::ring).base_radius();
    plan_.layout = layout(study_);

    const InstanceInputs nominal = Sampler(study_).nominal();
    const gears::Speeds turning = speeds(nominal.speed_rad_s);
    nominal_mesh_frequency_Hz_ = gears::mesh_frequency(train_, turning) / (2.0 * pi);
    sense_ = turning.sun > turning.carrier ? gears::PlanetSense::clockwise
                                           : gears::PlanetSense::counter_clockwise;
    build_pairs();
    build_pattern();
    build_plan();
}

// The given member's speed is a magnitude; the input turns in the positive sense.
gears::Speeds Scene::speeds(double given) const {
    gears::Speeds s =
        gears::train_speeds(train_, plan_.layout.fixed, turning_member(speed_member_), given);
    const double input = study_.operation.input == Member::ring ? s.ring : s.sun;
    return input >= 0.0 ? s : gears::Speeds{-s.sun, -s.planet, -s.ring, -s.carrier};
}

void Scene::build_pairs() {
    const Gearbox& g = study_.gearbox;
    if (g.tooth_profile == ToothProfile::constant) {
        const auto constant = [](double stiffness_N_m) {
            return std::make_unique<const stiffness::SquareWaveMesh>(
                stiffness::SquareWaveMesh::constant(stiffness_N_m));
        };
        sun_planet_ = constant(*g.sun_planet_stiffness_N_m);
        ring_planet_ = constant(*g.ring_planet_stiffness_N_m);
    } else {
        const stiffness::Material material{*g.young_modulus_Pa, *g.poisson_ratio, *g.face_width_m};
        const auto profile = g.tooth_profile == ToothProfile::root_circle
                                 ? stiffness::Profile::root_circle
                                 : stiffness::Profile::base_circle;
        const gears::Gear sun = gear_of(g, Member::sun);
        const gears::Gear planet = gear_of(g, Member::planet);
        const gears::Gear ring = gear_of(g, Member::ring);
        const gears::MeshGeometry sun_planet(sun, planet), ring_planet(planet, ring);
        sun_planet_ =
            std::make_unique<const stiffness::AdditiveMesh>(sun_planet, material, profile);
        ring_planet_ =
            std::make_unique<const stiffness::AdditiveMesh>(ring_planet, material, profile);
        const Fault& f = study_.fault;
        if (f.kind == FaultKind::crack) {
            const bool on_sun_mesh =
                f.member == Member::sun || (f.member == Member::planet && f.side == Member::sun);
            const int gear =
                f.member == Member::sun || (f.member == Member::planet && !on_sun_mesh) ? 1 : 2;
            fault_ = std::make_unique<const stiffness::ToothCrack>(
                on_sun_mesh ? sun_planet : ring_planet, material, profile, gear, f.angle_rad);
        }
    }
    // A tooth pair that is touched in the reverse order begins where it used to end.
    pairs_.reversed = sense_ == gears::PlanetSense::counter_clockwise;
    const auto add = [&](double pitch_phase, const stiffness::MeshStiffness& mesh) {
        const double since =
            pairs_.reversed ? mesh.contact_ratio() - mesh.pitch_position() : mesh.pitch_position();
        pairs_.mesh.push_back(&mesh);
        pairs_.start.push_back(lockstep::phase_in_period(pitch_phase - since));
    };
    for (int n = 0; n < train_.planets; ++n) {
        add(gears::sun_mesh_phase(train_, n, sense_), *sun_planet_);
    }
    for (int n = 0; n < train_.planets; ++n) {
        const double phase =
            gears::ring_mesh_phase(train_, n, sense_) + gears::ring_to_sun_phase(train_);
        add(phase, *ring_planet_);
    }
}

void Scene::build_pattern() {
    const Fault& f = study_.fault;
    if (f.kind == FaultKind::none) {
        return;
    }
    const auto planets = lockstep::equal_planets(train_.planets);
    switch (*f.member) {
        case Member::sun:
            pattern_ = lockstep::sun_fault_pattern(pairs_, planets, train_.sun_teeth);
            return;
        case Member::planet:
            pattern_ = lockstep::planet_fault_pattern(
                pairs_, f.planet - 1,
                f.side == Member::sun ? lockstep::PlanetSide::sun : lockstep::PlanetSide::ring,
                train_.planet_teeth);
            return;
        default:
            pattern_ = lockstep::ring_fault_pattern(pairs_, planets, train_.ring_teeth);
    }
}

// Samples a mesh period at least, for a rate of `key`.
int Scene::sampling(double frequency_Hz, const char* key) const {
    const double samples = std::ceil(frequency_Hz / nominal_mesh_frequency_Hz_ - 1e-9);
    if (samples > kMostSteps) {
        throw SceneError(key,
                         fmt::format("{:.3g} samples a mesh period are too many (at most {})",
                                     samples, kMostSteps),
                         "lower the rate or raise the speed");
    }
    return std::max(1, static_cast<int>(samples));
}

std::vector<double> Scene::mean_pairs() const {
    std::vector<double> k(static_cast<std::size_t>(train_.planets), mean_total(*sun_planet_));
    k.resize(2 * k.size(), mean_total(*ring_planet_));
    return k;
}

std::vector<double> Scene::stiffest_pairs() const {
    constexpr int kPhases = 200;
    std::vector<double> k;
    for (int i = 0; i < pairs_.pairs(); ++i) {
        double stiffest = 0.0;
        for (int p = 0; p < kPhases; ++p) {
            stiffest = std::max(stiffest, pairs_.total(i, static_cast<double>(p) / kPhases));
        }
        k.push_back(stiffest);
    }
    return k;
}

// One grid serves all gearboxes: it must be stable for the stiffest and lightest of them. A pilot
// of the ensemble, the same for every run of the study, stands for the rest; the margin covers what
// the pilot misses, and a gearbox beyond it is reported as diverged.
int Scene::choose_steps() {
    constexpr int kPilot = 32;
    constexpr double kMargin = 1.2;
    constexpr double kStepsPerBandPeriod = 20.0;  // of the sensor's band edge
    constexpr double kFewestStepsPerBandPeriod = 10.0;
    const Sampler sampler(study_);
    const std::vector<double> stiffest = stiffest_pairs();
    const auto limit_of = [&](const dynamics::PlanetaryInputs& in) {
        return lockstep::runge_kutta_limit(dynamics::assemble(plan_.layout, in, stiffest));
    };
    const dynamics::PlanetaryInputs nominal = inputs(sampler.nominal());
    const lockstep::StepLimit limit = limit_of(nominal);
    decay_meshes_ = 1.0 / (limit.slowest_decay_1_s * nominal.mesh_period_s);
    double stable = nominal.mesh_period_s / limit.step_s;
    const int pilot = study_.random.empty() ? 0 : kPilot;
    for (int i = 0; i < pilot; ++i) {
        const auto in = inputs(sampler.sample(Group::graded, static_cast<std::uint64_t>(i)));
        stable = std::max(stable, in.mesh_period_s / limit_of(in).step_s);
    }
    const double band_periods = study_.sensor.low_pass_Hz * nominal.mesh_period_s;
    const double least = std::ceil(std::max(stable, kFewestStepsPerBandPeriod * band_periods));
    const double chosen = std::ceil(std::max(kMargin * stable, kStepsPerBandPeriod * band_periods));
    if (!(chosen <= kMostSteps)) {
        throw SceneError(
            "numerics.steps_per_mesh",
            fmt::format("the explicit Runge-Kutta method would need {:.3g} steps a mesh "
                        "period (at most {})",
                        chosen, kMostSteps),
            "check for a very stiff support or bearing, a very light body, or a very "
            "low speed");
    }
    least_steps_ = static_cast<int>(least);
    const int given = study_.numerics.steps_per_mesh;
    if (given > 0 && given < least_steps_) {
        throw SceneError(
            "numerics.steps_per_mesh",
            fmt::format("{} steps are too few (below {} the explicit Runge-Kutta method "
                        "is unstable for this study's stiffest gearbox, or its sensor's "
                        "low-pass inaccurate)",
                        given, least_steps_),
            "leave the key out to have the steps chosen");
    }
    return given > 0 ? given : static_cast<int>(chosen);
}

// Enough mesh periods for twice the time in which the nominal gearbox's slowest mode decays to the
// tolerance.
int Scene::choose_max_meshes() const {
    constexpr double kFewest = 200.0, kMost = 1e6;
    const double decay = -2.0 * decay_meshes_ * std::log(study_.numerics.settle_tolerance);
    const int given = study_.numerics.max_meshes;
    return given > 0 ? given
                     : static_cast<int>(std::isfinite(decay) ? std::clamp(decay, kFewest, kMost)
                                                             : kFewest);
}

void Scene::build_plan() {
    const int samples =
        round_up_to_smooth(sampling(study_.sensor.sampling_Hz, "sensor.sampling_Hz"));
    if (samples < kFewestSamples) {
        throw SceneError(
            "sensor.sampling_Hz",
            fmt::format("{} sample(s) a mesh period leave nothing to window (mesh "
                        "frequency {:.4g} Hz)",
                        samples, nominal_mesh_frequency_Hz_),
            fmt::format("at least {:.4g} Hz", kFewestSamples * nominal_mesh_frequency_Hz_));
    }
    te_samples_ = std::min(
        sampling(study_.sensor.encoder_sampling_Hz, "sensor.encoder_sampling_Hz"), samples);
    while (samples % te_samples_ != 0) {
        ++te_samples_;
    }
    plan_.grid =
        lockstep::make_phase_grid(samples, choose_steps(), lockstep::contact_transitions(pairs_));
    plan_.nodes = lockstep::tabulate(pairs_, plan_.grid, plan_.layout.mesh_damping);
    plan_.low_pass_rad_s = 2.0 * pi * study_.sensor.low_pass_Hz;
    max_meshes_ = choose_max_meshes();
    set_te_weights();
}

// Park et al. (2016), Eq. 8: input rotation less output rotation times their ratio. Weights of the
// rotations of carrier, ring and sun, then per u = r theta.
void Scene::set_te_weights() {
    const double zs = train_.sun_teeth, zr = train_.ring_teeth;
    double carrier = 0.0, ring = 0.0, sun = 1.0;
    switch (plan_.layout.fixed) {
        case FixedMember::ring:
            carrier = -(zr + zs) / zs;
            break;
        case FixedMember::sun:
            sun = 0.0;
            ring = 1.0;
            carrier = -(zr + zs) / zr;
            break;
        case FixedMember::carrier:
            ring = zr / zs;
            break;
    }
    const double own = study_.operation.input == Member::ring ? ring : sun;
    plan_.te_weight[0] = carrier / own / plan_.layout.carrier_radius_m;
    plan_.te_weight[1] = ring / own / ring_radius_;
    plan_.te_weight[2] = sun / own / sun_radius_;
}

int Scene::path_meshes() const {
    return gears::meshes_per_carrier_turn(train_, plan_.layout.fixed).value_or(1);
}

dynamics::PlanetaryInputs Scene::inputs(const InstanceInputs& instance) const {
    dynamics::PlanetaryInputs out = body_inputs(instance);
    const gears::Speeds turning = speeds(instance.speed_rad_s);
    out.carrier_speed_rad_s = turning.carrier;
    out.mesh_period_s = 2.0 * pi / gears::mesh_frequency(train_, turning);

    // Torques of sun, ring and carrier in balance: T_s : T_r : T_c = Z_s : Z_r : -(Z_s + Z_r).
    // The held member's share is its support's reaction.
    const double zs = train_.sun_teeth, zr = train_.ring_teeth;
    const double given = plan_.layout.fixed == FixedMember::sun ? zr : zs;
    const double per_tooth = instance.torque_N_m / given;
    out.force_N[dynamics::sun] = per_tooth * zs / sun_radius_;
    out.force_N[dynamics::ring] = per_tooth * zr / ring_radius_;
    out.force_N[dynamics::carrier] = -per_tooth * (zs + zr) / plan_.layout.carrier_radius_m;
    out.force_N[dynamics::held_body(plan_.layout.fixed)] = 0.0;
    return out;
}

std::shared_ptr<const stiffness::FaultyMesh> Scene::faulty_mesh(double size) const {
    if (!fault_ || size <= 0.0) {
        return nullptr;
    }
    return stiffness::faulty_mesh(pairs_.curve(faulty_pair()), fault_->at(size));
}

}  // namespace gearpod::mc
