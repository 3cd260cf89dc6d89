#include "mc/numerics/measured_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearpod::mc {

namespace {

// Signals may cover fewer mesh periods after the change: both records keep the common ones.
void keep_common(std::vector<std::vector<double>>& a, std::vector<std::vector<double>>& b) {
    for (std::size_t g = 0; g < std::min(a.size(), b.size()); ++g) {
        const std::size_t common = std::min(a[g].size(), b[g].size());
        a[g].resize(common);
        b[g].resize(common);
    }
}

struct TimedPilot {
    PilotRecord record;
    double least_s = INFINITY;  // processor time of a gearbox
};
TimedPilot timed_pilot(const Planner& planner, int repeats) {
    const Pilot pilot(planner);
    TimedPilot timed;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        timed.record = pilot.run(planner.facts().numerics);
        timed.least_s = std::min(timed.least_s, timed.record.total_s);
    }
    return timed;
}

// Measures the change from the pilot `before` to that of a variant.
MeasuredEffect measure(TimedPilot before, const EffectVariant& variant, int repeats) {
    MeasuredEffect measured;
    measured.effect = variant.effect;
    measured.in_study = variant.in_study;
    try {
        TimedPilot after = timed_pilot(variant.planner(), repeats);
        measured.time_ratio =
            variant.in_study ? before.least_s / after.least_s : after.least_s / before.least_s;
        keep_common(after.record.sensor, before.record.sensor);
        keep_common(after.record.te, before.record.te);
        measured.change = pilot_error(after.record, before.record);
    } catch (const SceneError& error) {
        measured.refusal = error.key() + ": " + error.what();
    }
    return measured;
}

}  // namespace

EffectMeasurement measure_effects(const Planner& planner, const EffectRequest& request) {
    const TimeBudget time(request.seconds);
    EffectMeasurement all;
    std::optional<TimedPilot> before;
    double slowest_s = 0.0;
    for (const EffectVariant& variant : planner.effect_variants()) {
        if (!time.enough(slowest_s)) {
            all.omitted.push_back(variant.effect);
            continue;
        }
        request.progress(
            fmt::format("{} {}", variant.in_study ? "without" : "with", variant.effect));
        if (!before) {
            before = timed_pilot(planner, request.repeats);
        }
        const double start_s = thread_processor_s();
        const MeasuredEffect measured = measure(*before, variant, request.repeats);
        slowest_s = std::max(slowest_s, thread_processor_s() - start_s);
        request.measured(measured);
        all.effects.push_back(measured);
    }
    return all;
}

}  // namespace gearpod::mc
