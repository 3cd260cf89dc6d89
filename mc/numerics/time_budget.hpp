// Remaining processor time of a measurement. No new part is started when it has run out.
#pragma once

#include <cmath>

#include "machine/clocks.hpp"

namespace gearpod::mc {

class TimeBudget {
  public:
    // `seconds` 0: no limit.
    explicit TimeBudget(double seconds)
        : end_s_(seconds > 0.0 ? thread_processor_s() + seconds : INFINITY) {}

    double seconds() const { return end_s_ - thread_processor_s(); }
    bool enough(double needed_s = 0.0) const { return seconds() > needed_s; }

  private:
    double end_s_;
};

}  // namespace gearpod::mc
