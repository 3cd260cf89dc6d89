// Entry points of the program's commands, with the options of each. A command returns its exit code
// (mc/run/run_options.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/library/inspection_table.hpp"
#include "mc/new_study/planetary_datasheet.hpp"
#include "mc/new_study/rexs_choices.hpp"
#include "mc/recordings/recording_baselines.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

class Ranks;

struct NewOptions {
    std::string kind;     // gearbox kind; empty for a stage of a REXS model
    std::string command;  // command line, quoted in the study's first comment
    PlanetaryDatasheet planetary;
    std::string rexs;  // model file; empty: the datasheet's values are options
    RexsChoices rexs_choices;
    std::string out = "-";  // "-": standard output
    bool force = false;     // overwrite a file
};
int new_command(const NewOptions& options);

struct SweepOptions {
    StudyOptions study;
    bool lives = false;             // true: run `lives` at every point; false: `run`
    std::vector<std::string> vary;  // "section.key=[a, b, c]"
    std::string out;                // results folder; "": the study's name with -sweep
    std::string json, html;         // "": none; JSON "-": standard output
    bool force = false;             // overwrite the results of a different run
    bool quiet = false;
};
int sweep_command(const SweepOptions& options);

struct MergeOptions {
    std::vector<std::string> results;  // results files of the parts of one study
    std::string out;
    bool force = false;  // overwrite the results of a different run
    bool quiet = false;
};
int merge_command(const MergeOptions& options);

struct ReportOptions {
    std::string results;
    std::string json;       // "": none; "-": standard output
    std::string html, pdf;  // "": none
    std::string csv;        // folder for every table; "": none
    std::string figures;    // folder for the page's figures as SVG and PNG; "": none
    std::string evidence;   // folder for the evidence pack; "": none
    std::string dataset;    // folder for the dataset; "": none
    std::string condition;  // random input; each of its values gets its own threshold; "": none
    // Cost of a false alarm, cost of a missed fault, share of records with a fault: all or none.
    std::optional<double> alarm_cost, miss_cost, fault_share;
    bool shows_withheld = false;  // of lives with too large an interpolation error
    bool force = false;           // replaces outputs of another kind
};
int report_command(const ReportOptions& options);

struct RepairOptions {
    std::string results;
};
// Renews the integrity hash of a results file after reading it completely.
int repair_command(const RepairOptions& options);

struct MissesOptions {
    std::string results;
    std::string feature;
    double size = 0.0;                  // fault size in the unit of the study's key
    std::optional<double> noise_level;  // empty: reference_level()
    long gearboxes = 200;
    int records = 64;  // per gearbox, most of them with exponentially tilted noise
    std::string json;  // "": none; "-": standard output instead of the text
    bool quiet = false;
    bool force = false;  // replaces outputs of another kind
};
int misses_command(const MissesOptions& options);

struct RareOptions {
    std::string results;
    std::string feature;
    std::optional<double> rate;         // false-alarm rate; find its threshold
    std::optional<double> size;         // or fault size in its unit; find its miss rate
    std::optional<double> noise_level;  // empty: reference_level()
    long gearboxes = 1000;              // per level
    std::string json;                   // "": none; "-": standard output instead of the text
    bool quiet = false;
    bool force = false;  // replaces outputs of another kind
};
int rare_command(const RareOptions& options);

struct CompareOptions {
    std::vector<std::string> results;  // the others are compared with the first
    std::string json, html;            // "": none; JSON "-": standard output
    bool force = false;                // replaces outputs of another kind
};
int compare_command(const CompareOptions& options);

struct DescribeOptions {
    StudyOptions study;
    bool keys = false;  // print the keys of study files instead
    int ranks = 0;      // also forecast a run with this many MPI ranks; 0: do not
    // Processor seconds of each thread for the forecast; then it falls back on step counts.
    double seconds = 10.0;
};
int describe_command(const DescribeOptions& options);

struct LivesOptions {
    RunOptions run;          // without watch, signals and part
    std::string json, html;  // "": none; JSON "-": standard output
    bool shows_withheld = false;
};
int lives_command(const LivesOptions& options);
// Runs `lives` on the given MPI ranks. Every rank must call it.
int lives_study(const LivesOptions& options, const Ranks& ranks);
// Reports a results file written by `lives`. `report` calls it for such a file.
int report_lives(const ReportOptions& options);

struct StiffnessOptions {
    StudyOptions study;
    std::string csv;  // "": a summary; "-": standard output
    int points = 1000;
    bool te = false;     // loaded static transmission error instead of the stiffness
    bool force = false;  // replaces outputs of another kind
};
int stiffness_command(const StiffnessOptions& options);

struct ModesOptions {
    StudyOptions study;
    std::string json;
    std::string html, figures;  // page and folder of its figures; "": none
    bool force = false;  // replaces outputs of another kind
};
int modes_command(const ModesOptions& options);

struct AccuracyOptions {
    StudyOptions study;
    std::string json;               // "": none; "-": standard output instead of the table
    std::string html, figures;      // page and folder of its figures; "": none
    std::string peers;              // table of other programs' results, "": none
    int repeats = 3;                // timings of each solver setting
    std::optional<long> gearboxes;  // size of the pilot ensemble; 0: no detection rates
    double seconds = 300.0;         // limit of processor time; 0: none
    bool force = false;             // replaces outputs of another kind
    bool quiet = false;
};
int accuracy_command(const AccuracyOptions& options);

struct SimulateOptions {
    StudyOptions study;
    long instance = 0;   // row of the results file
    long meshes = 0;     // 0: one planet turn
    std::string out;     // .h5 or .csv
    bool force = false;  // replaces outputs of another kind
};
int simulate_command(const SimulateOptions& options);

struct FeaturesOptions {
    StudyOptions study;
    std::vector<std::string> signals;  // files, or glob patterns
    std::string manifest;              // table of recordings, instead of signals
    SignalColumns columns;
    std::vector<std::string> healthy;  // recordings of healthy gearboxes
    std::string baseline;              // earlier recording of the same gearbox, "": none
    // Baselines of many recordings; average 0: monitoring.average_records.
    BaselineOptions baselines{0, {}, false, 0};
    double noise_level = 1.0;  // of simulated healthy gearboxes, used without `healthy`
    std::string json;          // "": none; "-": standard output
    std::string out, csv;      // results file and table, for many recordings
    std::string against;       // results file of healthy gearboxes to compare with
    std::string feature;       // decides the alarm; "": the best ranked one in `against`
    bool force = false;        // replaces outputs of another kind
    bool quiet = false;
};
// Prints the features of one recording. For many recordings it calls recordings_command().
int features_command(const FeaturesOptions& options);
// Writes the features of many recordings to a results file and a table.
int recordings_command(const FeaturesOptions& options);

struct CalibrateOptions {
    StudyOptions study;
    std::vector<std::string> healthy;  // files, or glob patterns
    std::string manifest;              // table of recordings, instead of `healthy`
    std::string features;              // table of features, instead of `healthy`
    SignalColumns columns;
    std::vector<std::string> priors;   // KEY=LOW:HIGH[:log]; empty: the default priors
    std::vector<std::string> feature;  // features to compare; empty: all
    long sets = 200;                   // parameter sets integrated in each round
    std::string out, json;
    bool force = false;  // replaces outputs of another kind
    bool quiet = false;
};
int calibrate_command(const CalibrateOptions& options);

struct PodOptions : InspectionOptions {
    std::string table;
    std::string json, html;  // "": none; JSON "-": standard output
    std::string evidence;    // folder for the evidence pack; "": none
    bool force = false;      // replaces outputs of another kind
};
int pod_command(const PodOptions& options);

}  // namespace gearpod::mc
