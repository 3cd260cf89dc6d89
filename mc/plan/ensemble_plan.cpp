#include "mc/plan/ensemble_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "analysis/report/false_alarm_text.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {

std::string Part::text() const {
    return whole() ? "" : fmt::format("{}/{}", index + 1, count);
}

std::optional<Part> read_part(const std::string& text) {
    if (text.empty()) {
        return Part{};
    }
    constexpr std::size_t kMostParts = 1'000'000;
    Part part;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, part.index);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') {
        return std::nullopt;
    }
    const auto second = std::from_chars(first.ptr + 1, end, part.count);
    if (second.ec != std::errc() || second.ptr != end || part.index < 1 ||
        part.index > part.count || part.count > kMostParts) {
        return std::nullopt;
    }
    --part.index;
    return part;
}

BatchPlan::BatchPlan(std::int64_t threshold_instances, std::int64_t instances, const Part& part,
                     int threshold_records)
    : thresholds_(static_cast<std::size_t>(threshold_instances)),
      test_(static_cast<std::size_t>(instances)),
      records_(static_cast<std::size_t>(threshold_records)),
      part_(part) {}

Batch BatchPlan::batch(std::size_t index) const {
    const std::size_t all = number(index), thresholds = all_threshold_batches();
    const bool threshold = all < thresholds;
    const std::size_t in_group = threshold ? all : all - thresholds;
    const std::size_t gearboxes = threshold ? thresholds_ : test_;
    const std::size_t first = in_group * kBatchRows;
    return {threshold ? Group::threshold : Group::test, first, rows_before(index),
            std::min<std::size_t>(kBatchRows, gearboxes - first), threshold ? records_ : 1};
}

std::size_t BatchPlan::batch_of_row(std::size_t row) const {
    // All batches before the last one of the threshold group are full.
    const std::size_t thresholds = threshold_batches(), before = threshold_rows();
    return row < before ? row / (kBatchRows * records_) : thresholds + (row - before) / kBatchRows;
}

std::size_t BatchPlan::gearboxes_before(std::size_t batches) const {
    const std::size_t until = std::min(batches, this->batches());
    std::size_t gearboxes = until * kBatchRows;
    // Only the last batch of each group may be incomplete.
    const auto short_of = [&](std::size_t last, std::size_t instances) {
        const bool included = last % part_.count == part_.index && last / part_.count < until;
        return included ? (kBatchRows - instances % kBatchRows) % kBatchRows : 0;
    };
    const std::size_t thresholds = all_threshold_batches(), test = batches_of(test_);
    gearboxes -= thresholds > 0 ? short_of(thresholds - 1, thresholds_) : 0;
    gearboxes -= test > 0 ? short_of(thresholds + test - 1, test_) : 0;
    return gearboxes;
}

std::size_t BatchPlan::rows_before(std::size_t batches) const {
    const std::size_t healthy = gearboxes_before(std::min(batches, threshold_batches()));
    return gearboxes_before(batches) + (records_ - 1) * healthy;
}

namespace {

// Omits the title, the number of test gearboxes, the stopping rule, and all settings of threads,
// lanes, instruction set and checkpoints.
std::string identity_text(const Study& study) {
    Study essence = study;
    essence.title.clear();
    for (PythonFeature& feature : essence.features.python) {
        feature.file.clear();  // the hash of its content counts
    }
    essence.numerics.threads = Numerics{}.threads;
    essence.numerics.lanes = Numerics{}.lanes;
    essence.numerics.instruction_set = Numerics{}.instruction_set;
    essence.ensemble = {};
    essence.ensemble.threshold_instances = study.ensemble.threshold_instances;
    essence.ensemble.threshold_records = study.ensemble.threshold_records;
    essence.ensemble.importance_sampling = study.ensemble.importance_sampling;
    return resolved_text(essence);
}

std::vector<ParameterColumn> input_columns(const Study& study) {
    std::vector<ParameterColumn> columns;
    for (const RandomInput& input : study.random) {
        if (input.key != fault_size_key(study).path()) {
            const Key& key = *find_key(input.key);
            columns.push_back({key.column(), std::string(key.unit.si_name)});
        }
    }
    if (stored_baselines(study) > 0) {
        columns.push_back({kBaselineTorque, "1"});
    }
    if (study.ensemble.uses_importance_sampling()) {
        columns.push_back({kNoiseWeight, "1"});
    }
    columns.push_back({fault_size_column(study), std::string(fault_size_key(study).unit.si_name)});
    return columns;
}

std::vector<std::string> separating_meshes(const Study& study) {
    std::vector<std::string> names;
    if (teeth_can_separate(study)) {
        for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
            names.push_back(mesh_name(mesh));
        }
    }
    return names;
}

std::vector<VariantColumns> variants_of(const Study& study) {
    std::vector<VariantColumns> variants;
    for (const AdditionalSensor& sensor : study.sensor.additional) {
        variants.push_back({kSensorVariant + sensor.name,
                            fmt::format("sensor \"{}\", {:g} degrees from the first one",
                                        sensor.name, sensor.angle_deg),
                            variants.size()});
    }
    if (has_other_fault(study)) {
        variants.push_back(
            {kOtherFault,
             "healthy gearboxes of the threshold sample with " + other_fault_text(study),
             std::nullopt});
    }
    return variants;
}

}  // namespace

EnsemblePlan::EnsemblePlan() : EnsemblePlan(Study{}) {}

EnsemblePlan::EnsemblePlan(const Study& study_)
    : title(study_.title),
      study(resolved_text(study_)),
      identity(identity_text(study_)),
      seed(study_.ensemble.seed),
      threshold_gearboxes(study_.ensemble.threshold_instances),
      test_gearboxes(study_.ensemble.instances),
      threshold_records(study_.ensemble.threshold_records),
      inputs(input_columns(study_)),
      features(used_features(study_)),
      meshes(separating_meshes(study_)),
      variants(variants_of(study_)),
      request(detection_request(study_)),
      checkpoint_s(study_.ensemble.checkpoint_s),
      threads(study_.numerics.threads),
      lanes(study_.numerics.lanes) {
    if (study_.numerics.horizon == Horizon::superposed) {
        integration = {"superposed"};
    }
    shape = {inputs.size(), features.size(), request.noise_levels.size(),
             meshes.size(), variants.size(), integration.size()};
    for (const analysis::SizeGroup& group : request.groups) {
        group_names.push_back(size_text(study_, group));
    }
}

std::string EnsemblePlan::healthy_shortage() const {
    return analysis::sample_shortage(threshold_gearboxes, request.false_alarm_rate,
                                     request.confidence, analysis::Subject::gearboxes,
                                     threshold_records, request.importance_sampling);
}

void EnsemblePlan::append_inputs(std::span<const double> random_values, double noise_weight,
                                 std::vector<double>& row) const {
    row.insert(row.end(), random_values.begin(), random_values.end());
    if (request.importance_sampling) {
        row.push_back(noise_weight);
    }
}

std::optional<EnsemblePlan> recorded_plan(const std::string& study_text, const std::string& name,
                                          std::optional<std::int64_t> threshold_gearboxes) {
    std::optional<Study> study = read_study_text(study_text, name).study;
    if (!study) {
        return std::nullopt;
    }
    study->ensemble.threshold_instances =
        threshold_gearboxes.value_or(study->ensemble.threshold_instances);
    return EnsemblePlan(*study);
}

}  // namespace gearpod::mc
