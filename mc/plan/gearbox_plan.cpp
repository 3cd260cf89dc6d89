#include "mc/plan/gearbox_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "dynamics/gearbox_matrices.hpp"
#include "machine/contracts.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

dynamics::PlanetaryLayout planetary_layout(const Study& study) {
    dynamics::PlanetaryLayout result;
    const Gearbox& g = study.gearbox;
    result.planets = g.planets;
    result.pressure_angle_rad = g.pressure_angle_rad;
    result.helix_angle_rad = g.helix_angle_rad;
    result.positions_rad = g.planet_positions_rad;
    result.fixed = study.operation.fixed;
    result.motion = study.effects.torsional() ? dynamics::Motion::torsional
                                              : dynamics::Motion::translational_torsional;
    result.inertial_terms = study.effects.inertial_terms;
    result.mesh_damping = study.effects.mesh_damping;
    result.bearing_sources = !housing_bearings(study).empty();
    if (has_gears(study)) {
        result.carrier_radius_m = centre_distance_m(study);
        if (working_shifts(study).centre_distance_m) {
            result.sun_working_angle_rad = working_angle_rad(study, MeshKind::sun_planet);
            result.ring_working_angle_rad = working_angle_rad(study, MeshKind::ring_planet);
        }
    }
    return result;
}

dynamics::FixedShaftLayout fixed_shaft_layout(const Study& study) {
    dynamics::FixedShaftLayout result;
    result.base_radius_m[dynamics::pinion] = gear_of(study, Member::pinion).base_radius();
    result.base_radius_m[dynamics::gear] = gear_of(study, Member::gear).base_radius();
    result.mesh_damping = study.effects.mesh_damping;
    result.sensor = study.sensor.position == Member::gear ? dynamics::gear : dynamics::pinion;
    return result;
}

dynamics::PlanetaryInputs planetary_inputs(const InstanceInputs& in) {
    constexpr std::pair<int, Member> kBodies[] = {{dynamics::sun, Member::sun},
                                                  {dynamics::planet, Member::planet},
                                                  {dynamics::ring, Member::ring},
                                                  {dynamics::carrier, Member::carrier}};
    dynamics::PlanetaryInputs out;
    for (const auto& [body, member] : kBodies) {
        const BodyInstance& b = in.bodies[member];
        out.mass_kg[body] = b.mass_kg;
        out.inertia_over_r2_kg[body] = b.inertia_over_r2_kg;
        out.bearing_stiffness_N_m[body] = b.bearing_stiffness_N_m;
        out.bearing_damping_N_s_m[body] = b.bearing_damping_N_s_m;
    }
    std::ranges::copy(in.planets, out.planet_deviations);
    out.support_stiffness_N_m = in.support_stiffness_N_m;
    out.support_damping_N_s_m = in.support_damping_N_s_m;
    return out;
}

dynamics::FixedShaftInputs fixed_shaft_inputs(const InstanceInputs& in) {
    using namespace dynamics;
    FixedShaftInputs out;
    for (const auto& [which, member] :
         {std::pair{pinion, Member::pinion}, std::pair{gear, Member::gear}}) {
        const BodyInstance& b = in.bodies[member];
        out.mass_kg[which] = b.mass_kg;
        out.inertia_kg_m2[which] = b.inertia_kg_m2;
        out.bearing_stiffness_N_m[which] = b.bearing_stiffness_N_m;
        out.bearing_damping_N_s_m[which] = b.bearing_damping_N_s_m;
    }
    const FixedShaftInstance& f = in.fixed_shaft;
    out.coupling_stiffness_N_m_rad[pinion] = f.motor_coupling_stiffness_N_m_rad;
    out.coupling_stiffness_N_m_rad[gear] = f.load_coupling_stiffness_N_m_rad;
    out.coupling_damping_N_m_s_rad[pinion] = f.motor_coupling_damping_N_m_s_rad;
    out.coupling_damping_N_m_s_rad[gear] = f.load_coupling_damping_N_m_s_rad;
    out.motor_inertia_kg_m2 = f.motor_inertia_kg_m2;
    out.load_inertia_kg_m2 = f.load_inertia_kg_m2;
    return out;
}

// Tooth of planet n that its ring side counts as 0. This tooth meshes with the ring half a planet
// turn after its mesh with the sun (lockstep::planet_fault_pattern).
int first_on_ring(const lockstep::PairSet& pairs, PlanetId n, int teeth) {
    const double half_turn = 0.5 * (teeth + (pairs.reversed ? 1 : -1));
    const long later = std::lround(pairs.pitch_phase(sun_pair(n)) + half_turn -
                                   pairs.pitch_phase(ring_pair(n, pairs.pairs() / 2)));
    return static_cast<int>((teeth - later % teeth) % teeth);
}

// Sets the engagement of a side by the first pair in which it meets its mate.
void set_engagement(const lockstep::PairSet& pairs, std::span<const lockstep::PairTeeth> teeth,
                    ToothSide& side) {
    for (std::size_t p = 0; p < teeth.size(); ++p) {
        for (const int which : {0, 1}) {
            if (static_cast<std::size_t>(teeth[p].gear[which]) == side.gear) {
                const PairId pair{p};
                const stiffness::MeshStiffness& mesh = pairs.curve(pair);
                const double ratio = mesh.slice().contact_ratio();
                const bool outwards = (which == teeth[p].driver) != pairs.reversed;
                const double middle = 0.5 * (mesh.path_begin() + mesh.path_end());
                const double since = pairs.reversed ? mesh.contact_ratio() - middle : middle;
                side.middle = since - (pairs.pitch_phase(pair) - pairs.start[p]);
                side.outwards = outwards ? ratio : -ratio;
                return;
            }
        }
    }
}

// Adds bodies with their sides to a model of tooth errors.
class ToothErrorBuilder {
  public:
    ToothErrorBuilder(const Study& study, const GearboxPlan& gearbox)
        : study_(study), gearbox_(gearbox) {}

    ToothErrorModel make() && {
        const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(gearbox_.drivetrain.get());
        if (planetary == nullptr) {
            model_.pairs = lockstep::fixed_shaft_teeth();
            add(Member::pinion);
            add_side(MeshKind::pinion_gear, 0);
            add(Member::gear);
            add_side(MeshKind::pinion_gear, 0);
            return std::move(model_);
        }
        model_.pairs =
            lockstep::planetary_teeth(gearbox_.pairs(), planetary->train(), planetary->sense());
        add(Member::sun);
        add_side(MeshKind::sun_planet, 0);
        add(Member::ring);
        add_side(MeshKind::ring_planet, 0);
        for (int n = 0; n < gearbox_.planets; ++n) {
            const int teeth = add(Member::planet).teeth;
            add_side(MeshKind::sun_planet, 0, n);
            add_side(MeshKind::ring_planet, first_on_ring(gearbox_.pairs(), PlanetId{n}, teeth), n);
        }
        return std::move(model_);
    }

  private:
    ToothedBody& add(Member member) {
        return model_.bodies.emplace_back(member, gearbox_.teeth[member],
                                          gearbox_.stiffness->tooth_scales()[member],
                                          std::vector<ToothSide>());
    }

    // Adds a side to the last body, which is number `which` of its member.
    void add_side(MeshKind mesh, int first_tooth, int which = 0) {
        ToothedBody& body = model_.bodies.back();
        const bool is_first = body.sides.empty();
        ToothSide& side = body.sides.emplace_back();
        side.gear = sides_++;
        side.first_tooth = first_tooth;
        side.direction = is_first != gearbox_.pairs().reversed ? 1 : -1;
        side.working_angle_rad = working_angle_rad(study_, mesh);
        set_engagement(gearbox_.pairs(), model_.pairs, side);
        const MemberValues& given = study_.gearbox.bodies[body.member];
        const std::vector<double>& all = is_first ? given.index_m : given.ring_side_index_m;
        if (!all.empty()) {
            const auto begin = all.begin() + static_cast<std::ptrdiff_t>(which * body.teeth);
            side.measured_m.assign(begin, begin + body.teeth);
        }
    }

    const Study& study_;
    const GearboxPlan& gearbox_;
    ToothErrorModel model_;
    std::size_t sides_ = 0;
};

std::optional<ExcitationModel> excitation_model(const Study& study) {
    if (!has_variable_excitation(study)) {
        return std::nullopt;
    }
    ExcitationModel model;
    model.torque_noise = torque_fluctuates(study);
    if (speed_fluctuates(study)) {
        model.speed = {speed_has_sine(study), speed_has_noise(study)};
    }
    model.gravity = study.effects.gravity;
    return model;
}

// True if the study gives every mass and inertia that the modes need.
bool has_masses(const Study& study) {
    const Gearbox& g = study.gearbox;
    const FixedShaft& f = study.fixed_shaft;
    const auto has = [&](Member member) { return g.bodies[member].mass_kg.has_value(); };
    return g.kind == GearboxKind::planetary ? has(Member::sun) && has(Member::planet) &&
                                                  has(Member::ring) && has(Member::carrier)
                                            : has(Member::pinion) && has(Member::gear) &&
                                                  f.motor_inertia_kg_m2 && f.load_inertia_kg_m2;
}

// End of a shaft at a gearbox. The shaft's positive sense is that in which it turns.
lockstep::ShaftEnd shaft_end(const GearboxPlan& gearbox, Member shaft) {
    const auto& layout = gearbox.bodies.layout;
    const ShaftDegree degree = gearbox.drivetrain->shaft_degree(layout, shaft);
    const double turning = gearbox.drivetrain->rotation_m_s(gearbox.nominal) *
                           dynamics::rigid_rotation(layout)(degree.degree);
    return {degree.degree, std::copysign(1.0 / degree.radius_m, turning)};
}

// Inertia of the whole nominal gearbox as that shaft feels it while no spring deflects, kg m^2.
double shaft_inertia_kg_m2(const GearboxPlan& gearbox, Member shaft) {
    const auto& layout = gearbox.bodies.layout;
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    const auto inputs = gearbox.inputs(gearbox.nominal);
    const Eigen::VectorXd turn = dynamics::rigid_rotation(layout);
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    const double rate = end.turn_per_m * turn(end.degree);
    return turn.dot(dynamics::assemble(layout, inputs, none).mass * turn) / (rate * rate);
}

}  // namespace

BodyModel::BodyModel(const Study& study)
    : layout(study.gearbox.kind == GearboxKind::fixed_shaft
                 ? dynamics::GearboxLayout(fixed_shaft_layout(study))
                 : planetary_layout(study)),
      has_backlash(study.effects.separation == Separation::two_sided) {}

dynamics::GearboxInputs BodyModel::inputs(const InstanceInputs& instance) const {
    dynamics::GearboxInputs all = std::holds_alternative<dynamics::FixedShaftLayout>(layout)
                                      ? dynamics::GearboxInputs(fixed_shaft_inputs(instance))
                                      : planetary_inputs(instance);
    std::visit(
        [&](auto& inputs) {
            inputs.mesh_damping = instance.mesh_damping;
            if (has_backlash) {
                inputs.backlash_m = instance.backlash_m;
            }
        },
        all);
    return all;
}

GearboxPlan::GearboxPlan(const Study& study)
    : kind(study.gearbox.kind),
      planets(study.gearbox.planets),
      nominal(nominal_inputs(study)),
      bodies(study),
      drivetrain(make_drivetrain(study)),
      mesh_frequency_Hz(drivetrain->mesh_frequency_rad_s(nominal.speed_rad_s) /
                        (2.0 * std::numbers::pi)),
      stiffness(std::make_shared<const SceneStiffness>(study, *drivetrain)),
      excitation(excitation_model(study)) {
    for (const Member member : kAllMembers) {
        teeth[member] = has_toothed_member(kind, member) ? teeth_of(study, member).value() : 0;
    }
    if (has_tooth_errors(study)) {
        tooth_errors = ToothErrorBuilder(study, *this).make();
    }
}

dynamics::GearboxInputs GearboxPlan::inputs(const InstanceInputs& instance) const {
    dynamics::GearboxInputs all = bodies.inputs(instance);
    drivetrain->set(instance, all);
    return all;
}

signals::BearingImpulses bearing_impulses(const GearboxPlan& gearbox, const InstanceInputs& inputs,
                                          const Bearing& bearing) {
    const double shaft_Hz = bearing.shaft
                                ? gearbox.drivetrain->shaft_turns_per_mesh(*bearing.shaft) /
                                      dynamics::mesh_period_s(gearbox.inputs(inputs))
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

ModalPlan make_modal_plan(const Study& study) {
    if (!has_masses(study)) {
        throw SceneError("gearbox", "masses or inertias are missing, but modes need them",
                         "add them to [gearbox]");
    }
    std::shared_ptr<const Drivetrain> drivetrain;
    if (has_gears(study)) {
        drivetrain = make_drivetrain(study);
    }
    EXPECTS(drivetrain || study.gearbox.tooth_profile == StiffnessSource::constant);
    std::vector<double> mean_pairs = study.gearbox.tooth_profile == StiffnessSource::constant
                                         ? constant_pairs(study)
                                         : SceneStiffness(study, *drivetrain).mean_pairs();
    return {BodyModel(study),      nominal_inputs(study), std::move(mean_pairs),
            std::move(drivetrain), speed_member(study),   is_coupled(study)};
}

StageShaft make_shaft(const NeighbourStage& given, const GearboxPlan& other,
                      const GearboxPlan& stage) {
    StageShaft shaft;
    const Member here = *given.shaft, there = *given.stage_shaft;
    shaft.stiffness_N_m_rad = given.shaft_stiffness_N_m_rad;
    shaft.damping_ratio = given.shaft_damping_ratio;
    shaft.end[0] = shaft_end(other, here);
    shaft.end[1] = shaft_end(stage, there);
    shaft.mirrored = shaft_torque_N_m(other, here, other.nominal) *
                         shaft_torque_N_m(stage, there, stage.nominal) >
                     0.0;
    if (shaft.mirrored) {
        shaft.end[1].turn_per_m *= -1.0;
    }
    const double a = shaft_inertia_kg_m2(other, here), b = shaft_inertia_kg_m2(stage, there);
    const double inertia = a * b / (a + b), stiffness = given.shaft_stiffness_N_m_rad;
    shaft.frequency_Hz = std::sqrt(stiffness / inertia) / (2.0 * std::numbers::pi);
    shaft.damping_N_m_s_rad = 2.0 * given.shaft_damping_ratio * std::sqrt(stiffness * inertia);
    return shaft;
}

const GearboxPlan& other_end(const GearboxPlan& gearbox, const StagePlan& stage) {
    return stage.other ? *gearbox.stages[*stage.other].gearbox : gearbox;
}

double shaft_torque_N_m(const GearboxPlan& gearbox, Member shaft, const InstanceInputs& inputs) {
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    return dynamics::torque_force(gearbox.bodies.layout, gearbox.inputs(inputs))(end.degree) /
           end.turn_per_m;
}

std::vector<double> train_frequencies_Hz(const GearboxPlan& gearbox) {
    std::vector<const GearboxPlan*> gearboxes{&gearbox};
    std::vector<Eigen::Index> first{0}, first_of_stage(gearbox.stages.size(), 0);
    const auto degrees = [](const GearboxPlan& plan) {
        return Eigen::Index{dynamics::degrees_of_freedom(plan.bodies.layout)};
    };
    Eigen::Index size = degrees(gearbox);
    for (std::size_t i = 0; i < gearbox.stages.size(); ++i) {
        const StagePlan& stage = gearbox.stages[i];
        if (stage.shaft) {
            gearboxes.push_back(stage.gearbox.get());
            first.push_back(size);
            first_of_stage[i] = size;
            size += degrees(*stage.gearbox);
        }
    }
    dynamics::GearboxMatrices train = dynamics::zero_matrices(static_cast<int>(size));
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const GearboxPlan& plan = *gearboxes[g];
        const auto matrices = dynamics::assemble(plan.bodies.layout, plan.inputs(plan.nominal),
                                                 plan.stiffness->mean_pairs());
        const Eigen::Index n = matrices.mass.rows();
        train.mass.block(first[g], first[g], n, n) = matrices.mass;
        train.stiffness.block(first[g], first[g], n, n) = matrices.stiffness;
    }
    for (std::size_t i = 0; i < gearbox.stages.size(); ++i) {
        const StagePlan& stage = gearbox.stages[i];
        if (!stage.shaft) {
            continue;
        }
        const auto& [here, there] = stage.shaft->end;
        dynamics::SpringDamper shaft;
        shaft.row = Eigen::VectorXd::Zero(size);
        shaft.row((stage.other ? first_of_stage[*stage.other] : 0) + here.degree) = here.turn_per_m;
        shaft.row(first_of_stage[i] + there.degree) = -there.turn_per_m;
        shaft.stiffness = stage.shaft->stiffness_N_m_rad;
        dynamics::add(train, shaft);
    }
    return dynamics::natural_frequencies_Hz(train);
}

double coupled_run_in(const GearboxPlan& gearbox, double tolerance, int run_in_meshes) {
    const auto period = [](const GearboxPlan& plan) {
        return 1.0 / std::abs(plan.mesh_frequency_Hz);
    };
    double run_in = run_in_meshes;
    for (const StagePlan& stage : gearbox.stages) {
        if (stage.shaft) {
            const double rate_1_s =
                2.0 * std::numbers::pi * stage.shaft->frequency_Hz * stage.shaft->damping_ratio;
            const double decay_s = -std::log(tolerance) / rate_1_s;
            run_in = std::max({run_in, decay_s / period(gearbox),
                               (kMarginMeshes + 1) * period(*stage.gearbox) / period(gearbox)});
        }
    }
    return std::ceil(run_in);
}

}  // namespace gearpod::mc
