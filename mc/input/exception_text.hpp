// What to tell of an exception that nobody has put into words.
#pragma once

#include <exception>
#include <string>

namespace gearpod::mc {

// Its own words, or that the memory is exhausted, whose exceptions have none.
std::string exception_text(const std::exception& error);

}  // namespace gearpod::mc
