// Runs the hard cases with floating-point traps: an invalid operation, a division by zero or an
// overflow anywhere in the program's own code, or in threads that a test starts, ends the test
// program with SIGFPE (floating_point_traps.hpp).
#include "tests/hard/floating_point_traps.hpp"

namespace {
const gearpod::test::FloatingPointTraps kTraps;
}
