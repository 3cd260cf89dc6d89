// Checks the POD of inspections against statsmodels and scipy (reference/inspection_py.txt).
#include "analysis/inspection.hpp"
#include "tests/analysis/pod/inspection_examples.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_inspection {

using Where = SizeEstimate::Where;

TEST_CASE("Curves of all four links on both scales agree with statsmodels") {
    struct Row {
        Link link;
        bool log_size;
        double intercept, slope, log_likelihood;
    };
    const Row rows[] = {{Link::logit, false, -1.3988831, 1.3869358, -110.5673},
                        {Link::probit, false, -0.84769121, 0.83433678, -109.55589},
                        {Link::cloglog, false, -1.2860353, 0.84333228, -107.81749},
                        {Link::loglog, false, -0.63764937, 1.0799087, -111.89968},
                        {Link::logit, true, 0.35684475, 1.5953206, -117.33361},
                        {Link::probit, true, 0.22245301, 0.97465261, -116.44635},
                        {Link::cloglog, true, -0.24516164, 1.115555, -113.33023},
                        {Link::loglog, true, 0.75834497, 1.1143122, -119.61515}};
    for (const Row& row : rows) {
        const HitMissPod pod = inspect(hits(false), of_hits(row.link, row.log_size)).hit_miss;
        INFO(link_name(row.link) << row.log_size);
        REQUIRE(pod.refusal == "");
        CHECK(pod.chosen.curve.intercept == Approx(row.intercept).epsilon(3e-6));
        CHECK(pod.chosen.curve.slope == Approx(row.slope).epsilon(3e-6));
        CHECK(pod.chosen.log_likelihood == Approx(row.log_likelihood).epsilon(1e-7));
    }
}

TEST_CASE("The confidence-bound conventions are chi-squared 2.71, 3.84 and 5.99") {
    const std::pair<BoundConvention, double> rows[] = {{BoundConvention::one_sided, 3.0141444},
                                                       {BoundConvention::two_sided, 3.1112525},
                                                       {BoundConvention::handbook, 3.1112525},
                                                       {BoundConvention::joint, 3.2757382}};
    for (const auto& [convention, upper] : rows) {
        InspectionRequest request = of_hits(Link::logit, false);
        request.convention = convention;
        const HitMissPod pod = inspect(hits(false), request).hit_miss;
        CHECK(pod.a90.estimate.size == Approx(2.5928436).epsilon(1e-6));
        CHECK(pod.a90.upper.size == Approx(upper).epsilon(1e-6));
    }
}

TEST_CASE("Repeated inspections have the robust covariance of clusters") {
    InspectionRequest request = of_hits(Link::logit, false);
    request.convention = BoundConvention::one_sided;
    const InspectionResult result = inspect(hits(true), request);
    CHECK(result.specimens == 120);
    CHECK(result.repeats == 120);
    CHECK(result.hit_miss.rule.method == BoundMethod::wald);
    CHECK(result.hit_miss.a90.upper.size == Approx(2.8961093).epsilon(1e-6));
    std::vector<ClusteredOutcome> outcomes;
    const Inspections data = hits(true);
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        outcomes.push_back({data.size[i], data.value[i] != 0.0, data.specimen[i]});
    }
    const Eigen::Matrix2d robust = curve_covariance(outcomes, result.hit_miss.chosen.curve, true);
    CHECK(robust(0, 0) == Approx(0.094167383).epsilon(1e-6));
    CHECK(robust(0, 1) == Approx(-0.043159172).epsilon(1e-6));
    CHECK(robust(1, 1) == Approx(0.029010306).epsilon(1e-6));
}

TEST_CASE("Firth's penalty gives a curve where hits and misses do not overlap") {
    Inspections data;
    for (int i = 1; i <= 20; ++i) {
        data.size.push_back(i);
        data.value.push_back(i > 10 ? 1.0 : 0.0);
        data.specimen.push_back(i);
    }
    InspectionRequest request = of_hits(Link::logit, false);
    CHECK_THAT(inspect(data, request).hit_miss.refusal, Catch::Contains("do not overlap"));
    request.firth = true;
    request.convention = BoundConvention::handbook;
    const HitMissPod pod = inspect(data, request).hit_miss;
    REQUIRE(pod.refusal == "");
    CHECK(pod.chosen.curve.intercept == Approx(-8.9500545).epsilon(1e-5));
    CHECK(pod.chosen.curve.slope == Approx(0.85238615).epsilon(1e-5));
    CHECK(pod.a90.estimate.size == Approx(13.077734).epsilon(5e-6));
    CHECK(pod.a90.upper.size == Approx(19.473016).epsilon(1e-5));
}

TEST_CASE("Random specimen effects agree with statsmodels' mixed model") {
    const InspectionResult result = inspect(responses(true), of_responses());
    const SignalResponsePod& pod = result.signal_response;
    REQUIRE(pod.refusal == "");
    CHECK(pod.specimens == 40);
    const ResponseModel& model = pod.candidates[pod.chosen].model;
    CHECK(model.intercept == Approx(0.3029509).epsilon(1e-5));
    CHECK(model.slope == Approx(1.2604825).epsilon(1e-6));
    CHECK(model.between == Approx(0.15421262).epsilon(1e-4));
    CHECK(model.within == Approx(0.33216108).epsilon(1e-5));
    CHECK(model.covariance(0, 0) == Approx(0.010554059).epsilon(1e-3));
    CHECK(model.covariance(0, 1) == Approx(-0.0058927106).epsilon(1e-3));
    CHECK(model.covariance(1, 1) == Approx(0.003841114).epsilon(1e-3));
}

TEST_CASE("Censored responses, and likelihood-ratio bounds of their POD, agree with scipy") {
    InspectionRequest request = of_responses();
    request.limits = {3.0, 20.0};
    request.convention = BoundConvention::one_sided;
    request.method = BoundMethod::likelihood_ratio;
    const SignalResponsePod pod = inspect(responses(false), request).signal_response;
    REQUIRE(pod.refusal == "");
    const ResponseModel& model = pod.candidates[pod.chosen].model;
    CHECK(model.intercept == Approx(0.066045001).epsilon(1e-5));
    CHECK(model.slope == Approx(1.3606659).epsilon(1e-6));
    CHECK(model.sigma == Approx(0.32789997).epsilon(1e-6));
    CHECK(pod.a90.estimate.size == Approx(4.8409999).epsilon(1e-6));
    CHECK(pod.a90.upper.size == Approx(5.4181964).epsilon(1e-5));
    // The band's bound at that size equals the POD itself.
    request.method = BoundMethod::wald;
    const SignalResponsePod wald = inspect(responses(false), request).signal_response;
    CHECK(wald.curve.eta_at(std::log(wald.a90.upper.size), wald.rule.limit()) ==
          Approx(link_quantile(Link::probit, 0.9)));
}

TEST_CASE("The likelihood of censored and repeated responses matches a dense integral") {
    // Two values of one specimen, one at or below a limit: the integral over the specimen effect by
    // a fine sum.
    std::vector<Response> data;
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 40; ++i) {
        const double b = 0.7 * normal(engine);
        for (int m = 0; m < 3; ++m) {
            const double y = 1.0 + 0.5 * i + b + 0.5 * normal(engine);
            data.push_back({static_cast<double>(i), std::max(4.0, y), y <= 4.0 ? -1 : 0, i});
        }
    }
    const ResponseLikelihood likelihood(data, true);
    const auto maximum = likelihood.maximise();
    REQUIRE(maximum.converged);
    const ResponseModel model = likelihood.model(maximum);
    const auto log_likelihood = [&](double between) {
        double sum = 0.0;
        for (std::size_t first = 0; first < data.size(); first += 3) {
            double density = 0.0;
            for (double u = -8.0; u < 8.0; u += 0.002) {
                double product = std::exp(-0.5 * u * u) / std::sqrt(2.0 * M_PI) * 0.002;
                for (std::size_t i = first; i < first + 3; ++i) {
                    const double z = (data[i].y - model.at(data[i].x) - between * u) / model.within;
                    product *= data[i].censored != 0 ? link_probability(Link::probit, z)
                                                     : link_density(Link::probit, z) / model.within;
                }
                density += product;
            }
            sum += std::log(density);
        }
        return sum;
    };
    const double here = log_likelihood(model.between);
    CHECK(here > log_likelihood(1.02 * model.between));
    CHECK(here > log_likelihood(0.98 * model.between));
    CHECK(maximum.log_likelihood == Approx(here).epsilon(1e-5));
}

TEST_CASE("Box and Cox's power and the noise laws agree with scipy") {
    const Inspections data = responses(false);
    const auto power = box_cox_power({data.size, data.value, {}}, true, {}, false);
    CHECK(*power == Approx(-0.18186023).epsilon(1e-4));
    const std::vector<double> noise{1.1, 0.4, 2.3, 0.9, 1.7, 0.6, 3.1, 1.3, 0.8, 2.0, 1.5, 0.5};
    const auto laws = fit_noise_distributions(noise);
    REQUIRE(laws.size() == 4);
    CHECK(laws.front().kind == NoiseDistribution::Kind::lognormal);
    CHECK(laws.front().aic == Approx(4.0 + 2.0 * 12.553268).epsilon(1e-6));
    const auto weibull = std::find_if(laws.begin(), laws.end(), [](const NoiseDistribution& law) {
        return law.kind == NoiseDistribution::Kind::weibull;
    });
    CHECK(weibull->first == Approx(1.5280063).epsilon(1e-4));
    CHECK(weibull->second == Approx(1.845346).epsilon(1e-4));
    CHECK(weibull->aic == Approx(4.0 + 2.0 * 12.766475).epsilon(1e-6));
    for (const NoiseDistribution& law : laws) {
        CHECK(law.above(law.exceeded_by(0.03)) == Approx(0.03));
        CHECK(law.below(1.3) + law.above(1.3) == Approx(1.0));
    }
}

TEST_CASE("The reported number of further specimens brings the bound to the target") {
    InspectionRequest request = of_hits(Link::logit, false);
    request.target = 2.8;
    Inspections data = hits(false);
    const double factor = inspect(data, request).hit_miss.specimens_factor;
    CHECK(factor > 2.0);
    // Repeats the same table so many times, rounded either way.
    const auto upper_of = [&](int times) {
        Inspections many;
        for (int t = 0; t < times; ++t) {
            many.size.insert(many.size.end(), data.size.begin(), data.size.end());
            many.value.insert(many.value.end(), data.value.begin(), data.value.end());
        }
        for (std::size_t i = 0; i < many.size.size(); ++i) {
            many.specimen.push_back(static_cast<long>(i));
        }
        return inspect(many, request).hit_miss.a90.upper.size;
    };
    CHECK(upper_of(static_cast<int>(std::floor(factor))) > 2.8);
    CHECK(upper_of(static_cast<int>(std::ceil(factor))) < 2.8);
    request.target = 2.0;  // below a90 itself
    CHECK(std::isinf(inspect(data, request).hit_miss.specimens_factor));
    CHECK(inspect(data, request).all_found == 29);
}

TEST_CASE(
    "A lower threshold trades false calls for smaller sizes, and a rate determines the threshold") {
    Inspections data = responses(true);
    std::mt19937 engine(3);
    std::lognormal_distribution<double> noise(0.2, 0.3);
    for (int i = 0; i < 60; ++i) {
        data.size.push_back(0.0);
        data.value.push_back(noise(engine));
        data.specimen.push_back(1000 + i);
    }
    InspectionRequest request = of_responses();
    request.threshold.reset();
    CHECK_THAT(inspect(data, request).refusal, Catch::Contains("no threshold"));
    request.false_call_rate = 0.01;
    const InspectionResult result = inspect(data, request);
    REQUIRE(result.refusal == "");
    CHECK(result.without_flaw == 60);
    CHECK(result.noise.front().above(result.threshold) == Approx(0.01));
    REQUIRE(result.trade_off.size() > 10);
    for (std::size_t i = 1; i < result.trade_off.size(); ++i) {
        const TradeOffPoint &a = result.trade_off[i - 1], &b = result.trade_off[i];
        CHECK(a.threshold < b.threshold);
        CHECK(a.false_calls > b.false_calls);
        if (a.a90.estimate.where == Where::reached && b.a90.estimate.where == Where::reached) {
            CHECK(a.a90.estimate.size < b.a90.estimate.size);
            CHECK(a.a90.upper.size > a.a90.estimate.size);
        }
    }
}

TEST_CASE("Inspections without a flaw determine the floor of hit/miss curves") {
    Inspections data = hits(false);
    for (int i = 0; i < 50; ++i) {
        data.size.push_back(0.0);
        data.value.push_back(i < 5 ? 1.0 : 0.0);
        data.specimen.push_back(1000 + i);
    }
    const InspectionResult result = inspect(data, of_hits(Link::logit, false));
    CHECK(result.false_calls == 5);
    REQUIRE(result.hit_miss.candidates.size() == 2);
    CHECK(result.hit_miss.candidates[1].curve.form.floor == Approx(0.1));
    CHECK(result.false_call_bounds.lower == Approx(0.0332751).epsilon(1e-4));  // scipy's beta.ppf
    // If all of them are hits, hits say nothing.
    std::fill(data.value.end() - 50, data.value.end(), 1.0);
    CHECK(inspect(data, of_hits(Link::logit, false)).hit_miss.refusal ==
          "all 50 specimens without a flaw count as hits, so hits say nothing about flaws");
}

}  // namespace gearpod::analysis::test_inspection
