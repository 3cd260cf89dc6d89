// Checks that computations end early if and only if cancellation is requested.
#include <atomic>
#include <catch2/catch.hpp>

#include "machine/team.hpp"

namespace test_cancellation {

using namespace gearpod;
using namespace gearpod::machine;

namespace {

struct Switch final : CancellationSource {
    std::atomic<bool> on{false};
    bool stop() const override { return on; }
};

TEST_CASE("Nothing ends without a cancellation flag, and a request ends with the flag's lifetime") {
    CHECK_NOTHROW(throw_if_cancelled());
    {
        Switch stop_request;
        CHECK_NOTHROW(throw_if_cancelled());
        stop_request.on = true;
        CHECK_THROWS_AS(throw_if_cancelled(), Cancelled);
    }
    CHECK_NOTHROW(throw_if_cancelled());
}

TEST_CASE("A team stops between its tasks on request") {
    Switch stop_request;
    std::atomic<int> done{0};
    const auto task = [&](std::size_t i) {
        ++done;
        if (i == 3) {
            stop_request.on = true;
        }
    };
    CHECK_THROWS_AS(for_each_index(1000, 1, task), Cancelled);
    CHECK(done == 4);
}

}  // namespace

}  // namespace test_cancellation
