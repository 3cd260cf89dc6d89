// Evaluates a table of inspections by the same statistics as a study's detection: POD by size from
// hits and misses or from responses, false calls, the trade-off over thresholds, and the number of
// specimens that a bound needs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/smooth_response.hpp"
#include "analysis/statistics/noise_distribution.hpp"

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

}  // namespace gearpod::analysis
