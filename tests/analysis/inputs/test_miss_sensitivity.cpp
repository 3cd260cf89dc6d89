#include "analysis/inputs/miss_sensitivity.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_miss_sensitivity {

// Gearboxes are detected where size - torque's effect + scatter exceeds 1.
struct Study {
    std::vector<double> size, torque, bearing, fixed;
    std::vector<int> hit;
    std::vector<InputColumn> inputs() const {
        return {{"torque_N_m", "N m", torque}, {"bearing", "N/m", bearing}, {"fixed", "1", fixed}};
    }
};

Study study(bool levels, unsigned seed, double effect) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> draw;
    std::uniform_real_distribution<double> sizes(0.2, 3.0);
    Study out;
    for (int i = 0; i < 1500; ++i) {
        out.size.push_back(levels ? 0.5 * (i % 6) : sizes(engine));
        out.torque.push_back(draw(engine));
        out.bearing.push_back(draw(engine));
        out.fixed.push_back(7.0);
        const double distance =
            out.size.back() - effect * out.torque.back() + 0.3 * draw(engine) - 1.0;
        out.hit.push_back(i % 50 == 7 ? -1 : distance > 0.0 ? 1 : 0);
    }
    return out;
}

TEST_CASE("The input that decides the misses ranks first; irrelevant inputs stay at 1/2") {
    for (const bool levels : {true, false}) {
        const Study drawn = study(levels, 4, 0.6);
        const MissSensitivity result =
            miss_sensitivity(drawn.size, drawn.hit, drawn.inputs(), 0.95);
        REQUIRE(result.inputs.size() == 2);
        CHECK(result.inputs[0].name == "torque_N_m");
        CHECK(result.inputs[0].larger_in_misses > 0.85);
        CHECK(result.inputs[0].p_value < 1e-6);
        CHECK(result.inputs[1].bounds.lower < 0.5);
        CHECK(result.inputs[1].bounds.upper > 0.5);
        CHECK(result.left_out == std::vector<std::string>{"fixed"});
        CHECK(result.smallest >= 0.9);  // at least half are detected
    }
}

TEST_CASE("With one size the influence is the area between two shifted normal laws") {
    // Misses and hits differ by 1: Phi(1 / sqrt 2).
    std::mt19937_64 engine(9);
    std::normal_distribution<double> draw;
    std::vector<double> size(20000, 2.0), input;
    std::vector<int> hit;
    for (int i = 0; i < 20000; ++i) {
        hit.push_back(i % 4 != 0);
        input.push_back(draw(engine) + (hit.back() == 1 ? 0.0 : 1.0));
    }
    const MissSensitivity result = miss_sensitivity(size, hit, {{"x", "1", input}}, 0.95);
    const double truth = link_probability(Link::probit, 1.0 / std::sqrt(2.0));
    CHECK(result.misses == 5000);
    CHECK(result.inputs[0].bounds.lower < truth);
    CHECK(result.inputs[0].bounds.upper > truth);
    CHECK(result.inputs[0].larger_in_misses == Approx(truth).margin(0.015));
}

TEST_CASE("Intervals of an irrelevant input cover 1/2 over 1,000 studies") {
    int covered = 0, checked = 0;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        const Study drawn = study(true, 100 + seed, 0.0);
        const auto inputs = drawn.inputs();
        const MissSensitivity result = miss_sensitivity(drawn.size, drawn.hit, {inputs[1]}, 0.95);
        if (result.misses < 10) {
            CHECK_THAT(result.refusal, Catch::Contains("10 of each are needed"));
            continue;
        }
        REQUIRE(result.inputs.size() == 1);
        ++checked;
        covered += result.inputs[0].bounds.lower <= 0.5 && result.inputs[0].bounds.upper >= 0.5;
    }
    CHECK(checked > 700);
    // The margin is three standard deviations.
    CHECK(covered / static_cast<double>(checked) == Approx(0.95).margin(0.025));
}

TEST_CASE("Without misses or hits there is no influence to estimate") {
    const std::vector<double> size{0.0, 1.0, 1.0, 1.0, 2.0, 2.0};
    const std::vector<double> input{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    for (const int outcome : {0, 1, -1}) {
        const std::vector<int> hit(6, outcome);
        CHECK_THAT(miss_sensitivity(size, hit, {{"x", "1", input}}, 0.95).refusal,
                   Catch::Contains("no fault size"));
    }
    CHECK(!miss_sensitivity({}, {}, {}, 0.95).refusal.empty());
}

}  // namespace gearpod::analysis::test_miss_sensitivity
