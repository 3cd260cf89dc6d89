// Command-line options of a run, and exit codes of the program: 0 done, 2 bad input, 3 some
// gearboxes failed, 4 stopped early with a checkpoint to resume from.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

inline constexpr int kDone = 0;
inline constexpr int kBadInput = 2;
inline constexpr int kSomeFailed = 3;
inline constexpr int kResumable = 4;

// Study file and overrides from the command line.
struct StudyOptions {
    std::string path;
    std::vector<std::string> overrides;  // "section.key=value"
};

struct RunOptions {
    StudyOptions study;
    std::string out;  // "": the study's name with .h5, in the working directory
    bool resume = false;
    bool force = false;         // overwrite results of another study
    std::string time_limit;     // "hh:mm:ss"; "": none
    std::vector<long> signals;  // rows whose signals are added to the results
    std::string part;           // "2/4": every fourth batch, starting with the second; "": all
    std::string progress;       // "json": one object per line; "": text
    bool quiet = false;
    bool prints_results = true;  // prints the results at the end
    bool merges = false;         // all batches come from parts; without a checkpoint to resume from
};
int run_command(const RunOptions& options);

}  // namespace gearpod::mc
