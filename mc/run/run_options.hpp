// What a run is asked for on the command line, and the program's exit codes: 0 done, 2 bad input,
// 3 some gearboxes failed, 4 stopped before its end with a checkpoint to resume from.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

inline constexpr int kDone = 0;
inline constexpr int kBadInput = 2;
inline constexpr int kSomeFailed = 3;
inline constexpr int kResumable = 4;

// A study file and what the command line changes in it.
struct StudyOptions {
    std::string path;
    std::vector<std::string> overrides;  // "section.key=value"
};

struct RunOptions {
    StudyOptions study;
    std::string out;  // "": the study's name with .h5, in the working folder
    bool resume = false;
    bool force = false;         // overwrite what a run with other numbers has written
    std::string time_limit;     // "hh:mm:ss", "": none
    std::string watch;          // feature whose Pd the progress shows, "": the study's first
    std::vector<long> signals;  // rows whose signals the results hold as well
    std::string part;           // "2/4": every fourth tile, the second; "": all
    std::string progress;       // "json": one object a line; "": for people
    bool quiet = false;
    bool says_results = true;  // at the end, on the terminal
};
int run_command(const RunOptions& options);

}  // namespace gearpod::mc
