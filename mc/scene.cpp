#include "mc/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gears/mesh_geometry.hpp"
#include "lockstep/step_limit.hpp"
#include "mc/study_gears.hpp"

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

double fraction(double x) {
    return x - std::floor(x);
}

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

Problems scene_problems(const Scene& scene, const std::string& path) {
    const int steps = scene.study().numerics.steps_per_mesh;
    if (steps == 0 || steps >= scene.stable_steps()) {
        return {};
    }
    return {
        {path, 0, "numerics.steps_per_mesh",
         fmt::format("{} steps are too few (the explicit Runge-Kutta method is unstable below {} "
                     "for this study's stiffest gearbox)",
                     steps, scene.stable_steps()),
         "leave the key out to have the steps chosen"}};
}

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
    carrier_radius_ = plan_.layout.carrier_radius_m;

    const InstanceInputs nominal = Sampler(study_).nominal();
    const auto speeds = gears::train_speeds(train_, plan_.layout.fixed,
                                            turning_member(speed_member_), nominal.speed_rad_s);
    nominal_mesh_frequency_Hz_ = std::abs(gears::mesh_frequency(train_, speeds)) / (2.0 * pi);
    build_pairs();
    build_pattern();
    build_plan();
}

void Scene::build_pairs() {
    const Gearbox& g = study_.gearbox;
    if (g.tooth_profile == ToothProfile::constant) {
        sun_planet_ = stiffness::PairStiffness::constant(*g.sun_planet_stiffness_N_m);
        ring_planet_ = stiffness::PairStiffness::constant(*g.ring_planet_stiffness_N_m);
    } else {
        const stiffness::Material material{*g.young_modulus_Pa, *g.poisson_ratio, *g.face_width_m};
        const auto profile = g.tooth_profile == ToothProfile::root_circle
                                 ? stiffness::Profile::root_circle
                                 : stiffness::Profile::base_circle;
        const gears::Gear sun = gear_of(g, Member::sun);
        const gears::Gear planet = gear_of(g, Member::planet);
        const gears::Gear ring = gear_of(g, Member::ring);
        const gears::MeshGeometry sun_planet(sun, planet), ring_planet(planet, ring);
        sun_planet_.emplace(sun_planet, material, profile);
        ring_planet_.emplace(ring_planet, material, profile);
        const Fault& f = study_.fault;
        if (f.kind == FaultKind::crack) {
            const bool on_sun_mesh =
                f.member == Member::sun || (f.member == Member::planet && f.side == Member::sun);
            const int gear =
                f.member == Member::sun || (f.member == Member::planet && !on_sun_mesh) ? 1 : 2;
            cracked_.emplace(on_sun_mesh ? sun_planet : ring_planet, material, profile, gear,
                             f.angle_rad);
        }
    }
    pairs_.sun_planet = &*sun_planet_;
    pairs_.ring_planet = &*ring_planet_;
    for (int n = 0; n < train_.planets; ++n) {
        pairs_.start.push_back(
            fraction(gears::sun_mesh_phase(train_, n) - sun_planet_->pitch_position()));
    }
    for (int n = 0; n < train_.planets; ++n) {
        pairs_.start.push_back(fraction(gears::ring_mesh_phase(train_, n) +
                                        gears::ring_to_sun_phase(train_) -
                                        ring_planet_->pitch_position()));
    }
}

// A cracked planet tooth meets the same gear every Z_p meshes; a sun tooth meets the next planet
// every Z_s / N meshes, a ring tooth every Z_r / N.
void Scene::build_pattern() {
    const Fault& f = study_.fault;
    if (f.kind == FaultKind::none) {
        return;
    }
    const int n_planets = train_.planets;
    if (*f.member == Member::planet) {
        const int pair = (f.side == Member::sun ? 0 : n_planets) + f.planet - 1;
        pattern_.length = train_.planet_teeth;
        pattern_.passages = {{pair, pairs_.start[static_cast<std::size_t>(pair)]}};
        return;
    }
    const bool on_sun = *f.member == Member::sun;
    const int first = on_sun ? 0 : n_planets;
    pattern_.length = on_sun ? train_.sun_teeth : train_.ring_teeth;
    for (int i = 0; i < n_planets; ++i) {
        // The sun overtakes the planets in their order, the planets overtake the ring in reverse.
        const int n = on_sun ? i : (n_planets - i) % n_planets;
        const double phase = pairs_.start[static_cast<std::size_t>(first + n)];
        const double due = pairs_.start[static_cast<std::size_t>(first)] +
                           static_cast<double>(pattern_.length) * i / n_planets;
        pattern_.passages.push_back({first + n, phase + std::round(due - phase)});
    }
    std::sort(pattern_.passages.begin(), pattern_.passages.end(),
              [](const auto& a, const auto& b) { return a.start < b.start; });
}

int Scene::sampling(double frequency_Hz) const {
    return static_cast<int>(std::ceil(frequency_Hz / nominal_mesh_frequency_Hz_ - 1e-9));
}

std::vector<double> Scene::mean_pairs() const {
    std::vector<double> k(static_cast<std::size_t>(train_.planets), sun_planet_->mean());
    k.resize(2 * k.size(), ring_planet_->mean());
    return k;
}

std::vector<double> Scene::stiffest_pairs() const {
    constexpr int kPhases = 200;
    std::vector<double> k;
    for (int i = 0; i < pairs_.pairs(); ++i) {
        double stiffest = 0.0;
        for (int p = 0; p < kPhases; ++p) {
            stiffest = std::max(stiffest, pairs_.curve(i).mesh(static_cast<double>(p) / kPhases));
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
    constexpr double kStepsPerBandPeriod = 20.0;  // of the sensor's band edge, for accuracy
    const Sampler sampler(study_);
    const std::vector<double> stiffest = stiffest_pairs();
    const auto limit_of = [&](const dynamics::PlanetaryInputs& in) {
        return lockstep::runge_kutta_limit(dynamics::assemble(plan_.layout, in, stiffest));
    };
    const dynamics::PlanetaryInputs nominal = inputs(sampler.nominal());
    const lockstep::StepLimit limit = limit_of(nominal);
    decay_meshes_ = 1.0 / (limit.slowest_decay_1_s * nominal.mesh_period_s);
    double steps = nominal.mesh_period_s / limit.step_s;
    const int pilot = study_.random.empty() ? 0 : kPilot;
    for (int i = 0; i < pilot; ++i) {
        const auto in = inputs(sampler.sample(Group::graded, static_cast<std::uint64_t>(i)));
        steps = std::max(steps, in.mesh_period_s / limit_of(in).step_s);
    }
    stable_steps_ = static_cast<int>(std::ceil(steps));
    if (study_.numerics.steps_per_mesh > 0) {
        return study_.numerics.steps_per_mesh;
    }
    const double band = kStepsPerBandPeriod * study_.sensor.low_pass_Hz * nominal.mesh_period_s;
    return static_cast<int>(std::ceil(std::max(kMargin * steps, band)));
}

void Scene::build_plan() {
    const int samples = round_up_to_smooth(sampling(study_.sensor.sampling_Hz));
    te_samples_ = std::clamp(sampling(study_.sensor.encoder_sampling_Hz), 1, samples);
    while (samples % te_samples_ != 0) {
        ++te_samples_;
    }
    plan_.grid =
        lockstep::make_phase_grid(samples, choose_steps(), lockstep::contact_transitions(pairs_));
    plan_.nodes = lockstep::tabulate(pairs_, plan_.grid, plan_.layout.mesh_damping);
    plan_.low_pass_rad_s = 2.0 * pi * study_.sensor.low_pass_Hz;
    set_te_weights();
}

// Park et al. (2016), Eq. 8: input rotation less output rotation times their ratio; each operating
// condition and its reverse. Weights of the rotations of carrier, ring and sun, then per u = r
// theta.
void Scene::set_te_weights() {
    const double zs = train_.sun_teeth, zr = train_.ring_teeth;
    double carrier = 0.0, ring = 0.0, sun = 0.0;
    const Member input = study_.operation.input;
    switch (plan_.layout.fixed) {
        case FixedMember::ring:
            sun = 1.0;
            carrier = -(zr + zs) / zs;
            break;
        case FixedMember::sun:
            ring = 1.0;
            carrier = -(zr + zs) / zr;
            break;
        case FixedMember::carrier:
            sun = 1.0;
            ring = zr / zs;
            break;
    }
    const double own = input == Member::sun ? sun : input == Member::ring ? ring : carrier;
    plan_.te_weight[0] = carrier / own / carrier_radius_;
    plan_.te_weight[1] = ring / own / ring_radius_;
    plan_.te_weight[2] = sun / own / sun_radius_;
}

int Scene::path_meshes() const {
    return gears::meshes_per_carrier_turn(train_, plan_.layout.fixed).value_or(1);
}

dynamics::PlanetaryInputs Scene::inputs(const InstanceInputs& instance) const {
    dynamics::PlanetaryInputs out = body_inputs(instance);
    const auto speeds = gears::train_speeds(train_, plan_.layout.fixed,
                                            turning_member(speed_member_), instance.speed_rad_s);
    out.carrier_speed_rad_s = speeds.carrier;
    out.mesh_period_s = 2.0 * pi / std::abs(gears::mesh_frequency(train_, speeds));

    // Torques of sun, ring and carrier in balance: T_s : T_r : T_c = Z_s : Z_r : -(Z_s + Z_r).
    // The held member's share is its support's reaction.
    const double zs = train_.sun_teeth, zr = train_.ring_teeth;
    const double given = plan_.layout.fixed == FixedMember::sun ? zr : zs;
    const double per_tooth = instance.torque_N_m / given;
    out.force_N[dynamics::sun] = per_tooth * zs / sun_radius_;
    out.force_N[dynamics::ring] = per_tooth * zr / ring_radius_;
    out.force_N[dynamics::carrier] = -per_tooth * (zs + zr) / carrier_radius_;
    out.force_N[dynamics::held_body(plan_.layout.fixed)] = 0.0;
    return out;
}

std::optional<stiffness::CrackedToothCurve> Scene::cracked_tooth(double depth_m) const {
    if (!cracked_ || depth_m <= 0.0) {
        return std::nullopt;
    }
    return cracked_->at(depth_m);
}

double Scene::max_depth_m() const {
    return cracked_ ? cracked_->max_depth() : 0.0;
}

}  // namespace gearpod::mc
