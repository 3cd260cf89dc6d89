// Golden curves: output of the built program for a study, kept as a table under curves/, so that a
// change of any curve is detected. The README of tests/ has the commands.
#pragma once

#include <string>
#include <vector>

namespace gearpod::golden {

// Columns of equal length with their names.
struct Curves {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
};

// Source of the numbers among the program's outputs.
enum class Source {
    csv,     // standard output, as CSV with a header
    json,    // standard output, arrays of a JSON object
    results  // datasets of the HDF5 file that --out names (added to the command)
};

struct Golden {
    std::string name;     // name of curves/<name>.h5
    std::string command;  // arguments of gearpod, from the project's top folder
    Source source = Source::csv;
    // Columns, JSON keys or dataset paths to keep; all columns of a CSV if empty. A dataset's
    // values are stored row by row.
    std::vector<std::string> columns;
    int stride = 1;  // keeps one in so many values
    // Allowed difference as a fraction of the column's spread (largest minus smallest value).
    double tolerance = 0;
};

// The table of golden curves (table.cpp).
const std::vector<Golden>& goldens();

// Runs the program. Throws std::runtime_error if it fails or a column is missing.
Curves compute(const Golden& golden);

std::string curves_path(const Golden& golden);
// Reads the kept curves. Throws std::runtime_error if the file is missing or damaged.
Curves read_curves(const Golden& golden);
void write_curves(const Golden& golden, const Curves& curves);

// Differences above the tolerance, one line per column; empty if there are none. NaN equals only
// NaN.
std::string differences(const Curves& kept, const Curves& now, double tolerance);

}  // namespace gearpod::golden
