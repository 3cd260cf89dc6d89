// What the program does around its command line.
#pragma once

namespace gearpod::mc {

// main()'s exit code by `program`, given the same arguments: what it throws is said on stderr, and
// so is a processor that lacks the program's instruction set, or output that cannot be written.
int run_safely(int argc, char** argv, int (*program)(int argc, char** argv));

}  // namespace gearpod::mc
