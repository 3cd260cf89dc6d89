// Recordings of other programs, which Python reads (analysis/python/gearpod/signal_files.py).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/signal_error.hpp"

namespace gearpod::mc {

// Content of a file by its first bytes, or by the extension of its name.
enum class FileKind { text, hdf5, mat, sound, tdms, uff, unknown };
FileKind file_kind(const std::string& path);

// Message for a file of another format: formats that are read, and ways to convert others.
std::string unknown_format_text(const std::string& path);

// Channel of such a recording. Empty texts are not stated.
struct ForeignChannel {
    std::string name, title;  // the title is another name
    std::string text;         // name and shape in lists of channels
    std::string unit;
    std::string quantity, unit_text;  // quantity other than an acceleration, and its unit in words
    std::string unit_by_lengths;      // unit of acceleration by the file's unit of length
    std::optional<double> lengths_per_metre, sampling_Hz, start_s;
    std::string times;       // name of the channel with the times of the samples
    std::string note;        // lines to report if the channel is used
    std::string problem;     // reason why it is not a column of numbers
    std::string unreadable;  // reason why its values cannot be read
    Shape shape;             // columns of a matrix, and samples
};

// HDF5 file that a Python process has written, deleted when it is closed. The process has limits of
// memory and time; whatever happens to it on a damaged file, the caller gets a SignalError.
class ForeignFile {
  public:
    // `reader`: "mat", "sound", "tdms", "uff", or "responses" for frequency responses of universal
    // files. Throws SignalError.
    ForeignFile(const std::string& path, const std::string& reader);

    const std::vector<ForeignChannel>& channels() const { return channels_; }
    char separator() const { return separator_; }  // between the parts of a channel's name
    const std::string& note() const { return note_; }
    // Values of a column, from 0, of a channel with this index.
    std::vector<double> values(std::size_t channel, std::size_t column = 0) const;

  private:
    std::string path_;
    std::optional<Hdf5Handle> file_;
    std::vector<ForeignChannel> channels_;
    char separator_ = '/';
    std::string note_;
};

}  // namespace gearpod::mc
