// The hard cases run with floating-point traps: an invalid operation, a division by zero or an
// overflow anywhere in the program's own code, or in threads that a test starts, ends the test
// program with SIGFPE (floating_point_traps.hpp).
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "floating_point_traps.hpp"

int main(int argc, char** argv) {
    const gearpod::test::FloatingPointTraps traps;
    return Catch::Session().run(argc, argv);
}
