// Draws the realizations of an ensemble: the random inputs of gearbox k of a group.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mc/plan/draw_plan.hpp"
#include "mc/plan/gearbox_streams.hpp"
#include "mc/plan/instance_inputs.hpp"

namespace gearpod::mc {

// One random gearbox of the ensemble. It is drawn once: its tile, its features and its row in the
// results use the same values.
struct Realization {
    GearboxId id;
    InstanceInputs inputs;
    // Values of the random inputs of the study except the fault's size, SI, in the study's order.
    std::vector<double> random_values = {};
};

// Input with a given value, SI, which replaces the drawn or nominal one.
struct GivenInput {
    InputId id;
    double value = 0.0;
};

// Draws the gearboxes of both groups of one study. Immutable and safe to share between threads.
class Sampler {
  public:
    explicit Sampler(DrawPlan plan) : plan_(std::move(plan)) {}
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    // A record of a gearbox, independent of what was drawn before. The baseline record has no
    // fault, its own values of the inputs that vary from record to record, and a torque that
    // differs by features.baseline_torque_scatter. Given inputs replace the drawn ones in `inputs`;
    // all other random numbers are unchanged.
    Realization draw(const GearboxId& id, std::span<const GivenInput> given = {}) const;

    const DrawPlan& plan() const { return plan_; }

  private:
    std::vector<double> uniform_variates(const GearboxId& id) const;
    double draw_alone(const DrawnInput& input, const GearboxId& id) const;

    const DrawPlan plan_;
};

}  // namespace gearpod::mc
