#include "mc/study/copula.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::mc {

double standard_normal_cdf(double z) {
    constexpr double kLeast = 0x1p-53;
    return std::clamp(0.5 * std::erfc(-z / std::numbers::sqrt2), kLeast, 1.0 - kLeast);
}

Copula::Copula(const Study& study) {
    if (study.correlations.empty()) {
        return;
    }
    for (std::size_t i = 0; i < study.random.size(); ++i) {
        const std::string& key = study.random[i].key;
        const bool has = std::ranges::any_of(study.correlations, [&](const Correlation& pair) {
            return pair.first == key || pair.second == key;
        });
        has_.push_back(has ? 1 : 0);
        if (has) {
            inputs_.push_back(i);
        }
    }
    const auto count = static_cast<Eigen::Index>(inputs_.size());
    const auto index_of = [&](const std::string& key) {
        const auto found = std::ranges::find_if(
            inputs_, [&](std::size_t input) { return study.random[input].key == key; });
        return found - inputs_.begin();
    };
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(count, count);
    for (const Correlation& pair : study.correlations) {
        const auto i = index_of(pair.first), j = index_of(pair.second);
        matrix(i, j) = matrix(j, i) = 2.0 * std::sin(std::numbers::pi / 6.0 * pair.rank);
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    exists_ = cholesky.info() == Eigen::Success;
    factor_ = cholesky.matrixL();
}

std::vector<double> Copula::uniform_variates(
    const std::function<double(std::size_t input)>& normal) const {
    std::vector<double> normals, uniform_variates;
    for (const std::size_t input : inputs_) {
        normals.push_back(normal(input));
    }
    // Summed in a fixed order, not by Eigen, so that the bits are the same on every machine.
    for (std::size_t i = 0; i < normals.size(); ++i) {
        double z = 0.0;
        for (std::size_t j = 0; j <= i; ++j) {
            z += factor_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * normals[j];
        }
        uniform_variates.push_back(standard_normal_cdf(z));
    }
    return uniform_variates;
}

}  // namespace gearpod::mc
