// What a table of inspections says: POD by size from hits and misses or from responses, false
// calls, what another threshold would trade, and how many more specimens a bound takes. By the same
// statistics as a study's detection.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/statistics/noise_law.hpp"

namespace gearpod::analysis {

// A line each; sizes of 0 are places without a flaw.
struct Inspections {
    std::vector<double> size;
    std::vector<double> value;   // 1 hit and 0 miss, or the response
    std::vector<long> specimen;  // equal for repeated measurements of one
};

enum class BoundConvention { handbook, one_sided, two_sided, joint };

struct InspectionRequest {
    bool responses = false;  // else hits and misses
    double confidence = 0.95;
    BoundConvention convention = BoundConvention::handbook;
    std::optional<BoundMethod> method;  // none: the convention's own
    std::vector<bool> log_sizes = {false, true};
    std::optional<double> target;  // size
    // Of hits and misses.
    std::vector<Link> links = {kLinks, kLinks + 4};
    std::optional<double> floor;  // none: the rate without flaw, with and without it
    bool fit_ceiling = false;
    bool firth = false;
    // Of responses.
    Alarm alarm = Alarm::high;
    std::optional<double> threshold;        // none: from the false calls
    std::optional<double> false_call_rate;  // to set the threshold by
    CensoringLimits limits;
    std::vector<double> powers = {1.0, 0.0};
    bool insist = false;
};

// At a threshold.
struct TradeOffPoint {
    double threshold = 0.0;
    double false_calls = 0.0;  // probability by the noise's law; NaN without noise
    SizeBounds a50, a90;
};

struct InspectionResult {
    std::string refusal;  // why there is nothing
    HitMissTable table;
    HitMissPod hit_miss;
    SignalResponsePod signal_response;
    double threshold = 0.0;       // of responses
    long without_flaw = 0;        // values of size 0
    long false_calls = 0;         // of these
    Interval false_call_bounds;   // Clopper-Pearson, at the confidence
    std::vector<NoiseLaw> noise;  // of responses without flaw, the best first
    std::vector<TradeOffPoint> trade_off;
    long specimens = 0, repeats = 0;  // with a flaw; lines beyond one each
    // Specimens of one size of which all must be found for Pd 0.9 at the confidence.
    long all_found = 0;
};

InspectionResult inspect(const Inspections& data, const InspectionRequest& request);

}  // namespace gearpod::analysis
