// List of recordings with their gearbox, time, condition and operating conditions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/files/input/problems.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {

enum class Condition { unknown, healthy, faulty };

struct Recording {
    std::string file;
    std::optional<std::size_t> row;  // row in a file with one record per row
    std::string gearbox;             // "": unknown
    double time = 0.0;
    Condition condition = Condition::unknown;
    std::optional<double> size;  // fault size, in SI units if it is a length
    bool in_baseline = false;    // chosen for the gearbox's baseline
    std::vector<double> inputs;  // in the order of RecordingList::inputs

    std::string name() const;  // "file", "file row 3"
};

struct RecordingList {
    std::vector<Recording> recordings;
    std::vector<TableColumn> inputs;  // other columns: operating conditions
    std::optional<TableColumn> time, size;
};

// Reads a table (text_table.hpp) with a line for each recording. Columns:
//   file      path, relative to the manifest
//   row       row from 0, in an HDF5 file whose datasets have one record per row
//   gearbox   name of the gearbox
//   time      a number, in any unit
//   label     healthy or faulty; empty: unknown
//   size      fault size, 0 for a healthy gearbox; its unit in brackets
//   baseline  yes for the recordings that form the gearbox's baseline; no or empty for others
//   others    operating conditions, must be numbers
// Problems name the line. Throws SignalError if the table cannot be read.
RecordingList read_manifest(const std::string& path, Problems& problems);

// Lists files, and the files that match glob patterns (* and ?).
RecordingList recordings_of(const std::vector<std::string>& files, Problems& problems);

}  // namespace gearpod::mc
