// Options of `report`.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/library/run/run_options.hpp"

namespace gearpod::mc {

struct ReportOptions {
    std::string results;
    std::string json;       // "": none; "-": standard output
    std::string html, pdf;  // "": none
    std::string csv;        // folder for every table; "": none
    std::string figures;    // folder for the page's figures as SVG, PNG and PDF; "": none
    std::string evidence;   // folder for the evidence pack; "": none
    std::vector<std::string> sections;  // to print; empty: the screen, or everything if `full`
    bool full = false;
    std::string condition;  // random input; each of its values gets its own threshold; "": none
    bool shows_withheld = false;  // of lives with too large an interpolation error
    bool force = false;           // replaces outputs of another kind
};

// Runs and reports lives of gearboxes, for `lives` itself and for the commands that call it.

class Ranks;

struct LivesOptions {
    RunOptions run;          // without signals and part
    std::string json, html;  // "": none; JSON "-": standard output
    bool full = false;       // prints all findings
    bool shows_withheld = false;
};

// Runs `lives` on the given MPI ranks. Every rank must call it. Returns the exit code.
int lives_study(const LivesOptions& options, const Ranks& ranks);
// Prints the screen of a report, everything or the requested sections. `part`: of a part of an
// ensemble. Returns false after printing that the report does not have a section.
bool print_report(const ReportOptions& options, const analysis::Report& report, bool part);
// Reports a results file written by `lives`. `report` calls it for such a file, and prints what it
// throws.
int report_lives(const ReportOptions& options);

}  // namespace gearpod::mc
