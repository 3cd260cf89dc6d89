// Bounds of a POD curve from a line through responses that cover their confidence in small tables.
// A bound of the POD at a size is exceeded by the true POD with probability 1 - confidence. Where
// it crosses a POD, it bounds the size.
#pragma once

#include <memory>

#include "analysis/pod/response_bounds.hpp"
#include "analysis/pod/simulated_responses.hpp"

namespace gearpod::analysis {

// Exact bounds for least squares on one scale without censored or repeated values: the line's
// distance from the threshold over its standard error follows a noncentral t distribution with
// n - 2 degrees of freedom. D. B. Owen, Technometrics 10 (1968), 445-478.
std::unique_ptr<ResponseBounds> exact_bounds(const SignalResponseFit& fit, double threshold,
                                             Alarm alarm, double confidence);

// Bounds with the limits of simulated tables.
std::unique_ptr<ResponseBounds> simulated_bounds(const SignalResponseFit& fit, double threshold,
                                                 Alarm alarm,
                                                 std::shared_ptr<const SimulatedLimits> limits);

}  // namespace gearpod::analysis
