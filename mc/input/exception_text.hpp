// Message for an exception that has not been translated into a problem.
#pragma once

#include <exception>
#include <string>

namespace gearpod::mc {

// what(), or a message about exhausted memory for the exceptions that report it.
std::string exception_text(const std::exception& error);

}  // namespace gearpod::mc
