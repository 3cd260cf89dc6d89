#include "mc/plan/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mc/plan/feature_needs.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

constexpr int kAllMeshes = std::numeric_limits<int>::max();

const Study& with_gears(const Study& study) {
    if (!has_gears(study)) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    return study;
}

bool differ_only_in_convergence_tolerance(Numerics a, const Numerics& b) {
    a.convergence_tolerance = b.convergence_tolerance;
    return a == b;
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
    Study own = *stage.study;
    const double factor =
        turns_Hz(other_end, *stage.shaft, stage) / turns_Hz(own, *stage.stage_shaft, stage);
    for (std::optional<double>* speed :
         {&own.operation.sun_speed_rad_s, &own.operation.ring_speed_rad_s,
          &own.operation.carrier_speed_rad_s, &own.operation.pinion_speed_rad_s}) {
        if (*speed) {
            **speed *= factor;
        }
    }
    if (stage.coupled() && !own.numerics.integrator) {
        own.numerics.integrator = lockstep::Integrator::central_difference;
    }
    own.sensor.low_pass_Hz = study.sensor.low_pass_Hz;
    own.sensor.sampling_Hz = std::max(own.sensor.sampling_Hz, study.sensor.sampling_Hz);
    // The study's own sensors and their converters alone measure.
    own.sensor.additional.clear();
    own.sensor.range_m_s2.reset();
    own.sensor.record_s.reset();
    own.sensor.record_turns.reset();
    own.features = {};
    own.features.use = {"sensor_rms"};
    // Other gearboxes here are other gearboxes there.
    own.ensemble.seed = static_cast<std::int64_t>(
        fnv1a(stage.name, static_cast<std::uint64_t>(study.ensemble.seed)) >> 1);
    return own;
}

std::vector<Scene> make_stages(const Study& study) {
    std::vector<Scene> scenes;
    const std::vector<Study> studies = stage_studies(study);
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const NeighbourStage& stage = study.sensor.stages[i];
        try {
            scenes.emplace_back(studies[i]);
        } catch (const SceneError& error) {
            throw SceneError(kStagesKey, named(stage, error.key() + ": " + error.what()),
                             error.remedy(), error.kind());
        }
        const InstanceInputs nominal = nominal_inputs(studies[i]);
        if (stage.role == SourceRole::other_fault && !(nominal.fault_size > 0.0) &&
            std::ranges::none_of(studies[i].random, [](const RandomInput& input) {
                return input.kind == InputKind::fault_size;
            })) {
            throw SceneError(kStagesKey, named(stage, "its other fault has the size 0"),
                             "give its [fault] a size");
        }
    }
    return scenes;
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

Scene::Scene(const Study& study)
    : Scene(study, std::make_shared<const Sampler>(study), make_drivetrain(with_gears(study)),
            nullptr, nullptr, nullptr, kAllMeshes) {}

Scene::Scene(Study study, SharedSampler sampler, std::shared_ptr<const Drivetrain> drivetrain,
             SharedStiffness stiffness, SharedPlan plan, SharedStages stages, int most_recorded)
    : study_(std::move(study)),
      sampler_(std::move(sampler)),
      drivetrain_(std::move(drivetrain)),
      stiffness_(stiffness ? std::move(stiffness)
                           : std::make_shared<const SceneStiffness>(study_, *drivetrain_)),
      plan_(plan ? std::move(plan)
                 : std::make_shared<const ScenePlan>(
                       make_plan(study_, *sampler_, *drivetrain_, *stiffness_))),
      stages_(stages ? std::move(stages)
                     : std::make_shared<const std::vector<Scene>>(make_stages(study_))),
      span_(drivetrain_->span()),
      nominal_mesh_frequency_Hz_(mc::nominal_mesh_frequency_Hz(study_, *drivetrain_)),
      features_(make_feature_plan(study_, span_)),
      signal_meshes_(mc::signal_meshes(study_, features_, std::abs(nominal_mesh_frequency_Hz_))),
      most_recorded_(most_recorded),
      max_meshes_(study_.effects.quasi_static()
                      ? 1
                      : choose_max_meshes(study_, plan_->stepping.decay_meshes)) {}

Scene Scene::with(const Numerics& numerics) const {
    const Numerics& own = study_.numerics;
    const bool same_stiffness = own.stiffness_tolerance == numerics.stiffness_tolerance &&
                                own.face_slices == numerics.face_slices;
    const bool same_plan = differ_only_in_convergence_tolerance(own, numerics);
    Study study = study_;
    study.numerics = numerics;
    return {std::move(study),
            sampler_,
            drivetrain_,
            same_stiffness ? stiffness_ : nullptr,
            same_plan ? plan_ : nullptr,
            stages_,
            most_recorded_};
}

Scene Scene::with(const Life& life) const {
    Study study = study_;
    study.life = life;
    return {std::move(study), sampler_, drivetrain_, stiffness_, plan_, stages_, most_recorded_};
}

Scene Scene::recording_at_most(int meshes) const {
    return {study_, sampler_, drivetrain_, stiffness_, plan_, stages_, meshes};
}

std::vector<int> faulty_pairs(const Scene& scene) {
    std::vector<int> pairs(static_cast<std::size_t>(scene.fault().curves()), -1);
    for (const lockstep::FaultPassage& passage : scene.pattern().passages) {
        int& pair = pairs[static_cast<std::size_t>(passage.curve)];
        pair = pair < 0 ? passage.pair : pair;
    }
    return pairs;
}

double faulty_total(const Scene& scene, int pair, const stiffness::FaultyMesh& mesh, double since) {
    const lockstep::PairSet& pairs = scene.pairs();
    if (since < 0.0 || since >= mesh.duration()) {
        return pairs.total(pair, pairs.start[static_cast<std::size_t>(pair)] + since);
    }
    const double tau = pairs.reversed ? mesh.duration() - since : since;
    const auto limit = pairs.reversed ? stiffness::Limit::from_below : stiffness::Limit::from_above;
    return total_at(mesh, pairs.curve(pair).transitions(), tau, limit);
}

double loaded_approach(const Scene& scene, int pair, double phase) {
    constexpr double kInside = 1e-9;  // mesh periods, towards later phases
    const lockstep::PairSet& pairs = scene.pairs();
    const double since = phase - pairs.start[static_cast<std::size_t>(pair)];
    const double tau = pairs.reversed ? pairs.curve(pair).contact_ratio() - since : since;
    const double inside = pairs.reversed ? tau - kInside : tau + kInside;
    const double period = std::floor(inside);
    const SceneMesh& mesh =
        scene.meshes()[static_cast<std::size_t>(pair / scene.drivetrain().pairs_per_mesh())];
    return mesh.loaded->approach(tau - period, inside - period);
}

}  // namespace gearpod::mc
