// Files that are either absent, old or complete: written to a temporary in the same folder, flushed
// to the disk, then renamed. A symbolic link stays, and the file it names is written. What exists
// and is not a regular file (device, pipe, socket) is refused, not replaced.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gearpod::mc {

// Throws std::runtime_error naming the path and the reason (not writable, not a regular file, disk
// full); then the file at `path` is as it was and the temporary is gone.
void write_file(const std::string& path, std::span<const std::byte> bytes);

// Why write_file(path) could not work (folder missing, read-only, path is a folder or a device),
// or "".
// Leaves no file behind and an existing file as it was.
std::string why_not_writable(const std::string& path);

// The file that a chain of symbolic links ends at, whether it exists or not; the links themselves
// where the chain has no end.
std::string behind_links(std::string path);

}  // namespace gearpod::mc
