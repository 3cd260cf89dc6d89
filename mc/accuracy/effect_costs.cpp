#include "mc/accuracy/effect_costs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gearpod::mc {

void measure_effect_costs(const Scene& own, const AccuracyRequest& request, const TimeBudget& time,
                          AccuracyReport& report) {
    constexpr double kTimeShare = 0.25;
    // A budget of 0 would have no limit.
    const double seconds =
        std::isfinite(time.seconds()) ? std::max(1e-9, kTimeShare * time.seconds()) : 0.0;
    EffectMeasurement measured = measure_effects(
        own, {.repeats = request.repeats, .seconds = seconds, .progress = request.progress});
    report.effects = std::move(measured.effects);
    if (!measured.omitted.empty()) {
        report.left_out.push_back(
            fmt::format("cost of effects: {}", fmt::join(measured.omitted, ", ")));
    }
}

}  // namespace gearpod::mc
