// Starts Python: for pages, models and recordings of other programs, and for the users' features.
#pragma once

#include <sys/types.h>

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

}  // namespace gearpod::mc
