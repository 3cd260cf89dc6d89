#include "lockstep/plan/phase_grid.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_phase_grid {

TEST_CASE("The phase grid covers a mesh period with a node on every sample and transition") {
    const std::vector<double> transitions{0.75, 0.0, 0.123456789, 0.6022, 0.123456789 + 1e-15};
    const PhaseGrid grid = make_phase_grid(7, 100, transitions);
    double phase = 0.0;
    int sample = 0;
    for (const Step& step : grid.steps) {
        CHECK(step.phase == Approx(phase).margin(1e-14));
        CHECK(step.length > 0.0);
        CHECK(step.length <= 1.0 / 100 + 1e-14);
        CHECK(grid.lengths[static_cast<std::size_t>(step.kind)] ==
              Approx(step.length).margin(1e-12));
        if (step.sample >= 0) {
            CHECK(step.sample == sample);
            CHECK(step.phase == Approx(sample / 7.0).margin(1e-14));
            ++sample;
        }
        phase = step.phase + step.length;
    }
    CHECK(phase == Approx(1.0));
    CHECK(sample == 7);
    for (const double t : transitions) {
        double nearest = 1.0;
        for (const Step& step : grid.steps) {
            nearest = std::min(nearest, std::abs(step.phase - t));
        }
        CHECK(nearest < 1e-12);
    }
}

TEST_CASE("A phase grid without samples or steps is refused") {
    CHECK_THROWS_AS(make_phase_grid(0, 100, {}), std::invalid_argument);
    CHECK_THROWS_AS(make_phase_grid(5, 0, {}), std::invalid_argument);
}

}  // namespace gearpod::lockstep::test_phase_grid
