// Checks the default bounds of `pod` against scipy (reference/inspection_py.txt) and against
// properties that they must have. Their coverage is measured in test_pod_coverage.cpp.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/inspection.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/response_bounds.hpp"
#include "analysis/report/inspection_report.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/analysis/pod/inspection_examples.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_calibrated_bounds {

// First `count` of the responses.
Inspections first_responses(std::size_t count) {
    Inspections data = responses(false);
    data.size.resize(count);
    data.value.resize(count);
    data.specimen.resize(count);
    return data;
}

TEST_CASE("Exact bounds agree with scipy's noncentral t, and simulated ones with them") {
    const SignalResponsePod pod = inspect(first_responses(12), of_responses()).signal_response;
    REQUIRE(pod.refusal == "");
    CHECK(pod.rule.method == BoundMethod::exact);
    CHECK(pod.a50.lower.size == Approx(2.8129684).epsilon(1e-6));
    CHECK(pod.a50.upper.size == Approx(3.4963071).epsilon(1e-6));
    CHECK(pod.a90.lower.size == Approx(3.6562181).epsilon(1e-6));
    CHECK(pod.a90.upper.size == Approx(4.9671246).epsilon(1e-6));
    // The band crosses a POD of 0.9 where the size's bound lies.
    const SignalResponseFit& fit = pod.candidates[pod.chosen];
    const auto exact = exact_bounds(fit, 6.0, Alarm::high, 0.95);
    CHECK(exact->point(4.9671246).lower == Approx(0.9).epsilon(1e-5));
    CHECK(exact->point(3.6562181).upper == Approx(0.9).epsilon(1e-5));
    CHECK(exact->specimens(0.9, 4.9671246) == Approx(1.0).epsilon(1e-3));
    // One given scale, so that simulated limits have nothing else to account for.
    const Inspections data = first_responses(12);
    SignalResponseRequest request;
    request.threshold = 6.0;
    request.method = LineMethod::maximum_likelihood;
    request.log_sizes = {true};
    request.powers = {0.0};
    request.accept_failed_checks = true;
    const auto limits = std::make_shared<const SimulatedLimits>(
        ResponseRows{data.size, data.value, data.specimen}, false, fit, request);
    CHECK(limits->tables() == 1000);
    const auto simulated = simulated_bounds(fit, 6.0, Alarm::high, limits);
    const SizeBounds a90 = simulated->size(0.9, data.size[0] / 100.0, 8.66);
    CHECK(a90.upper.size == Approx(4.9671246).epsilon(0.02));
    CHECK(a90.lower.size == Approx(3.6562181).epsilon(0.02));
}

TEST_CASE("Default bounds of responses span scales, and repeat to the bit") {
    InspectionRequest request;
    request.responses = true;
    request.threshold = 6.0;
    request.limits = {3.0, 20.0};
    const SignalResponsePod a = inspect(responses(false), request).signal_response;
    const SignalResponsePod b = inspect(responses(false), request).signal_response;
    REQUIRE(a.refusal == "");
    CHECK(a.rule.method == BoundMethod::calibrated);
    CHECK(a.a90.upper.size == b.a90.upper.size);
    CHECK(a.growing_coverage == b.growing_coverage);
    CHECK(a.growing_answered >= 0.0);
    request.convention = BoundConvention::handbook;
    const SignalResponsePod handbook = inspect(responses(false), request).signal_response;
    CHECK(handbook.a90.estimate.size == Approx(a.a90.estimate.size));
    CHECK(handbook.a90.upper.size < a.a90.upper.size);
    CHECK(handbook.simulated_coverage > 0.75);
    CHECK(handbook.simulated_coverage < 0.97);
}

TEST_CASE("Few clusters never narrow the bound of a90") {
    // 60 flaws in three groups, hit from a size that differs between groups.
    Inspections alone;
    for (int i = 0; i < 60; ++i) {
        const double size = 0.1 * (i + 1);
        alone.size.push_back(size);
        alone.value.push_back(size + 0.9 * std::sin(2.1 * i) + 0.5 * (i % 3 - 1) > 2.5);
        alone.specimen.push_back(i);
    }
    Inspections grouped = alone;
    for (std::size_t i = 0; i < grouped.specimen.size(); ++i) {
        grouped.specimen[i] = static_cast<long>(i % 3);
    }
    const InspectionRequest request = of_hits(Link::logit, false);
    const HitMissPod independent = inspect(alone, request).hit_miss;
    const HitMissPod clustered = inspect(grouped, request).hit_miss;
    REQUIRE(clustered.refusal == "");
    CHECK(clustered.clusters == 3);
    CHECK(clustered.design_effect >= 1.0);
    CHECK(clustered.a90.estimate.size == independent.a90.estimate.size);
    CHECK(place_of(clustered.a90.upper) > place_of(independent.a90.upper));
    for (std::size_t i = 0; i < grouped.specimen.size(); ++i) {
        grouped.specimen[i] = static_cast<long>(i % 2);
    }
    CHECK_THAT(inspect(grouped, request).hit_miss.refusal, Catch::Contains("need at least 3"));
    // Ten repeats of everything hold no more information if every specimen counts once.
    Inspections repeated;
    for (int r = 0; r < 10; ++r) {
        repeated.size.insert(repeated.size.end(), alone.size.begin(), alone.size.end());
        repeated.value.insert(repeated.value.end(), alone.value.begin(), alone.value.end());
        repeated.specimen.insert(repeated.specimen.end(), alone.specimen.begin(),
                                 alone.specimen.end());
    }
    InspectionRequest handbook = request;
    handbook.convention = BoundConvention::handbook;
    CHECK(inspect(repeated, handbook).hit_miss.a90.upper.size ==
          Approx(inspect(alone, handbook).hit_miss.a90.upper.size).epsilon(1e-6));
    CHECK(clustered_chi_squared(1.0, 1000000, 0.95) == Approx(2.7055).epsilon(1e-4));
}

// Responses 40 a / (a + 1.5) with scatter 1.2 sqrt(a), of sizes 0.3 to 4.
Inspections on_a_curve(int specimens, int repeats) {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> normal;
    Inspections data;
    for (int i = 0; i < specimens; ++i) {
        const double size = 0.3 + 3.7 * (i + 0.5) / specimens, shared = normal(engine);
        for (int r = 0; r < repeats; ++r) {
            const double own = normal(engine);
            const double e = repeats > 1 ? std::sqrt(0.8) * shared + std::sqrt(0.2) * own : shared;
            data.size.push_back(size);
            data.value.push_back(40.0 * size / (size + 1.5) + 1.2 * std::sqrt(size) * e);
            data.specimen.push_back(i);
        }
    }
    return data;
}

TEST_CASE("A curve is fitted where no line passes the checks") {
    InspectionRequest request;
    request.responses = true;
    request.threshold = 15.0;
    const InspectionResult found = inspect(on_a_curve(300, 1), request);
    REQUIRE_THAT(found.signal_response.refusal, Catch::Contains("no scale passes the checks"));
    REQUIRE(found.smooth.has_value());
    REQUIRE(found.smooth->refusal() == "");
    // 15 = 40 a / (a + 1.5) at 0.9; 1.28155 scatters further at 1.0625.
    CHECK(found.smooth->a50().estimate.size == Approx(0.9).epsilon(0.05));
    CHECK(found.smooth->a90().estimate.size == Approx(1.0625).epsilon(0.05));
    CHECK(found.smooth->a90().lower.size < found.smooth->a90().estimate.size);
    CHECK(found.smooth->a90().upper.size > found.smooth->a90().estimate.size);
    CHECK(found.smooth->growth() == Approx(0.5).margin(0.2));
    CHECK(found.smooth->scatter(1.0) == Approx(1.2).epsilon(0.2));
    double inside = 0.0;
    for (const PodPoint& point : found.smooth->band()) {
        const double truth = 40.0 * point.size / (point.size + 1.5) - 15.0;
        const double pod = link_probability(Link::probit, truth / (1.2 * std::sqrt(point.size)));
        CHECK(point.pod == Approx(pod).margin(0.08));
        CHECK(point.lower <= point.pod);
        CHECK(point.pod <= point.upper);
        inside += point.lower <= pod && pod <= point.upper ? 1.0 : 0.0;
    }
    CHECK(inside > 0.8 * static_cast<double>(found.smooth->band().size()));
    const std::string text = report_text(inspection_report(request, found, {"t", {}, "v", ""}));
    CHECK_THAT(text, Catch::Contains("monotone curve"));
    const auto json = inspection_json(on_a_curve(300, 1), request, found, {"t", {}, "v", ""});
    const auto& smooth = json["signal_response"]["smooth"];
    CHECK(smooth["band"]["pod"].size() == smooth["mean"].size());
    CHECK(smooth["mean"].front() == Approx(found.smooth->mean(found.smooth->smallest())));

    // Eight equal responses hold no more information than one.
    const Inspections once = on_a_curve(60, 1);
    ResponseRows rows{once.size, once.value, once.specimen}, eight;
    for (int r = 0; r < 8; ++r) {
        eight.size.insert(eight.size.end(), rows.size.begin(), rows.size.end());
        eight.value.insert(eight.value.end(), rows.value.begin(), rows.value.end());
        eight.specimen.insert(eight.specimen.end(), rows.specimen.begin(), rows.specimen.end());
    }
    const SmoothResponse alone(rows, 15.0, Alarm::high, 0.95);
    const SmoothResponse repeated(eight, 15.0, Alarm::high, 0.95);
    CHECK(repeated.correlation() == Approx(1.0).margin(1e-6));
    CHECK(repeated.a90().estimate.size == Approx(alone.a90().estimate.size).epsilon(1e-3));
    CHECK(repeated.a90().upper.size == Approx(alone.a90().upper.size).epsilon(0.02));

    // Falling responses of the opposite sign have the same sizes.
    for (double& value : rows.value) {
        value = -value;
    }
    const SmoothResponse falling(rows, -15.0, Alarm::low, 0.95);
    CHECK(falling.a90().upper.size == Approx(alone.a90().upper.size).epsilon(0.02));
    rows.size.resize(10);
    rows.value.resize(10);
    rows.specimen.resize(10);
    CHECK_THAT(SmoothResponse(rows, -15.0, Alarm::low, 0.95).refusal(),
               Catch::Contains("needs 15 specimens"));
}

TEST_CASE("The documented coverage is that printed next to the bounds") {
    std::ifstream stream(GEARPOD_TESTS_DIR "/../docs/validation/coverage.md");
    const std::string page(std::istreambuf_iterator<char>(stream), {});
    for (const MeasuredCoverage& row : kMeasuredCoverage) {
        const std::string line = fmt::format("| {} | {} | {} | {} | {} |", row.kind, row.specimens,
                                             row.tables, row.upper_per_cent, row.lower_per_cent);
        INFO(line);
        CHECK(test::contains(page, line));
    }
    const MeasuredCoverage* nearest = measured_coverage(kHits, 40);
    REQUIRE(nearest != nullptr);
    CHECK(nearest->specimens == 30);
    const InspectionResult found = inspect(hits(false), of_hits(Link::logit, false));
    const std::string text =
        report_text(inspection_report(of_hits(Link::logit, false), found, {"t", {}, "v", ""}));
    CHECK_THAT(text, Catch::Contains("In tables of known truth (hits, logit, "));
}

TEST_CASE("Values that are not finite, and few specimens, are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    InspectionRequest request = of_hits(Link::logit, false);
    request.floor = nan;
    request.confidence = nan;
    request.target = nan;
    Inspections data = hits(false);
    data.size[3] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(inspect(data, request),
                      Catch::Contains("sizes must be finite") && Catch::Contains("confidence") &&
                          Catch::Contains("target") && Catch::Contains("floor"));
    InspectionRequest line = of_responses();
    line.threshold = nan;
    line.false_call_rate = nan;
    line.limits.left = nan;
    CHECK_THROWS_WITH(inspect(responses(false), line), Catch::Contains("threshold") &&
                                                           Catch::Contains("false-call rate") &&
                                                           Catch::Contains("censoring limit"));
    Inspections few = responses(true);
    few.size.resize(27);
    few.value.resize(27);
    few.specimen.resize(27);
    InspectionRequest scales = of_responses();
    CHECK(inspect(few, scales).signal_response.refusal == "");
    scales.accept_failed_checks = false;
    CHECK_THAT(inspect(few, scales).signal_response.refusal,
               Catch::Contains("only 9 specimens with repeated values"));
}

}  // namespace gearpod::analysis::test_calibrated_bounds
