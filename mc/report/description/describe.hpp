// Text printed by `describe`, and its parts that compute: the effects that a study calls for,
// lives, and forecasts of time, memory and disk.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "mc/lives/life_tile.hpp"
#include "mc/numerics/forecast/forecast.hpp"
#include "mc/plan/description.hpp"
#include "mc/plan/planner.hpp"

namespace gearpod::mc {

// Prints only these from now on, without headings, and no more than a screen holds:
// "heading: name" is an entry, "heading: " a paragraph, "heading: *" all entries, and
// "heading: names" their names as one list.
void print_first_screen(std::set<std::string> shown);

void print_heading(const std::string& text);

// Prints a name and a value in two columns, with long values in several lines. Names longer than 25
// characters shift the value to the right.
void print_entry(const std::string& name, const std::string& value);

// Prints a text as indented lines.
void print_paragraph(const std::string& text);

// Prints a heading and its entries.
void print_section(const DescriptionSection& section);

// Study text for a terminal.

// Breaks lines of a study that are longer than 80 characters where TOML allows it: an inline table
// becomes dotted keys, and an array takes several lines. Strings stay whole. The meaning is the
// same.
std::string wrapped_study(std::string_view toml);

// Prints one entry for each optional effect: its computing time, and whether it changes a feature
// by more than numerics.tolerance, or 1 % without it. Uses the study's own solver setting, short
// records where every mesh period is integrated, and about `seconds` of processor time. May throw
// machine::Cancelled and SceneError. `span`, `mesh_frequency_Hz`: those of any plan of the study.
void print_effect_changes(const Planner& planner, const signals::SpanLayout& span,
                          double mesh_frequency_Hz, double seconds);

// Prints random inputs of a gearbox and of each of its records, or all reasons why `lives` refuses
// the study; nothing for a study without lives.
void print_life(const StudyLives& lives);

// Forecast of a study's `lives` for this machine and one process, before any gearbox is integrated.
// The integration time follows from the time of one mesh period and the number of mesh periods that
// the damping requires (solution_choice.hpp). The time of a record is measured with artificial
// signals.
struct LivesForecast {
    int threads = 0;
    double gearbox_s = 0.0;  // processor time to integrate a gearbox, mean over all
    double record_s = 0.0;   // processor time of a record
    long gearboxes = 0, records = 0;
    std::string crack_records;   // from the start of a crack to failure (crack_records_text)
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

// Processor time of rank 0's main thread for a batch of another rank: messages, packing and the
// checkpoint. Measured by tests/bench/bench_ranks (docs/developer/ensemble.md).
double leader_time_s(double batch_bytes);

// Disk space of the checkpoint with all batches, and of the results file.
double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape);
double results_bytes(const BatchPlan& plan, const RowShape& shape);

// Forecast for ranks that equal this process in machine, threads and memory.
struct RankForecast {
    double gearboxes_s = 0.0;       // wall-clock time to compute the gearboxes with all ranks
    double total_s = 0.0;           // including set-up and rank 0's analysis
    double busy_threads = 0.0;      // threads that have a batch to compute
    double rank_bytes = 0.0;        // memory of every rank except rank 0
    double leader_bytes = 0.0;      // memory of rank 0
    double checkpoint_bytes = 0.0;  // disk space during the run
    double results_bytes = 0.0;     // results file; twice while a new one is written
    double batches_per_s = 0.0;     // batches that rank 0 receives and writes
    double leader_share = 0.0;      // fraction of rank 0's time; at 1 it delays the others
    double bounding_ranks = 0.0;    // number of ranks from which rank 0 delays the others
};

RankForecast forecast_ranks(const RunCost& calibration, const BatchPlan& plan,
                            const RowShape& shape, const RunForecast& alone, int ranks);

// Prints the forecast of `lives`. `chooses`: chooses the integrated torques and speeds as `lives`
// does if this takes at most some seconds; otherwise states the range. `ranks`: as for
// print_forecast(). Throws SceneError if the records of a gearbox are too short.
void print_lives_forecast(const TilePlan& tile, const LifePlan& plan, double setup_s, int ranks,
                          bool chooses);

// Computes some gearboxes and their analysis, for a few seconds at most. Prints the estimated time
// and memory of a run in this process, and in `ranks` such processes unless that is 0.
// `planner`: of the study of `scene`; `setup_s`: time used to start the program and build it.
void print_forecast(const Scene& scene, const Planner& planner, double setup_s, int ranks);

// Peak memory of this process.
struct PeakMemory {
    double setup_bytes = 0.0;     // when the scene was built
    double computed_bytes = 0.0;  // while gearboxes were computed; 0 if they took no more
};

// Forecast from the numbers of gearboxes and time steps alone, where computing some gearboxes takes
// too long.
void print_step_forecast(const TilePlan& tile, const EnsemblePlan& ensemble,
                         const PeakMemory& memory);

}  // namespace gearpod::mc
