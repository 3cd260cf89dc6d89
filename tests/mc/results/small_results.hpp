// Results of small runs, and writes to a full disk.
#pragma once

#include <sys/resource.h>

#include <csignal>

#include "tests/mc/program.hpp"

namespace gearpod::test {

// Results of a run in a folder.
struct SmallRun {
    Folder folder;
    std::string path = folder.file("r.h5");

    explicit SmallRun(const std::string& arguments) {
        require_success("run " + arguments + " --quiet --out " + path);
    }
};

// Message of the error of a call while files may have that many bytes only, as on a full disk.
template <class Call>
std::string message_of_full_disk(rlim_t bytes, Call call) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    const rlimit small{bytes, limit.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string message = message_of(call);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    return message;
}

}  // namespace gearpod::test
