#include "analysis/inputs/input_effects.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/analysis/reference_data.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_input_effects {

using Where = SizeEstimate::Where;

// A POD with a given rather than fitted curve. Only its form and tested sizes are used.
HitMissPod pod_of_form(const PodForm& form, double smallest, double largest) {
    HitMissPod pod;
    pod.chosen.curve = {form, 0.0, 0.0, 1.0};
    pod.smallest = smallest;
    pod.largest = largest;
    return pod;
}

TEST_CASE("Test and a90 map agree with statsmodels and Fieller's bounds") {
    const auto columns = reference_columns("inputs_300");
    const std::vector<int> hit(columns[2].begin(), columns[2].end());
    const HitMissPod pod = pod_of_form({Link::logit, false, 0.0, false}, 0.1, 20.0);
    const InputEffects result =
        input_effects(columns[0], hit, {{"z", "1", columns[1]}}, pod, {0.0, 5.0}, 0.95);
    const InputEffect& z = result.inputs.at(0);
    CHECK(z.degrees == 2);
    CHECK(z.statistic == Approx(22.08586602).epsilon(1e-8));
    CHECK(z.p_value == Approx(1.599982119e-05).epsilon(1e-6));
    // Reference: reference/robustness_py.txt.
    const double a90[][4] = {{6.708111, 3.355907471, 3.672758021, 4.056032315},
                             {8.792695, 3.085616424, 3.309180786, 3.599181739},
                             {10.06425, 2.846893438, 3.065423489, 3.349432313},
                             {11.279575, 2.599767996, 2.816876989, 3.097865396},
                             {13.19128, 2.054896835, 2.395120559, 2.795355218}};
    REQUIRE(z.values.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(z.values[i] == Approx(a90[i][0]).epsilon(1e-9));
        CHECK(z.a90[i].lower.size == Approx(a90[i][1]).epsilon(1e-7));
        CHECK(z.a90[i].estimate.size == Approx(a90[i][2]).epsilon(1e-7));
        CHECK(z.a90[i].upper.size == Approx(a90[i][3]).epsilon(1e-7));
    }
}

TEST_CASE("Bins have equal counts and Wilson's bounds; few values get one bin each") {
    std::vector<double> size, z, levels;
    std::vector<int> hit;
    for (int i = 0; i < 500; ++i) {
        size.push_back(i % 2 == 0 ? 1.0 : 3.0);
        z.push_back((i * 37) % 500);
        levels.push_back(100.0 * (i % 3));
        hit.push_back(i % 10 == 9 ? -1 : z.back() >= 250 ? 1 : 0);
    }
    const InputEffects result =
        input_effects(size, hit, {{"z", "1", z}, {"levels", "1", levels}, {"fixed", "1", size}},
                      pod_of_form({}, 1.0, 3.0), {3.0, 3.0}, 0.95);
    const auto& bins = result.inputs.at(0).bins;
    REQUIRE(bins.size() == 5);
    long tested = 0;
    for (const InputBin& bin : bins) {
        CHECK(bin.tested == 40);  // 250 of size 3, of which 50 have no value
        CHECK(bin.low <= bin.middle);
        CHECK(bin.middle <= bin.high);
        CHECK(bin.bounds.lower == wilson_interval(bin.detected, bin.tested, 0.95).lower);
        tested += bin.tested;
    }
    CHECK(tested == 200);
    CHECK(bins[0].pd == 0.0);
    CHECK(bins[4].pd == 1.0);
    const InputEffect& few = result.inputs.at(1);
    REQUIRE(few.bins.size() == 3);
    CHECK(few.bins[1].low == 100.0);
    CHECK(few.bins[1].high == 100.0);
    CHECK(few.values == std::vector<double>{0.0, 100.0, 200.0});
}

TEST_CASE("Repeated values share a bin") {
    const InputBins bins = equal_count_bins(std::vector<double>{5, 5, 5, 5, 5, 1, 2, 3, 4, 6}, 4);
    CHECK(bins.of == std::vector<std::size_t>{2, 2, 2, 2, 2, 0, 0, 0, 1, 3});
    CHECK(bins.bins == 4);
    CHECK(equal_count_bins({}, 4).bins == 0);
    CHECK(equal_count_bins(std::vector<double>{7, 7, 7}, 4).bins == 1);
}

// Gearboxes detected with probability F(-4 + 2 a + z), F logistic.
struct Study {
    std::vector<double> size, z, idle;
    std::vector<int> hit;

    Study(int count, unsigned seed, double effect = 1.0) {
        std::mt19937_64 engine(seed);
        std::uniform_real_distribution<double> draw;
        std::normal_distribution<double> normal;
        for (int i = 0; i < count; ++i) {
            size.push_back(4.0 * (1.0 - draw(engine)));
            z.push_back(normal(engine));
            idle.push_back(normal(engine));
            const double eta = -4.0 + 2.0 * size.back() + effect * z.back();
            hit.push_back(draw(engine) < link_probability(Link::logit, eta) ? 1 : 0);
        }
    }
};

TEST_CASE("The study's own curve gives the map; the irrelevant input has no effect") {
    const Study study(2000, 3);
    const HitMissPod pod = hit_miss_pod(
        hit_miss_table(study.size, std::vector<char>(study.hit.begin(), study.hit.end())),
        {0.0, 0.95});
    REQUIRE(pod.refusal == "");
    const InputEffects result =
        input_effects(study.size, study.hit, {{"z", "1", study.z}, {"idle", "1", study.idle}}, pod,
                      {1.0, 3.0}, 0.95);
    CHECK(result.inputs[0].p_value < 1e-20);
    CHECK(result.inputs[1].p_value > 0.05);
    // a90 = (4 + ln 9 - z) / 2.
    for (std::size_t i = 1; i < 5; ++i) {
        const double truth = 0.5 * (4.0 + std::log(9.0) - result.inputs[0].values[i]);
        CHECK(result.inputs[0].a90[i].estimate.size == Approx(truth).margin(0.25));
    }
}

TEST_CASE("Sizes beyond the tested ones are not extrapolated") {
    const Study study(2000, 3, 3.0);
    const HitMissPod pod = pod_of_form({Link::logit, false, 0.0, false}, 0.01, 4.0);
    const InputEffects result =
        input_effects(study.size, study.hit, {{"z", "1", study.z}}, pod, {1.0, 3.0}, 0.95);
    // z = -1.64: (4 + 2.2 + 4.9) / 2 > 4; z = 1.64: 0.63.
    CHECK(result.inputs[0].a90.front().estimate.where == Where::not_reached);
    CHECK(result.inputs[0].a90.front().upper.where == Where::not_reached);
    CHECK(result.inputs[0].a90.back().estimate.where == Where::reached);
}

TEST_CASE("One outcome class, no gearboxes or no curve: a reason instead of a number") {
    Study study(200, 5);
    const auto effects = [&](const std::vector<int>& hit, const HitMissPod& pod) {
        return input_effects(study.size, hit, {{"z", "1", study.z}}, pod, {0.0, 4.0}, 0.95);
    };
    const HitMissPod pod = pod_of_form({Link::logit, false, 0.0, false}, 0.01, 4.0);
    for (const int outcome : {0, 1}) {
        const InputEffects same = effects(std::vector<int>(200, outcome), pod);
        CHECK(same.inputs[0].refusal == "all outcomes are equal");
        CHECK(std::isnan(same.inputs[0].p_value));
        CHECK(same.inputs[0].a90.empty());
        CHECK(same.inputs[0].bins.size() == 5);
    }
    CHECK(effects(std::vector<int>(200, -1), pod).left_out == std::vector<std::string>{"z"});
    HitMissPod none = pod;
    none.refusal = "no threshold";
    CHECK(effects(study.hit, none).inputs[0].refusal == "no threshold");
    // Hits and misses that one input separates completely have no likelihood maximum.
    std::vector<int> parted =
        test::mapped(study.z, [&](const double z) { return z > 0.0 ? 1 : 0; });
    CHECK(!effects(parted, pod).inputs[0].refusal.empty());
}

TEST_CASE("Bins contain sizes at which detection is neither rare nor certain") {
    const auto cell = [](double size, double pd) {
        DetectionCell c;
        c.size = {size, size};
        c.pd = pd;
        return c;
    };
    const SizeGroup middle =
        transition_sizes({cell(0, 0.2), cell(1, 0.05), cell(2, 0.3), cell(3, 0.9), cell(4, 1.0)});
    CHECK(middle.low == 2.0);
    CHECK(middle.high == 3.0);
    const SizeGroup nearest = transition_sizes({cell(0, 0.05), cell(1, 0.07), cell(2, 1.0)});
    CHECK(nearest.low == 1.0);
    CHECK(std::isnan(transition_sizes({cell(0, 0.05)}).low));
    CHECK(!in_range(1.0, transition_sizes({})));
}

TEST_CASE("Bounds of the a90 map cover the truth; the test keeps its level", "[.coverage]") {
    constexpr int kStudies = 2000;
    const HitMissPod pod = pod_of_form({Link::logit, false, 0.0, false}, 0.001, 4.0);
    double upper[5] = {}, lower[5] = {}, false_alarms = 0.0;
    for (int s = 0; s < kStudies; ++s) {
        const Study study(600, 1000 + s, 0.6);
        const InputEffects result =
            input_effects(study.size, study.hit, {{"z", "1", study.z}, {"idle", "1", study.idle}},
                          pod, {1.0, 3.0}, 0.95);
        for (std::size_t i = 0; i < 5; ++i) {
            const InputEffect& z = result.inputs[0];
            const double truth = 0.5 * (4.0 + std::log(9.0) - 0.6 * z.values[i]);
            const SizeBounds& a90 = z.a90.at(i);
            upper[i] += a90.upper.where == Where::not_reached || a90.upper.size >= truth;
            lower[i] += a90.lower.where == Where::reached && a90.lower.size <= truth;
        }
        // The p-value is taken alone, so that no adjustment hides the level.
        false_alarms +=
            input_effects(study.size, study.hit, {{"idle", "1", study.idle}}, pod, {1.0, 3.0}, 0.95)
                .inputs[0]
                .p_value < 0.05;
    }
    for (std::size_t i = 0; i < 5; ++i) {
        CAPTURE(i, upper[i] / kStudies, lower[i] / kStudies);
        CHECK(upper[i] / kStudies == Approx(0.95).margin(0.015));
        CHECK(lower[i] / kStudies == Approx(0.95).margin(0.015));
    }
    CHECK(false_alarms / kStudies == Approx(0.05).margin(0.015));
}

// Gearboxes are detected where size - torque's effect + scatter exceeds 1.
struct MissStudy {
    std::vector<double> size, torque, bearing, fixed;
    std::vector<int> hit;
    std::vector<InputColumn> inputs() const {
        return {{"torque_N_m", "N m", torque}, {"bearing", "N/m", bearing}, {"fixed", "1", fixed}};
    }
};

MissStudy study(bool levels, unsigned seed, double effect) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> draw;
    std::uniform_real_distribution<double> sizes(0.2, 3.0);
    MissStudy out;
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
        const MissStudy drawn = study(levels, 4, 0.6);
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
        const MissStudy drawn = study(true, 100 + seed, 0.0);
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

}  // namespace gearpod::analysis::test_input_effects
