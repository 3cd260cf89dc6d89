// Checks correlated random inputs against closed forms of the Gaussian copula.
#include "analysis/statistics/rank_statistics.hpp"
#include "mc/plan/sampling.hpp"
#include "tests/mc/plan/random_samples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_correlations {

using namespace tests;
using tests::samples_of;

constexpr double kRank = 0.6;

const std::string kTorque = "random.operation.torque_N_m=";
const std::string kMass = "random.gearbox.planet.mass_kg=";
const std::string kCarrier = "random.gearbox.carrier.mass_kg=";

std::string pair_of(const std::string& first, const std::string& second, const std::string& rank) {
    return "{between=['" + first + "','" + second + "'],rank=" + rank + "}";
}
const std::string kPairOf =
    "random.correlations=[" +
    pair_of("operation.torque_N_m", "gearbox.planet.mass_kg", std::to_string(kRank)) + "]";

StudyReading reading_of(const std::vector<std::string>& overrides) {
    return read_study_text(kExampleStudy, "study.toml", overrides);
}

struct Pairs {
    std::vector<double> torque, mass, exponent;
};
Pairs draw(const std::vector<std::string>& overrides, std::uint64_t count) {
    const StudyReading reading = reading_of(overrides);
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    const Sampler sampler(DrawPlan{*reading.study});
    Pairs pairs;
    for (std::uint64_t i = 0; i < count; ++i) {
        const InstanceInputs inputs = sampler.draw({Group::test, i}).inputs;
        pairs.torque.push_back(inputs.torque_N_m);
        pairs.mass.push_back(inputs.bodies[Member::planet].mass_kg);
        pairs.exponent.push_back(inputs.path_exponent);
    }
    return pairs;
}

double pearson(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    double mx = 0.0, my = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mx += x[i] / n;
        my += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
        xy += (x[i] - mx) * (y[i] - my);
    }
    return xy / std::sqrt(xx * yy);
}

double spearman(const std::vector<double>& x, const std::vector<double>& y) {
    using gearpod::analysis::midranks;
    return pearson(midranks(x), midranks(y));
}

// The single problem of a study with these overrides.
std::string problem_of(const std::vector<std::string>& overrides) {
    const StudyReading reading = reading_of(overrides);
    REQUIRE(reading.problems.size() == 1);
    return format(reading.problems);
}

TEST_CASE("Correlated inputs have the requested rank correlation and their own distributions") {
    constexpr std::uint64_t kCount = 20000;
    const double error = 4.0 / std::sqrt(static_cast<double>(kCount));
    const double r = 2.0 * std::sin(std::numbers::pi / 6.0 * kRank);

    SECTION("normal ones: Pearson's equals that of the normals") {
        const Pairs pairs = draw({kTorque + "{distribution='normal',mean=400,sd=20}",
                                  kMass + "{distribution='normal',mean=2,sd=0.1}", kPairOf},
                                 kCount);
        CHECK(spearman(pairs.torque, pairs.mass) == Approx(kRank).margin(error));
        CHECK(pearson(pairs.torque, pairs.mass) == Approx(r).margin(error));
        CHECK(spearman(pairs.torque, pairs.exponent) == Approx(0.0).margin(error));
        CHECK(kolmogorov_smirnov(pairs.mass, [](double x) {
                  return 0.5 * std::erfc((2.0 - x) / (0.1 * std::numbers::sqrt2));
              }) < kKsLimit);
    }
    SECTION("lognormal ones: Pearson's is in closed form") {
        constexpr double kTorqueCv = 0.5, kMassCv = 0.3;
        const Pairs pairs = draw({kTorque + "{distribution='lognormal',median=400,cv=0.5}",
                                  kMass + "{distribution='lognormal',median=2,cv=0.3}", kPairOf},
                                 kCount);
        const double s = std::sqrt(std::log1p(kTorqueCv * kTorqueCv)),
                     t = std::sqrt(std::log1p(kMassCv * kMassCv));
        CHECK(spearman(pairs.torque, pairs.mass) == Approx(kRank).margin(error));
        CHECK(pearson(pairs.torque, pairs.mass) ==
              Approx(std::expm1(r * s * t) / (kTorqueCv * kMassCv)).margin(2.0 * error));
        CHECK(kolmogorov_smirnov(pairs.torque, [&](double x) {
                  return 0.5 * std::erfc(-std::log(x / 400.0) / (s * std::numbers::sqrt2));
              }) < kKsLimit);
    }
    SECTION("any: rank correlation follows the law") {
        for (const char* law : {"'uniform',low=1,high=3", "'triangular',low=1,mode=1.2,high=3",
                                "'weibull',scale=2,shape=3", "'beta',low=1,high=3,alpha=2,beta=5",
                                "'truncated-normal',mean=2,sd=1,low=1,high=3"}) {
            INFO(law);
            const std::string text = std::string("{distribution=") + law + "}";
            const Pairs pairs = draw(
                {kTorque + "{distribution='normal',mean=400,sd=20}", kMass + text, kPairOf}, 5000);
            CHECK(spearman(pairs.torque, pairs.mass) == Approx(kRank).margin(2.0 * error));
            const Distribution mass = distribution_of(text);
            // Its quantiles have their nominal frequency.
            for (const double share : {0.1, 0.5, 0.9}) {
                const auto below = std::ranges::count_if(
                    pairs.mass, [&](double x) { return x <= mass.quantile(share); });
                CHECK(static_cast<double>(below) / 5000.0 == Approx(share).margin(0.02));
            }
            std::vector<double> drawn = samples_of(text, 5000);
            std::ranges::nth_element(drawn, drawn.begin() + 4000);
            CHECK(mass.quantile(0.8) == Approx(drawn[4000]).epsilon(0.03));
        }
    }
}

TEST_CASE("Lists keep their frequencies when they are correlated") {
    const Pairs pairs =
        draw({kTorque + "{distribution='discrete',values=[300,100,200],weights=[1,2,5]}",
              kMass + "{distribution='empirical',values=[3,1,1,2]}", kPairOf},
             20000);
    for (const auto& [value, share] : {std::pair{100.0, 0.25}, {200.0, 0.625}, {300.0, 0.125}}) {
        CHECK(static_cast<double>(std::ranges::count(pairs.torque, value)) / 20000.0 ==
              Approx(share).margin(0.015));
    }
    CHECK(static_cast<double>(std::ranges::count(pairs.mass, 1.0)) / 20000.0 ==
          Approx(0.5).margin(0.015));
    CHECK(spearman(pairs.torque, pairs.mass) > 0.4);  // ties lower it
}

TEST_CASE("A correlation leaves the random values of other inputs unchanged") {
    const std::vector<std::string> laws = {kTorque + "{distribution='normal',mean=400,sd=20}",
                                           kMass + "{distribution='normal',mean=2,sd=0.1}"};
    std::vector<std::string> correlated = laws;
    correlated.push_back(kPairOf);
    CHECK(draw(laws, 50).exponent == draw(correlated, 50).exponent);
    CHECK(draw(laws, 50).mass != draw(correlated, 50).mass);
    // The written study contains the correlation.
    const Study study = *reading_of(correlated).study;
    CHECK(read_study_text(resolved_text(study), "again.toml").study == study);
    // A value for all gearboxes removes it.
    const std::string of_study =
        "random.correlations=[" +
        pair_of("gearbox.planet.bearing_stiffness_N_m", "sensor.path_exponent", "0.5") + "]";
    CHECK(reading_of({of_study}).study->correlations.size() == 1);
    const StudyReading reading = reading_of({of_study, "sensor.path_exponent=0.2"});
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    CHECK(reading.study->correlations.empty());
}

TEST_CASE("Impossible correlations are refused") {
    const std::string mass = kMass + "{distribution='normal',mean=2,sd=0.1}";
    const std::string torque = kTorque + "{distribution='normal',mean=400,sd=20}";
    const auto list = [](const std::string& pairs) { return "random.correlations=" + pairs; };
    const std::string t = "operation.torque_N_m", m = "gearbox.planet.mass_kg",
                      c = "gearbox.carrier.mass_kg";
    const auto has = [](const std::string& text, const char* part) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    };
    has(problem_of({torque, mass, kCarrier + "{distribution='normal',mean=10,sd=1}",
                    list("[" + pair_of(t, m, "0.9") + "," + pair_of(t, c, "0.9") + "," +
                         pair_of(m, c, "-0.9") + "]")}),
        "not positive definite");
    has(problem_of({torque, list("[" + pair_of(t, m, "0.5") + "]")}),
        "pair 1: gearbox.planet.mass_kg is not random");
    has(problem_of({torque, mass, list("[" + pair_of(t, t, "0.5") + "]")}), "name two inputs");
    has(problem_of({torque, mass, list("[" + pair_of(t, m, "1") + "]")}), "> -1 and < 1");
    has(problem_of(
            {torque, mass, list("[" + pair_of(t, m, "0.5") + "," + pair_of(m, t, "0.4") + "]")}),
        "pair 2: gearbox.planet.mass_kg and operation.torque_N_m are correlated already");
    has(problem_of({torque, list("[" + pair_of(t, "fault.depth_mm", "0.5") + "]")}),
        "is the fault size");
    has(problem_of({torque, kMass + "{distribution='levels',values=[1,2]}",
                    list("[" + pair_of(t, m, "0.5") + "]")}),
        "takes its values in turn");
    has(problem_of({torque, kMass + "{distribution='empirical',values=[1,2],rows=3}",
                    list("[" + pair_of(t, m, "0.5") + "]")}),
        "sampled by row");
    has(problem_of({torque, mass, list("[" + pair_of(t, m, "0.5").insert(1, "with=1,") + "]")}),
        "unknown key with");
    has(problem_of({torque, mass, list("3")}), "must be a list of pairs");
}

}  // namespace gearpod::mc::test_correlations
