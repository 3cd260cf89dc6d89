#include "mc/plan/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

const Study& with_gears(const Study& study) {
    if (!has_gears(study)) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    return study;
}

std::string named(const NeighbourStage& stage, const std::string& what) {
    return fmt::format("stage \"{}\": {}", stage.name, what);
}

void check_steady(const NeighbourStage& stage) {
    if (speed_fluctuates(*stage.study) || has_random_fluctuations(*stage.study)) {
        throw SceneError(kStagesKey, named(stage, "its torque or speed fluctuates within a record"),
                         "give it a steady torque and speed");
    }
    for (const RandomInput& input : stage.study->random) {
        if (input.quantity == RecordQuantity::speed) {
            throw SceneError(kStagesKey,
                             named(stage, input.key + " is random, but the common shaft sets it"),
                             "remove it from [random] there");
        }
    }
}

// Turns per second of a shaft at the nominal speed of its study.
double turns_Hz(const Study& study, Member shaft, const NeighbourStage& stage) {
    if (!has_shaft(study.gearbox.kind, shaft)) {
        throw SceneError(
            kStagesKey,
            named(stage, fmt::format("a {} gearbox has no {}",
                                     study.gearbox.kind == GearboxKind::planetary ? "planetary"
                                                                                  : "fixed-shaft",
                                     member_name(shaft))),
            use_shafts_text(study.gearbox.kind));
    }
    const auto drivetrain = make_drivetrain(study);
    const double turns = drivetrain->shaft_turns_per_mesh(shaft) *
                         std::abs(nominal_mesh_frequency_Hz(study, *drivetrain));
    if (turns == 0.0) {
        throw SceneError(kStagesKey,
                         named(stage, fmt::format("the {} of its common shaft stands still",
                                                  member_name(shaft))),
                         "name shafts that turn");
    }
    return turns;
}

// Study of a stage with the sensor of the study, and with the speed of the common shaft.
Study stage_study(const Study& study, const NeighbourStage& stage, const Study& other_end) {
    Study adapted = *stage.study;
    const double factor =
        turns_Hz(other_end, *stage.shaft, stage) / turns_Hz(adapted, *stage.stage_shaft, stage);
    for (std::optional<double>* speed :
         {&adapted.operation.sun_speed_rad_s, &adapted.operation.carrier_speed_rad_s,
          &adapted.operation.pinion_speed_rad_s}) {
        if (*speed) {
            **speed *= factor;
        }
    }
    if (stage.coupled() && !adapted.numerics.integrator) {
        adapted.numerics.integrator = lockstep::Integrator::central_difference;
    }
    adapted.sensor.low_pass_Hz = study.sensor.low_pass_Hz;
    adapted.sensor.sampling_Hz = std::max(adapted.sensor.sampling_Hz, study.sensor.sampling_Hz);
    // Only the study's sensors and their converters measure.
    adapted.sensor.additional.clear();
    adapted.sensor.range_m_s2.reset();
    adapted.sensor.record_s.reset();
    adapted.sensor.record_turns.reset();
    adapted.features = {};
    adapted.features.use = {"sensor_rms"};
    // Other gearboxes here are other gearboxes there.
    adapted.ensemble.seed = static_cast<std::int64_t>(
        fnv1a(stage.name, static_cast<std::uint64_t>(study.ensemble.seed)) >> 1);
    return adapted;
}

void check_other_fault(const NeighbourStage& stage, const Study& study) {
    if (stage.role == SourceRole::other_fault && !(nominal_inputs(study).fault_size > 0.0) &&
        std::ranges::none_of(study.random, [](const RandomInput& input) {
            return input.kind == InputKind::fault_size;
        })) {
        throw SceneError(kStagesKey, named(stage, "its other fault has the size 0"),
                         "give its [fault] a size");
    }
}

std::shared_ptr<const TilePlan> stage_tile(const Study& study, const NeighbourStage& stage) {
    try {
        return std::make_shared<const TilePlan>(Scene(study).tile());
    } catch (const SceneError& error) {
        throw SceneError(kStagesKey, named(stage, error.key() + ": " + error.what()),
                         error.remedy(), error.kind());
    }
}

// The stages next to that gearbox of the study. Throws SceneError.
std::vector<StagePlan> make_stages(const Study& study, const GearboxPlan& gearbox) {
    const std::vector<NeighbourStage>& given = study.sensor.stages;
    const std::vector<Study> studies = stage_studies(study);
    std::vector<StagePlan> stages;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const NeighbourStage& stage = given[i];
        StagePlan& made = stages.emplace_back();
        made.tile = stage_tile(studies[i], stage);
        made.gearbox = made.tile->gearbox;
        check_other_fault(stage, studies[i]);
        made.name = stage.name;
        made.gain = stage.gain;
        made.role = stage.role;
        made.member[0] = *stage.shaft;
        made.member[1] = *stage.stage_shaft;
        if (!stage.of.empty()) {
            made.other = std::ranges::find(given, stage.of, &NeighbourStage::name) - given.begin();
        }
        if (stage.coupled()) {
            made.shaft = make_shaft(stage, made.other ? *stages[*made.other].gearbox : gearbox,
                                    *made.gearbox);
        }
    }
    return stages;
}

// Longest run-in that is accepted, in recorded mesh periods.
constexpr double kLongestRunIn = 10.0;
// Largest change of a shaft's phase, and of the decay by its damper, in one step of a gearbox. The
// frequency of its twist is then correct to 1 %.
constexpr double kMostPhase = 0.2;

// Inverse of the inertia of the member alone at which a shaft ends, 1/(kg m^2).
double inverse_inertia(const GearboxPlan& gearbox, const lockstep::ShaftEnd& end) {
    const auto& layout = gearbox.bodies.layout;
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    const auto matrices = dynamics::assemble(layout, gearbox.inputs(gearbox.nominal), none);
    return end.turn_per_m * end.turn_per_m / matrices.mass(end.degree, end.degree);
}

// Mesh period of the slowest gearbox over the nominal one, among the first of the study.
double slowest_period(const Sampler& sampler, double nominal) {
    constexpr std::uint64_t kGearboxes = 256;
    double slowest = 1.0;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        for (const Group group : {Group::threshold, Group::test}) {
            slowest = std::max(slowest, nominal / sampler.draw({group, i}).inputs.speed_rad_s);
        }
    }
    return slowest;
}

// Checks one gearbox of a train: the study's, or that of a stage.
class TrainGearbox {
  public:
    // `stage`: number of the stage; empty for the study's gearbox.
    TrainGearbox(const Study& study, const Scene& scene, std::optional<std::size_t> stage)
        : train_(scene.gearbox()),
          stage_(stage ? &train_.stages[*stage] : nullptr),
          study_(stage ? *study.sensor.stages[*stage].study : study),
          integration_((stage_ ? *stage_->tile : scene.tile()).solve->integration()),
          gearbox_(stage_ ? *stage_->gearbox : train_),
          name_(stage_ ? fmt::format("stage \"{}\": ", stage_->name) : "") {
        for (const StagePlan& other : train_.stages) {
            if (!other.shaft) {
                continue;
            }
            if (stage_ == &other) {
                shafts_.push_back({other, 1});
            }
            if (stage == other.other) {
                shafts_.push_back({other, 0});
            }
        }
    }

    // Checks that the gearbox can be integrated with its shafts. `slowest`: largest mesh period of
    // its gearboxes over the nominal one.
    void check_coupled(double slowest) const {
        const char* where = stage_ ? "in the study of that stage" : "here";
        if (!lockstep::supports_steps(integration_)) {
            throw SceneError(kStagesKey,
                             name_ +
                                 "a shaft with a stiffness needs the central difference method "
                                 "in double precision",
                             fmt::format("give numerics.integrator = \"central-difference\" and "
                                         "numerics.precision = \"double\" {}",
                                         where));
        }
        if (gearbox_.excitation) {
            throw SceneError(kStagesKey,
                             name_ +
                                 "a shaft with a stiffness needs a steady torque and speed "
                                 "without gravity",
                             fmt::format("remove fluctuations and effects.gravity {}", where));
        }
        if (stage_ && has_housing(study_)) {
            throw SceneError(kStagesKey, name_ + "a coupled stage cannot have a housing of its own",
                             "remove it there; the gain of the stage stands for its path");
        }
        if (stage_ && study_.numerics.verify) {
            throw SceneError(kStagesKey, name_ + "numerics.verify has no effect on a coupled stage",
                             "remove it there");
        }
        check_members();
        const double needed = slowest * needed_steps();
        if (steps() < needed) {
            throw SceneError(kStagesKey,
                             fmt::format("{}with its shafts the slowest gearbox needs {:.0f} steps "
                                         "per mesh period, and has {:.0f}",
                                         name_, std::ceil(needed), steps()),
                             fmt::format("give numerics.steps_per_mesh = {:.0f} {}, or a softer "
                                         "shaft",
                                         std::ceil(1.05 * needed), where));
        }
    }

    // Checks that the shaft of this stage bears a torque at both ends.
    void check_balance() const {
        const GearboxPlan& other = other_end(train_, *stage_);
        const double torque = shaft_torque_N_m(other, stage_->member[0], other.nominal);
        const double torque_there = shaft_torque_N_m(gearbox_, stage_->member[1], gearbox_.nominal);
        if (torque == 0.0 || torque_there == 0.0) {
            throw SceneError(
                kStagesKey,
                fmt::format("{}the common shaft bears no torque {}", name_,
                            torque == 0.0 ? "in the gearbox at its other end" : "in this stage"),
                "give both a torque (operation.torque_N_m)");
        }
    }

    // Checks that the steps of this uncoupled stage are stable next to the slowest gearbox of the
    // study.
    void check_steps(double slowest) const {
        if (!lockstep::is_explicit(integration_.integrator)) {
            return;
        }
        const double needed = slowest * needed_steps();
        if (steps() < needed) {
            throw SceneError(
                kStagesKey,
                fmt::format("{}next to the slowest gearbox it needs {:.0f} steps per mesh "
                            "period, and has {}",
                            name_, std::ceil(needed), integration_.grid.steps.size()),
                fmt::format("give numerics.steps_per_mesh = {:.0f} in the study of that stage",
                            std::ceil(1.05 * needed)));
        }
    }

  private:
    // End of a stage's shaft at this gearbox: 0 if the stage is another one, else 1.
    struct Side {
        const StagePlan& stage;
        std::size_t end = 0;
    };

    double steps() const { return static_cast<double>(integration_.grid.steps.size()); }

    // Checks that each member has one elastic shaft at most: it sets the torque there.
    void check_members() const {
        std::vector<Member> members;
        for (const Side& side : shafts_) {
            members.push_back(side.stage.member[side.end]);
        }
        for (const Member member : members) {
            if (std::ranges::count(members, member) > 1) {
                throw SceneError(
                    kStagesKey,
                    fmt::format("{}two elastic shafts end at the {}, and each would bear its whole "
                                "torque",
                                name_, member_name(member)),
                    "couple one stage with each member");
            }
        }
    }

    // Steps per mesh period that the nominal gearbox needs to be stable with its elastic shafts
    // held at their other ends, and to resolve how these twist and how their dampers act between
    // the members at both ends.
    double needed_steps() const {
        const auto inputs = gearbox_.inputs(gearbox_.nominal);
        auto matrices = dynamics::assemble(gearbox_.bodies.layout, inputs,
                                           gearbox_.stiffness->stiffest_pairs());
        double fastest_1_s = 0.0;
        for (const auto& [stage, end] : shafts_) {
            const auto& ends = stage.shaft->end;
            dynamics::SpringDamper shaft;
            shaft.row = Eigen::VectorXd::Zero(matrices.mass.rows());
            shaft.row(ends[end].degree) = ends[end].turn_per_m;
            shaft.stiffness = stage.shaft->stiffness_N_m_rad;
            shaft.damping = stage.shaft->damping_N_m_s_rad;
            dynamics::add(matrices, shaft);
            const double inverse = inverse_inertia(other_end(train_, stage), ends[0]) +
                                   inverse_inertia(*stage.gearbox, ends[1]);
            fastest_1_s = std::max(
                {fastest_1_s, std::sqrt(shaft.stiffness * inverse), shaft.damping * inverse});
        }
        const double period = dynamics::mesh_period_s(inputs);
        return std::max(period / lockstep::longest_stable_step(matrices, integration_.integrator),
                        period * fastest_1_s / kMostPhase);
    }

    const GearboxPlan& train_;
    const StagePlan* stage_;  // null for the study's gearbox
    const Study& study_;
    const lockstep::IntegrationPlan& integration_;
    const GearboxPlan& gearbox_;
    const std::string name_;  // "stage "second": " for messages; "" for the study's gearbox
    std::vector<Side> shafts_;
};

// Checks of the study with coupled stages.
void check_train(const Study& study, const Scene& scene) {
    if (study.effects.quasi_static()) {
        throw SceneError("effects.motion",
                         "an elastic shaft to another stage needs gears with inertia",
                         "choose another motion than quasi-static");
    }
    const Numerics& numerics = study.numerics;
    if (numerics.verify || numerics.paired_gearboxes > 0) {
        throw SceneError(numerics.verify ? "numerics.verify" : "numerics.paired_gearboxes",
                         "would repeat gearboxes with finer steps of the study's own stage only",
                         "remove it; compare runs with another numerics.steps_per_mesh");
    }
    if (numerics.horizon == Horizon::periodic) {
        throw SceneError("numerics.horizon",
                         "with an elastic shaft to another stage no mesh period repeats another",
                         "use \"full\"");
    }
    if (const double run_in =
            coupled_run_in(scene.gearbox(), scene.solve().convergence.tolerance, 0);
        run_in > kLongestRunIn * scene.record().signal_meshes) {
        throw SceneError(kStagesKey,
                         fmt::format("the motion of the gearboxes against each other takes {:.3g} "
                                     "mesh periods to decay to numerics.settle_tolerance, more "
                                     "than {:g} times a record",
                                     run_in, kLongestRunIn),
                         "give a stiffer shaft or more damping, or leave shaft_stiffness_N_m_rad "
                         "out");
    }
}

}  // namespace

std::vector<Study> stage_studies(const Study& study) {
    const std::vector<NeighbourStage>& stages = study.sensor.stages;
    std::vector<Study> studies;
    for (const NeighbourStage& stage : stages) {
        check_steady(stage);
        const auto of = std::ranges::find(stages, stage.of, &NeighbourStage::name) - stages.begin();
        studies.push_back(stage_study(
            study, stage, stage.of.empty() ? study : studies[static_cast<std::size_t>(of)]));
    }
    return studies;
}

bool share_steps(Numerics a, const Numerics& b) {
    a.convergence_tolerance = b.convergence_tolerance;
    a.tolerance = b.tolerance;
    a.scatter_tolerance = b.scatter_tolerance;
    return a == b;
}

Scene::Scene(const Study& study)
    : ensemble_(std::make_shared<const EnsemblePlan>(with_gears(study))) {
    tile_.sampler = std::make_shared<const Sampler>(DrawPlan(study));
    auto gearbox = std::make_shared<GearboxPlan>(study);
    auto steps = std::make_shared<const ScenePlan>(make_plan(study, sampler(), *gearbox));
    gearbox->stages = make_stages(study, *gearbox);
    tile_.gearbox = std::move(gearbox);
    const Drivetrain& drivetrain = *tile_.gearbox->drivetrain;
    tile_.features = make_feature_plan(study, drivetrain.span());
    const int samples = steps->integration.grid.samples;
    tile_.sensors = std::make_shared<const std::vector<SensorPlan>>(
        make_sensor_plans(study, drivetrain, samples));
    tile_.record =
        make_record_plan(study, *tile_.gearbox, features(), sensors(), samples, steps->te_samples);
    tile_.solve = std::make_shared<const SolvePlan>(SolveSettings(study), *tile_.gearbox, record(),
                                                    std::move(steps));
    lives_ = std::make_shared<const StudyLives>(study, features(), *tile_.gearbox);
}

const LifePlan& Scene::life() const {
    if (!lives_->plan) {
        throw lives_->problems.front();
    }
    return *lives_->plan;
}

Scene Scene::with_numerics_of(const Study& study) const {
    const Numerics &given = solve().settings.numerics, &numerics = study.numerics;
    const bool same_stiffness = given.stiffness_tolerance == numerics.stiffness_tolerance;
    Scene scene = *this;
    scene.ensemble_ = std::make_shared<const EnsemblePlan>(study);
    if (!same_stiffness) {
        auto gearbox = std::make_shared<GearboxPlan>(study);
        gearbox->stages = this->gearbox().stages;
        scene.tile_.gearbox = std::move(gearbox);
    }
    const auto steps =
        share_steps(given, numerics)
            ? solve().steps
            : std::make_shared<const ScenePlan>(make_plan(study, sampler(), scene.gearbox()));
    scene.tile_.solve =
        std::make_shared<const SolvePlan>(SolveSettings(study), scene.gearbox(), record(), steps);
    return scene;
}

TilePlan TilePlan::recording_at_most(int meshes) const {
    TilePlan tile = *this;
    tile.record.recorded_meshes = std::min(record.signal_meshes, meshes);
    tile.solve =
        std::make_shared<const SolvePlan>(solve->settings, *gearbox, tile.record, solve->steps);
    return tile;
}

TilePlan TilePlan::of_span() const {
    if (!record.length) {
        return *this;
    }
    TilePlan tile = *this;
    tile.record.length.reset();
    tile.record.signal_meshes = features.signal_meshes;
    tile.record.same_window = tile.record.same_positions = 1;
    tile.record.samples_needed = samples_of(*sensors);
    return tile.recording_at_most(features.signal_meshes);
}

void check_stages(const Study& study, const Scene& scene) {
    const std::vector<StagePlan>& stages = scene.gearbox().stages;
    if (stages.empty()) {
        return;
    }
    const double slowest = slowest_period(scene.sampler(), scene.gearbox().nominal.speed_rad_s);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (!stages[i].shaft) {
            TrainGearbox(study, scene, i).check_steps(slowest);
        }
    }
    if (!is_coupled(study)) {
        return;
    }
    check_train(study, scene);
    TrainGearbox(study, scene, std::nullopt).check_coupled(slowest);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (stages[i].shaft) {
            const TrainGearbox gearbox(study, scene, i);
            gearbox.check_coupled(slowest);
            gearbox.check_balance();
        }
    }
}

// An elastic shaft sets the torque of its stage, so that the loads are in balance.
Problems stage_notices(const Study& study, const std::string& file) {
    Problems notices;
    for (const NeighbourStage& stage : study.sensor.stages) {
        if (stage.coupled() && stage.study->find_random("operation.torque_N_m") != nullptr) {
            notices.push_back({file, 0, "sensor.stages",
                               "the random torque of stage \"" + stage.name +
                                   "\" is not used: its shaft sets the torque",
                               ""});
        }
    }
    return notices;
}

}  // namespace gearpod::mc
