// Hit/miss POD of one feature at one noise level (MIL-HDBK-1823A, appendix G.3; ASTM E2862).
// Candidates are logit and probit on size and on log size, each with floor 0 and ceiling 1, with
// the healthy gearboxes' rate as floor, and with a fitted ceiling. The curve of least AIC is chosen
// (H. Akaike, IEEE Trans. Autom. Control 19 (1974), 716-723). The choice itself is uncertain, so
// the bounds are the widest of all curves whose AIC is within 2 of the least (K. P. Burnham, D. R.
// Anderson, Model Selection and Multimodel Inference (2002), section 2.6). Bounds of the chosen
// curve alone would cover 89 to 95 instead of 93 to 98 % (test_coverage.cpp).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/pod_bounds.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/pod_likelihood.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Maximum likelihood fit of one form, or the reason why there is none.
struct HitMissFit {
    PodCurve curve;
    double log_likelihood = 0.0;  // without the binomial coefficients
    double aic = 0.0;
    GoodnessOfFit fit;
    std::string refusal;  // empty if fitted
};
GEARPOD_FIELDS(HitMissFit, curve_, log_likelihood_, aic_, fit_, refusal)

struct HitMissPod {
    long tests = 0;  // faulty gearboxes with a value
    long hits = 0;
    double smallest = 0.0, largest = 0.0;  // tested sizes
    std::string refusal;                   // reason why there is no curve, empty if there is one
    HitMissFit chosen;
    std::vector<HitMissFit> candidates;
    // Forms of the curves that the bounds span, the chosen one first.
    std::vector<PodForm> supported;
    SizeBounds a50, a90;         // a90.upper is a90/95 at a confidence of 95 %
    std::vector<PodPoint> band;  // over the tested sizes
    bool doubtful = false;       // the goodness of fit rejects the curve at 5 %
    BoundRule rule;
    // Clusters of outcomes and the design effect on the bounds (pod_curve.hpp); 0 and 1
    // without.
    long clusters = 0;
    double design_effect = 1.0;
    // Share of tables simulated from the chosen curve in which the bound holds a90. NaN if not
    // simulated.
    double simulated_coverage = kNan;
    // Covariance of the chosen curve's location and scale (pod_curve.hpp). NaN with a fitted
    // ceiling or without individual outcomes.
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Constant(kNan);
    // Number of specimens needed to bring a90's upper bound to the requested target, as a factor on
    // the number tested. NaN without a target.
    double specimens_factor = kNan;
};
GEARPOD_FIELDS(HitMissPod, tests, hits, smallest, largest, refusal, chosen_, candidates, supported_,
               a50, a90, band, doubtful, rule_, clusters_, design_effect_, simulated_coverage_,
               covariance_, specimens_factor_)

struct HitMissRequest {
    double floor = 0.0;        // rate of the healthy gearboxes; 0: only curves without floor
    double confidence = 0.95;  // of each one-sided bound, unless there is a rule
    int band_points = 41;

    std::optional<BoundRule> rule = {};
    std::vector<Link> links = {Link::logit, Link::probit};
    std::vector<bool> log_sizes = {false, true};
    bool without_floor = true;  // also fit curves without the floor
    bool fit_ceiling = true;    // also fit curves with a ceiling
    bool firth = false;
    // Individual outcomes, for Wald bounds and the covariance. With more outcomes than clusters the
    // covariance is robust, and calibrated bounds are those of pod_curve.hpp.
    std::vector<ClusteredOutcome> outcomes = {};
    std::optional<double> target = {};  // size to which a90's bound should come down
    std::string tested = "faulty gearbox";
    int simulated_tables = 0;  // for simulated_coverage
};

// Fits one form alone, for comparison with other programs and for coverage tests.
HitMissFit fit_hit_miss(const HitMissTable& table, const PodForm& form);

// Sizes with a POD of `pod` by curves of these forms, each fitted to the table: estimates, or
// bounds of a side. Empty where no curve fits.
std::vector<std::optional<SizeEstimate>> sizes_by_form(const HitMissTable& table,
                                                       std::span<const PodForm> forms, double pod,
                                                       const BoundRule& rule,
                                                       std::optional<Side> side);

HitMissPod hit_miss_pod(const HitMissTable& table, const HitMissRequest& request);

// Outcome of every gearbox (detected, missed or without a value), and the POD curve of the
// outcomes.

// 1 detected, 0 missed, -1 no value.
std::vector<int> outcomes(std::span<const double> values, double threshold, Alarm alarm);

// Fits the POD curve; refuses without a threshold. The floor is the healthy rate of the detection.
HitMissPod pod_of_outcomes(std::span<const double> sizes, const std::vector<int>& hit,
                           const LevelDetection& detection, double confidence,
                           int band_points = HitMissRequest{}.band_points);

}  // namespace gearpod::analysis
