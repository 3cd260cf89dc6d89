#include "mc/plan/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/keys/key.hpp"

namespace gearpod::mc {
namespace {

bool is_fault_size(const RandomInput& input) {
    return input.kind == InputKind::fault_size;
}

// Purpose of the draws from a distribution. Inputs from the columns of one table share it.
StreamPurpose purpose_of(const RandomInput& input) {
    const int table = input.distribution.rows().group;
    return table > 0 ? with_suffix(StreamPurpose::table_row, std::to_string(table))
                     : with_suffix(StreamPurpose::random_input, flat_path(input.key));
}

std::uint64_t product_or_most(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    return a > kMost / b ? kMost : a * b;
}

// Place value of each random input's digit in the mixed radix: the product of the numbers of values
// of the inputs before it.
std::vector<std::uint64_t> level_strides(const std::vector<RandomInput>& inputs) {
    std::vector<std::uint64_t> lengths(inputs.size(), 1);
    std::uint64_t length = 1;
    for (const bool size : {true, false}) {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const std::uint64_t count = inputs[i].distribution.levels().size();
            if (is_fault_size(inputs[i]) == size && count > 0) {
                lengths[i] = length;
                length = product_or_most(length, count);
            }
        }
    }
    return lengths;
}

std::vector<DrawnInput> drawn_inputs(const Study& study) {
    const std::vector<std::uint64_t> strides = level_strides(study.random);
    std::vector<DrawnInput> inputs;
    for (std::size_t i = 0; i < strides.size(); ++i) {
        const RandomInput& input = study.random[i];
        inputs.push_back({input_id(input.key), input.kind, input.distribution,
                          with_suffix(StreamPurpose::random_input, flat_path(input.key)),
                          purpose_of(input), strides[i]});
    }
    return inputs;
}

// Record whose random numbers an input has: that of the gearbox is the test record, and that of the
// baseline's assembly the first baseline record.
GearboxId owner(GearboxId id, DrawnPer per) {
    id.record = per == DrawnPer::gearbox ? Record::test : id.record;
    id.baseline = per == DrawnPer::record ? id.baseline : 0;
    return id;
}

}  // namespace

std::uint64_t stored_baselines(const Study& study) {
    return compares_records(study) && study.features.baseline_torque_scatter > 0.0 &&
                   !study.life.interval_h
               ? static_cast<std::uint64_t>(study.features.baseline_records)
               : 0;
}

DrawPlan::DrawPlan(const Study& study)
    : seed(static_cast<std::uint64_t>(study.ensemble.seed)),
      rows(study.ensemble),
      inputs(drawn_inputs(study)),
      copula(study),
      recipe(study),
      fault_size(input_id("fault." + std::string(size_defining_kind(study).size().name))),
      baseline_torque_scatter(study.features.baseline_torque_scatter),
      stored_baselines(mc::stored_baselines(study)),
      redraws_teeth(redraws(study, "teeth")) {
    if (has_random_planets(study)) {
        planets.emplace(study.gearbox,
                        redraws(study, "pins") ? DrawnPer::assembly : DrawnPer::gearbox);
    }
}

std::vector<double> Sampler::uniform_variates(const GearboxId& id) const {
    return plan_.copula.uniform_variates(
        [&](std::size_t input) { return Normals(plan_.seed, id, plan_.inputs[input].normal)(); });
}

// Value of an input that is not correlated.
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

// Torque of a baseline record relative to that of the test record.
double Sampler::baseline_torque(const GearboxId& id) const {
    Normals unit = Normals::of_record(plan_.seed, id, StreamPurpose::baseline_torque);
    return std::exp(plan_.baseline_torque_scatter * unit());
}

Realization Sampler::draw(const GearboxId& id, std::span<const GivenInput> given) const {
    InputValues values = plan_.recipe.nominal;
    Realization realization;
    realization.id = id;
    const std::vector<double> uniform = uniform_variates(id);
    for (std::size_t i = 0, correlated = 0; i < plan_.inputs.size(); ++i) {
        const DrawnInput& input = plan_.inputs[i];
        const double value = plan_.copula.has(i)
                                 ? input.distribution.quantile(uniform[correlated++])
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
        const double share = baseline_torque(id);
        inputs.torque_N_m *= share;
        inputs.fixed_shaft.load_torque_N_m *= share;
    } else if (plan_.stored_baselines > 0) {
        double sum = 0.0;
        GearboxId baseline = id;
        baseline.record = Record::baseline;
        for (baseline.baseline = 0; baseline.baseline < plan_.stored_baselines;
             ++baseline.baseline) {
            sum += baseline_torque(baseline);
        }
        realization.random_values.push_back(
            std::abs(sum / static_cast<double>(plan_.stored_baselines) - 1.0));
    }
    return realization;
}

}  // namespace gearpod::mc
