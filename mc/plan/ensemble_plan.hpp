// Ensemble of a run: batches of gearboxes, the columns of their rows, the detection
// rates that it estimates, and when it stops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "features/feature.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Number of gearboxes in a batch. It does not depend on the number of lanes, because the unit of
// work must be the same on every machine. A gearbox has one row per record: one, or
// ensemble.threshold_records in the threshold group.
inline constexpr int kBatchRows = 16;

// Numbers in a row: the parameters (EnsemblePlan::inputs), then features x noise levels, then
// the contact loss ratio of each mesh, then whether the motion was superposed, then features x
// noise levels of each variant.
struct RowShape {
    std::size_t parameters = 0;
    std::size_t features = 0;
    std::size_t levels = 0;
    std::size_t meshes = 0;       // 0 if teeth cannot lose contact
    std::size_t variants = 0;     // as EnsemblePlan::variants
    std::size_t integration = 0;  // as Results::integration

    std::size_t values() const { return variant_value_of(variants, 0); }
    // Index of the fault size, and of the importance weight of a row that has one.
    std::size_t fault_size() const { return parameters - 1; }
    std::size_t noise_weight() const { return parameters - 2; }
    // Index of the first contact loss ratio.
    std::size_t contact_loss() const { return parameters + features * levels; }
    std::size_t integration_value() const { return contact_loss() + meshes; }
    std::size_t value_of(std::size_t feature, std::size_t level) const {
        return parameters + feature * levels + level;
    }
    // Index of the first noise level of a variant's feature.
    std::size_t variant_value_of(std::size_t variant, std::size_t feature) const {
        return integration_value() + integration + (variant * features + feature) * levels;
    }
    bool operator==(const RowShape&) const = default;
};

// Consecutive gearboxes of one group. The records of a gearbox follow one another.
struct Batch {
    Group group = Group::test;
    std::uint64_t first_index = 0;  // within the group
    std::size_t first_row = 0;      // within the results
    std::size_t gearboxes = 0;
    std::size_t records = 1;

    std::size_t rows() const { return gearboxes * records; }
};

// Part of an ensemble that is computed by a separate run: every count-th batch. All parts have
// about the same number of gearboxes of either group.
struct Part {
    std::size_t index = 0;  // less than count
    std::size_t count = 1;

    bool whole() const { return count == 1; }
    std::string text() const;  // "2/4" for index 1 of 4; "" for the whole ensemble
    bool operator==(const Part&) const = default;
};
// Parses "2/4"; "" is the whole ensemble. Empty if the text is invalid.
std::optional<Part> read_part(const std::string& text);

// All batches of an ensemble: first those of the threshold group, then those of the test group. A
// larger test group begins with the batches of a smaller one, except for the last, which may be
// incomplete. For a part of an ensemble, the part's batches and rows are numbered from 0 in the
// same order.
class BatchPlan {
  public:
    BatchPlan(std::int64_t threshold_instances, std::int64_t instances, const Part& part = {},
              int threshold_records = 1);

    std::size_t rows() const { return rows_before(batches()); }
    std::size_t threshold_rows() const { return rows_before(threshold_batches()); }
    std::size_t test_rows() const { return rows() - threshold_rows(); }
    std::size_t threshold_gearboxes() const { return threshold_rows() / records_; }
    // Records per gearbox of the threshold group.
    std::size_t threshold_records() const { return records_; }
    // Name of a row: "gearboxes", or "records" if some gearboxes have several.
    const char* counted() const { return records_ > 1 ? "records" : "gearboxes"; }
    // Test gearboxes of the whole ensemble.
    std::size_t test_gearboxes() const { return test_; }
    std::size_t batches() const { return of_part(all_threshold_batches() + batches_of(test_)); }
    std::size_t threshold_batches() const { return of_part(all_threshold_batches()); }
    Batch batch(std::size_t index) const;
    // Number of a batch in the whole ensemble.
    std::size_t number(std::size_t index) const { return part_.index + index * part_.count; }
    std::size_t batch_of_row(std::size_t row) const;
    std::size_t rows_before(std::size_t batches) const;

  private:
    static std::size_t batches_of(std::size_t rows) { return (rows + kBatchRows - 1) / kBatchRows; }
    std::size_t all_threshold_batches() const { return batches_of(thresholds_); }
    // Number of this part's batches among the first `first` batches of the ensemble.
    std::size_t of_part(std::size_t first) const {
        return (first + part_.count - 1 - part_.index) / part_.count;
    }

    std::size_t gearboxes_before(std::size_t batches) const;

    // gearboxes in each group, and records per threshold gearbox
    std::size_t thresholds_, test_, records_;
    Part part_;
};

// Parameter that holds the importance weights of exponentially tilted records
// (signals/windowing/noise_importance_sampler.hpp).
inline constexpr const char* kNoiseWeight = "noise_weight";
// Beginning of the names of variants that are measured by additional sensors.
inline const std::string kSensorVariant = "sensor_";
// Name of the variant in which the healthy gearboxes of the threshold group have another fault than
// that of the study (SourceRole::other_fault). Its values are NaN for test gearboxes.
inline constexpr const char* kOtherFault = "other_fault";

struct ParameterColumn {
    std::string name;  // "planet_bearing_stiffness_N_m", fault_size_column()
    std::string unit;  // SI, e.g. "N/m"; "1" for a pure number
};

// Features of the same gearboxes with other signals.
struct VariantColumns {
    std::string name, description;
    std::optional<std::size_t> sensor;  // additional sensor; empty for kOtherFault
};

struct EnsemblePlan {
    // The plan of an empty study.
    EnsemblePlan();
    explicit EnsemblePlan(const Study& study);

    BatchPlan batches(const Part& part = {}) const {
        return {threshold_gearboxes, test_gearboxes, part, threshold_records};
    }
    // Appends the values of `inputs` except the fault's size. A plain record has weight 1.
    void append_inputs(std::span<const double> random_values, double noise_weight,
                       std::vector<double>& row) const;

    // States that there are too few healthy gearboxes for the false-alarm rate, or "".
    std::string healthy_shortage() const;

    std::string title;
    std::string study;     // resolved text
    std::string identity;  // the same without settings that do not affect the rows
    std::int64_t seed;
    std::int64_t threshold_gearboxes, test_gearboxes;
    int threshold_records;  // of each gearbox of the threshold group
    // Every random input, the weight of exponentially tilted records, and the fault's size last.
    std::vector<ParameterColumn> inputs;
    std::vector<const features::Feature*> features;
    std::vector<std::string> meshes;  // whose contact loss is stored; none if teeth cannot separate
    std::vector<std::string> integration;  // "superposed", or none
    std::vector<VariantColumns> variants;
    RowShape shape;
    analysis::DetectionRequest request;
    std::vector<std::string> group_names;  // sizes of the request's groups, "3 mm"
    double checkpoint_s;
    int threads;  // 0: all
    int lanes;
};

// Plan of the study whose text a results file holds; `name` stands for it in messages. With
// `threshold_gearboxes`, the same study with another number of these. Empty if this program cannot
// read the study.
std::optional<EnsemblePlan> recorded_plan(const std::string& study_text, const std::string& name,
                                          std::optional<std::int64_t> threshold_gearboxes = {});

}  // namespace gearpod::mc
