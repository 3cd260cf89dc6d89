// Computations leave off while somebody wishes so, and only then.
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

TEST_CASE("Nobody leaves without a wish, and a wish ends with who had it") {
    CHECK_NOTHROW(leave_if_stopped());
    {
        Switch wish;
        CHECK_NOTHROW(leave_if_stopped());
        wish.on = true;
        CHECK_THROWS_AS(leave_if_stopped(), Stopped);
    }
    CHECK_NOTHROW(leave_if_stopped());
}

TEST_CASE("A team leaves off between its tasks") {
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
