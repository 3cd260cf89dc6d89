// Top-level error handling of the program.
#pragma once

namespace gearpod::mc {

// Calls `program` with the arguments and returns main()'s exit code. Prints to stderr what
// `program` throws, and reports a processor that lacks the required instruction set, or output that
// cannot be written.
int run_safely(int argc, char** argv, int (*program)(int argc, char** argv));

}  // namespace gearpod::mc
