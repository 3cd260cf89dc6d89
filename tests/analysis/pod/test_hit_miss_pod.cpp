#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/pod_bounds.hpp"
#include "tests/analysis/reference_data.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_hit_miss_pod {

using Where = SizeEstimate::Where;

HitMissTable targets() {
    const auto columns = reference_columns("hit_miss_60");
    return hit_miss_table(columns[0], std::vector<char>(columns[1].begin(), columns[1].end()));
}

HitMissTable levels() {
    const auto columns = reference_columns("hit_miss_levels");
    return test::tabulated(columns[0].size(), [&](std::size_t i) {
        return HitMissRow{columns[0][i], columns[1][i], columns[2][i]};
    });
}

SizeBounds bounds_of(const HitMissTable& table, const PodForm& form, double pod) {
    const PodLikelihood likelihood(table, form);
    std::optional<PodLikelihood::Parameters> start;
    if (form.free_ceiling) {
        start = likelihood.maximise().parameters;
    }
    return size_bounds(table, likelihood, likelihood.maximise(start), pod, one_sided_bound(0.95));
}

TEST_CASE("The hit/miss fit of a published data set has its published numbers") {
    // Source: Air Force Research Laboratory, POD 4.5, HitMissResults_Good_1.csv.
    const HitMissFit fit = fit_hit_miss(targets(), {Link::logit, false, 0.0, false});
    CHECK(fit.refusal == "");
    CHECK(fit.curve.intercept == Approx(-11.83265105).epsilon(1e-8));
    CHECK(fit.curve.slope == Approx(45.30678376).epsilon(1e-8));
    CHECK(fit.aic == Approx(28.45673968).epsilon(1e-8));
    CHECK(*fit.curve.size_at(0.9) == Approx(0.309663906).epsilon(1e-8));
}

TEST_CASE("All four two-parameter fits and their likelihood-ratio bounds agree with R") {
    struct Row {
        PodForm form;
        double fit[3];  // intercept, slope, log-likelihood
        double a50[3], a90[3];
    };
    // Reference: reference/reference_R.txt.
    const Row rows[] = {{{Link::logit, false, 0.0, false},
                         {-11.83265106, 45.30678377, -12.22836983},
                         {0.2423077193, 0.2611673148, 0.2817961773},
                         {0.2828695266, 0.3096639061, 0.3564541722}},
                        {{Link::logit, true, 0.0, false},
                         {15.93880201, 11.80174944, -12.19497445},
                         {0.2401344837, 0.2590988306, 0.2792576532},
                         {0.2826130874, 0.3121199112, 0.3686309806}},
                        {{Link::probit, false, 0.0, false},
                         {-6.846425033, 26.179584309, -12.10682702},
                         {0.2424759723, 0.2615177086, 0.2823000449},
                         {0.2851180641, 0.3104700625, 0.3569871409}},
                        {{Link::probit, true, 0.0, false},
                         {9.179100871, 6.800078543, -12.08276606},
                         {0.2400425729, 0.2592785826, 0.2795649038},
                         {0.2847928826, 0.3130505022, 0.3684848610}}};
    const HitMissTable table = targets();
    for (const Row& row : rows) {
        INFO(form_text(row.form));
        const HitMissFit fit = fit_hit_miss(table, row.form);
        CHECK(fit.curve.intercept == Approx(row.fit[0]).epsilon(3e-6));
        CHECK(fit.curve.slope == Approx(row.fit[1]).epsilon(3e-6));
        CHECK(fit.log_likelihood == Approx(row.fit[2]).epsilon(1e-9));
        for (const double pod : {0.5, 0.9}) {
            const SizeBounds found = bounds_of(table, row.form, pod);
            const double* expected = pod == 0.5 ? row.a50 : row.a90;
            CHECK(found.lower.size == Approx(expected[0]).epsilon(1e-6));
            CHECK(found.estimate.size == Approx(expected[1]).epsilon(1e-6));
            CHECK(found.upper.size == Approx(expected[2]).epsilon(1e-6));
        }
    }
}

TEST_CASE("Fits with a floor and a ceiling, and their bounds, agree with a general optimiser") {
    // Reference: reference/reference_R.txt, optim() on the same counts with floor 0.05.
    const HitMissTable table = levels();
    const PodForm floored{Link::logit, false, 0.05, false};
    const HitMissFit plain = fit_hit_miss(table, floored);
    CHECK(plain.curve.intercept == Approx(-4.460444301).epsilon(1e-5));
    CHECK(plain.curve.slope == Approx(2.285924506).epsilon(1e-5));
    CHECK(plain.log_likelihood == Approx(-915.812206).epsilon(1e-9));
    const PodForm free{Link::logit, false, 0.05, true};
    const HitMissFit ceiling = fit_hit_miss(table, free);
    CHECK(ceiling.refusal == "");
    CHECK(ceiling.curve.intercept == Approx(-5.7576847481).epsilon(1e-4));
    CHECK(ceiling.curve.slope == Approx(3.0974445248).epsilon(1e-4));
    CHECK(ceiling.curve.ceiling == Approx(0.9691479875).epsilon(1e-5));
    CHECK(ceiling.log_likelihood == Approx(-892.2980489).epsilon(1e-9));
    CHECK(ceiling.fit.statistic == Approx(2.2417829496).epsilon(1e-4));
    CHECK(ceiling.fit.degrees == 3);
    CHECK(ceiling.fit.p_value == Approx(0.5237653899).epsilon(1e-4));
    const SizeBounds a90 = bounds_of(table, free, 0.9);
    CHECK(a90.lower.size == Approx(2.566746483).epsilon(1e-5));
    CHECK(a90.estimate.size == Approx(2.668868506).epsilon(1e-5));
    CHECK(a90.upper.size == Approx(2.779847221).epsilon(1e-5));
    const PodLikelihood likelihood(table, floored);
    const PodPoint at_two =
        pod_band(likelihood, likelihood.maximise(), {2.0}, one_sided_bound(0.95)).front();
    CHECK(at_two.lower == Approx(0.5242995843).epsilon(1e-6));
    CHECK(at_two.pod == Approx(0.5514312880).epsilon(1e-6));
    CHECK(at_two.upper == Approx(0.5785730879).epsilon(1e-6));
}

TEST_CASE("Every bound of the band lies where the profile deviance is z squared") {
    const HitMissTable table = levels();
    const double z = link_quantile(Link::probit, 0.95);
    for (const bool free : {false, true}) {
        const PodForm form{Link::probit, true, 0.05, free};
        const PodLikelihood likelihood(table, form);
        const auto maximum = likelihood.maximise();
        for (const PodPoint& point :
             pod_band(likelihood, maximum, {0.7, 1.0, 1.6, 2.2, 3.0, 4.2}, one_sided_bound(0.95))) {
            for (const double pod : {point.lower, point.upper}) {
                const auto held = likelihood.maximise_through(likelihood.standardised(point.size),
                                                              pod, maximum.parameters);
                CHECK(2.0 * (maximum.log_likelihood - held.log_likelihood) ==
                      Approx(z * z).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("The band of a nearly constant rate matches a search over all curves") {
    // Alarms of features that do not respond to the fault, at a false-alarm rate of 0.05. The best
    // curves of the first case fall steeply and fit the smallest size best, far from the curves
    // that bound the others. The best curve of the second case is the floor itself, where the
    // likelihood is flat.
    const struct {
        double floor;
        int hits[6];
    } cases[] = {{0.0488, {35, 24, 23, 25, 29, 31}}, {0.05198, {21, 28, 20, 30, 26, 26}}};
    const auto& given = cases[GENERATE(0, 1)];
    const double tested[] = {0.0005, 0.001, 0.0015, 0.002, 0.003, 0.00428};
    const HitMissTable table = test::tabulated(6, [&](int i) {
        return HitMissRow{tested[i], static_cast<double>(given.hits[i]), 500};
    });
    const PodForm form{Link::logit, false, given.floor, false};
    const PodLikelihood likelihood(table, form);
    const auto maximum = likelihood.maximise();
    const auto sizes = test::tabulated(21, [](int i) { return 0.0005 + 0.00378 * i / 20; });
    const auto band = pod_band(likelihood, maximum, sizes, one_sided_bound(0.95));
    // Parametrizes curves by their logits at the smallest and the largest size.
    const auto pod_at = [&](double first, double last, double size) {
        const double eta = first + (last - first) * (size - 0.0005) / 0.00378;
        return form.floor + (1.0 - form.floor) / (1.0 + std::exp(-eta));
    };
    std::vector<double> largest(sizes.size(), 0.0);
    const double least = maximum.log_likelihood - 0.5 * 1.6448536269514722 * 1.6448536269514722;
    for (double first = -14.0; first <= 0.0; first += 0.02) {
        for (double last = -14.0; last <= 0.0; last += 0.02) {
            double value = 0.0;
            for (const HitMissRow& row : table) {
                const double pod = pod_at(first, last, row.size);
                value += row.hits * std::log(pod) + (row.tests - row.hits) * std::log1p(-pod);
            }
            for (std::size_t i = 0; value >= least && i < sizes.size(); ++i) {
                largest[i] = std::max(largest[i], pod_at(first, last, sizes[i]));
            }
        }
    }
    for (std::size_t i = 3; i < sizes.size(); ++i) {
        CHECK(band[i].upper == Approx(largest[i]).margin(6e-4));
    }
    CHECK(band[0].upper < 0.1);
    CHECK(band[1].upper < 0.1);
}

TEST_CASE("The band includes the floor where the best curve equals it to the last digit") {
    // Alarms of 500 gearboxes each: only the largest fault is detectable.
    const double tested[] = {0.0005, 0.001, 0.0015, 0.002, 0.003, 0.00428};
    const double hits[] = {25, 18, 37, 25, 25, 122};
    const HitMissTable table = test::tabulated(6, [&](int i) {
        return HitMissRow{tested[i], hits[i], 500};
    });
    const PodForm form{GENERATE(Link::logit, Link::probit), GENERATE(false, true), 3.0 / 61.0,
                       false};
    INFO(link_name(form.link) << (form.log_size ? " of log size" : " of size"));
    const PodLikelihood likelihood(table, form);
    const auto sizes = test::tabulated(41, [](int i) { return 0.0005 + 0.00378 * i / 40; });
    for (const PodPoint& point :
         pod_band(likelihood, likelihood.maximise(), sizes, one_sided_bound(0.95))) {
        INFO(point.size);
        CHECK(point.lower >= form.floor);
        CHECK(point.upper >= point.pod);
        // The bound is above every observed rate except that of the largest fault.
        CHECK(point.upper < (point.size < 0.003 ? 37.0 / 500.0 : 0.3));
    }
}

TEST_CASE("The curve of least AIC keeps the floor and the ceiling that generated the data") {
    const HitMissPod pod = hit_miss_pod(levels(), {0.05, 0.95, 9});
    CHECK(pod.refusal == "");
    CHECK(pod.chosen.curve.form.free_ceiling);
    CHECK(!pod.doubtful);
    CHECK(pod.candidates.size() == 12);
    REQUIRE(pod.band.size() == 9);
    for (const PodPoint& point : pod.band) {
        CHECK((point.lower <= point.pod && point.pod <= point.upper));
    }
}

TEST_CASE("Outcomes that determine no curve are refused with the reason") {
    const auto refusal = [](const HitMissTable& table) {
        const HitMissPod pod = hit_miss_pod(table, {});
        CHECK(pod.a90.estimate.where != Where::reached);
        CHECK(pod.band.empty());
        return pod.refusal;
    };
    CHECK_THAT(refusal({}), Catch::Contains("no faulty gearbox has a value"));
    CHECK_THAT(refusal({{1.0, 0.0, 9.0}, {2.0, 0.0, 9.0}}),
               Catch::Contains("was detected: a90 is not"));
    CHECK_THAT(refusal({{1.0, 9.0, 9.0}, {2.0, 9.0, 9.0}}), Catch::Contains("every faulty"));
    CHECK_THAT(refusal({{1.0, 4.0, 9.0}}), Catch::Contains("only one fault size"));
    CHECK_THAT(refusal({{1.0, 0.0, 9.0}, {2.0, 9.0, 9.0}}), Catch::Contains("do not overlap"));
    // One mixed size between misses and hits does not determine the slope either.
    CHECK_THAT(refusal({{1.0, 0.0, 9.0}, {2.0, 4.0, 9.0}, {3.0, 9.0, 9.0}}),
               Catch::Contains("do not overlap"));
    CHECK_THAT(refusal({{1.0, 7.0, 9.0}, {2.0, 3.0, 9.0}, {3.0, 2.0, 9.0}}),
               Catch::Contains("does not rise"));
}

TEST_CASE("a90 is not extrapolated beyond the tested sizes") {
    const HitMissTable weak{{1.0, 2.0, 50.0}, {2.0, 6.0, 50.0}, {3.0, 9.0, 50.0}};
    const HitMissPod far = hit_miss_pod(weak, {});
    CHECK(far.a90.estimate.where == Where::not_reached);
    CHECK(far.a90.upper.where == Where::not_reached);
    CHECK(std::isnan(far.a90.estimate.size));
    const HitMissTable strong{{1.0, 45.0, 50.0}, {2.0, 48.0, 50.0}, {3.0, 49.0, 50.0}};
    const HitMissPod near = hit_miss_pod(strong, {});
    CHECK(near.a50.estimate.where == Where::below_tested);
    CHECK(near.a90.upper.where == Where::reached);
}

TEST_CASE("A ceiling below 0.9 leaves a90 unreached however large the fault") {
    HitMissTable table;
    for (int i = 1; i <= 12; ++i) {
        const double pod = 0.02 + 0.68 / (1.0 + std::exp(-3.0 * (0.5 * i - 2.0)));
        table.push_back({0.5 * i, std::round(300.0 * pod), 300.0});
    }
    const HitMissPod pod = hit_miss_pod(table, {0.02, 0.95, 5});
    CHECK(pod.chosen.curve.form.free_ceiling);
    CHECK(pod.chosen.curve.ceiling == Approx(0.7).margin(0.02));
    CHECK(pod.a50.estimate.where == Where::reached);
    CHECK(pod.a90.estimate.where == Where::not_reached);
}

TEST_CASE("Sizes are not binned: a size split into near-equal ones gives the same curve") {
    HitMissTable split;
    for (const HitMissRow& row : levels()) {
        for (int i = 0; i < 20; ++i) {
            const double share = row.hits / row.tests;
            split.push_back({row.size * (1.0 + 1e-9 * i), share * 20.0, 20.0});
        }
    }
    const PodForm form{Link::probit, true, 0.05, true};
    const PodCurve whole = fit_hit_miss(levels(), form).curve;
    const PodCurve parts = fit_hit_miss(split, form).curve;
    CHECK(parts.slope == Approx(whole.slope).epsilon(1e-5));
    CHECK(parts.ceiling == Approx(whole.ceiling).epsilon(1e-6));
}

TEST_CASE("Hosmer-Lemeshow keeps its level for a true curve and rejects a wrong one") {
    // Two hundred sizes of one gearbox each make ten groups.
    HitMissTable right, wrong;
    for (int i = 1; i <= 200; ++i) {
        const double size = 0.02 * i;
        // Outcomes from a low-discrepancy sequence, so that counts follow their rates closely.
        const double draw = std::fmod(0.5 + i * 0.6180339887498949, 1.0);
        right.push_back({size, draw < 1.0 / (1.0 + std::exp(4.0 - 2.0 * size)) ? 1.0 : 0.0, 1.0});
        wrong.push_back({size, size > 1.0 && size < 2.0 ? 1.0 : (draw < 0.3 ? 1.0 : 0.0), 1.0});
    }
    const PodForm form{Link::logit, false, 0.0, false};
    const GoodnessOfFit good = fit_hit_miss(right, form).fit;
    CHECK(good.test == GoodnessOfFit::Test::hosmer_lemeshow);
    CHECK(good.degrees == 8);
    CHECK(good.p_value > 0.1);
    CHECK(fit_hit_miss(wrong, form).fit.p_value < 1e-6);
}

}  // namespace gearpod::analysis::test_hit_miss_pod
