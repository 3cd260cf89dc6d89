// Prints the life simulation for `describe`: random inputs of a gearbox and of each of its records.
#pragma once

#include <string>

#include "mc/lives/life_tile.hpp"
#include "mc/plan/scene_error.hpp"

namespace gearpod::mc {

// Prints nothing for a study without lives.
void print_life(const StudyLives& lives);

// Forecast of a study's `lives`: time, memory and file size, before any gearbox is integrated.

// Forecast for this machine and one process. The integration time follows from the time of one mesh
// period and the number of mesh periods that the damping requires (solution_choice.hpp). The time
// of a record is measured with artificial signals.
struct LivesForecast {
    int threads = 0;
    double gearbox_s = 0.0;  // processor time to integrate a gearbox, mean over all
    double record_s = 0.0;   // processor time of a record
    long gearboxes = 0, records = 0;
    double pilots_s = 0.0;       // choice of the integrated torques and speeds, on one thread
    double processor_s = 0.0;    // of all threads, without the set-up
    double integration_s = 0.0;  // wall-clock time until the last thread finishes its last batch
    double setup_s = 0.0;
    double memory_bytes = 0.0;  // tiles of all threads, and the memory already in use
    double file_bytes = 0.0;    // results file; the checkpoint is as large until the run ends

    double total_s() const { return setup_s + pilots_s + integration_s; }
};

// `pilot_loads`: InterpolationChoice::loads.
LivesForecast forecast_lives(const LifeTiles& tiles, int threads, double setup_s,
                             int pilot_loads = 0);

// Prints the forecast as a section of `describe`. Chooses the integrated torques and speeds as
// `lives` does if this takes at most some seconds; otherwise it states the range.
void print_lives_forecast(const TilePlan& tile, const LifePlan& plan, double setup_s);

}  // namespace gearpod::mc
