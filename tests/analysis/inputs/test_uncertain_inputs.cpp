#include "analysis/inputs/uncertain_inputs.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_uncertain_inputs {

// Synthetic campaign with logit POD = -6 + 3 a + effect . z for independent standard normal z. The
// a90 is then normal with mean (log 9 + 6) / 3; its standard deviation is the root sum of squares
// of the effects over 3.
struct Campaign {
    std::vector<double> size, first, second;
    std::vector<int> hit;
    HitMissPod pod;

    Campaign(std::size_t gearboxes, double of_first, double of_second) {
        std::mt19937 engine(7);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> unit;
        for (std::size_t i = 0; i < gearboxes; ++i) {
            size.push_back(5.0 * unit(engine));
            first.push_back(normal(engine));
            second.push_back(100.0 + 10.0 * normal(engine));
            const double eta = -6.0 + 3.0 * size.back() + of_first * first.back() +
                               of_second * 0.1 * (second.back() - 100.0);
            hit.push_back(unit(engine) < 1.0 / (1.0 + std::exp(-eta)) ? 1 : 0);
        }
        pod.chosen.curve = {{Link::logit, false, 0.0, false}, -6.0, 3.0, 1.0};
        pod.smallest = 0.0;
        pod.largest = 5.0;
        pod.band = {{1.0, 0.0, 0.0, 0.0}, {2.0, 0.0, 0.0, 0.0}};
    }
    EpistemicBand band() const {
        return epistemic_band(size, hit, {{"first", "1", first}, {"second", "N", second}}, pod);
    }
};

constexpr double kQuantile = 1.6448536;  // of the normal law at 95 %
const double kMiddle = (std::log(9.0) + 6.0) / 3.0;

TEST_CASE("The band of two uncertain inputs has their combined width") {
    const Campaign campaign(40000, 1.5, 2.0);
    const EpistemicBand found = campaign.band();
    REQUIRE(found.refusal.empty());
    CHECK(found.inputs == std::vector<std::string>{"first", "second"});
    const double half = kQuantile * 2.5 / 3.0;
    CHECK(found.a90_low.size == Approx(kMiddle - half).margin(0.05));
    CHECK(found.a90_high.size == Approx(kMiddle + half).margin(0.05));
    // The logit at size 2 is 2.5 times a standard normal number.
    REQUIRE(found.band.size() == 2);
    CHECK(found.band[1].pod == Approx(0.5).margin(0.02));
    CHECK(found.band[1].upper == Approx(1.0 / (1.0 + std::exp(-2.5 * kQuantile))).margin(0.01));
    CHECK(found.band[1].lower == Approx(1.0 / (1.0 + std::exp(2.5 * kQuantile))).margin(0.01));
}

TEST_CASE(
    "Inputs without effect leave no uncertainty, and there is no extrapolation beyond the tested "
    "sizes") {
    const EpistemicBand none = Campaign(40000, 0.0, 0.0).band();
    CHECK(none.a90_high.size - none.a90_low.size < 0.1);
    const EpistemicBand wide = Campaign(40000, 8.0, 0.0).band();
    CHECK(wide.a90_low.where == SizeEstimate::Where::below_tested);
    CHECK(wide.a90_high.where == SizeEstimate::Where::not_reached);
}

TEST_CASE("Without a varying input, or without a curve, there is no band") {
    Campaign campaign(200, 1.0, 0.0);
    std::fill(campaign.first.begin(), campaign.first.end(), 1.0);
    std::fill(campaign.second.begin(), campaign.second.end(), 1.0);
    CHECK(campaign.band().inputs.empty());
    Campaign refused(200, 1.0, 0.0);
    refused.pod.refusal = "no curve";
    CHECK(refused.band().refusal == "no curve");
    CHECK(refused.band().band.empty());
}

}  // namespace gearpod::analysis::test_uncertain_inputs
