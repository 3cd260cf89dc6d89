// POSIX file descriptor that closes itself, and functions that read and write in full despite
// interruptions.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace gearpod::mc {

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

}  // namespace gearpod::mc
