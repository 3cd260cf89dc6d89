// Input that cannot be used, for functions that report problems by an exception.
#pragma once

#include <stdexcept>

namespace gearpod::mc {

// The message is what the program prints: one line per problem, without a final end of line.
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace gearpod::mc
