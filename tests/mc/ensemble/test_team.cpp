// Checks OpenMP teams: every task runs once on as many threads as OpenMP grants, and exceptions are
// not lost.
#include <atomic>

#include "machine/team.hpp"
#include "tests/test.hpp"

namespace gearpod::test_team {

TEST_CASE("Every index is processed once, for any team size") {
    for (const int threads : {1, 2, 3, 7}) {
        for (const std::size_t count : {0, 1, 2, 100}) {
            std::vector<std::atomic<int>> times(count);
            machine::for_each_index(count, threads, [&](std::size_t i) { ++times[i]; });
            for (const auto& each : times) {
                REQUIRE(each == 1);
            }
        }
    }
}

TEST_CASE("Every thread of a team receives the team's size") {
    for (const int threads : {1, 2, 5}) {
        std::atomic<int> calls{0};
        std::atomic<bool> same{true};
        machine::run_team(threads, [&](int granted) {
            ++calls;
            same = same && granted == threads;
        });
        CHECK(calls == threads);
        CHECK(same);
    }
}

TEST_CASE("An exception in a team is rethrown after the others have finished") {
    std::atomic<int> calls{0};
    const auto work = [&](std::size_t i) {
        ++calls;
        if (i == 3) {
            throw std::runtime_error("the fourth");
        }
    };
    CHECK_THROWS_WITH(machine::for_each_index(50, 2, work), "the fourth");
    CHECK(calls == 50);
    std::atomic<int> threads{0};
    CHECK_THROWS_WITH(machine::run_team(3, [&](int) { work(static_cast<std::size_t>(++threads)); }),
                      "the fourth");
    CHECK(threads == 3);
}

}  // namespace gearpod::test_team
