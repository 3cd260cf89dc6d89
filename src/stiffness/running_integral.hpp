// Integral of a piecewise smooth curve from its start, as Chebyshev series.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "stiffness/teeth/chebyshev.hpp"

namespace gearpod::stiffness {

class RunningIntegral {
  public:
    // curve(t, inside, values): values at ascending t of a piece, with `inside` strictly within it.
    using Curve = std::function<void(std::span<const double>, double inside, std::span<double>)>;

    // Integral over [points.front(), points.back()] of a curve that is smooth between the points
    // (ascending). Pieces whose series have not decayed below `tolerance` (absolute, of the curve)
    // are halved, up to eight times.
    RunningIntegral(const Curve& curve, std::span<const double> points, double tolerance);

    // Integral at ascending t; 0 before the first point, whole() after the last.
    void operator()(std::span<const double> t, std::span<double> values) const;
    double whole() const { return whole_; }

  private:
    void add_piece(const Curve& curve, double begin, double end, double tolerance, int halvings);

    std::vector<ChebyshevSeries> pieces_;
    double whole_ = 0;
};

}  // namespace gearpod::stiffness
