// Stiffness of one faulty tooth pair over its engagement, N/m, in smooth Chebyshev pieces.
// Positions are mesh periods since the start of the engagement.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/positions.hpp"

namespace gearpod::stiffness {

// Value type; threads may share its const members. The stiffness is zero between the pieces.
class ToothPairCurve {
  public:
    static constexpr int kMaxTerms = 40;
    struct Piece {
        double begin = 0, end = 0;  // mesh periods
        int terms = 0;
        std::array<double, kMaxTerms> coefficients{};
    };

    // Stiffness at ascending positions (to 1e-10) within a stretch; at its ends the limits from
    // within. Evaluating positions one by one gives the same bits.
    void operator()(std::span<const double> tau, const Stretch& stretch,
                    std::span<double> stiffness) const;
    // Stiffness over the whole engagement; at jumps, the limit from above.
    void operator()(std::span<const double> tau, std::span<double> stiffness) const;
    double operator()(double tau) const;

    const std::vector<Piece>& pieces() const { return pieces_; }

  private:
    friend class ToothPairFit;
    std::vector<Piece> pieces_;
};

// Fits tooth pair curves by Chebyshev interpolation.
class ToothPairFit {
  public:
    // stiffness(tau, values): N/m at ascending positions strictly within a smooth piece.
    using Stiffness = std::function<void(std::span<const double>, std::span<double>)>;

    // tolerance: absolute error in N/m, reached if 40 terms per piece suffice.
    explicit ToothPairFit(double tolerance) : tolerance_(tolerance) {}
    // Fits the curve on [0, contact_ratio], which is smooth between the breaks (ascending).
    ToothPairCurve operator()(const Stiffness& stiffness, std::span<const double> breaks,
                              double contact_ratio) const;

  private:
    void add_piece(ToothPairCurve& curve, const Stiffness& stiffness, double begin, double end,
                   int cuts) const;

    double tolerance_;
    ChebyshevTransform transform_{ToothPairCurve::kMaxTerms};
};

// Integral of a piecewise smooth curve from its start, as Chebyshev series.
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
