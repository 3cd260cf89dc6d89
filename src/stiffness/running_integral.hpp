// The integral of a piecewise smooth curve from its beginning on, as Chebyshev series.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "stiffness/teeth/chebyshev.hpp"

namespace gearpod::stiffness {

class RunningIntegral {
  public:
    // curve(t, inside, values) at ascending t of a piece that `inside` lies strictly within.
    using Curve = std::function<void(std::span<const double>, double inside, std::span<double>)>;

    // Over [points.front(), points.back()], smooth between the points (ascending). Pieces whose
    // series do not end below `tolerance` (of the curve, absolute) are halved, up to eight times.
    RunningIntegral(const Curve& curve, std::span<const double> points, double tolerance);

    // At ascending t; 0 before the first point, whole() behind the last.
    void operator()(std::span<const double> t, std::span<double> values) const;
    double whole() const { return whole_; }

  private:
    void add_piece(const Curve& curve, double begin, double end, double tolerance, int halvings);

    std::vector<ChebyshevSeries> pieces_;
    double whole_ = 0;
};

}  // namespace gearpod::stiffness
