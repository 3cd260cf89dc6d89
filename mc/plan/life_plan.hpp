// Lives of gearboxes that are measured repeatedly while a crack grows: their records, the loads at
// which they are integrated, the crack growth and the monitoring.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mc/files/input/problems.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/study/study.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"

namespace gearpod::mc {

// Distribution of the torque, speed, gain or noise of records, as a factor on the value of the
// gearbox. It is given by a scatter key of [life] (a lognormal distribution) or in [random] with
// per = "record". In both cases, a record has one standard normal number per quantity, which the
// distribution converts to a factor.
class RecordDistribution {
  public:
    // `scatter`: rms of the factor's logarithm, used if [random] has no distribution of the
    // quantity. `distinct`: number of equally frequent factors, each that of the mean normal number
    // of its part; the spread of these numbers is restored to 1.
    RecordDistribution(const Study& study, RecordQuantity quantity, double scatter,
                       std::optional<int> distinct = {});

    bool varies() const { return input_.has_value() || scatter_ > 0.0; }
    // True if the distribution is given in [random].
    bool given() const { return input_.has_value(); }
    // Factor for a standard normal number; monotonically increasing.
    double factor(double unit) const;
    // Root mean square of the factor (numerically, or an upper approximation for lognormal
    // factors).
    double rms() const;
    // Ascending factors at which a gearbox is integrated, between which records are interpolated.
    // They belong to the normal numbers -1.5 and 1.5; {1} if the quantity is constant.
    std::vector<double> integrated_factors() const;
    // All factors that occur, ascending; empty if they are not limited to a number.
    std::vector<double> distinct_factors() const;
    // For example "scatters by 2 % (rms) about the gearbox's" or "lognormal, ...".
    std::string text() const;

  private:
    double factor_of(double unit) const;

    double scatter_;
    std::vector<double> distinct_;  // normal numbers
    std::optional<RandomInput> input_;
    double nominal_ = 1.0;  // in the unit of the distribution
};

struct RecordDistributions {
    explicit RecordDistributions(const Study& study);

    RecordDistribution torque, speed, gain, noise;
    bool sensor_noise_only;  // false if it applies to the encoders as well
};

// Number of torques or speeds at which a gearbox is integrated. Signals of other records are
// interpolated between them.
struct LoadNumber {
    std::optional<int> nodes;  // of one polynomial; empty: two quantiles, linear between them
    bool given = false;        // in the study; otherwise it is chosen (choose_interpolation)

    bool operator==(const LoadNumber&) const = default;
};

// Length of a record in planet turns.
struct RecordSpan {
    int turns = 0;  // whole planet turns in each recording
    // planet turns after which every tooth of a planet has met every ring tooth once
    int all_turns = 0;
    int recordings = 1;  // number of recordings averaged in a record

    // True if every recording consists of complete spans.
    bool whole() const { return turns % all_turns == 0; }
};

// Content of a results file of lives, and how it is monitored.
struct CampaignPlan {
    // Ensemble of the lives; its inputs are those that do not vary by record.
    EnsemblePlan ensemble;
    std::string assumptions;  // see assumptions()
    // Healthy lives that count false alarms, in addition to those that set the thresholds.
    long counting_lives = 0;
    int records = 0, baseline_records = 0;
    double interval_h = 0.0;  // between records
    // Depth of the crack when it begins to grow, smallest one of interest, and depth at which a
    // life ends.
    double begin_m = 0.0, smallest_m = 0.0, last_m = 0.0;
    // Number of depth steps from 0 to the last depth, and the one in which the crack begins to
    // grow.
    int depth_steps = 1, first_step = 0;
    bool torque_regression = false;
    std::vector<std::string> detectors;
    double false_alarms_per_1000_h = 0.0;

    // Depth at the end of that number of steps, and at the middle of a step. The errors of
    // interpolation between depths are measured at the middle of the first and the last step.
    double depth_m(int steps) const { return last_m * steps / depth_steps; }
    double middle_m(int step) const { return last_m * (step + 0.5) / depth_steps; }
};
// Precondition: the study has lives.
CampaignPlan make_campaign_plan(const Study& study);
// Plan of the study whose text a results file holds; `name` stands for it in messages. Empty if
// this program cannot read the study, or if it has no lives.
std::optional<CampaignPlan> recorded_campaign_plan(const std::string& study_text,
                                                   const std::string& name);

// Growth of the crack: by Paris' law from a first depth, or along a curve of hours since the crack
// started and its depth then.
struct ParisStart {
    double first_m;
};
struct DepthCurve {
    std::vector<double> hours, depth_m;
};

// Tooth whose root cracks.
struct CrackedTooth {
    gears::MeshGeometry geometry;  // of a mesh with the tooth
    int gear;                      // 1 or 2 of the mesh
    stiffness::Profile profile;
    double angle_rad, face_width_m;
    stiffness::CrackLaw law;
    int teeth;     // of the gear
    int meetings;  // of the tooth with its mates in as many mesh periods as the gear has teeth
};

struct LifePlan {
    CampaignPlan campaign;
    // Records.
    RecordDistributions distributions;
    LoadNumber torques, speeds;
    // Largest error of signals between them, relative to the change made by the smallest crack of
    // interest.
    double interpolation_tolerance;
    double noise_level;
    RecordLength length;  // if it is not the span
    int recordings;       // averaged in a record
    std::string record;   // its length and the tooth pairs in it, "26 turns of ..."
    // Gearboxes.
    std::uint64_t seed;
    std::shared_ptr<const Sampler> sampler;  // inputs that vary by record are nominal
    std::shared_ptr<const Drivetrain> drivetrain;
    // Differences between gearboxes: tooth errors, and keys of random inputs. Keys of random
    // inputs without effect, because the crack grows to its size.
    std::vector<std::string> gearbox_inputs, ignored_inputs;
    // Crack.
    CrackedTooth tooth;
    std::variant<ParisStart, DepthCurve> growth;

    // Length of a record at this speed. Throws SceneError if recordings are too short.
    RecordSpan record_span(double speed_rad_s) const;
};

// Lives of a study, or the reasons why it has none whose records can be superposed.
struct StudyLives {
    StudyLives(const Study& study, const FeaturePlan& features, const GearboxPlan& gearbox);

    bool requested;                    // the study has [life]
    std::vector<std::string> ignored;  // given keys without effect: they concern single records
    std::vector<SceneError> problems;  // all reasons
    Problems problems_in(const std::string& file) const;  // the same, for messages
    std::shared_ptr<const LifePlan> plan;                 // null if there are any
};

}  // namespace gearpod::mc
