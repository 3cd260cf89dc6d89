// Checks bounds over synthetic studies with known truth: 95 % bounds must hold in 95 % of them. The
// tag is [.coverage]; ctest runs it as analysis-coverage of -C long.
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/pod_bounds.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_coverage {

using Where = SizeEstimate::Where;
constexpr int kStudies = 2000;
constexpr double kMargin = 0.015;  // three standard deviations of a coverage of 0.95

// One hit/miss study of the true curve. Sizes are uniform in (0, largest), either all different or
// on as many equally spaced levels.
HitMissTable draw_study(const PodCurve& truth, int count, double largest, int levels,
                        std::mt19937_64& engine) {
    std::uniform_real_distribution<double> draw;
    std::vector<double> sizes;
    std::vector<char> hits;
    for (int i = 0; i < count; ++i) {
        const double share = 1.0 - draw(engine);
        sizes.push_back(largest * (levels > 0 ? std::ceil(share * levels) / levels : share));
        hits.push_back(draw(engine) < truth.pod(sizes.back()) ? 1 : 0);
    }
    return hit_miss_table(sizes, hits);
}

// Bounds outside the tested sizes hold unless the truth lies inside on the wrong side.
bool upper_holds(const SizeEstimate& bound, double truth) {
    return bound.where == Where::not_reached ||
           (bound.where == Where::reached && truth <= bound.size);
}
bool lower_holds(const SizeEstimate& bound, double truth) {
    return bound.where == Where::below_tested ||
           (bound.where == Where::reached && truth >= bound.size);
}

struct Covered {
    double upper = 0.0, lower = 0.0, band_lower = 0.0, band_upper = 0.0;
    int studies = 0;
};

Covered coverage_of_form(const PodCurve& truth, int count, int levels, double at_size) {
    constexpr double kLargest = 5.0;
    std::mt19937_64 engine(17);
    Covered covered;
    const double a90 = *truth.size_at(0.9);
    for (int s = 0; s < kStudies; ++s) {
        const HitMissTable table = draw_study(truth, count, kLargest, levels, engine);
        if (!fit_hit_miss(table, truth.form).refusal.empty()) {
            continue;
        }
        const PodLikelihood likelihood(table, truth.form);
        const auto maximum = likelihood.maximise();
        const SizeBounds bounds =
            size_bounds(table, likelihood, maximum, 0.9, one_sided_bound(0.95));
        const PodPoint point =
            pod_band(likelihood, maximum, {at_size}, one_sided_bound(0.95)).front();
        ++covered.studies;
        covered.upper += upper_holds(bounds.upper, a90);
        covered.lower += lower_holds(bounds.lower, a90);
        covered.band_lower += point.lower <= truth.pod(at_size);
        covered.band_upper += point.upper >= truth.pod(at_size);
    }
    for (double* share :
         {&covered.upper, &covered.lower, &covered.band_lower, &covered.band_upper}) {
        *share /= covered.studies;
    }
    return covered;
}

TEST_CASE("Likelihood-ratio bounds of two-parameter curves cover the truth", "[.coverage]") {
    for (const PodCurve& truth : {PodCurve{{Link::logit, false, 0.0, false}, -4.0, 2.0, 1.0},
                                  PodCurve{{Link::probit, true, 0.0, false}, -1.4, 2.0, 1.0},
                                  PodCurve{{Link::logit, false, 0.05, false}, -4.0, 2.0, 1.0}}) {
        INFO(form_text(truth.form));
        const Covered covered = coverage_of_form(truth, 300, 0, 2.5);
        CAPTURE(covered.upper, covered.lower, covered.band_lower, covered.band_upper);
        CHECK(covered.studies == kStudies);
        CHECK(covered.upper == Approx(0.95).margin(kMargin));
        CHECK(covered.lower == Approx(0.95).margin(kMargin));
        CHECK(covered.band_lower == Approx(0.95).margin(kMargin));
        CHECK(covered.band_upper == Approx(0.95).margin(kMargin));
    }
}

TEST_CASE("Likelihood-ratio bounds with floor and ceiling cover the truth", "[.coverage]") {
    // A ceiling that is far enough from 1 and from 0.9 to be found in most studies.
    const PodCurve truth{{Link::logit, false, 0.05, true}, -5.0, 3.0, 0.96};
    const Covered covered = coverage_of_form(truth, 1500, 30, 1.6);
    CAPTURE(covered.studies, covered.upper, covered.lower, covered.band_lower, covered.band_upper);
    CHECK(covered.studies > 0.99 * kStudies);
    CHECK(covered.upper == Approx(0.95).margin(kMargin));
    CHECK(covered.lower == Approx(0.95).margin(kMargin));
    CHECK(covered.band_lower == Approx(0.95).margin(kMargin));
    CHECK(covered.band_upper == Approx(0.95).margin(kMargin));
}

TEST_CASE("The bound of a90 over all supported curves covers the truth", "[.coverage]") {
    // The bound of the chosen curve alone covers 0.89 to 0.95 here.
    for (const PodCurve& truth : {PodCurve{{Link::probit, false, 0.05, false}, -3.0, 1.6, 1.0},
                                  PodCurve{{Link::logit, true, 0.05, false}, -3.0, 4.0, 1.0},
                                  PodCurve{{Link::logit, false, 0.05, true}, -5.0, 3.0, 0.96},
                                  PodCurve{{Link::logit, false, 0.0, false}, -4.0, 2.0, 1.0}}) {
        INFO(form_text(truth.form));
        const double a90 = *truth.size_at(0.9);
        std::mt19937_64 engine(23);
        double upper = 0.0;
        int studies = 0;
        for (int s = 0; s < kStudies; ++s) {
            const HitMissPod pod =
                hit_miss_pod(draw_study(truth, 600, 5.0, 20, engine), {0.05, 0.95, 2});
            if (pod.refusal.empty()) {
                ++studies;
                upper += upper_holds(pod.a90.upper, a90);
            }
        }
        CAPTURE(upper / studies);
        CHECK(studies == kStudies);
        CHECK(upper / studies > 0.95 - kMargin);
        CHECK(upper / studies < 0.985);  // wide where a ceiling is hard to identify
    }
}

TEST_CASE("Bounds of a POD from a line with normal scatter cover the truth", "[.coverage]") {
    std::mt19937_64 engine(29);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> draw(0.5, 4.0);
    // For value = 1 + a + 0.5 e and threshold 3, a90 = 2 + 0.5 z.
    const double a90 = 2.0 + 0.5 * link_quantile(Link::probit, 0.9);
    double upper = 0.0, lower = 0.0;
    int studies = 0;
    for (int s = 0; s < 2 * kStudies && studies < kStudies; ++s) {
        std::vector<double> sizes, values;
        for (int i = 0; i < 100; ++i) {
            sizes.push_back(draw(engine));
            values.push_back(1.0 + sizes.back() + 0.5 * normal(engine));
        }
        const SignalResponsePod pod =
            signal_response_pod(sizes, values, {3.0, Alarm::high, 0.95, 2});
        // Studies whose checks fail by chance, or in which another scale passes with less AIC,
        // concern the selection and not the bound.
        if (pod.refusal.empty() && !pod.candidates[pod.chosen].scale.log_size &&
            pod.candidates[pod.chosen].scale.power == 1.0) {
            ++studies;
            upper += upper_holds(pod.a90.upper, a90);
            lower += lower_holds(pod.a90.lower, a90);
        }
    }
    CAPTURE(studies);
    REQUIRE(studies == kStudies);
    CHECK(upper / studies == Approx(0.95).margin(kMargin));
    CHECK(lower / studies == Approx(0.95).margin(kMargin));
}

}  // namespace gearpod::analysis::test_coverage
