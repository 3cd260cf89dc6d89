// Program with kernels of other widths and instruction sets in addition to those of a user's build.
#pragma once

#include "tests/mc/program.hpp"

namespace gearpod::test {

inline Outcome compared_program(const std::string& arguments) {
    return shell(std::string(GEARPOD_COMPARED_PROGRAM) + " " + arguments);
}

}  // namespace gearpod::test
