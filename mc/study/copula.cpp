#include "mc/study/copula.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numbers>

namespace gearpod::mc {

Copula::Copula(const Study& study) {
    if (study.correlations.empty()) {
        return;
    }
    for (const RandomInput& input : study.random) {
        const bool has = std::ranges::any_of(study.correlations, [&](const Correlation& one) {
            return one.first == input.key || one.second == input.key;
        });
        has_.push_back(has ? 1 : 0);
        if (has) {
            keys_.push_back(input.key);
        }
    }
    const auto count = static_cast<Eigen::Index>(keys_.size());
    const auto place = [&](const std::string& key) {
        return std::ranges::find(keys_, key) - keys_.begin();
    };
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(count, count);
    for (const Correlation& one : study.correlations) {
        const auto i = place(one.first), j = place(one.second);
        matrix(i, j) = matrix(j, i) = 2.0 * std::sin(std::numbers::pi / 6.0 * one.rank);
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    exists_ = cholesky.info() == Eigen::Success;
    factor_ = cholesky.matrixL();
}

std::vector<double> Copula::shares(
    const std::function<Philox(const std::string& key)>& stream) const {
    std::vector<double> normals, shares;
    for (const std::string& key : keys_) {
        Philox engine = stream(key);
        normals.push_back(boost::random::normal_distribution<double>()(engine));
    }
    // In order, not by Eigen: the same bits on every machine.
    for (std::size_t i = 0; i < normals.size(); ++i) {
        double z = 0.0;
        for (std::size_t j = 0; j <= i; ++j) {
            z += factor_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * normals[j];
        }
        constexpr double kLeast = 0x1p-53;
        shares.push_back(
            std::clamp(0.5 * std::erfc(-z / std::numbers::sqrt2), kLeast, 1.0 - kLeast));
    }
    return shares;
}

}  // namespace gearpod::mc
