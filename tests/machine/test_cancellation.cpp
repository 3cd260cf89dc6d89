// Checks that computations end early if and only if cancellation is requested.
#include <atomic>

#include "machine/team.hpp"
#include "tests/test.hpp"

namespace gearpod::machine::test_cancellation {

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

}  // namespace gearpod::machine::test_cancellation
