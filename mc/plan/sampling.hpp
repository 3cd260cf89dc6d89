// Sampling plan of the random inputs (ensemble.sampling): independent, or a randomized quasi-Monte
// Carlo sequence that fills their ranges evenly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mc/plan/draw_plan.hpp"
#include "mc/plan/gearbox_streams.hpp"
#include "mc/plan/instance_inputs.hpp"
#include "mc/study/copula.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/random/scrambled_sobol.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Assigns a dimension to every input that is sampled by a distribution's quantile, in the order of
// the study's random inputs. Gearboxes of one group with the same `levels` and `grid` values are
// the points of one sequence, scrambled by the seed. A larger ensemble continues the sequences.
class SamplingPlan {
  public:
    // `combinations`: number of combinations of `levels` and `grid` values; `sizes`: number of
    // fault sizes, which vary fastest.
    SamplingPlan(const Study& study, std::uint64_t sizes, std::uint64_t combinations);

    // True if the study's random input at this index is sampled by variate().
    bool has(std::size_t input) const {
        return input < dimension_.size() && dimension_[input] >= 0;
    }
    // Uniform variate in (0, 1) of an input of a gearbox.
    double variate(std::size_t input, Group group, std::uint64_t index) const;

  private:
    struct SequencePoint {
        std::uint64_t sequence, number;
    };
    SequencePoint place(Group group, std::uint64_t index) const;

    std::uint64_t seed_;
    std::uint64_t sizes_, combinations_;
    std::vector<int> dimension_;           // by input; -1: not sampled by the plan
    std::vector<StreamPurpose> purposes_;  // by dimension
    Sobol sobol_;
};

// Draws the realizations of an ensemble: the random inputs of gearbox k of a group.

// One random gearbox of the ensemble. It is drawn once: its tile, its features and its row in the
// results use the same values.
struct Realization {
    GearboxId id;
    InstanceInputs inputs;
    // Values of the random inputs of the study except the fault's size, SI, in the study's order.
    std::vector<double> random_values = {};
};

// The same gearbox at an additional sensor (GearboxId::sensor): it has noise of its own.
Realization at_sensor(const Study& study, const Realization& realization, std::uint64_t sensor);

// Random input with a given value, which replaces the random one.
struct GivenInput {
    std::string key;   // "gearbox.tooth_quality"
    double value = 0;  // SI
};

// Draws the gearboxes of both groups of one study. Immutable and safe to share between threads.
// Inputs with `levels` or `grid` take their values in turn, in all combinations. The level indices
// of instance i are the digits of i in a mixed radix with the numbers of values as bases. The
// lowest digit is the fault's size, so that each size gets equally many gearboxes; the others
// follow in the order of the schema. n gearboxes contain all combinations equally often if n is a
// multiple of their number.
class Sampler {
  public:
    explicit Sampler(const Study& study);
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    // A record of a gearbox, independent of what was drawn before. The baseline record has no
    // fault, its own values of the inputs that vary from record to record, and a torque that
    // differs by features.baseline_torque_scatter. Given inputs replace the drawn ones in `inputs`;
    // all other random numbers are unchanged.
    Realization draw(const GearboxId& id, std::span<const GivenInput> given = {}) const;

    const DrawPlan& draw_plan() const { return draw_plan_; }

  private:
    // Random input of the study, with what its draws need.
    struct DrawnInput {
        const RandomInput* input;
        const void* place;            // in study_ (NumberAccess::place)
        StreamPurpose normal, whole;  // of normal variates, and of draws from the distribution
        std::uint64_t level_stride;   // number of successive instances with the same level index
        bool is_size;                 // of the fault
    };
    std::vector<double> uniform_variates(const GearboxId& id) const;
    double draw_alone(const DrawnInput& drawn, const GearboxId& id) const;

    const Study study_;
    const DrawPlan draw_plan_;
    const Copula copula_;
    std::vector<DrawnInput> inputs_;
    const SamplingPlan plan_;
};

}  // namespace gearpod::mc
