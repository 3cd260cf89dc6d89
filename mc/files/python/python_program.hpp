// Runs a Python program to its end, such as the one that makes pages.
#pragma once

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

struct PythonOutput {
    int code = 0;      // exit code, or 128 plus the number of the signal that ended the process
    std::string text;  // standard output
};

// Runs the interpreter with these arguments and standard input. The program prints its own errors
// to standard error. Throws PythonError if it cannot be started.
PythonOutput run_python(const std::vector<std::string>& arguments, const std::string& input);

}  // namespace gearpod::mc
