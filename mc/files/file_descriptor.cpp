#include "mc/files/file_descriptor.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>

namespace gearpod::mc {
namespace {

bool send_all(int fd, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t sent = ::send(fd, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) {
            continue;
        }
        if (sent <= 0) {
            return false;
        }
        at += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int fd, void* data, std::size_t size, int timeout_ms) {
    char* at = static_cast<char*>(data);
    while (size > 0) {
        pollfd ready{fd, POLLIN, 0};
        const int found = ::poll(&ready, 1, timeout_ms);
        if (found < 0 && errno == EINTR) {
            continue;
        }
        const ssize_t got = found > 0 ? ::recv(fd, at, size, 0) : -1;
        if (got <= 0) {
            return false;
        }
        at += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

bool send_framed(int fd, std::span<const char> bytes, std::span<const std::byte> more) {
    const std::uint64_t length = bytes.size() + more.size();
    return send_all(fd, &length, sizeof length) && send_all(fd, bytes.data(), bytes.size()) &&
           send_all(fd, more.data(), more.size());
}

bool receive_framed(int fd, std::string& bytes, int timeout_ms) {
    std::uint64_t length = 0;
    if (!receive_all(fd, &length, sizeof length, timeout_ms)) {
        return false;
    }
    bytes.resize(length);
    return receive_all(fd, bytes.data(), length, timeout_ms);
}

}  // namespace gearpod::mc
