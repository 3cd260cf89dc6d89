// Measures the cost of each effect of a scene: time of one step of one realization against the
// enabled effects, with eight lanes. The three scenes are Liang's train in x, y and rotation, its
// rotations alone, and a fixed-shaft stage. README.md tabulates `a_step`.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "bench_scene.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"

namespace {

using namespace gearpod;

constexpr int kLanes = 8;

struct Case {
    const char* name;
    std::vector<std::string> overrides;
};

const std::vector<std::string> kTrain{"effects.inertial_terms=false", "numerics.integrator=rk4",
                                      "fault.depth_mm=0", "numerics.steps_per_mesh=4320"};
// Tian's stage with couplings for which an explicit method is stable.
const std::vector<std::string> kStage{"gearbox.motor_coupling_damping_N_m_s_rad=5",
                                      "gearbox.load_coupling_damping_N_m_s_rad=5",
                                      "gearbox.pinion.bearing_damping_N_s_m=1800",
                                      "gearbox.gear.bearing_damping_N_s_m=1800",
                                      "numerics.integrator=rk4",
                                      "sensor.low_pass_Hz=4000"};

// The effects that a scene may have in addition, one after the other.
const std::vector<Case> kTrainEffects{
    {"none", {}},
    {"inertial-terms", {"effects.inertial_terms=true"}},
    {"transmission-error", {"gearbox.sun_planet.error_um=[1]"}},
    {"separation", {"effects.separation=one-sided"}},
    {"torque-noise", {"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=3"}},
    {"gravity", {"effects.gravity=true"}},
    {"torque-noise+gravity",
     {"operation.torque_noise=0.1", "operation.torque_noise_band_Hz=3", "effects.gravity=true"}},
    {"speed-sine", {"operation.speed_fluctuation=0.01", "operation.speed_fluctuation_order=1"}},
    {"speed-noise", {"operation.speed_noise=0.01", "operation.speed_noise_band_Hz=3"}},
    {"all",
     {"effects.inertial_terms=true", "effects.separation=one-sided",
      "gearbox.sun_planet.error_um=[1]", "operation.torque_noise=0.1",
      "operation.torque_noise_band_Hz=3", "effects.gravity=true",
      "operation.speed_fluctuation=0.01", "operation.speed_fluctuation_order=1"}}};

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// A tile of one study, integrated one mesh period at a time as in mc.
class Tile {
  public:
    Tile(const std::string& study, const std::vector<std::string>& overrides)
        : scene_(bench::study_scene(study, overrides)) {
        const std::vector<mc::Realization> gearboxes(
            kLanes, {{mc::Group::test, 0}, scene_->gearbox().nominal});
        for (const mc::Realization& gearbox : gearboxes) {
            inputs_.push_back(scene_->gearbox().inputs(gearbox.inputs));
        }
        excitation_ = mc::draw_excitation(
            scene_->gearbox(), scene_->draw().seed,
            {scene_->solve().longest_run_in(), scene_->record().signal_meshes}, gearboxes);
        if (excitation_) {
            mesh_integrator_ = lockstep::make_excited_integrator<kLanes>(
                scene_->solve().integration(), *excitation_, inputs_);
        } else {
            steady_ =
                lockstep::make_mesh_integrator<kLanes>(scene_->solve().integration(), inputs_);
        }
        state_ = lockstep::equilibrium_state(scene_->solve().integration(), inputs_);
        record_ = lockstep::make_record(scene_->solve().integration(), kLanes, false);
    }

    void integrate_mesh(int mesh) {
        if (mesh_integrator_ != nullptr) {
            (*mesh_integrator_)(mesh, {}, state_, record_);
        } else {
            (*steady_)({}, state_, record_);
        }
    }
    double gearbox_steps() const {
        return kLanes * static_cast<double>(scene_->solve().integration().grid.steps.size());
    }

  private:
    const std::unique_ptr<mc::Scene> scene_;
    std::vector<dynamics::GearboxInputs> inputs_;
    std::optional<lockstep::Excitation> excitation_;
    std::unique_ptr<lockstep::ExcitedIntegrator<kLanes>> mesh_integrator_;
    std::unique_ptr<const lockstep::MeshIntegrator<kLanes>> steady_;
    lockstep::TileState state_;
    lockstep::MeshRecord record_;
};

void run(benchmark::State& state, const std::string& study,
         const std::vector<std::string>& overrides) {
    Tile tile(study, overrides);
    int mesh = 0;
    tile.integrate_mesh(mesh++);
    for (auto _ : state) {
        tile.integrate_mesh(mesh++ % 200);
    }
    state.counters["a_step"] =
        benchmark::Counter(tile.gearbox_steps(), benchmark::Counter::kIsIterationInvariantRate |
                                                     benchmark::Counter::kInvert);
}

void add(const std::string& scene, const std::string& study, const std::vector<std::string>& base,
         const std::vector<std::string>& left_out) {
    for (const Case& effect : kTrainEffects) {
        bool possible = true;
        std::vector<std::string> overrides = base;
        for (const std::string& text : effect.overrides) {
            bool kept = true;
            for (const std::string& key : left_out) {
                kept = kept && !text.starts_with(key);
            }
            possible = possible && (kept || effect.overrides.size() > 2);
            if (kept) {
                overrides.push_back(text);
            }
        }
        if (possible) {
            benchmark::RegisterBenchmark((scene + "/" + effect.name).c_str(), run, study,
                                         overrides);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    add("translational", "published/liang-fig-5-8.toml", kTrain, {});
    add("rotations", "published/liang-fig-5-8.toml", joined(kTrain, {"effects.motion=torsional"}),
        {"effects.gravity", "effects.inertial"});
    // Weight acts on rotations only where the planets do not balance each other.
    add("rotations-unbalanced", "published/liang-fig-5-8.toml",
        joined(kTrain, {"effects.motion=torsional", "gearbox.planets=3",
                        "gearbox.planet_positions_deg=[0,90,180]"}),
        {"effects.inertial", "effects.separation", "gearbox.sun_planet.error", "operation."});
    add("fixed-shaft", "published/tian-fig-4-9.toml", kStage,
        {"effects.inertial", "gearbox.sun_planet.error"});
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
