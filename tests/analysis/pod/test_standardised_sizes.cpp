// Checks few nodes in place of many sizes: moments, and log likelihoods of curves of any slope.
#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/pod_likelihood.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_standardised_sizes {

// Table with one size per gearbox, with outcomes from a curve of this slope at its midpoint.
HitMissTable drawn(int count, double slope, double floor, double ceiling, std::mt19937_64& engine) {
    std::uniform_real_distribution<double> uniform;
    std::vector<double> sizes;
    std::vector<char> hits;
    for (int i = 0; i < count; ++i) {
        const double size = 4.28 * (1.0 - uniform(engine));
        const double rate = link_probability(Link::logit, slope * (size - 2.0));
        sizes.push_back(size);
        hits.push_back(uniform(engine) < floor + (ceiling - floor) * rate ? 1 : 0);
    }
    return hit_miss_table(sizes, hits);
}

TEST_CASE("nodes of any width keep the sizes' count, mean and variance, and are fewer") {
    std::mt19937_64 engine(1);
    const HitMissTable table = drawn(9000, 2.0, 0.05, 1.0, engine);
    for (const bool log_size : {false, true}) {
        const StandardisedSizes sizes(table, log_size);
        for (const double width : {0.01, 0.1, 0.5, 1.0, 4.0, 20.0}) {
            const SizeNodes& nodes = sizes.nodes(width);
            CAPTURE(log_size, width, nodes.u.size());
            CHECK(nodes.weight.sum() == Approx(9000.0).epsilon(1e-12));
            CHECK(nodes.weight.head(nodes.hits).sum() == Approx(total_hits(table)).epsilon(1e-12));
            CHECK(nodes.weight.minCoeff() > 0.0);
            CHECK(std::abs((nodes.weight * nodes.u).sum()) < 1e-8);
            CHECK((nodes.weight * nodes.u.square()).sum() == Approx(9000.0).epsilon(1e-12));
            CHECK(nodes.cell <= width);
        }
        CHECK(sizes.nodes(1e-9).u.size() == 9000);
        CHECK(sizes.nodes(0.5).u.size() < 600);
    }
}

TEST_CASE("sizes tested at few levels stay unchanged") {
    const HitMissTable table = test::tabulated(12, [](int i) {
        return HitMissRow{0.3 * (i + 1), 41.0 + i, 100.0};
    });
    const StandardisedSizes sizes(table, false);
    CHECK(sizes.nodes(100.0).cell == 0.0);
    CHECK(sizes.nodes(100.0).u.size() == 24);
}

// The sum over all gearboxes in long double.
double log_likelihood(const HitMissTable& table, const PodCurve& curve) {
    long double sum = 0.0L;
    const long double rise = curve.ceiling - curve.form.floor;
    for (const HitMissRow& row : table) {
        const long double eta =
            curve.intercept + static_cast<long double>(curve.slope) * curve.form.scaled(row.size);
        const bool logit = curve.form.link == Link::logit;
        const auto up = [&](long double at) {
            return logit ? 1.0L / (1.0L + std::exp(-at)) : 0.5L * std::erfc(-at / std::sqrt(2.0L));
        };
        const double misses = row.tests - row.hits;
        if (row.hits > 0.0) {
            sum += row.hits * std::log(curve.form.floor + rise * up(eta));
        }
        if (misses > 0.0) {
            sum += misses * std::log(1.0L - curve.ceiling + rise * up(-eta));
        }
    }
    return static_cast<double>(sum);
}

TEST_CASE("log likelihoods over nodes equal those over all gearboxes, for flat and steep curves") {
    std::mt19937_64 engine(2);
    for (const double slope : {0.2, 1.0, 4.0, 15.0, 60.0, 300.0}) {
        for (const double floor : {0.0, 0.002, 0.05}) {
            for (const double ceiling : {0.95, 1.0}) {
                const HitMissTable table = drawn(8000, slope, floor, ceiling, engine);
                for (const Link link : {Link::logit, Link::probit}) {
                    for (const bool log_size : {false, true}) {
                        const PodForm form{link, log_size, floor, ceiling < 1.0};
                        const PodLikelihood likelihood(table, form);
                        const auto maximum = likelihood.maximise();
                        const PodCurve curve = likelihood.curve(maximum.parameters);
                        CAPTURE(slope, floor, ceiling, link_name(link), log_size, curve.slope);
                        CHECK(maximum.log_likelihood ==
                              Approx(log_likelihood(table, curve)).epsilon(0.0).margin(2e-8));
                    }
                }
            }
        }
    }
}

}  // namespace gearpod::analysis::test_standardised_sizes
