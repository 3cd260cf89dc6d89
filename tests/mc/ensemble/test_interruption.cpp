// Checks signals and the time limit from the run's view.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "mc/ensemble/interruption.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_interruption {

using namespace std::chrono_literals;

TEST_CASE("Time limits are parsed as hours, minutes and seconds") {
    CHECK(parse_time_limit("00:00:01") == 1s);
    CHECK(parse_time_limit("01:30:07") == 5407s);
    CHECK(parse_time_limit("120:00:00") == 120h);
    for (const char* text :
         {"", "1", "01:30", "1:2:3", "00:60:00", "00:00:60", "-1:00:00", "00:00:01x", "a:b:c",
          "00:00:1", "00:00:", ":00:00", "00:-1:00", "99999999:00:00", "1:00:00:00"}) {
        INFO(text);
        CHECK_FALSE(parse_time_limit(text).has_value());
    }
}

TEST_CASE("A signal requests a stop during the lifetime of a watcher") {
    for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP}) {
        const Interruption interruption(std::nullopt);
        CHECK(interruption.reason(1h).empty());
        std::raise(number);
        CHECK_FALSE(interruption.reason({}).empty());
        // A sweep has one around those of its points: none of them misses a signal.
        CHECK(Interruption(std::nullopt).signalled());
    }
}

TEST_CASE("Simultaneous signals count as one request, a later one ends the program") {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const Interruption interruption(std::nullopt);
        std::raise(SIGTERM);
        std::raise(SIGTERM);
        std::this_thread::sleep_for(Interruption::kSameRequest);
        std::raise(SIGUSR1);
        std::raise(SIGXCPU);
        std::raise(SIGINT);
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGINT);
}

TEST_CASE("The time limit includes the time to finish") {
    const Interruption interruption(2s);
    CHECK(interruption.reason(0s).empty());
    CHECK(interruption.reason(1.5s).empty());
    CHECK(interruption.reason(2s) == "the time limit");
    std::this_thread::sleep_for(600ms);
    CHECK(interruption.reason(1.5s) == "the time limit");
}

TEST_CASE("Computing stops shortly after a signal, at the limit, or on request") {
    {
        const Interruption interruption(1h);
        CHECK_FALSE(interruption.stop());
        std::raise(SIGTERM);
        CHECK_FALSE(interruption.stop());  // work that is nearly finished may be completed
        std::this_thread::sleep_for(Interruption::kGrace + 50ms);
        CHECK(interruption.stop());
        CHECK_THROWS_AS(gearpod::machine::throw_if_cancelled(), gearpod::machine::Cancelled);
        interruption.disable_cancellation();
        CHECK_FALSE(interruption.stop());
    }
    CHECK_NOTHROW(gearpod::machine::throw_if_cancelled());
    const Interruption limited(1s);
    CHECK_FALSE(limited.stop());
    limited.cancel_in(1h);  // not later than the limit
    std::this_thread::sleep_for(1100ms);
    CHECK(limited.stop());
}

TEST_CASE("A request to stop takes effect at the requested time") {
    const Interruption interruption(std::nullopt);
    interruption.cancel_in(200ms);
    CHECK_FALSE(interruption.stop());
    std::this_thread::sleep_for(250ms);
    CHECK(interruption.stop());
}

}  // namespace gearpod::mc::test_interruption
