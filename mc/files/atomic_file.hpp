// Files that are either absent, old or complete. They are written to a temporary file in the same
// folder, flushed to the disk and renamed. Symbolic links are kept, and the file they refer to is
// written. An existing device, pipe or socket is an error and is not replaced.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace gearpod::mc {

// Throws std::runtime_error naming the path and the reason (not writable, not a regular file, disk
// full). In this case the file at `path` is unchanged and the temporary file is deleted.
void write_file(const std::string& path, std::span<const std::byte> bytes);

// File that is written in pieces under a temporary name and renamed when it is complete. There is
// one temporary name per path: a file left by a killed writer is reused. Two writers at the same
// time must be excluded by other means.
class PendingFile {
  public:
    // Throws std::runtime_error as write_file() does.
    explicit PendingFile(const std::string& path);
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    // Deletes the temporary file unless commit() was called.
    ~PendingFile();

    const std::string& name() const { return name_; }
    // Flushes `fd`, a descriptor of name(), and renames the file. Throws std::runtime_error.
    void commit(int fd);
    // Throws std::runtime_error with the reason of `error` (errno).
    [[noreturn]] void fail(int error) const;

  private:
    std::string path_, target_, name_;
};

// Reason why write_file(path) would fail (missing folder, read-only, path is a folder or a device),
// or "". Leaves no file behind and does not change an existing file.
std::string why_not_writable(const std::string& path);

// Reason why no PendingFile(path) can be written, or "": a link, a pipe, a device or a file with a
// second name has the temporary name.
std::string why_not_pending(const std::string& path);

// True if both names refer to the same file, after following links. Either file may not exist yet.
bool same_file(const std::string& one, const std::string& other);

// Creates `path` with this content and returns an open file descriptor. Returns -1 and sets errno
// (EEXIST) if the name exists. `prepare` may lock the file before it becomes visible.
int create_exclusively(const std::string& path, std::span<const std::byte> bytes,
                       const std::function<void(int)>& prepare);

// Target of a chain of symbolic links, whether it exists or not. Returns the last link followed if
// the chain has no end.
std::string resolve_links(std::string path);

}  // namespace gearpod::mc
