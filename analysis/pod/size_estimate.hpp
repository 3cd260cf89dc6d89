// Sizes and probabilities derived from a POD curve, each with its one-sided bounds.
#pragma once

#include <limits>

namespace gearpod::analysis {

// Size at which the curve reaches a POD. Curves are not extrapolated beyond the tested sizes.
struct SizeEstimate {
    enum class Where { reached, below_tested, not_reached };
    Where where = Where::not_reached;
    double size = 0.0;  // if reached, otherwise NaN
};

// Ordering: below the tested sizes < reached < not reached.
inline double place_of(const SizeEstimate& estimate) {
    using Where = SizeEstimate::Where;
    return estimate.where == Where::below_tested ? -std::numeric_limits<double>::infinity()
           : estimate.where == Where::reached    ? estimate.size
                                                 : std::numeric_limits<double>::infinity();
}

inline SizeEstimate estimate_within(double size, double smallest, double largest) {
    if (!(size <= largest)) {
        return {SizeEstimate::Where::not_reached, std::numeric_limits<double>::quiet_NaN()};
    }
    return size < smallest ? SizeEstimate{SizeEstimate::Where::below_tested,
                                          std::numeric_limits<double>::quiet_NaN()}
                           : SizeEstimate{SizeEstimate::Where::reached, size};
}

struct SizeBounds {
    SizeEstimate estimate;
    SizeEstimate lower;  // one-sided
    SizeEstimate upper;  // one-sided: a90/95 for a90 at 95 %
};

struct PodPoint {
    double size = 0.0;
    double pod = 0.0;
    double lower = 0.0;  // lower and upper are one-sided
    double upper = 0.0;
};

}  // namespace gearpod::analysis
