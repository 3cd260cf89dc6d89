// Computes the features of all records of several gearboxes. The gearboxes are integrated once at
// each of a few depths and loads, and their records are superpositions.
#pragma once

#include <span>
#include <vector>

#include "machine/fields.hpp"
#include "machine/no_value.hpp"
#include "mc/ensemble/gearbox/healthy_solution.hpp"
#include "mc/lives/crack_life.hpp"
#include "mc/lives/superposition.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct GearboxLife {
    Status status = Status::ok;
    LifeHistory history;
    std::vector<std::vector<double>> values;  // [feature][record]; empty for a gearbox that failed
};

// Interpolation errors as rms over the span; NaN if not measured. `first` and `last`: at the middle
// of the depth step in which the crack begins to grow, and of the last one, relative to the effect
// of the crack there. `load`: the largest error halfway between neighbouring integrated torques and
// speeds, without a crack, relative to the signal there.
struct InterpolationErrors {
    double first = kNan;
    double last = kNan;
    double load = kNan;  // 0 if all records have the same load
    // InterpolationChoice::error; NaN if the file does not contain it.
    double change = kNan;

    // Takes the maximum of both for each error.
    void take(const InterpolationErrors& other);
};
GEARPOD_FIELDS(InterpolationErrors, first, last, load, change)

// Processor time in seconds, spent per gearbox and per record.
struct LifeCosts {
    double gearboxes = 0.0, records = 0.0;
    long gearbox_count = 0, record_count = 0;
};

// Processor time in seconds for the records of a gearbox.
struct RecordTimes {
    double step_s = 0.0;    // per depth step: preparing the superposition
    double record_s = 0.0;  // per record
};

class LifeTiles {
  public:
    // `tile` must outlive the object.
    LifeTiles(const TilePlan& tile, LifePlan plan);

    // A gearbox without its fault. Inputs that vary by record are nominal.
    Realization draw(const GearboxId& id) const;

    // Simulates the lives of gearboxes. `errors`: interpolation errors of the first gearboxes; NaN
    // for those that failed.
    std::vector<GearboxLife> run(std::span<const Realization> gearboxes, bool cracked,
                                 LifeCosts& costs,
                                 std::span<InterpolationErrors> errors = {}) const;

    // Computes all records of a gearbox from synthetic signals, and measures the time.
    RecordTimes time_records() const;

    // Factors on the torque and speed of a gearbox.
    struct Load {
        double torque = 1.0, speed = 1.0;
    };
    // Healthy reference solution of the gearboxes at a load.
    HealthySolution healthy_solution(std::span<const Realization> gearboxes,
                                     const Load& load) const;

    LifeHistory history(const GearboxId& id) const;  // of a gearbox with a crack
    // For 0 and each depth (CampaignPlan::depth_m): true if cracked gearboxes with these histories
    // are integrated there, because a record lies in an adjacent step. `tested`: also the depths
    // at which the interpolation error is measured.
    std::vector<bool> integrated_depths(std::span<const LifeHistory* const> histories,
                                        bool tested) const;
    // Number of loads that are integrated, and number of loads between them at which interpolation
    // errors are measured.
    std::size_t load_count() const { return torques_.factors().size() * speeds_.factors().size(); }
    std::size_t gap_count() const;

    const TilePlan& tile() const { return tile_; }
    const LifePlan& plan() const { return plan_; }
    // Number of gearboxes integrated in lockstep.
    std::size_t lanes() const;

  private:
    class Lane;
    class InterpolationCheck;
    using SignalsByLoad = std::vector<std::vector<LaneSignals>>;  // [lane][load]
    LaneSignals synthetic_signals(std::uint64_t number) const;
    // Integrated loads, and interpolation weights of each of them for another load.
    std::vector<Load> loads() const;
    std::vector<double> load_weights(const Load& load) const;

    const TilePlan tile_;  // its records are the span
    const LifePlan plan_;
    const LoadAxis torques_, speeds_;
    const CrackLife crack_;
};

}  // namespace gearpod::mc
