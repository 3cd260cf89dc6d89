// Files that are either absent, old or complete: written to a temporary in the same folder, flushed
// to the disk, then renamed. A symbolic link stays, and the file it names is written. What exists
// and is not a regular file (device, pipe, socket) is refused, not replaced.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace gearpod::mc {

// Throws std::runtime_error naming the path and the reason (not writable, not a regular file, disk
// full); then the file at `path` is as it was and the temporary is gone.
void write_file(const std::string& path, std::span<const std::byte> bytes);

// A file that is written in pieces under another name and takes its own once it is whole. There is
// one such name for a path: what a killed writer left there is used again, and two writers at a
// time must be kept apart by other means.
class PendingFile {
  public:
    // Throws std::runtime_error as write_file() does.
    explicit PendingFile(const std::string& path);
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    // Without commit() nothing is left.
    ~PendingFile();

    const std::string& name() const { return name_; }
    // Flushes `fd`, which is open on name(), and renames. Throws std::runtime_error.
    void commit(int fd);
    // Throws std::runtime_error with the reason of `error` (errno).
    [[noreturn]] void fail(int error) const;

  private:
    std::string path_, target_, name_;
};

// Why write_file(path) could not work (folder missing, read-only, path is a folder or a device),
// or "".
// Leaves no file behind and an existing file as it was.
std::string why_not_writable(const std::string& path);

// Why no PendingFile(path) can be written: a link, a pipe, a device or a file with a second name is
// where it would be; or "".
std::string why_not_pending(const std::string& path);

// Whether two names, of which either may not exist yet, are those of one file, links followed.
bool same_file(const std::string& one, const std::string& other);

// Creates `path` with an open file of that text, unless something of that name is there: -1 with
// errno (EEXIST). `prepare` may lock the file, which nobody sees before.
int create_exclusively(const std::string& path, std::span<const std::byte> bytes,
                       const std::function<void(int)>& prepare);

// The file that a chain of symbolic links ends at, whether it exists or not; the links themselves
// where the chain has no end.
std::string behind_links(std::string path);

}  // namespace gearpod::mc
