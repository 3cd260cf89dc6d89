// Draws the realizations of an ensemble: the random inputs of gearbox k of a group.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mc/plan/gearbox_streams.hpp"
#include "mc/plan/instance_inputs.hpp"
#include "mc/study/copula.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Plan of what is drawn for each gearbox of a study.

// Random input of a study, with what its draws need.
struct DrawnInput {
    InputId id;
    InputKind kind;
    Distribution distribution;
    StreamPurpose normal, whole;  // of normal variates, and of draws from the distribution
    std::uint64_t level_stride;   // number of successive instances with the same level index
};

// Inputs with `levels` or `grid` take their values in turn, in all combinations. The level indices
// of instance i are the digits of i in a mixed radix with the numbers of values as bases. The
// lowest digit is the fault's size, so that each size gets equally many gearboxes; the others
// follow in the order of the schema. n gearboxes contain all combinations equally often if n is a
// multiple of their number.
struct DrawPlan {
    explicit DrawPlan(const Study& study);

    std::uint64_t seed;
    RowOrder rows;
    std::vector<DrawnInput> inputs;  // in the order of the schema
    Copula copula;
    InputsRecipe recipe;
    InputId fault_size;  // is 0 in the threshold group
    std::optional<PlanetScatter> planets;
    // Standard deviation of the logarithm of a baseline record's torque relative to that of the
    // test record.
    double baseline_torque_scatter;
    // Baseline records of whose mean torque the difference from that of the test record, relative
    // and without its sign, is a value of the gearbox.
    std::uint64_t stored_baselines;
    bool redraws_teeth;  // true if the gears are turned for the baseline's assembly
};

inline constexpr const char* kBaselineTorque = "baseline_torque_difference";  // its column
// DrawPlan::stored_baselines: 0 without features that compare records, and in lives.
std::uint64_t stored_baselines(const Study& study);

// One random gearbox of the ensemble. It is drawn once: its tile, its features and its row in the
// results use the same values.
struct Realization {
    GearboxId id;
    InstanceInputs inputs;
    // Values of the random inputs of the study except the fault's size, SI, in the study's order,
    // and of a test record kBaselineTorque, if the plan stores it.
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
    double baseline_torque(const GearboxId& id) const;

    const DrawPlan plan_;
};

}  // namespace gearpod::mc
