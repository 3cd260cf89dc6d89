// Stiffness of one faulty tooth pair from the start of its engagement to the end, N/m, in smooth
// Chebyshev pieces. Positions in mesh periods since the engagement began.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/stretch.hpp"

namespace gearpod::stiffness {

// A value; const members may be shared by threads. Zero between its pieces.
class ToothPairCurve {
  public:
    static constexpr int kMaxTerms = 40;
    struct Piece {
        double begin = 0, end = 0;  // mesh periods
        int terms = 0;
        std::array<double, kMaxTerms> coefficients{};
    };

    // Stiffness at ascending positions (to 1e-10) within a stretch; at its ends the limits from
    // within. Same bits one by one.
    void operator()(std::span<const double> tau, const Stretch& stretch,
                    std::span<double> stiffness) const;
    // Over the whole engagement; where it jumps, the limit from above.
    void operator()(std::span<const double> tau, std::span<double> stiffness) const;
    double operator()(double tau) const;

    const std::vector<Piece>& pieces() const { return pieces_; }

  private:
    friend class ToothPairFit;
    std::vector<Piece> pieces_;
};

// Interpolates curves.
class ToothPairFit {
  public:
    // stiffness(tau, values): N/m at ascending positions strictly within a smooth piece.
    using Stiffness = std::function<void(std::span<const double>, std::span<double>)>;

    // tolerance: absolute error in N/m where 40 terms a piece suffice.
    explicit ToothPairFit(double tolerance) : tolerance_(tolerance) {}
    // On [0, contact_ratio], smooth between the breaks (ascending).
    ToothPairCurve operator()(const Stiffness& stiffness, std::span<const double> breaks,
                              double contact_ratio) const;

  private:
    void add_piece(ToothPairCurve& curve, const Stiffness& stiffness, double begin, double end,
                   int cuts) const;

    double tolerance_;
    ChebyshevTransform transform_{ToothPairCurve::kMaxTerms};
};

}  // namespace gearpod::stiffness
