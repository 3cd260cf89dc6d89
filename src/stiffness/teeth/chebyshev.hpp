// Chebyshev series on an interval, built from values at Chebyshev points and evaluated by
// Clenshaw's recurrence.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace gearpod::stiffness {

// Writes values[i] = sum_j c_j T_j(x), x = (2 t - begin - end) / (end - begin), for t = t[i].
// Values below `least` are raised to it. Fused operations are explicit, so that all instruction
// sets and any number of points give the same bits.
void evaluate_chebyshev(std::span<const double> coefficients, double begin, double end,
                        std::span<const double> t, std::span<double> values,
                        double least = -std::numeric_limits<double>::infinity());

// Interpolation at the n Chebyshev points of the first kind.
class ChebyshevTransform {
  public:
    explicit ChebyshevTransform(int n);
    int size() const { return static_cast<int>(points_.size()); }
    // Points cos(pi (2 i + 1) / 2 n), i = 0..n-1, descending from 1 to -1.
    const std::vector<double>& points() const { return points_; }
    // Computes the n coefficients of the interpolant of the n values at points().
    void fit(std::span<const double> values, std::span<double> coefficients) const;

  private:
    std::vector<double> points_;
    std::vector<double> matrix_;  // [i * n + j]: weight of value i in coefficient j
};

// Number of leading terms for which the sum of the dropped coefficients is below tolerance
// (absolute).
int chebyshev_terms(std::span<const double> coefficients, double tolerance);

// Number of nodes and tolerance for the curves of healthy teeth over an engagement.
inline constexpr int kSeriesNodes = 48;
inline constexpr double kSeriesTolerance = 1e-13;

class ChebyshevSeries {
  public:
    ChebyshevSeries() = default;
    // Interpolates f on [begin, end] with n points and drops terms below relative_tolerance of the
    // largest value.
    ChebyshevSeries(const std::function<double(double)>& f, double begin, double end, int n,
                    double relative_tolerance);
    // Constant series.
    ChebyshevSeries(double value, double begin, double end)
        : begin_(begin), end_(end), coefficients_{value} {}

    double operator()(double t) const;
    void operator()(std::span<const double> t, std::span<double> values) const {
        evaluate_chebyshev(coefficients_, begin_, end_, t, values);
    }
    // Integral of the series with these coefficients on [begin, end], as a series with `value` at
    // begin.
    static ChebyshevSeries integral_of(std::span<const double> coefficients, double begin,
                                       double end, double value);
    // Integral over [begin, end].
    double integral() const;
    double begin() const { return begin_; }
    double end() const { return end_; }
    std::span<const double> coefficients() const { return coefficients_; }

  private:
    double begin_ = 0, end_ = 1;
    std::vector<double> coefficients_;
};

}  // namespace gearpod::stiffness
