// History of one gearbox: times of its records, their loads, and the crack depths.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mc/plan/life_plan.hpp"
#include "stiffness/growth/crack_growth.hpp"

namespace gearpod::mc {

// Properties of a record; the factors apply to the values of its gearbox.
struct LifeRecord {
    double hours = 0.0;
    double depth_m = 0.0;  // 0 before the crack
    double torque = 1.0, speed = 1.0, gain = 1.0, noise = 1.0;
};

struct LifeHistory {
    std::vector<LifeRecord> records;
    // index of the first record with a crack; number of records without one
    std::size_t first_cracked = 0;
    std::optional<double> end_hours;  // time of tooth failure; empty if the tooth survives
};

// Number of records that cracks have from their start to the failure of their teeth, "3 (2 to 4)":
// median and range; "none fails" if no tooth does.
std::string crack_records_text(std::span<const LifeHistory* const> histories);

// Crack growth at the root of the faulty tooth by Paris' law or along a curve. The torque and speed
// of a record act until the next record. The force is the static mesh force, shared evenly by the
// planets.
class CrackLife {
  public:
    // The plan must outlive the object.
    explicit CrackLife(const LifePlan& plan);

    // Load cycles of the faulty tooth per hour, on the side of its crack.
    double cycles_per_hour(const InstanceInputs& inputs) const;
    // Delta K at a mesh force of 1 N, m^(-3/2).
    double range_per_force(double depth_m) const;

    // History of a gearbox. The crack exists from the first record after the baseline. A healthy
    // life has all its records, a cracked one those before its end. The random numbers depend only
    // on the gearbox.
    LifeHistory history(const Realization& gearbox, bool cracked) const;

  private:
    // Both end the history when the tooth fails.
    void grow(const ParisStart& growth, const InstanceInputs& inputs, LifeHistory& history) const;
    void grow(const DepthCurve& curve, const InstanceInputs& inputs, LifeHistory& history) const;
    double force_N(const InstanceInputs& inputs, const LifeRecord& record) const;

    const LifePlan& plan_;
    stiffness::RootCrack crack_;
};

}  // namespace gearpod::mc
