// Lives as rows of a results file.
#pragma once

#include "mc/ensemble/results_check.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// Batches of lives. The threshold group contains the healthy lives: first
// ensemble.threshold_instances that determine the thresholds, then life.healthy_lives that count
// false alarms. Cracks grow in the test group.
BatchPlan lives_plan(const Study& study);

// Results of kind kLivesKind without rows; the columns are empty.
Results lives_frame(const Study& study);

// Checks the rows. Throws std::runtime_error as check_results() does.
void check_lives(const std::string& path, const Results& frame, const RowSource& rows);

// True if the interpolation errors of a gearbox are measured.
bool measures_interpolation(const GearboxId& id);

// Appends the row of a gearbox's life.
void add_life(const Study& study, const Realization& gearbox, const GearboxLife& life,
              const InterpolationErrors& errors, BatchRows& rows);

// Life in a row of such a frame.
struct LifeRow {
    GearboxLife life;
    InterpolationErrors interpolation;
};
LifeRow life_of_row(const Study& study, const Results& frame, const ResultRow& row);

}  // namespace gearpod::mc
