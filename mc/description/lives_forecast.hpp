// What `lives` of a study takes: time, memory and the size of its file, before any gearbox is
// marched.
#pragma once

#include <string>

#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// On this machine, in one process. Marches by the time of a mesh period and how many the damping
// asks for (mesh_time.hpp); records by those of a gearbox whose signals are made up.
struct LivesForecast {
    int threads = 0;
    double gearbox_s = 0.0;  // of processor time: marches, a mean over all gearboxes
    double record_s = 0.0;   // and records
    long gearboxes = 0, records = 0;
    double marches_s = 0.0;  // wall clock until the last thread has its last batch
    double setup_s = 0.0;
    double memory_bytes = 0.0;  // of all threads' tiles, and what the process has already
    double file_bytes = 0.0;    // of the results; a checkpoint beside them as much until the end

    double total_s() const { return setup_s + marches_s; }
};

LivesForecast forecast_lives(const LifeTiles& tiles, int threads, double setup_s);

// Its section of `describe`.
void print_lives_forecast(const LifeTiles& tiles, double setup_s);

}  // namespace gearpod::mc
