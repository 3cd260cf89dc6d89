// Turns floating-point exceptions into SIGFPE with glibc's feenableexcept. New threads inherit
// them.
#pragma once

#include <cfenv>

namespace gearpod::test {

inline constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

// Enables traps during its lifetime.
class FloatingPointTraps {
  public:
    FloatingPointTraps() : before_(fegetexcept()) {
        std::feclearexcept(FE_ALL_EXCEPT);
        feenableexcept(kTrapped);
    }
    ~FloatingPointTraps() { restore(before_); }
    FloatingPointTraps(const FloatingPointTraps&) = delete;
    FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

    static void restore(int excepts) {
        std::feclearexcept(FE_ALL_EXCEPT);
        fedisableexcept(FE_ALL_EXCEPT);
        feenableexcept(excepts);
    }

  private:
    int before_;
};

// Disables traps during its lifetime: a realization that is meant to diverge overflows before it is
// stopped.
class ExpectedOverflow {
  public:
    ExpectedOverflow() : before_(fedisableexcept(FE_ALL_EXCEPT)) {}
    ~ExpectedOverflow() { FloatingPointTraps::restore(before_); }
    ExpectedOverflow(const ExpectedOverflow&) = delete;
    ExpectedOverflow& operator=(const ExpectedOverflow&) = delete;

  private:
    int before_;
};

}  // namespace gearpod::test
