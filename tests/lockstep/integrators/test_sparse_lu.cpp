// Checks sparse factors against the dense solver of Eigen.
#include "lockstep/integrators/implicit_lanes.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_sparse_lu {

// Arrow matrix: `spokes` blocks of two that couple only with the last three rows; not symmetric.
Eigen::MatrixXd arrow(int spokes, std::mt19937& engine) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const int n = 2 * spokes + 3;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const bool hub = i >= 2 * spokes || j >= 2 * spokes;
            if (hub || i / 2 == j / 2) {
                m(i, j) = uniform(engine) + (i == j ? 2.0 * n : 0.0);
            }
        }
    }
    return m;
}

// Solves A x = g with the algorithm of the lockstep stage.
Eigen::VectorXd solve(const SparseLu& lu, const Eigen::MatrixXd& f, Eigen::VectorXd x) {
    const auto substitute = [&](const SparseEntries& entries) {
        for (std::size_t e = 0; e < entries.to.size(); ++e) {
            x(entries.to[e]) -= f(entries.to[e], entries.from[e]) * x(entries.from[e]);
        }
    };
    substitute(lu.lower);
    x.array() /= f.diagonal().array();
    substitute(lu.upper);
    return x;
}

TEST_CASE("Sparse factors give the dense solution for any order of the rows") {
    std::mt19937 engine(1);
    for (const int spokes : {1, 4, 8}) {
        const Eigen::MatrixXd tidy = arrow(spokes, engine);
        Eigen::PermutationMatrix<Eigen::Dynamic> mix(tidy.rows());
        mix.setIdentity();
        std::shuffle(mix.indices().begin(), mix.indices().end(), engine);
        const Eigen::MatrixXd m = mix * tidy * mix.transpose();
        const SparseLu lu = eliminate(m);
        const Eigen::VectorXd g = Eigen::VectorXd::LinSpaced(m.rows(), -1.0, 2.0);
        const Eigen::VectorXd exact = m.partialPivLu().solve(g);
        CHECK((solve(lu, factors(lu, m), g) - exact).norm() < 1e-13 * exact.norm());
        // Elimination of an arrow from its spokes causes no fill-in: the factors have its entries.
        const int entries = static_cast<int>((m.array() != 0.0).count());
        CHECK(lu.lower.size() + lu.upper.size() + m.rows() == entries);
    }
}

TEST_CASE("Entries are the nonzero elements, column by column") {
    Eigen::MatrixXd m(2, 2);
    m << 1.0, 0.0, 3.0, -4.0;
    const SparseEntries entries = nonzero_entries(m);
    CHECK(entries.to == std::vector<int>{0, 1, 1});
    CHECK(entries.from == std::vector<int>{0, 0, 1});
}

}  // namespace gearpod::lockstep::test_sparse_lu
