// Integrates the study's realizations by gearpod, and provides all data for the other solvers.
#pragma once

#include <memory>

#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "peer_runs.hpp"
#include "rows.hpp"

namespace gearpod::peers {

class GearpodSolver {
  public:
    explicit GearpodSolver(const Options& options);

    const Task& task() const { return task_; }
    const mc::Study& study() const { return study_; }
    const mc::Scene& scene() const { return scene_; }

    // Processor seconds per mesh period of the tile, in doubles by the scene's rk4.
    double tile_mesh_s();

  private:
    void start();
    double start_value(int i) const;

    const mc::Study study_;
    const mc::Scene scene_, fine_;
    GearboxInputs8 gearboxes_;
    StiffnessTables tables_, fine_tables_;
    Task task_;
    std::unique_ptr<const lockstep::MeshIntegrator<kGearboxes>> mesh_integrator_;
    std::unique_ptr<const lockstep::RigidRotation> rotation_;
    lockstep::TileState state_;
};

}  // namespace gearpod::peers
