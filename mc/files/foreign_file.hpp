// Recordings of other programs, which Python reads (analysis/python/gearpod/signal_files.py).
#pragma once

#include <stdexcept>
#include <string>

namespace gearpod::mc {

// Problem with a signal file; the message names the file and the place.
class SignalError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Content of a file by its first bytes, or by the extension of its name.
enum class FileKind { text, hdf5, mat, sound, tdms, uff, unknown };
FileKind file_kind(const std::string& path);

// Message for a file of another format: formats that are read, and ways to convert others.
std::string unknown_format_text(const std::string& path);

// Temporary file that a Python process has written, deleted by the destructor. The process has
// limits of memory and time; whatever happens to it on a damaged file, the caller gets a
// SignalError.
class PythonOutputFile {
  public:
    // `reader`: "mat", "sound", "tdms" and "uff" give HDF5; "text" and "responses", for frequency
    // responses of universal files, give CSV (text_table.hpp). Throws SignalError.
    PythonOutputFile(const std::string& path, const std::string& reader);
    PythonOutputFile(const PythonOutputFile&) = delete;
    PythonOutputFile& operator=(const PythonOutputFile&) = delete;
    ~PythonOutputFile();

    const std::string& name() const { return name_; }

  private:
    explicit PythonOutputFile(const std::string& path);  // an empty file

    std::string name_;
};

}  // namespace gearpod::mc
