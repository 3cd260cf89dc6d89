// Quadrature over the part of a crack's length that a contact sees. Positions t from 0 to 1.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace gearpod::stiffness {

// Gauss points in panels of eight. Integrals end anywhere in a panel: the integrand is interpolated
// through the panel's points.
class SliceRule {
  public:
    explicit SliceRule(int slices);
    const std::vector<double>& points() const { return points_; }
    // Writes the weights for the integral over all of [0, 1].
    void whole(std::span<double> weights) const;
    // The same over the parts where seen(t) > 0, whose zeros are at least 1 / samples apart.
    void where(const std::function<double(double)>& seen, int samples,
               std::span<double> weights) const;

  private:
    void add_part(std::size_t panel, double from, double to, std::span<double> weights) const;

    std::size_t panels_;
    std::vector<double> points_;
};

}  // namespace gearpod::stiffness
