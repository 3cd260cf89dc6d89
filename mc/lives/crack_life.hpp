// The life of one gearbox as its records see it: when they are taken, under what load, and how deep
// the crack is by then.
#pragma once

#include <optional>
#include <vector>

#include "mc/lives/record_laws.hpp"
#include "mc/scene/scene.hpp"
#include "stiffness/growth/root_crack.hpp"

namespace gearpod::mc {

// What a record has of its own, as factors on its gearbox's values.
struct LifeRecord {
    double hours = 0.0;
    double depth_m = 0.0;  // 0: no crack yet
    double torque = 1.0, speed = 1.0, gain = 1.0, noise = 1.0;
};

struct LifeHistory {
    std::vector<LifeRecord> records;
    std::size_t first_cracked = 0;    // record; all of them without a crack
    std::optional<double> end_hours;  // when the tooth went; empty while it holds
};

// Growth at the root of the study's faulty tooth by Paris' law, or along the study's curve: the
// torque and speed of a record act until the next one. The force is the static one of the mesh,
// shared evenly by the planets. The study must have a life.
class CrackLife {
  public:
    explicit CrackLife(const Scene& scene);

    // Engagements of the faulty tooth in an hour, on the side of its crack.
    double cycles_per_hour(const InstanceInputs& inputs) const;
    // Delta K at a force of 1 N on the mesh, m^(-3/2).
    double range_per_force(double depth_m) const;

    // The crack is there from the first record behind the baseline on. A healthy life has all its
    // records, a cracked one those before its end. Random numbers are the gearbox's own.
    LifeHistory history(const GearboxId& id, const InstanceInputs& inputs, bool cracked) const;

  private:
    // Both end the history when the tooth goes.
    void grow(const InstanceInputs& inputs, LifeHistory& history) const;
    void follow_curve(const InstanceInputs& inputs, LifeHistory& history) const;
    bool breaks(const InstanceInputs& inputs, const LifeRecord& record) const;
    double force_N(const InstanceInputs& inputs, const LifeRecord& record) const;

    const Scene& scene_;
    const RecordLaws laws_;
    stiffness::RootCrack crack_;
};

}  // namespace gearpod::mc
