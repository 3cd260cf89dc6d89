// Effect of a solver setting on detection rates: the same ensemble computed with two settings.
#pragma once

#include <optional>
#include <vector>

#include "analysis/reliability.hpp"
#include "machine/fields.hpp"
#include "mc/plan/scene.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Results of a pilot ensemble and the reliability derived from them.
struct PilotEnsemble {
    Results results;
    std::optional<analysis::Reliability> reliability;
};

PilotEnsemble run_pilot_ensemble(const TilePlan& tile, const EnsemblePlan& ensemble);

// True if the healthy sample is large enough for thresholds.
bool has_rates(const PilotEnsemble& pilot);

struct DetectionChange {
    long gearboxes = 0;   // test gearboxes
    double alarms = 0.0;  // fraction of alarm decisions (gearbox, feature, noise level) that differ
    double pd = 0.0;      // largest change of a detection rate
    double pd_half_width = 0.0;  // of that rate's interval, in the reference
    double a90 = -1.0;           // largest relative change of an a90 that both reach; -1: none
    double a90_interval = 0.0;   // of that a90: (upper bound - a90) / a90; infinite if not reached
};
GEARPOD_FIELDS(DetectionChange, gearboxes, alarms_changed, pd_change, pd_half_width, a90_change_,
               a90_interval)
DetectionChange detection_change(const PilotEnsemble& here, const PilotEnsemble& reference);

}  // namespace gearpod::mc
