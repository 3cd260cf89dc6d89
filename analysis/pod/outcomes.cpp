#include "analysis/pod/outcomes.hpp"

#include <cmath>

#include "analysis/detection/threshold.hpp"

namespace gearpod::analysis {

std::vector<int> outcomes(std::span<const double> values, double threshold, Alarm alarm) {
    std::vector<int> hit;
    for (const double value : values) {
        hit.push_back(!std::isfinite(value) ? -1 : is_alarm(value, threshold, alarm) ? 1 : 0);
    }
    return hit;
}

HitMissPod pod_of_outcomes(std::span<const double> sizes, const std::vector<int>& hit,
                           const LevelDetection& detection, double confidence, int band_points) {
    HitMissPod pod;
    if (std::isnan(detection.threshold)) {
        pod.refusal = "no threshold";
        return pod;
    }
    if (!(detection.healthy_rate >= 0.0 && detection.healthy_rate < 1.0)) {
        pod.refusal = "the healthy test gearboxes contradict the threshold";
        return pod;
    }
    std::vector<double> tested;
    std::vector<char> detected;
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i] >= 0) {
            tested.push_back(sizes[i]);
            detected.push_back(hit[i] == 1 ? 1 : 0);
        }
    }
    return hit_miss_pod(hit_miss_table(tested, detected),
                        {detection.healthy_rate, confidence, band_points});
}

}  // namespace gearpod::analysis
