// Attributes of HDF5 objects that any program may have written.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mc/files/column_search.hpp"
#include "mc/files/hdf5_data.hpp"

namespace gearpod::mc {

struct Hdf5Attribute {
    std::string name;
    // Either texts, of fixed or variable length, or numbers; one for a scalar. Both are empty for
    // other types.
    std::vector<std::string> texts;
    std::vector<double> numbers;

    // The only number, also if it is written as text.
    std::optional<double> number() const;
};

// Attributes of an open object, at most a thousand values each. Throws Hdf5Error.
std::vector<Hdf5Attribute> attributes_of(hid_t object);

// Reason why a file cannot be opened as HDF5: it was not closed, is truncated, or is another kind
// of file, which is named. Empty if none is found.
std::string hdf5_open_problem(const std::string& path);

// Datasets of an HDF5 file of any structure, and the signals among them.

// Index of the datasets in all groups. Links are followed within the file only; nothing in other
// files is ever opened. Names are paths without a slash at their start; those in the group
// /signals, if it exists, also omit "signals/". Functions throw Hdf5Error if the file is damaged.
class Hdf5Index {
  public:
    // `rows`: signals are the rows of two-dimensional datasets.
    Hdf5Index(const std::string& path, bool rows);

    // Names of the datasets that are signals: vectors of numbers, also N x 1; or the datasets of
    // two dimensions with `rows`.
    std::vector<std::string> signals() const;
    // Number of vectors of more than one value directly in a group.
    std::size_t signals_in(const std::string& group) const;
    // Datasets of one number directly in a group.
    std::vector<std::pair<std::string, double>> scalars_in(const std::string& group) const;
    // The first twenty datasets with shapes.
    std::string contents() const;
    // Datasets of any kind that the choice fits (column_search.hpp).
    std::vector<std::string> matching(const ColumnChoice& choice) const;
    // Reason why a dataset, or "data:2" of a matrix, cannot be read as a signal; "" if it can.
    std::string problem_of(const std::string& name) const;
    // Number of columns of a matrix; 0 if it is none.
    std::size_t columns_of(const std::string& matrix) const;

    // Values of a signal, of a matrix column, or of a row. Throws SignalError if the row does not
    // exist.
    std::vector<double> read(const std::string& name, std::optional<std::size_t> row,
                             std::size_t most_values) const;
    std::vector<Hdf5Attribute> attributes(const std::string& name) const;
    std::vector<Hdf5Attribute> group_attributes(const std::string& group) const;
    std::vector<Hdf5Attribute> root_attributes() const;

  private:
    enum class Content { numbers, text, compound, other, elsewhere };
    struct Dataset {
        std::string path;
        std::optional<Content> content = {};  // empty until it is inspected
        Shape shape = {};
    };

    const Dataset& inspected(const std::string& name) const;
    bool is_signal(const Dataset& dataset) const;
    std::string text_of(const std::string& name) const;
    std::string shown_name(const std::string& path) const;

    std::string path_;
    bool rows_;
    Hdf5Handle file_;
    std::string base_;  // "signals/" or ""
    std::set<std::string> groups_;
    std::vector<std::string> names_;
    mutable std::map<std::string, Dataset> datasets_;  // by name
};

}  // namespace gearpod::mc
