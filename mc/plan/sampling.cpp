#include "mc/plan/sampling.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace gearpod::mc {
namespace {

// Standard normal quantile at probability `share`.
double standard_normal_quantile(double share) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * share);
}

// Record whose random numbers an input has: that of the gearbox is the test record, and that of the
// baseline's assembly the first baseline record.
GearboxId owner(GearboxId id, DrawnPer per) {
    id.record = per == DrawnPer::gearbox ? Record::test : id.record;
    id.baseline = per == DrawnPer::record ? id.baseline : 0;
    return id;
}

}  // namespace

// Uniform variates of the correlated inputs.
std::vector<double> Sampler::uniform_variates(const GearboxId& id) const {
    return plan_.copula.uniform_variates([&](std::size_t input) {
        if (plan_.sampling.has(input)) {
            return standard_normal_quantile(plan_.sampling.variate(input, id.group, id.index));
        }
        return Normals(plan_.seed, id, plan_.inputs[input].normal)();
    });
}

// Value of an input that is neither correlated nor sampled by the plan.
double Sampler::draw_alone(const DrawnInput& input, const GearboxId& id) const {
    const Distribution& distribution = input.distribution;
    const GearboxId owner_id = owner(id, distribution.per());
    if (id.exchanged && distribution.has_quantile()) {
        return distribution.quantile(
            standard_normal_cdf(Normals::of_record(plan_.seed, owner_id, input.whole)()));
    }
    Philox engine = record_stream(plan_.seed, owner_id, input.whole);
    return distribution.draw(engine,
                             source_index(plan_.seed, id, input.whole) / input.level_stride);
}

Realization Sampler::draw(const GearboxId& id, std::span<const GivenInput> given) const {
    InputValues values = plan_.recipe.nominal;
    Realization realization;
    realization.id = id;
    const SamplingPlan& sampling = plan_.sampling;
    const std::vector<double> uniform = uniform_variates(id);
    for (std::size_t i = 0, correlated = 0; i < plan_.inputs.size(); ++i) {
        const DrawnInput& input = plan_.inputs[i];
        const Distribution& distribution = input.distribution;
        // A baseline's own values are not points of the sampling plan.
        const bool planned = sampling.has(i) &&
                             (id.record == Record::test || distribution.per() == DrawnPer::gearbox);
        const double value = plan_.copula.has(i) ? distribution.quantile(uniform[correlated++])
                             : planned
                                 ? distribution.quantile(sampling.variate(i, id.group, id.index))
                                 : draw_alone(input, id);
        values.set(input.id, value);
        if (input.kind != InputKind::fault_size) {
            realization.random_values.push_back(value);
        }
    }
    if (id.group == Group::threshold) {
        values.set(plan_.fault_size, 0.0);
    }
    for (const GivenInput& input : given) {
        values.set(input.id, input.value);
    }
    InstanceInputs& inputs = realization.inputs;
    inputs = instance_inputs(plan_.recipe, values);
    if (plan_.planets) {
        add_random_planets(
            *plan_.planets, values,
            Normals::of_record(plan_.seed, owner(id, plan_.planets->pins), StreamPurpose::planets),
            inputs.planets);
    }
    if (id.record == Record::baseline) {
        inputs.fault_size = 0.0;
        Normals unit = Normals::of_record(plan_.seed, id, StreamPurpose::baseline_torque);
        const double share = std::exp(plan_.baseline_torque_scatter * unit());
        inputs.torque_N_m *= share;
        inputs.fixed_shaft.load_torque_N_m *= share;
    }
    return realization;
}

}  // namespace gearpod::mc
