// What a rung does to detection rates: the same ensemble, computed in two ways.
#pragma once

#include <optional>
#include <vector>

#include "analysis/reliability.hpp"
#include "mc/results/results_file.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// An ensemble's rows and what follows from them.
struct PilotEnsemble {
    Results results;
    std::optional<analysis::Reliability> reliability;
};

// The study with at most `gearboxes` in all, shared out as the study does.
Study pilot_ensemble_study(const Study& study, long gearboxes);
PilotEnsemble run_pilot_ensemble(const Study& study);

// Whether its healthy sample is large enough for thresholds.
bool has_rates(const PilotEnsemble& pilot);

struct DetectionChange {
    long gearboxes = 0;          // graded
    double alarms = 0.0;         // share of verdicts (gearbox, feature, noise level) that differ
    double pd = 0.0;             // largest change of a detection rate
    double pd_half_width = 0.0;  // of that rate's interval, in the reference
    double a90 = -1.0;          // largest change of an a90 that both reach, as a share; -1: none is
    double a90_interval = 0.0;  // of that a90: upper bound less estimate, as a share; infinite if
                                // not reached
};
DetectionChange detection_change(const PilotEnsemble& here, const PilotEnsemble& reference);

}  // namespace gearpod::mc
