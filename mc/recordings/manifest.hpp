// Which recordings there are, and what is known of each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/files/text_table.hpp"
#include "mc/input/problems.hpp"

namespace gearpod::mc {

enum class Condition { unknown, healthy, faulty };

struct Recording {
    std::string file;
    std::optional<std::size_t> row;  // of a file with a record in each row
    std::string gearbox;             // "" if it is not known
    double time = 0.0;
    Condition condition = Condition::unknown;
    std::optional<double> size;  // of its fault, in SI if it is a length
    std::vector<double> inputs;  // as RecordingList::inputs

    std::string name() const;  // "file", "file row 3"
};

struct RecordingList {
    std::vector<Recording> recordings;
    std::vector<TableColumn> inputs;  // other columns of numbers: conditions
    std::optional<TableColumn> time, size;
};

// A table (text_table.hpp) with a line for each recording. Columns:
//   file      its path, seen from the manifest
//   row       from 0, of an HDF5 file whose datasets hold a record in each row
//   gearbox   its name
//   time      a number, in whatever unit
//   label     healthy or faulty; empty where it is not known
//   size      of the fault, 0 of a healthy gearbox; its unit in brackets
//   all others are conditions and must be numbers
// Problems name the line. Throws SignalError if the table itself cannot be read.
RecordingList read_manifest(const std::string& path, Problems& problems);

// Of files alone, and of what a pattern with * and ? matches.
RecordingList recordings_of(const std::vector<std::string>& files, Problems& problems);

}  // namespace gearpod::mc
