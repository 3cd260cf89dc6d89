// Contracts: EXPECTS(condition) states a precondition, ENSURES(condition) a property of the result.
// Builds with the cmake option GEARPOD_CONTRACTS check them; elsewhere they are compiled but never
// evaluated. Inner loops of kernels have none.
#pragma once

#include <stdexcept>
#include <string>

namespace gearpod::machine {

// A violated contract is a mistake in the program, not in its input.
class ContractViolation : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

[[noreturn]] inline void violated(const char* kind, const char* condition, const char* file,
                                  int line) {
    throw ContractViolation(std::string(file) + ":" + std::to_string(line) + ": " + kind + " " +
                            condition + " is violated");
}

}  // namespace gearpod::machine

// Throws ContractViolation unless the condition holds.
#define GEARPOD_CHECK_CONTRACT(kind, ...) \
    ((__VA_ARGS__) ? static_cast<void>(0) \
                   : ::gearpod::machine::violated(kind, #__VA_ARGS__, __FILE__, __LINE__))
#ifdef GEARPOD_CONTRACTS
#    define EXPECTS(...) GEARPOD_CHECK_CONTRACT("precondition", __VA_ARGS__)
#    define ENSURES(...) GEARPOD_CHECK_CONTRACT("postcondition", __VA_ARGS__)
#else
#    define EXPECTS(...) static_cast<void>(false && (__VA_ARGS__))
#    define ENSURES(...) static_cast<void>(false && (__VA_ARGS__))
#endif
