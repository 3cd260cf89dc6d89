// A checksum behind the HDF5 part of a results file, where HDF5 does not look. The HDF5 library may
// crash or hang on a damaged file (its heap of strings has no checksum), so ours are checked first.
#pragma once

#include <string>

namespace gearpod::mc {

enum class Seal { intact, broken, missing };

// Appends the seal to an open file: a mark of 8 bytes and FNV-1a (64 bits, little-endian) of all
// bytes before it. False with errno if reading or writing fails.
bool append_seal(int fd);

// Of the file at `path`; missing if it cannot be read.
Seal check_seal(const std::string& path);

}  // namespace gearpod::mc
