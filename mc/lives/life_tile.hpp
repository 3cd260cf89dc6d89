// Some gearboxes of a study from their draws to the features of all their records: marched once at
// each of a few depths and torques, their records composed.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mc/gearbox/healthy_march.hpp"
#include "mc/lives/crack_life.hpp"
#include "mc/lives/record_laws.hpp"
#include "mc/lives/record_span.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct GearboxLife {
    Status status = Status::ok;
    LifeHistory history;
    std::vector<std::vector<double>> values;  // [feature][record]; none of a gearbox that failed
};

// What interpolation takes, rms over the span: in the middle of the first and the last step of
// depth, over what the crack changes there, and without a crack halfway between neighbours of the
// torques and speeds that are marched, the largest, over the signal there. NaN where it was not
// looked at.
struct InterpolationErrors {
    double first = std::numeric_limits<double>::quiet_NaN();
    double last = std::numeric_limits<double>::quiet_NaN();
    double load = std::numeric_limits<double>::quiet_NaN();  // 0 where all records have one

    // Of both the larger one.
    void take(const InterpolationErrors& other);
};
// The depths of the first two, m.
double first_interpolated_m(const Life& life);
double last_interpolated_m(const Life& life);

// How long what belongs to gearboxes and what belongs to records took, seconds of processor time.
struct LifeCosts {
    double gearboxes = 0.0, records = 0.0;
    long gearbox_count = 0, record_count = 0;
};

// What hearing a gearbox takes, seconds of processor time.
struct RecordTrial {
    double step_s = 0.0;    // each step of depth: what its records are composed of
    double record_s = 0.0;  // each record
};

class LifeTiles {
  public:
    // Throws SceneError for what records cannot be composed of.
    explicit LifeTiles(const Scene& scene);

    // `errors`: of the first gearboxes, as many as are looked at; of those that failed NaN.
    std::vector<GearboxLife> run(std::span<const GearboxId> ids, bool cracked, LifeCosts& costs,
                                 std::span<InterpolationErrors> errors = {}) const;

    // All records of a gearbox, of signals that are made up in place of marches.
    RecordTrial try_records() const;

    LifeHistory history(const GearboxId& id) const;  // of one that cracks
    // At how many loads it is marched, and is looked at between these.
    std::size_t load_count() const { return torques_.size() * speeds_.size(); }
    std::size_t gap_count() const;

    const Scene& scene() const { return scene_; }
    // Gearboxes in lockstep.
    std::size_t lanes() const;

  private:
    class Lane;
    class Look;
    using Marched = std::vector<std::vector<LaneSignals>>;  // [lane][load]
    LaneSignals made_up(std::uint64_t number) const;
    // Factors on a gearbox's torque and speed.
    struct Load {
        double torque = 1.0, speed = 1.0;
    };
    // Of every gearbox.
    HealthyMarch march(std::span<const GearboxId> ids, const Load& load) const;
    InstanceInputs inputs(const GearboxId& id) const;
    double depth(int step) const;
    // Those that are marched, and how much of each makes up another.
    std::vector<Load> loads() const;
    std::vector<double> shares(const Load& load) const;

    const Scene& scene_;
    const RecordLaws laws_;
    const std::vector<double> torques_, speeds_;  // factors that are marched
    const Sampler sampler_;
    const signals::PathGrid path_;
    const CrackLife crack_;
};

}  // namespace gearpod::mc
