// Checks that failures in the child process that reads a file do not affect the program.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "mc/files/isolated_reading.hpp"
#include "tests/mc/program.hpp"

namespace test_isolated_signal {

using namespace gearpod;
using namespace gearpod::test;

namespace {

// A file whose reader performs a given action.
class MadeUp : public mc::SignalFile {
  public:
    std::vector<std::string> names() const override { return {"sensor", "bad", "loud", "te"}; }
    std::vector<double> read(const std::string& name) override {
        if (name == "bad") {
            std::raise(SIGSEGV);
        }
        if (name == "loud") {
            return std::vector<double>(std::size_t{1} << 36, 1.0);
        }
        if (name == "te") {
            throw mc::SignalError("x.h5: te cannot be read");
        }
        return {1.0, -2.5, 1e300};
    }
    std::string unit(const std::string& name) override { return name + "/s"; }
    std::optional<double> sampling_Hz() override { return 280.0; }
};

std::unique_ptr<mc::SignalFile> made_up(const Folder& folder) {
    std::ofstream(folder.file("x.h5")) << "something";
    return mc::isolated_signal(folder.file("x.h5"), [] { return std::make_unique<MadeUp>(); });
}

TEST_CASE("Columns, units and rate are transferred unchanged") {
    const Folder folder;
    const auto file = made_up(folder);
    CHECK(file->names() == std::vector<std::string>{"sensor", "bad", "loud", "te"});
    CHECK(file->read("sensor") == std::vector<double>{1.0, -2.5, 1e300});
    CHECK(file->unit("te") == "te/s");
    CHECK(file->sampling_Hz() == 280.0);
    CHECK_THROWS_WITH(file->read("te"), "x.h5: te cannot be read");
    CHECK(file->read("sensor").size() == 3);
}

TEST_CASE(
    "A reader that ends by a signal, or requests all memory, causes an error and nothing else") {
    const Folder folder;
#ifndef __SANITIZE_ADDRESS__  // which ends a program that requests so much
    CHECK_THROWS_WITH(made_up(folder)->read("loud"), Catch::Contains("needs more memory"));
#endif
    const auto file = made_up(folder);
    CHECK_THROWS_WITH(file->read("bad"), Catch::Contains("x.h5: is damaged"));
    CHECK_THROWS_AS(file->read("sensor"), mc::SignalError);
    CHECK_THROWS_WITH(mc::isolated_signal(folder.file("none.h5"),
                                          []() -> std::unique_ptr<mc::SignalFile> {
                                              throw mc::SignalError("none.h5: no such file");
                                          }),
                      "none.h5: no such file");
    CHECK_THROWS_WITH(
        mc::isolated_signal(folder.file("x.h5"),
                            []() -> std::unique_ptr<mc::SignalFile> { std::abort(); }),
        Catch::Contains("is damaged"));
}

TEST_CASE("No child process remains") {
    {
        const Folder folder;
        const auto file = made_up(folder);
        CHECK(file->read("sensor").size() == 3);
    }
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
    CHECK(errno == ECHILD);
}

}  // namespace

}  // namespace test_isolated_signal
