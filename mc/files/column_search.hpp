// Columns in groups: search by path or by the last part of a path, and statements of the sampling
// rate under their usual names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

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
