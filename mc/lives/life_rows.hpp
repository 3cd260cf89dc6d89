// Lives as rows of a results file: what is computed, stored and exchanged of a gearbox.
#pragma once

#include "mc/ensemble/results_check.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// The threshold group are the healthy lives: ensemble.threshold_instances that set the thresholds,
// then life.healthy_lives that count false alarms. In the graded group cracks grow.
BatchPlan lives_plan(const Study& study);

// What the results say besides their rows, of kind kLivesKind. Columns are empty.
Results lives_frame(const Study& study);

// Throws std::runtime_error as check_results() does.
void check_lives(const std::string& path, const Results& frame, const RowSource& rows);

// Whether a gearbox is among those that interpolation is looked at.
bool looked_at(const GearboxId& id);

// `parameters`: Sampler::row(). Appends a row.
void add_life(const Study& study, const std::vector<double>& parameters, const GearboxLife& life,
              const InterpolationErrors& errors, BatchRows& rows);

// The life in a row of such a frame.
struct LifeRow {
    GearboxLife life;
    InterpolationErrors interpolation;
};
LifeRow life_of_row(const Study& study, const Results& frame, const RowBlock& block,
                    std::size_t row);

}  // namespace gearpod::mc
