// Child processes: Python, for pages, models and recordings of other programs and for the users'
// features, and trials of a library that may crash or hang on a damaged file.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearpod::mc {

// Message for the user: a file that cannot be used, or a process that ended.
struct PythonError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Interpreter that GEARPOD_PYTHON names, by default /usr/bin/python3.
std::string python_interpreter();

// Starts the interpreter with these arguments and file descriptors. Signals act in the process as
// usual, whatever this program blocks, and the order of Python's sets is fixed. Throws PythonError
// if it cannot be started.
pid_t start_python(std::vector<std::string> arguments, int input, int output, int errors);

// Waits until the process ends. Returns the status of waitpid().
int wait_for_end(pid_t child);

// End of a process by this status, as "ended with exit code 1".
std::string ended_text(int status);

struct PythonOutput {
    int status = 0;    // of waitpid(): 0 if the program succeeded
    std::string text;  // standard output
};

// Runs the interpreter to its end with these arguments and standard input. The program prints its
// errors to standard error, unless `silent`. Throws PythonError if it cannot be started.
PythonOutput run_python(const std::vector<std::string>& arguments, const std::string& input,
                        bool silent = false);

// Calls `read`, which reads the file at `path`, in a forked child process. Returns true if it ends,
// with or without an exception. Returns false if the library crashes, takes more than 256 MB plus
// this many bytes per byte of the file, or does not end within 10 s plus one second per ten
// megabytes. True if no process can be created. Not thread-safe.
bool survives_reading(const std::string& path, const std::function<void()>& read,
                      std::uintmax_t memory_per_byte = 8);

}  // namespace gearpod::mc
