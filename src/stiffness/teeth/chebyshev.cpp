#include "stiffness/teeth/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::stiffness {

ChebyshevTransform::ChebyshevTransform(int n)
    : points_(n), matrix_(static_cast<std::size_t>(n) * n) {
    for (int i = 0; i < n; ++i) {
        const double angle = std::numbers::pi * (2 * i + 1) / (2 * n);
        points_[i] = std::cos(angle);
        for (int j = 0; j < n; ++j)
            matrix_[static_cast<std::size_t>(i) * n + j] =
                (j == 0 ? 1.0 : 2.0) / n * std::cos(j * angle);
    }
}

void ChebyshevTransform::fit(std::span<const double> values, std::span<double> coefficients) const {
    const int n = size();
    std::fill_n(coefficients.begin(), n, 0.0);
    for (int i = 0; i < n; ++i) {
        const double* row = matrix_.data() + static_cast<std::size_t>(i) * n;
        for (int j = 0; j < n; ++j)
            coefficients[j] += values[i] * row[j];
    }
}

int chebyshev_terms(std::span<const double> coefficients, double tolerance) {
    int terms = static_cast<int>(coefficients.size());
    double dropped = 0;
    while (terms > 1 && dropped + std::abs(coefficients[terms - 1]) < tolerance)
        dropped += std::abs(coefficients[--terms]);
    return terms;
}

ChebyshevSeries::ChebyshevSeries(const std::function<double(double)>& f, double begin, double end,
                                 int n, double relative_tolerance)
    : begin_(begin), end_(end), coefficients_(n) {
    const ChebyshevTransform transform(n);
    std::vector<double> values(n);
    double largest = 0;
    for (int i = 0; i < n; ++i) {
        values[i] = f(0.5 * (begin + end) + 0.5 * (end - begin) * transform.points()[i]);
        largest = std::max(largest, std::abs(values[i]));
    }
    transform.fit(values, coefficients_);
    coefficients_.resize(chebyshev_terms(coefficients_, relative_tolerance * largest));
}

double ChebyshevSeries::operator()(double t) const {
    double value = 0;
    (*this)({&t, 1}, {&value, 1});
    return value;
}

ChebyshevSeries ChebyshevSeries::integral_of(std::span<const double> coefficients, double begin,
                                             double end, double value) {
    // Integral of T_j: T_(j+1) / 2 (j+1) - T_(j-1) / 2 (j-1); of T_0: T_1.
    const std::size_t n = coefficients.size();
    const auto c = [&](std::size_t j) { return j < n ? coefficients[j] : 0.0; };
    ChebyshevSeries sum(0.0, begin, end);
    sum.coefficients_.resize(n + 1);
    double at_begin = 0;
    for (std::size_t j = 1; j <= n; ++j) {
        const double before = j == 1 ? 2 * c(0) : c(j - 1);
        const double coefficient =
            0.5 * (end - begin) * (before - c(j + 1)) / (2 * static_cast<double>(j));
        sum.coefficients_[j] = coefficient;
        at_begin += j % 2 == 0 ? coefficient : -coefficient;
    }
    sum.coefficients_[0] = value - at_begin;
    return sum;
}

double ChebyshevSeries::integral() const {
    // Integral of T_j over [-1, 1]: 2 / (1 - j^2) for even j, 0 for odd j.
    double sum = 0;
    for (std::size_t j = 0; j < coefficients_.size(); j += 2)
        sum += coefficients_[j] * 2 / (1 - static_cast<double>(j) * static_cast<double>(j));
    return sum * 0.5 * (end_ - begin_);
}

}  // namespace gearpod::stiffness
