// Features of the gearboxes of a study at every noise level, those in Python included, and the mean
// of healthy records with which trending features compare.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_signals.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/plan/tile_plan.hpp"

namespace gearpod::mc {

// Exception in a feature, or a return value that is not a number. The feature has no value there.
struct PythonProblem {
    std::string feature;
    double noise_level = 1.0;
    std::string line;  // of a file, with its name
    std::string what;
};

// Use one object per thread.
class PythonFeatures {
  public:
    // Computes those of `computed` that are external, in this order. The plans must outlive the
    // object.
    PythonFeatures(const RecordPlan& record, const FeaturePlan& features,
                   std::span<const features::Feature* const> computed);

    bool empty() const { return used_.empty(); }

    // Adds the signals of a record at the next noise level.
    void add(double noise_level, const InstanceInputs& inputs, const features::FeatureInput& input);
    // Values [feature * levels + level] of the record whose signals were added, NaN where a feature
    // fails; the reasons are in problems(). `work` names the record in messages. Throws PythonError
    // and machine::Cancelled as PythonWorker::ask does.
    std::vector<double> compute(const std::string& work);
    const std::vector<PythonProblem>& problems() const { return problems_; }

  private:
    // Appends one record's signals; the first level also describes them in the request.
    void add_record(const char* kind, const InstanceInputs& inputs,
                    const features::FeatureInput& input);

    const RecordPlan& record_;
    const FeaturePlan& features_;
    std::vector<PythonFeature> used_;
    struct Request;
    std::shared_ptr<Request> request_;  // of the record whose signals are being added
    std::vector<double> values_;
    std::vector<PythonProblem> problems_;
};

// Prints each problem once per process and place, with the record that `work` names, on stderr.
void print_python_problems(const std::vector<PythonProblem>& problems, const std::string& work);

// Means over a few healthy records of the study at every noise level.
struct HealthyReference {
    static constexpr int kRecords = 8;

    std::vector<double> residual_variance;  // [level], (m/s^2)^2

    features::HealthyRecords at(std::size_t level) const { return {residual_variance[level]}; }
};

class HealthyRecordsMean {
  public:
    explicit HealthyRecordsMean(std::size_t levels);
    // `input` must hold the parts of the averaged sensor signal.
    void add(std::size_t level, const features::FeatureInput& input);
    // NaN if no record was added.
    HealthyReference mean() const;

  private:
    HealthyReference sum_;
    std::vector<int> records_;
};

// Mean over the first eight gearboxes of the threshold sample, with their own noise. Gearboxes that
// failed are left out.
HealthyReference simulated_reference(const TilePlan& plan);
// The same mean, of the first sensor or of an additional one (GearboxId::sensor); empty unless a
// feature of the study needs it.
HealthyReference healthy_reference(const TilePlan& plan, std::uint64_t sensor = 0);

// Signals from which features are computed at one noise level.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples, from tooth 0
    std::vector<double> tooth_rms;  // m/s^2, Z_p values, from tooth 0; empty without a sensor
};

// Computes the features that a study uses.
class RealizationFeatures : public RealizationSignals {
  public:
    // `healthy` comes from healthy_reference() and must outlive the object. Without `python`,
    // features in Python are NaN, and their files are not needed. `sensor` as in GearboxId.
    RealizationFeatures(const TilePlan& plan, const HealthyReference* healthy, bool python = true,
                        std::uint64_t sensor = 0);

    // Values of all used features, [feature * noise levels + level]. If `signals` is not null, one
    // entry per noise level is appended to it.
    std::vector<double> compute(const LaneSignals& gearbox, const Realization& realization,
                                std::vector<LevelSignals>* signals = nullptr);

  private:
    // A baseline record with noise. If records have a length, `cut` is the record, and `aligned`
    // are its signals at the tooth position of the test record.
    struct Baseline {
        RealizationSignals signals;
        LaneSignals cut, aligned;
        double noise_m_s2 = 0.0;  // rms noise of the sensor at noise level 1
    };
    // Computes the features in Python from the signals that were added to `python_`.
    void add_python_values(const Realization& realization, std::vector<double>& values);
    void load(const LaneSignals& gearbox, const Realization& realization);
    void load_baselines(const LaneSignals& gearbox, const Realization& realization,
                        const RecordWindow& window);
    void load_change(const LaneSignals& gearbox, const Realization& realization);

    const RecordPlan& plan_;
    const RowOrder rows_;
    std::vector<const features::Feature*> features_;
    PythonFeatures python_;
    const HealthyReference* healthy_;
    std::size_t levels_;
    LaneSignals record_;               // cut from the signals if records have a length
    std::vector<Baseline> baselines_;  // empty unless a feature compares with baseline records
    // Null unless a feature uses the change since the baseline.
    std::unique_ptr<RealizationSignals> change_;
    LaneSignals changed_;
};

}  // namespace gearpod::mc
