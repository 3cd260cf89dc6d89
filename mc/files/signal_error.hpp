#pragma once

#include <stdexcept>

namespace gearpod::mc {

// Problem with a signal file; the message names the file and the place.
class SignalError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace gearpod::mc
