// Integrity hash of a results file. It stands in the HDF5 user block, the first 512 bytes, which
// other programs keep when they open the file for writing. It is checked before HDF5 opens the
// file, because the library may crash or hang on a damaged one: its string heap has no checksum.
//
//   0   "gearpod\n"
//   8   FNV-1a (64 bits, little-endian) of all bytes from 16 on
//   16  zeros up to 512
//
// Files of format version 2 have no user block. Mark and hash of all bytes before them are their
// last 16 bytes, which HDF5 cuts when another program opens the file for writing. The bit by which
// HDF5 marks a file as open for writing is excluded from the hash.
#pragma once

#include <cstddef>
#include <string>

namespace gearpod::mc {

inline constexpr std::size_t kUserBlockBytes = 512;

// truncated: the file ends before the end that HDF5 has noted in it. missing: a file without mark
// in a user block or at its end.
enum class ChecksumState { intact, broken, truncated, missing };

// Writes the hash of the bytes of an open file: into its user block, or behind the HDF5 part of a
// file that has none. Replaces an older hash. Returns false and sets errno if reading or writing
// fails.
bool write_checksum(int fd);

// Checks the file at `path`; missing if it cannot be read.
ChecksumState check_file_checksum(const std::string& path);

// True if another program has locked the file, as HDF5 does while it is open for writing.
bool is_open_for_writing(const std::string& path);

}  // namespace gearpod::mc
