// Runs the hard cases with floating-point traps (floating_point_traps.hpp). An invalid operation, a
// division by zero or an overflow ends the test program with SIGFPE. This applies to the program's
// own code and to threads that a test starts.
#include "tests/hard/floating_point_traps.hpp"

namespace {
const gearpod::test::FloatingPointTraps kTraps;
}
