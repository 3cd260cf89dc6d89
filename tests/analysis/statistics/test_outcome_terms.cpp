// Checks the vectorised terms of binomial likelihoods against scalar link functions, finite
// differences and other instruction sets.
#include "analysis/statistics/outcome_terms.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_outcome_terms {

constexpr OutcomeCurve kCurves[] = {{Link::logit, 0.0, 1.0},    {Link::probit, 0.05, 1.0},
                                    {Link::probit, 0.0, 1.0},   {Link::cloglog, 0.01, 0.97},
                                    {Link::loglog, 0.01, 0.97}, {Link::loglog, 0.0, 1.0}};

struct Terms {
    std::vector<double> log_probability, slope, information;
};

Terms terms_of(const OutcomeCurve& curve, const std::vector<double>& eta,
               const std::vector<char>& yes) {
    Terms terms;
    for (std::vector<double>* values : {&terms.log_probability, &terms.slope, &terms.information}) {
        values->resize(eta.size());
    }
    outcome_terms(curve, static_cast<long>(eta.size()), eta.data(), yes.data(),
                  terms.log_probability.data(), terms.slope.data(), terms.information.data());
    return terms;
}

LikelihoodSums sums_of(const OutcomeLine& line, bool yes, const std::vector<double>& u,
                       const std::vector<double>& weight) {
    LikelihoodSums sums;
    add_outcomes(line, yes, static_cast<long>(u.size()), u.data(), weight.data(), sums);
    return sums;
}

std::vector<double> evenly(double low, double high, int count) {
    return test::tabulated(count, [&](int i) { return low + (high - low) * i / (count - 1); });
}

TEST_CASE("Terms of outcomes agree with the link functions from tail to tail") {
    const std::vector<double> eta = evenly(-25.0, 25.0, 1003);
    for (const OutcomeCurve& curve : kCurves) {
        for (const char yes : {char{0}, char{1}}) {
            CAPTURE(link_name(curve.link), curve.floor, static_cast<int>(yes));
            const Terms terms = terms_of(curve, eta, std::vector<char>(eta.size(), yes));
            const double rise = curve.ceiling - curve.floor;
            int compared = 0;
            for (std::size_t i = 0; i < eta.size(); ++i) {
                const LinkValues at = link_values(curve.link, eta[i]);
                const double hit = curve.floor + rise * at.up;
                const double miss = (1.0 - curve.ceiling) + rise * at.down;
                if (!(hit * miss > 1e-280)) {
                    continue;
                }
                ++compared;
                const double own = yes ? hit : -miss, by_eta = rise * at.density;
                CHECK(terms.log_probability[i] ==
                      Approx(std::log(std::abs(own))).epsilon(1e-12).margin(1e-15));
                CHECK(terms.slope[i] == Approx(by_eta / own).epsilon(1e-12).margin(1e-300));
                CHECK(terms.information[i] ==
                      Approx(by_eta / hit * (by_eta / miss)).epsilon(1e-12).margin(1e-300));
            }
            CHECK(compared > 300);
        }
    }
}

TEST_CASE("Sums over outcomes have the derivatives of their value") {
    const std::vector<double> u = evenly(-2.0, 3.0, 21), weight = evenly(1.0, 4.0, 21);
    for (const OutcomeCurve& curve :
         {kCurves[3], kCurves[4], OutcomeCurve{Link::probit, 0.1, 0.9}}) {
        for (const bool yes : {false, true}) {
            CAPTURE(link_name(curve.link), yes);
            const OutcomeLine line{curve, -0.4, 1.3};
            const LikelihoodSums sums = sums_of(line, yes, u, weight);
            constexpr double kStep = 1e-6;
            const auto slope_along = [&](double OutcomeLine::*part) {
                OutcomeLine more = line, less = line;
                more.*part += kStep;
                less.*part -= kStep;
                return (sums_of(more, yes, u, weight).value - sums_of(less, yes, u, weight).value) /
                       (2.0 * kStep);
            };
            CHECK(sums.by_first == Approx(slope_along(&OutcomeLine::intercept)).epsilon(1e-7));
            CHECK(sums.by_slope == Approx(slope_along(&OutcomeLine::slope)).epsilon(1e-7));
            OutcomeLine more = line, less = line;
            more.curve.ceiling += kStep;
            less.curve.ceiling -= kStep;
            CHECK(sums.by_ceiling == Approx((sums_of(more, yes, u, weight).value -
                                             sums_of(less, yes, u, weight).value) /
                                            (2.0 * kStep))
                                         .epsilon(1e-7));
        }
    }
}

TEST_CASE("Sums over outcomes are those of the single outcomes") {
    const std::vector<double> u = evenly(-4.0, 4.0, 21), weight = evenly(1.0, 4.0, 21);
    for (const OutcomeCurve& curve : kCurves) {
        const OutcomeLine line{curve, 0.3, 0.9, 0.5, -0.2};
        const LikelihoodSums all = sums_of(line, true, u, weight);
        LikelihoodSums single;
        for (std::size_t i = 0; i < u.size(); ++i) {
            add_outcomes(line, true, 1, &u[i], &weight[i], single);
        }
        CHECK(all.value == Approx(single.value).epsilon(1e-13));
        CHECK(all.by_first == Approx(single.by_first).epsilon(1e-13));
        CHECK(all.first_slope == Approx(single.first_slope).epsilon(1e-12));
        CHECK(all.slope_slope == Approx(single.slope_slope).epsilon(1e-13));
        CHECK(all.slope_ceiling == Approx(single.slope_ceiling).epsilon(1e-12));
    }
}

TEST_CASE("Terms and sums have the same bits on all instruction sets") {
    using namespace gearpod;
    const std::vector<double> u = evenly(-9.0, 9.0, 101), weight = evenly(1.0, 4.0, 101);
    const std::vector<char> yes(u.size(), 1);
    for (const OutcomeCurve& curve : kCurves) {
        const OutcomeLine line{curve, 0.3, 0.9};
        const Terms terms = terms_of(curve, u, yes);
        const LikelihoodSums sums = sums_of(line, true, u, weight);
        test::for_each_instruction_set([&] {
            const Terms other = terms_of(curve, u, yes);
            CHECK(other.log_probability == terms.log_probability);
            CHECK(other.slope == terms.slope);
            CHECK(other.information == terms.information);
            const LikelihoodSums again = sums_of(line, true, u, weight);
            CHECK(again.value == sums.value);
            CHECK(again.slope_slope == sums.slope_slope);
            CHECK(again.first_ceiling == sums.first_ceiling);
        });
    }
}

}  // namespace gearpod::analysis::test_outcome_terms
