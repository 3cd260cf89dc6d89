// The program's commands. Each returns the exit code (mc/run/run_options.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/gearbox/measured_signal.hpp"
#include "mc/new_study/planetary_datasheet.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

class Ranks;

struct NewOptions {
    std::string kind;     // of gearbox
    std::string command;  // how it was called, for the study's first comment
    PlanetaryDatasheet planetary;
    std::string out = "-";  // "-": standard output
    bool force = false;     // overwrite a file
};
int new_command(const NewOptions& options);

struct SweepOptions {
    StudyOptions study;
    bool lives = false;             // points are `lives`, else `run`
    std::vector<std::string> vary;  // "section.key=[a, b, c]"
    std::string out;                // folder of the results; "": the study's name with -sweep
    std::string json, html;         // "": none; JSON "-": standard output
    bool force = false;             // overwrite what a run with other numbers has written
    bool quiet = false;
};
int sweep_command(const SweepOptions& options);

struct MergeOptions {
    std::vector<std::string> results;  // of the parts of a study
    std::string out;
    bool force = false;  // overwrite what a run with other numbers has written
    bool quiet = false;
};
int merge_command(const MergeOptions& options);

struct ReportOptions {
    std::string results;
    std::string json;       // "": none; "-": standard output
    std::string html, pdf;  // "": none
    std::string csv;        // folder for every table; "": none
    std::string figures;    // folder for the page's figures as SVG and PNG; "": none
    std::string condition;  // random input whose values get thresholds of their own; "": none
    // Of a false alarm and of a missed fault, and the share of records with a fault; all or none.
    std::optional<double> alarm_cost, miss_cost, fault_share;
};
int report_command(const ReportOptions& options);

struct MissesOptions {
    std::string results;
    std::string feature;
    double size = 0.0;                  // of the fault, in its unit
    std::optional<double> noise_level;  // empty: the one that reports show first
    long gearboxes = 200;
    int records = 64;  // of each, most with tilted noise
    std::string json;  // "": none; "-": standard output instead of the text
    bool quiet = false;
};
int misses_command(const MissesOptions& options);

struct RareOptions {
    std::string results;
    std::string feature;
    std::optional<double> rate;         // of false alarms whose threshold is asked for
    std::optional<double> size;         // or of a fault whose misses are, in its unit
    std::optional<double> noise_level;  // empty: the one that reports show first
    long gearboxes = 1000;              // of a level
    std::string json;                   // "": none; "-": standard output instead of the text
    bool quiet = false;
};
int rare_command(const RareOptions& options);

struct CompareOptions {
    std::vector<std::string> results;  // the first is what the others are held against
    std::string json, html;            // "": none; JSON "-": standard output
};
int compare_command(const CompareOptions& options);

struct DescribeOptions {
    StudyOptions study;
    bool keys = false;  // print all keys of study files instead
    int ranks = 0;      // also forecast a run of so many; 0: not
};
int describe_command(const DescribeOptions& options);

struct LivesOptions {
    RunOptions run;          // without watch, signals and part
    std::string json, html;  // "": none; JSON "-": standard output
};
int lives_command(const LivesOptions& options);
// The same by ranks that are there already. All of them call it.
int lives_study(const LivesOptions& options, const Ranks& ranks);
// Of the results file that it has written; `report` comes here with one.
int report_lives(const ReportOptions& options);

struct StiffnessOptions {
    StudyOptions study;
    std::string csv;  // "": a summary; "-": standard output
    int points = 1000;
    bool te = false;  // the loaded static transmission error in place of the stiffness
};
int stiffness_command(const StiffnessOptions& options);

struct ModesOptions {
    StudyOptions study;
    std::string json;
};
int modes_command(const ModesOptions& options);

struct AccuracyOptions {
    StudyOptions study;
    std::string json;               // "": none; "-": standard output instead of the table
    std::string peers;              // table of other programs' results, "": none
    int repeats = 3;                // of every rung's time
    std::optional<long> gearboxes;  // of the pilot ensemble; 0: no detection rates
    double seconds = 300.0;         // processor time; 0: as long as it takes
    bool quiet = false;
};
int accuracy_command(const AccuracyOptions& options);

struct SimulateOptions {
    StudyOptions study;
    long instance = 0;  // row of the results file
    long meshes = 0;    // 0: one planet turn
    std::string out;    // .h5 or .csv
};
int simulate_command(const SimulateOptions& options);

struct FeaturesOptions {
    StudyOptions study;
    std::vector<std::string> signals;  // files, or patterns of their names
    std::string manifest;              // table of recordings instead
    SignalColumns columns;
    std::vector<std::string> healthy;  // recordings of healthy gearboxes
    std::string baseline;              // earlier recording of the same gearbox, "": none
    double noise_level = 1.0;          // of the simulated ones, where there are no recordings
    std::string json;                  // "": none; "-": standard output
    std::string out, csv;              // of many: results file and table
    std::string against;               // results file of healthy gearboxes to compare with
    std::string feature;               // that decides; "": the best ranked there
    bool quiet = false;
};
// Of one recording what it gives, of many a results file and a table.
int features_command(const FeaturesOptions& options);
int recordings_command(const FeaturesOptions& options);

struct CalibrateOptions {
    StudyOptions study;
    std::vector<std::string> healthy;  // files, or patterns of their names
    std::string manifest;              // table of recordings instead
    std::string features;              // table of their features instead
    SignalColumns columns;
    std::vector<std::string> priors;   // KEY=LOW:HIGH[:log]; none: the usual ones
    std::vector<std::string> feature;  // those that are compared; none: all
    long draws = 200;                  // marched, in each round
    std::string out, json;
    bool quiet = false;
};
int calibrate_command(const CalibrateOptions& options);

struct PodOptions {
    std::string table;
    std::string size;                 // columns; "": by their usual names
    std::vector<std::string> hits;    // of hit/miss, several are repeats
    std::vector<std::string> values;  // of responses
    std::string specimen;
    std::vector<std::string> links;  // "": all
    std::string size_scale;          // "linear", "log", "": both
    std::string response_scale;      // the same, "box-cox" or a power
    std::string convention = "handbook", bounds;
    std::string alarm = "high";
    std::optional<double> threshold, false_call_rate, left, right, floor, target;
    double confidence = 0.95;
    bool fit_ceiling = false, firth = false;
    std::string json, html;
};
int pod_command(const PodOptions& options);

}  // namespace gearpod::mc
