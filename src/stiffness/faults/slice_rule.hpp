// Quadrature over the part of a crack's length that affects a contact. Positions t range from 0 to
// 1.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace gearpod::stiffness {

// Gauss points in panels of eight. Integrals may end anywhere in a panel, because the integrand is
// interpolated through the panel's points.
class SliceRule {
  public:
    explicit SliceRule(int slices);
    const std::vector<double>& points() const { return points_; }
    // Writes the weights of the integral over all of [0, 1].
    void whole(std::span<double> weights) const;
    // Writes the weights of the integral over the parts where seen(t) > 0. `seen` is sampled at
    // samples / panels points of every panel, rounded down; of two zeros between neighbouring
    // points none is noticed.
    void where(const std::function<double(double)>& seen, int samples,
               std::span<double> weights) const;

  private:
    void add_part(std::size_t panel, double from, double to, std::span<double> weights) const;

    std::size_t panels_;
    std::vector<double> points_;
};

}  // namespace gearpod::stiffness
