// Boost.Math policy that returns NaN or infinity where an argument or a result is out of range,
// instead of throwing. One unusual value must not end the analysis of a finished run.
#pragma once

#include <boost/math/policies/policy.hpp>

namespace gearpod::analysis {

namespace boost_policies = boost::math::policies;
using QuietPolicy =
    boost_policies::policy<boost_policies::domain_error<boost_policies::ignore_error>,
                           boost_policies::pole_error<boost_policies::ignore_error>,
                           boost_policies::overflow_error<boost_policies::ignore_error>,
                           boost_policies::rounding_error<boost_policies::ignore_error>,
                           boost_policies::evaluation_error<boost_policies::ignore_error>>;
// The same without 80-bit intermediate values, for functions that take time.
using QuietDoublePolicy =
    boost_policies::normalise<QuietPolicy, boost_policies::promote_double<false>>::type;

}  // namespace gearpod::analysis
