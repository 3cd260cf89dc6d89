// Checks that failures in the child process that reads a file do not affect the program.
#include <sys/wait.h>

#include <cerrno>
#include <csignal>

#include "mc/files/isolated_reading.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_isolated_reading {

using namespace test;

TEST_CASE("A reader that crashes, or requests all memory, does not survive") {
    const Folder folder;
    const std::string file = folder.file("x.h5");
    write_bytes(file, "something");
    CHECK(mc::survives_reading(file, [] {}));
    CHECK(mc::survives_reading(file, [] { throw std::runtime_error("te cannot be read"); }));
    CHECK_FALSE(mc::survives_reading(file, [] { std::raise(SIGSEGV); }));
    CHECK_FALSE(mc::survives_reading(file, [] { std::abort(); }));
#ifndef __SANITIZE_ADDRESS__  // which ends a program that requests so much
    const auto large = [] { std::vector<char>(std::size_t{300} << 20, 'x').back() = 'y'; };
    CHECK_FALSE(mc::survives_reading(file, large));
    CHECK(mc::survives_reading(file, large, std::size_t{30} << 20));
#endif
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
    CHECK(errno == ECHILD);
}

}  // namespace gearpod::test_isolated_reading
