// Records the signals of a tile's sensors and encoders while it is being integrated.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/tile/tile.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/sensor_plan.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {

// Recorders of a tile's sensor signals, one for each path of each sensor.
using SensorRecorders = std::vector<std::vector<std::unique_ptr<signals::SensorResponse>>>;

bool has_gain(std::span<const Realization> realizations);
// Multiplies the recorded acceleration of each lane by the sensor gain of that lane's gearbox.
void apply_gain(std::span<const Realization> realizations, machine::AlignedVector& acceleration);

// Path exponents of gearboxes along one path of a sensor; 0 for all but the first.
std::vector<double> path_exponents(std::span<const Realization> realizations, std::size_t path);

class TileSensorRecorder {
  public:
    // Keeps the first `kept_meshes` mesh periods of sensor samples; -1 keeps all. `realizations`
    // has one entry per lane and must outlive the object. `sensors` must outlive the time
    // integration. `meshes`: number of mesh periods that are recorded; 0 stands for the plan's.
    TileSensorRecorder(const RecordPlan& plan, std::span<const SensorPlan> sensors,
                       const signals::Tones& tones, std::span<const Realization> realizations,
                       int kept_meshes, int meshes = 0);

    // Only these parts of the signal are recorded; empty: all of it.
    void record_only(std::span<const lockstep::SpanPart> parts) { parts_ = parts; }

    // Takes the record of mesh period k; matches lockstep::RecordedSpan::on_record. If fewer mesh
    // periods are recorded than the signal or its part has, they are repeated there.
    void operator()(int k, const lockstep::MeshRecord& record);

    SensorRecorders take_recorders() { return std::move(recorders_); }
    double spent_s() const { return spent_s_; }

  private:
    const std::span<const Realization> realizations_;
    const bool has_gain_;
    const int signal_meshes_, recorded_meshes_;
    int record_meshes_;  // of the longest record
    std::span<const lockstep::SpanPart> parts_;
    SensorRecorders recorders_;
    machine::AlignedVector amplified_acceleration_;
    double spent_s_ = 0.0;
};

}  // namespace gearpod::mc
