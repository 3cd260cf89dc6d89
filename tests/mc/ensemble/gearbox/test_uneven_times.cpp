// Checks that the program writes the times of samples at an uneven speed, whatever lanes it is
// built for.
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/shipped_studies.hpp"
#include "tests/test.hpp"

namespace gearpod::test_uneven_times {

using namespace test;

TEST_CASE("simulate writes uneven times where the speed fluctuates") {
    const auto [folder, path] = TemporaryFile("signals.csv");
    require_success("simulate " + study_path("uneven-speed.toml") +
                    " --instance 1 --meshes 31 --set operation.speed_fluctuation=0.04 --out " +
                    path);
    const std::vector<double> time = columns_of(path).at("time");
    REQUIRE(time.size() > 100);
    double shortest = time[1] - time[0], longest = shortest;
    for (std::size_t i = 1; i < time.size(); ++i) {
        shortest = std::min(shortest, time[i] - time[i - 1]);
        longest = std::max(longest, time[i] - time[i - 1]);
    }
    // A sine of 4 % and noise of 0.2 %, over two turns of the sun.
    CHECK(shortest > 0.0);
    CHECK(longest / shortest == Approx(1.04 / 0.96).epsilon(0.02));
}

}  // namespace gearpod::test_uneven_times
