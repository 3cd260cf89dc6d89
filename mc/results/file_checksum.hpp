// Checksum of a results file, stored after the HDF5 part. It is checked before HDF5 opens the file,
// because the library may crash or hang on a damaged one: its string heap has no checksum.
#pragma once

#include <string>

namespace gearpod::mc {

enum class ChecksumState { intact, broken, missing };

// Appends the checksum to an open file: a mark of 8 bytes and FNV-1a (64 bits, little-endian) of
// all bytes before it. Returns false and sets errno if reading or writing fails.
bool append_checksum(int fd);

// Checks the file at `path`; missing if it cannot be read.
ChecksumState check_file_checksum(const std::string& path);

}  // namespace gearpod::mc
