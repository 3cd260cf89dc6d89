// Files that are either absent, old or complete. They are written to a temporary file in the same
// folder, flushed to the disk and renamed. Symbolic links are kept, and the file they refer to is
// written. An existing device, pipe or socket is an error and is not replaced. Also descriptors
// that close themselves, and messages with their length for a socket.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace gearpod::mc {

// POSIX file descriptor that closes itself. The functions below read and write in full despite
// interruptions.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Descriptor() { close(); }

    int get() const { return fd_; }
    // Passes ownership to the caller, who must close it.
    int release() { return std::exchange(fd_, -1); }
    bool close() {
        const int fd = std::exchange(fd_, -1);
        return fd < 0 || ::close(fd) == 0;
    }

  private:
    int fd_;
};

// Writes all bytes at `offset`. Returns false and sets errno on failure.
inline bool write_at(int fd, std::span<const std::byte> bytes, off_t offset) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(fd, bytes.data(), bytes.size(), offset);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            errno = written == 0 ? ENOSPC : errno;
            return false;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += written;
    }
    return true;
}

// Reads at `offset` and returns the number of bytes: fewer than requested at the end of the file,
// -1 with errno on failure.
inline ssize_t read_at(int fd, std::span<std::byte> bytes, off_t offset) {
    ssize_t total = 0;
    while (!bytes.empty()) {
        const ssize_t got = ::pread(fd, bytes.data(), bytes.size(), offset);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return -1;
        }
        if (got == 0) {
            break;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += got;
        total += got;
    }
    return total;
}

// Messages between a process and its child over a stream socket: their length, then their bytes.

// Sends one message of both parts. False if the other process has closed the socket.
bool send_framed(int fd, std::span<const char> bytes, std::span<const std::byte> more = {});
// Waits at most `timeout_ms` for each part; -1 waits without limit. False as above, or if the time
// is over.
bool receive_framed(int fd, std::string& bytes, int timeout_ms);

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
