// Crack growth by Paris' law, da/dN = C (Delta K)^m. P. C. Paris, F. Erdogan, J. Basic Eng. 85
// (1963), 528-533. The range is proportional to the load, Delta K = load k(a), so that load and
// depth separate. The integral of da / (C k(a)^m) from the first depth equals the sum of load^m
// over the cycles, in any order. The model has no threshold and no retardation by overloads.
#pragma once

#include <functional>
#include <vector>

namespace gearpod::stiffness {

struct ParisLaw {
    double factor = 0.0;    // C, m per cycle at a range of 1 Pa m^(1/2)
    double exponent = 0.0;  // m
};

// Paris' law from C in its usual unit, mm per cycle at 1 MPa m^(1/2).
ParisLaw paris_law_mm_MPa(double factor, double exponent);

class ParisGrowth {
  public:
    // range(depth): Delta K in Pa m^(1/2) for a load of 1, positive and continuous on [first,
    // last]. Throws std::invalid_argument unless 0 < first < last, C > 0 and the range is positive
    // there.
    ParisGrowth(const ParisLaw& law, std::function<double(double)> range, double first,
                double last);

    // Sum of load^m over the cycles that grow the crack from the first depth to `depth`, which is
    // clamped to [first, last].
    double damage_to(double depth) const;
    // Depth after a sum of load^m over cycles; the last depth if the sum exceeds damage_to(last).
    // NaN for NaN.
    double depth_after(double damage) const;
    // Sum of load^m over `cycles` cycles with this load.
    double damage_of(double load, double cycles) const;

  private:
    double rate_inverse(double depth) const;  // dD/da
    double between(double from, double to) const;

    ParisLaw law_;
    std::function<double(double)> range_;
    std::vector<double> depth_, damage_;  // nodes; the depths grow by a fixed ratio
};

}  // namespace gearpod::stiffness
