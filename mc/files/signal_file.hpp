// Columns of signal files, and their search: by path or by the last part of a path. Statements of
// the sampling rate under their usual names.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mc/files/foreign_file.hpp"

namespace gearpod::mc {

// Signal with a name and one value per sample.
struct SignalColumn {
    std::string name;
    std::string unit;  // may be empty
    std::vector<double> values;
};

// Recorded signals in a file: named columns of equal length.

// Choice of a column by its name.
struct ColumnChoice {
    std::string name;
    std::string near = {};  // full name of the column that it belongs to; "": none
    bool requested = true;  // false for a default name; then a column that is unusable is skipped
};

class SignalFile {
  public:
    virtual ~SignalFile() = default;

    // Full names of the columns.
    virtual std::vector<std::string> names() const = 0;
    // Values of a column, which must exist. Throws SignalError.
    virtual std::vector<double> read(const std::string& name) = 0;
    // Unit of a column if the file states it, else "".
    virtual std::string unit(const std::string&) { return ""; }
    // Sampling rate of one column, which has been read, or "" of the whole file, if the file states
    // it. Throws SignalError if statements contradict each other.
    virtual std::optional<double> sampling_Hz_of(const std::string&) { return std::nullopt; }
    std::optional<double> sampling_Hz() { return sampling_Hz_of(""); }
    // Full name of the chosen column, "" if there is none. In a file with groups the name may be a
    // path, or the last part of one, which is looked for in the group of `near`, then in the groups
    // around it. Throws SignalError if a requested choice is ambiguous or not a column of numbers.
    virtual std::string find(const ColumnChoice& choice);
    // List of the columns for messages, at most twenty.
    virtual std::string contents();
    // Statements of the file that are not used, and choices that were made, in reading so far.
    virtual std::vector<std::string> notes() { return {}; }

    bool has(const std::string& name) const;
};

// The first twenty of the texts, "a, b, c and 5 more"; "none" if there are none.
std::string listed_text(const std::vector<std::string>& texts);

// Opens a file according to its first bytes, or to the extension of its name. Throws SignalError.
//   .csv, .txt   A header line with names and units in brackets ("sensor [m/s^2]"), then a line
//                of numbers per sample (text_table.hpp). Columns that are not read may contain
//                anything. Python converts other forms, also compressed ones (.csv.gz, .txt.gz).
//   .h5, .hdf5   Vectors of numbers, also N x 1, in any group, named by their paths; those in the
//                group /signals by their names. "data:2" is the second column of a matrix; with
//                `row`, rows of two-dimensional datasets. Attributes state the unit (unit, units,
//                ...), the scale (scale, scale_factor, add_offset, ...) and the sampling rate (fs,
//                sampling_rate, dt, wf_increment, ...). Data in other files (links, external and
//                virtual storage) are rejected.
//   .mat         Real vectors and matrix columns (MATLAB 4 to 7.3), also in structs ("s.sensor")
//                and cells ("c{1}"). The last variable of a name counts. The sampling rate may be a
//                variable or field with a usual name. Tables are rejected.
//   .wav, .rf64, .w64, .flac, .aiff, .au, .caf
//                The column sensor, or channel1, channel2, ...; integers are fractions of the
//                full scale. Lossy compression is rejected.
//   .tdms        Numeric channels as "group/channel", also found as "channel" if that is
//                unique. Timestamps are seconds from the first one. Linear and polynomial scales
//                are applied.
//   .uff, .unv   Real time histories of dataset 58: the column sensor, or function1,
//                function2, ..., also under unique titles; uneven ones have the column time.
// Python reads the last four (foreign_file.hpp). Other formats are rejected with ways to convert
// them.
// `row`, from 0: index of the record in an HDF5 file that has one record per row.
std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row = std::nullopt);

// Recording in a file or in memory.
struct SignalSource {
    std::string name;  // path of the file; of a recording in memory the name for messages
    // Columns of a recording in memory, each once; null: a file.
    std::shared_ptr<const std::vector<SignalColumn>> columns = nullptr;

    SignalSource() = default;
    SignalSource(std::string path) : name(std::move(path)) {}  // implicit, like a path
    SignalSource(std::string message_name, std::vector<SignalColumn> in_memory);

    bool empty() const { return name.empty(); }
    // Opens the file (open_signal_file) or gives the columns. Throws SignalError.
    std::unique_ptr<SignalFile> open(std::optional<std::size_t> row) const;
};

// Readers for the kinds of file.
std::unique_ptr<SignalFile> open_signal_csv(const std::string& path);
std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path,
                                             std::optional<std::size_t> row);
// `reader`: that of PythonOutputFile (foreign_file.hpp).
std::unique_ptr<SignalFile> open_signal_foreign(const std::string& path, const std::string& reader);

// The path without its last part, "" for a name at the top. Names have no separator at their start.
std::string group_of(const std::string& name, char separator);
// The last part of a path.
std::string leaf_of(const std::string& name, char separator);

// Full names that the choice fits: the name itself; else that name in the group of `near` or the
// nearest group around it; else, unless a default name belongs to another column, all names that
// end with it. A default name is first looked for next to `near`.
std::vector<std::string> matching_columns(const std::vector<std::string>& all,
                                          const ColumnChoice& choice, char separator);

// "data:2" is the second column of the matrix "data".
struct MatrixColumn {
    std::string matrix;
    std::size_t column = 0;  // from 1
};
std::optional<MatrixColumn> matrix_column(const std::string& name);

// File with columns in groups, and columns of matrices.
class NamedColumns : public SignalFile {
  public:
    std::string find(const ColumnChoice& choice) override;
    std::vector<std::string> notes() override { return notes_; }

  protected:
    // `full_name`: the word for a full name in messages, "path".
    NamedColumns(const std::string& path, const char* full_name)
        : path_(path), full_name_(full_name) {}
    // Columns of any kind that the choice fits (matching_columns).
    virtual std::vector<std::string> matching(const ColumnChoice& choice) const = 0;
    // Reason, for messages, why a column cannot be read as a signal; "" if it can.
    virtual std::string problem_of(const std::string& name) const = 0;
    // Adds a note unless there is an equal one.
    void add_note(const std::string& text);

    const std::string path_;

  private:
    const char* full_name_;
    std::vector<std::string> notes_;
};

// "5120 x 2"
std::string shape_text(const std::vector<unsigned long long>& shape);

// Form of an array for a signal: the dimension of time, and the number of columns. Dimensions of
// size 1 do not count; of two others, the longer one is time. Empty if there is no such form.
struct SignalForm {
    std::size_t time = 0;                // index of the dimension
    std::optional<std::size_t> columns;  // index of the other dimension, if it is a matrix
};
std::optional<SignalForm> signal_form(const std::vector<unsigned long long>& shape);

// Name and value of a statement, for example an attribute.
struct NumberStatement {
    std::string name;
    double value = 0.0;
};
// Letters and digits of a name in lower case: "sampling_rate" and "SamplingRate" are equal.
std::string plain_name(std::string_view name);
// Sampling rate, Hz, if the name is a usual one of a sampling rate or interval: fs, sampling_rate,
// dt, wf_increment, also with a unit (sampling_rate_kHz).
std::optional<double> stated_rate_Hz(const NumberStatement& statement);
// The rate on which the statements agree to 0.1 %; those of a rate count before those of an
// interval. Throws SignalError, with `where` in its text, if they differ or are not above zero.
std::optional<double> agreed_rate_Hz(const std::vector<NumberStatement>& statements,
                                     const std::string& where);

}  // namespace gearpod::mc
