// Evaluates a table of inspections by the same statistics as a study's detection: POD by size from
// hits and misses or from responses, false calls, the trade-off over thresholds, and the number of
// specimens that a bound needs. The measured coverage of its bounds is tabulated.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/smooth_response.hpp"
#include "analysis/statistics/noise_distribution.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Columns of the table, one entry per line. A size of 0 is a place without a flaw.
struct Inspections {
    std::vector<double> size;
    std::vector<double> value;   // 1 for a hit and 0 for a miss, or the response
    std::vector<long> specimen;  // equal for repeated measurements of one specimen
};

// Calibrated: one-sided bounds that cover the confidence in small tables. The others are
// asymptotic.
enum class BoundConvention { calibrated, handbook, one_sided, two_sided, joint };
const char* convention_name(BoundConvention convention);

struct InspectionRequest {
    bool responses = false;  // values are responses, otherwise hits and misses
    double confidence = 0.95;
    BoundConvention convention = BoundConvention::calibrated;
    std::optional<BoundMethod> method;  // none: the default of the convention
    std::vector<bool> log_sizes = {false, true};
    std::optional<double> target;  // size at which the POD is requested
    // Tables simulated from the fit to state the coverage of the bound of a90.
    int simulated_tables = 200;
    // Options for hits and misses.
    std::vector<Link> links = {kLinks, kLinks + 4};
    // None: the false-call rate of places without a flaw; fits with and without it are compared.
    std::optional<double> floor;
    bool fit_ceiling = false;
    bool firth = false;
    // Options for responses.
    Alarm alarm = Alarm::high;
    std::optional<double> threshold;        // none: derived from false_call_rate
    std::optional<double> false_call_rate;  // sets the threshold if none is given
    CensoringLimits limits;
    // Box-Cox exponents of the response to try: 1 linear, 0 logarithm.
    std::vector<double> powers = {1.0, 0.0};
    bool accept_failed_checks = false;
};

// False calls and detectable sizes at one threshold.
struct TradeOffPoint {
    double threshold = 0.0;
    double false_calls = 0.0;  // probability from the noise distribution; NaN without noise values
    SizeBounds a50, a90;
};
GEARPOD_FIELDS(TradeOffPoint, threshold, false_calls, a50, a90)

struct InspectionResult {
    std::string refusal;  // reason why there is no result, or ""
    HitMissTable table;
    bool once_per_specimen = false;  // every specimen counts once, its repeats sharing its weight
    HitMissPod hit_miss;
    SignalResponsePod signal_response;
    // Curve where no line through the responses passes the checks; needs default bounds and
    // uncensored values.
    std::optional<SmoothResponse> smooth;
    double threshold = 0.0;                // for responses
    long without_flaw = 0;                 // number of values of size 0
    long false_calls = 0;                  // number of hits among them
    Interval false_call_bounds;            // Clopper-Pearson, at the requested confidence
    std::vector<NoiseDistribution> noise;  // fits to the responses without flaw, in order of AIC
    std::vector<TradeOffPoint> trade_off;
    long specimens = 0, repeats = 0;  // specimens with a flaw; lines in excess of one per specimen
    // Flaws of at least the upper bound of a90, hits among them, and the lower bound of their POD
    // without a curve (Clopper-Pearson). 0 tests without a bound, and with repeats.
    long tests_above = 0, hits_above = 0;
    double demonstrated_pod = 0.0;
    // Number of specimens of one size that must all be found to demonstrate Pd 0.9 at the
    // confidence.
    long all_found = 0;
};

// Throws std::invalid_argument with all problems of the data and the request, such as values that
// are not finite.
InspectionResult inspect(const Inspections& data, const InspectionRequest& request);

// Coverage of the default bounds of `pod`, measured on tables of known truth by
// tests/analysis/pod/test_pod_coverage.cpp. Printed next to the bounds, and in
// docs/validation/coverage.md.
struct MeasuredCoverage {
    const char* kind;                       // one of the kinds below
    int specimens;                          // of a table
    int tables;                             // that were drawn
    double upper_per_cent, lower_per_cent;  // of tables whose bound of a90 held
};

inline constexpr char kScalesGiven[] = "responses, scales given",
                      kOnALine[] = "responses on a line",
                      kOnLogScales[] = "responses on log scales",
                      kRepeated[] = "three responses of every specimen",
                      kLeftCensored[] = "responses censored below",
                      kCensored[] = "responses censored below and above",
                      kPowerFitted[] = "responses, Box-Cox power fitted",
                      kOnACurve[] = "responses on a curve whose scatter grows",
                      kRepeatedOnACurve[] = "eight responses of every specimen on a curve",
                      kHits[] = "hits, logit", kHitsOfLogSize[] = "hits, probit of log size",
                      kCeiling95[] = "hits, ceiling 0.95", kCeiling85[] = "hits, ceiling 0.85",
                      kRepeatedHits[] = "three hits or misses of every specimen",
                      kInspectors[] = "hits of inspectors on flaws of their own",
                      kGrowing[] = "responses, scatter in proportion to the size";

inline constexpr MeasuredCoverage kMeasuredCoverage[] = {
    {kScalesGiven, 10, 500, 94.8, 94.2},
    {kScalesGiven, 20, 500, 94.2, 95.4},
    {kScalesGiven, 40, 500, 94.0, 94.2},
    {kScalesGiven, 100, 500, 94.8, 94.8},
    {kScalesGiven, 200, 500, 95.2, 95.6},
    {kOnALine, 10, 500, 92.3, 94.1},
    {kOnALine, 20, 100, 93.8, 95.2},
    {kOnALine, 40, 200, 92.6, 94.2},
    {kOnALine, 100, 500, 95.6, 94.8},
    {kOnALine, 200, 500, 95.0, 96.2},
    {kOnLogScales, 10, 100, 96.0, 92.0},
    {kOnLogScales, 20, 100, 95.3, 94.0},
    {kOnLogScales, 40, 100, 94.4, 95.1},
    {kOnLogScales, 200, 500, 95.6, 95.4},
    {kRepeated, 10, 100, 91.0, 93.0},
    {kRepeated, 13, 200, 92.9, 94.4},
    {kRepeated, 30, 100, 99.0, 94.8},
    {kLeftCensored, 20, 100, 93.9, 99.0},
    {kLeftCensored, 40, 500, 93.9, 98.2},
    {kLeftCensored, 100, 500, 94.4, 98.2},
    {kCensored, 20, 100, 96.0, 96.0},
    {kCensored, 40, 500, 97.0, 98.0},
    {kPowerFitted, 20, 100, 94.0, 95.0},
    {kPowerFitted, 40, 100, 94.8, 93.8},
    {kPowerFitted, 100, 100, 95.9, 94.9},
    {kGrowing, 10, 100, 93.3, 86.7},
    {kGrowing, 20, 100, 87.9, 91.4},
    {kGrowing, 40, 100, 90.6, 96.2},
    {kGrowing, 100, 100, 92.3, 96.2},
    {kOnACurve, 40, 60, 100, 95.0},
    {kRepeatedOnACurve, 35, 60, 93.1, 96.6},
    {kHits, 30, 100, 98.4, 98.4},
    {kHits, 60, 100, 95.3, 95.3},
    {kHitsOfLogSize, 30, 100, 96.3, 97.9},
    {kHitsOfLogSize, 60, 100, 96.7, 96.0},
    {kCeiling95, 30, 100, 98.9, 87.2},
    {kCeiling95, 60, 100, 98.0, 83.8},
    {kCeiling85, 30, 100, 86.7, 100},
    {kRepeatedHits, 10, 89, 97.8, 100},
    {kRepeatedHits, 30, 100, 95.0, 98.0},
    {kInspectors, 3, 100, 100, 100},
    {kInspectors, 10, 100, 97.0, 99.0},
    {kInspectors, 30, 100, 97.0, 98.0},
};

// Row of the kind whose number of specimens is nearest. Null for a kind without rows.
inline const MeasuredCoverage* measured_coverage(const char* kind, long specimens) {
    const MeasuredCoverage* nearest = nullptr;
    const auto distance = [&](const MeasuredCoverage& row) {
        return std::abs(std::log(static_cast<double>(specimens) / row.specimens));
    };
    for (const MeasuredCoverage& row : kMeasuredCoverage) {
        if (row.kind == kind && (nearest == nullptr || distance(row) < distance(*nearest))) {
            nearest = &row;
        }
    }
    return nearest;
}

inline bool is_smooth(const InspectionResult& result) {
    return result.smooth && result.smooth->refusal().empty();
}

// Kind of a table that has a curve.
inline const char* kind_of_table(const InspectionRequest& request, const InspectionResult& result) {
    const HitMissPod& hits = result.hit_miss;
    const SignalResponsePod& line = result.signal_response;
    if (!request.responses) {
        const bool own_flaws = static_cast<long>(result.table.size()) > 2 * result.specimens;
        return result.repeats > 0                ? (own_flaws ? kInspectors : kRepeatedHits)
               : hits.chosen.curve.form.log_size ? kHitsOfLogSize
                                                 : kHits;
    }
    return is_smooth(result)    ? (result.repeats > 0 ? kRepeatedOnACurve : kOnACurve)
           : result.repeats > 0 ? kRepeated
           : line.right > 0     ? kCensored
           : line.left > 0      ? kLeftCensored
           : line.rule.method == BoundMethod::exact          ? kScalesGiven
           : std::isnan(request.powers.front())              ? kPowerFitted
           : line.candidates[line.chosen].scale.power == 1.0 ? kOnALine
                                                             : kOnLogScales;
}

}  // namespace gearpod::analysis
