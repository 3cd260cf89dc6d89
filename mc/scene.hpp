// What all gearboxes of a study share, made once: gears, stiffness curves, phase grid, fault
// pattern.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gears/planetary.hpp"
#include "lockstep/tile.hpp"
#include "mc/sampling.hpp"
#include "mc/study.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

// What is wrong with a study that only building its scene shows: numbers of steps or samples.
class SceneError : public std::runtime_error {
  public:
    SceneError(std::string key, const std::string& what, std::string remedy)
        : std::runtime_error(what), key_(std::move(key)), remedy_(std::move(remedy)) {}
    const std::string& key() const { return key_; }
    const std::string& remedy() const { return remedy_; }

  private:
    std::string key_, remedy_;
};

class Scene {
  public:
    // The study must have tooth numbers (Study::gearbox.has_teeth()). Throws SceneError.
    explicit Scene(const Study& study);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    const Study& study() const { return study_; }
    const gears::PlanetaryTrain& train() const { return train_; }
    const stiffness::MeshStiffness& sun_planet() const { return *sun_planet_; }
    const stiffness::MeshStiffness& ring_planet() const { return *ring_planet_; }
    const lockstep::PairSet& pairs() const { return pairs_; }
    const lockstep::MarchPlan& plan() const { return plan_; }
    const lockstep::FaultPattern& pattern() const { return pattern_; }
    // The pair that the first passage of the faulty tooth weakens, or -1.
    int faulty_pair() const { return pattern_.passages.empty() ? -1 : pattern_.passages[0].pair; }

    // Z_p Z_r: the meshes after which every planet tooth has met every ring tooth.
    int span_meshes() const { return train_.planet_teeth * train_.ring_teeth; }
    // Meshes after which the path to the sensor repeats; 1 if the carrier stands still.
    int path_meshes() const;
    // Samples of the sensor, and of the encoders, in one mesh period.
    int samples_per_mesh() const { return plan_.grid.samples; }
    int te_samples_per_mesh() const { return te_samples_; }
    double nominal_mesh_frequency_Hz() const { return nominal_mesh_frequency_Hz_; }
    // Steps a mesh period below which the integrator is unstable for some gearbox of a pilot sample
    // or the sensor's low-pass is inaccurate; mesh periods that a disturbance of the nominal
    // gearbox takes to decay by 1/e (infinite without damping); mesh periods in which a gearbox
    // must settle.
    int least_steps() const { return least_steps_; }
    double decay_meshes() const { return decay_meshes_; }
    int max_meshes() const { return max_meshes_; }
    // Sense of the planets' turn past the carrier; it orders the mesh phases.
    gears::PlanetSense planet_sense() const { return sense_; }
    // All pairs at their stiffest: the bound for the integrator's step.
    std::vector<double> stiffest_pairs() const;
    std::vector<double> mean_pairs() const;

    dynamics::PlanetaryInputs inputs(const InstanceInputs& instance) const;
    // The faulty pair of one gearbox; none if the fault's size is 0.
    std::shared_ptr<const stiffness::FaultyMesh> faulty_mesh(double size) const;

  private:
    gears::Speeds speeds(double given) const;
    void build_pairs();
    void build_pattern();
    void build_plan();
    void set_te_weights();
    int sampling(double frequency_Hz, const char* key) const;
    int choose_steps();
    int choose_max_meshes() const;

    Study study_;
    Member speed_member_;
    gears::PlanetaryTrain train_;
    double sun_radius_ = 0.0, ring_radius_ = 0.0;  // of the base circles, m
    std::unique_ptr<const stiffness::MeshStiffness> sun_planet_, ring_planet_;
    std::unique_ptr<const stiffness::ToothFaultFamily> fault_;
    lockstep::PairSet pairs_;
    lockstep::FaultPattern pattern_;
    lockstep::MarchPlan plan_;
    int te_samples_ = 0;
    int least_steps_ = 0;
    int max_meshes_ = 0;
    gears::PlanetSense sense_ = gears::PlanetSense::clockwise;
    double decay_meshes_ = 0.0;
    double nominal_mesh_frequency_Hz_ = 0.0;
};

// The dynamic model's choices, also for gearboxes without teeth (modes).
dynamics::PlanetaryLayout layout(const Study& study);

// Masses, bearings, supports and damping of one gearbox; speed and load are left at zero.
dynamics::PlanetaryInputs body_inputs(const InstanceInputs& instance);

}  // namespace gearpod::mc
