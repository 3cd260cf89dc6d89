// Checks that failures in the child process that reads a file do not affect the program.
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>

#include "mc/files/child_process.hpp"
#include "tests/mc/files/recorded.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/recording_bytes.hpp"

namespace gearpod::test_isolated_reading {

using namespace test;

TEST_CASE("A reader that crashes, or requests all memory, does not survive") {
    const auto [folder, file] = TemporaryFile("x.h5");
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

// Checks the process that reads recordings of other programs, and the ends of it. The recordings of
// tests/recordings check what is read, and tests/python/test_signal_files.py every value.

using Catch::Contains;
using Values = std::vector<double>;

TEST_CASE("The end of the Python process is reported, and no process or file remains") {
    const Folder folder;
    const Values values{0.1, -2.0, 1e-300};
    const std::string file = file_with(folder, "a.mat", mat_bytes({{"sensor", values}}, false));
    const auto error_with = [&](const std::string& script, const std::string& path) {
        const std::string python = file_with(folder, "python", "#!/bin/sh\n" + script + "\n");
        chmod(python.c_str(), 0755);
        setenv("GEARPOD_PYTHON", script.empty() ? "/none" : python.c_str(), 1);
        const std::string error = reading_error(path);
        unsetenv("GEARPOD_PYTHON");
        return error;
    };
    setenv("TMPDIR", folder.file("temporary").c_str(), 1);
    std::filesystem::create_directory(folder.file("temporary"));
    CHECK_THAT(error_with("", file),
               Contains("/none cannot be started") && Contains("GEARPOD_PYTHON"));
    CHECK_THAT(error_with("kill -SEGV $$", file),
               Contains("a.mat: is damaged: reading it was ended by"));
    CHECK_THAT(error_with("exit 1", file), Contains("ended with exit code 1"));
    CHECK_THAT(error_with("printf ': is made up'; exit 3", file), Contains("a.mat: is made up"));
    CHECK_THAT(error_with("exit 0", file), Contains("what Python has read cannot be taken over"));
    CHECK_THAT(error_with("exec /usr/bin/python3 -S \"$@\"", file_with(folder, "a.wav", "RIFF")),
               Contains("needs the Python packages numpy, h5py, soundfile") &&
                   Contains("apt-get install python3-numpy"));
    CHECK(mc::open_signal_file(file)->read("sensor") == values);
    CHECK(std::filesystem::is_empty(folder.file("temporary")));
    unsetenv("TMPDIR");
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

}  // namespace gearpod::test_isolated_reading
