// Records the accelerometer and encoder signals of a tile while it is being integrated, and applies
// the gain of the sensor.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/integration_plan.hpp"
#include "mc/gearbox/sensor_paths.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/sensor/sensor_response.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const Realization> realizations);
// Multiplies the recorded acceleration of each lane by the sensor gain of that lane's gearbox.
void apply_gain(std::span<const Realization> realizations, machine::AlignedVector& acceleration);

std::vector<double> path_exponents(std::span<const Realization> realizations);

class TileSensorRecorder {
  public:
    // Keeps the first `kept_meshes` mesh periods of sensor samples; -1 keeps all. `realizations`
    // has one entry per lane and must outlive the object. `path` must outlive the time integration.
    TileSensorRecorder(const Scene& scene, const SensorPaths& path,
                       std::span<const Realization> realizations, int kept_meshes);

    // Takes the record of mesh period k; matches lockstep::RecordedSpan::on_record. If fewer mesh
    // periods are recorded than the signal has, the signal repeats them.
    void operator()(int k, const lockstep::MeshRecord& record);

    // Responses of the first and the additional sensors.
    std::vector<std::unique_ptr<signals::SensorResponse>> take_responses() {
        return std::move(responses_);
    }
    double spent_s() const { return spent_s_; }

  private:
    const std::span<const Realization> realizations_;
    const bool has_gain_;
    const int signal_meshes_, recorded_meshes_;
    std::vector<std::unique_ptr<signals::SensorResponse>> responses_;
    machine::AlignedVector amplified_acceleration_;
    double spent_s_ = 0.0;
};

}  // namespace gearpod::mc
