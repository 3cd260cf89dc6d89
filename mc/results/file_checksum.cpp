#include "mc/results/file_checksum.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "mc/files/file_descriptor.hpp"
#include "mc/random/fnv.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kChecksumMark = "gearpod\n";
constexpr off_t kChecksumBytes = 16;

std::string checksum_bytes(std::uint64_t sum) {
    std::string checksum(kChecksumMark);
    for (int byte = 0; byte < 8; ++byte) {
        checksum += static_cast<char>((sum >> (8 * byte)) & 0xff);
    }
    return checksum;
}

std::optional<off_t> size_of(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 ? std::optional(status.st_size) : std::nullopt;
}

// Checksum of the first `size` bytes; empty if reading fails.
std::optional<std::uint64_t> sum_of(int fd, off_t size) {
    std::vector<std::byte> piece(std::size_t{1} << 20);
    std::uint64_t sum = kFnvStart;
    for (off_t at = 0; at < size;) {
        const auto length =
            std::min<std::size_t>(piece.size(), static_cast<std::size_t>(size - at));
        if (read_at(fd, std::span(piece).first(length), at) != static_cast<ssize_t>(length)) {
            return std::nullopt;
        }
        sum = fnv1a({reinterpret_cast<const char*>(piece.data()), length}, sum);
        at += static_cast<off_t>(length);
    }
    return sum;
}

}  // namespace

bool append_checksum(int fd) {
    const auto size = size_of(fd);
    const auto sum = size ? sum_of(fd, *size) : std::nullopt;
    if (!sum) {
        return false;
    }
    const std::string checksum = checksum_bytes(*sum);
    return write_at(fd, std::as_bytes(std::span(checksum)), *size);
}

ChecksumState check_file_checksum(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    const auto size = size_of(file.get());
    if (!size || *size < kChecksumBytes) {
        return ChecksumState::missing;
    }
    std::string checksum(kChecksumBytes, '\0');
    const off_t end = *size - kChecksumBytes;
    if (read_at(file.get(), std::as_writable_bytes(std::span(checksum)), end) != kChecksumBytes ||
        !checksum.starts_with(kChecksumMark)) {
        return ChecksumState::missing;
    }
    const auto sum = sum_of(file.get(), end);
    return sum && checksum == checksum_bytes(*sum) ? ChecksumState::intact : ChecksumState::broken;
}

}  // namespace gearpod::mc
