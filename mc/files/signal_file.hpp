// Recorded signals in a file: named columns of one length, CSV, HDF5 or MAT.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearpod::mc {

// What is wrong with a signal file; names file and place.
class SignalError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class SignalFile {
  public:
    virtual ~SignalFile() = default;

    // Names of the columns.
    virtual std::vector<std::string> names() const = 0;
    // A column of that name, which must be there. Throws SignalError.
    virtual std::vector<double> read(const std::string& name) = 0;
    // The unit of a column, if the file says so; else "".
    virtual std::string unit(const std::string&) { return ""; }
    // The sampling rate, if the file says so.
    virtual std::optional<double> sampling_Hz() { return std::nullopt; }

    bool has(const std::string& name) const;
};

// Opens a file by the end of its name; those that a library reads (HDF5, MAT) in a process of
// their own (isolated_signal.hpp). Throws SignalError.
//   .csv         a header line of names with their units in brackets ("sensor [m/s^2]"), then a
//   line
//                of numbers a sample; commas, semicolons or tabs between them, decimal commas where
//                none stand between; lines that begin with # are comments
//   .h5, .hdf5   datasets of one dimension in the group /signals, else in the root, or a row of
//   those
//                of two; the rate may be an attribute sampling_Hz of the group or the root; an
//                attribute scale of a dataset is a factor on its values, unit their unit; what
//                lies in other files (links, external and virtual storage) is refused
//   .mat         variables that are real vectors (MATLAB 4 to 7.3), and fields of structs that are,
//                as "s.sensor"; the rate may be a variable or field sampling_Hz; tables are refused
//   .wav         the column sensor, or channel1, channel2, ...; whole numbers as a share of the full
//                scale
//   .uff, .unv   dataset 58, real and even in time: the column sensor, or function1, function2, ...
// `row`, from 0: the record of an HDF5 file whose datasets hold one in each row.
std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row = std::nullopt);

// One for each kind of file, here.
std::unique_ptr<SignalFile> open_signal_csv(const std::string& path);
std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path,
                                             std::optional<std::size_t> row);
std::unique_ptr<SignalFile> open_signal_mat(const std::string& path);
std::unique_ptr<SignalFile> open_signal_wav(const std::string& path);
std::unique_ptr<SignalFile> open_signal_uff(const std::string& path);

}  // namespace gearpod::mc
