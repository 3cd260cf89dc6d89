// Checks that computations end early if and only if cancellation is requested.
#include <atomic>
#include <catch2/catch.hpp>

#include "machine/stop.hpp"
#include "machine/team.hpp"

using namespace gearpod;
using namespace gearpod::machine;

namespace {

struct Switch final : StopWish {
    std::atomic<bool> on{false};
    bool stop() const override { return on; }
};

TEST_CASE("Nothing ends without a cancellation flag, and a request ends with the flag's lifetime") {
    CHECK_NOTHROW(leave_if_stopped());
    {
        Switch wish;
        CHECK_NOTHROW(leave_if_stopped());
        wish.on = true;
        CHECK_THROWS_AS(leave_if_stopped(), Stopped);
    }
    CHECK_NOTHROW(leave_if_stopped());
}

TEST_CASE("A team stops between its tasks on request") {
    Switch wish;
    std::atomic<int> done{0};
    const auto task = [&](std::size_t i) {
        ++done;
        if (i == 3) {
            wish.on = true;
        }
    };
    CHECK_THROWS_AS(for_each_index(1000, 1, task), Stopped);
    CHECK(done == 4);
}

}  // namespace
