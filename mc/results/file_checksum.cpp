#include "mc/results/file_checksum.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mc/files/atomic_file.hpp"
#include "mc/study/random/fnv.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kChecksumMark = "gearpod\n";
constexpr std::string_view kHdf5Mark = "\x89HDF\r\n\x1a\n";
constexpr off_t kChecksumBytes = 16;  // mark and hash
// HDF5 file format specification, superblock version 0: lowest byte of the consistency flags, end
// of the file, and the bit of the flags that stands for "open for writing".
constexpr off_t kFlagsAt = 20, kEndAt = 40, kEndBytes = 8;
constexpr std::byte kOpenForWriting{1};

std::string little_endian(std::uint64_t number) {
    std::string bytes;
    for (int byte = 0; byte < 8; ++byte) {
        bytes += static_cast<char>((number >> (8 * byte)) & 0xff);
    }
    return bytes;
}

std::optional<off_t> size_of(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 ? std::optional(status.st_size) : std::nullopt;
}

// `count` bytes from `at` on; fewer if the file ends.
std::string bytes_at(int fd, off_t at, off_t count) {
    std::string bytes(static_cast<std::size_t>(count), '\0');
    const ssize_t got = read_at(fd, std::as_writable_bytes(std::span(bytes)), at);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    return bytes;
}

bool has_user_block(int fd) {
    return bytes_at(fd, kUserBlockBytes, kHdf5Mark.size()) == kHdf5Mark;
}

// Hash of the bytes from `begin` to `end`; empty if reading fails. `superblock` is the position of
// the HDF5 part.
std::optional<std::uint64_t> sum_of(int fd, off_t begin, off_t end, off_t superblock) {
    std::vector<std::byte> piece(std::size_t{1} << 20);
    std::uint64_t sum = kFnvStart;
    for (off_t at = begin; at < end;) {
        const auto length = std::min<std::size_t>(piece.size(), static_cast<std::size_t>(end - at));
        if (read_at(fd, std::span(piece).first(length), at) != static_cast<ssize_t>(length)) {
            return std::nullopt;
        }
        const off_t flags = superblock + kFlagsAt - at;
        if (flags >= 0 && flags < static_cast<off_t>(length)) {
            piece[static_cast<std::size_t>(flags)] &= ~kOpenForWriting;
        }
        sum = fnv1a({reinterpret_cast<const char*>(piece.data()), length}, sum);
        at += static_cast<off_t>(length);
    }
    return sum;
}

bool write_text_at(int fd, const std::string& text, off_t at) {
    return write_at(fd, std::as_bytes(std::span(text)), at);
}

// Checks a file with a user block, which another program may have written.
ChecksumState check_user_block(int fd, off_t size) {
    const std::string head = bytes_at(fd, 0, kChecksumBytes);
    const auto sum = sum_of(fd, kChecksumBytes, size, kUserBlockBytes);
    const bool hash_fits = sum && head.ends_with(little_endian(*sum));
    if (!head.starts_with(kChecksumMark)) {
        return hash_fits ? ChecksumState::broken : ChecksumState::missing;
    }
    if (hash_fits) {
        return ChecksumState::intact;
    }
    const std::string end = bytes_at(fd, kUserBlockBytes + kEndAt, kEndBytes);
    std::uint64_t whole = 0;
    for (std::size_t i = end.size(); i > 0; --i) {
        whole = whole << 8 | static_cast<unsigned char>(end[i - 1]);
    }
    const bool cut = end.size() < kEndBytes || static_cast<std::uint64_t>(size) < whole;
    return cut ? ChecksumState::truncated : ChecksumState::broken;
}

}  // namespace

bool write_checksum(int fd) {
    const auto size = size_of(fd);
    if (!size) {
        return false;
    }
    if (has_user_block(fd)) {
        const auto sum = sum_of(fd, kChecksumBytes, *size, kUserBlockBytes);
        return sum && write_text_at(fd, std::string(kChecksumMark) + little_endian(*sum), 0);
    }
    off_t end = *size;
    if (end >= kChecksumBytes && bytes_at(fd, end - kChecksumBytes, 8) == kChecksumMark) {
        end -= kChecksumBytes;
    }
    const auto sum = sum_of(fd, 0, end, 0);
    return sum && write_text_at(fd, std::string(kChecksumMark) + little_endian(*sum), end);
}

ChecksumState check_file_checksum(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = size_of(file.get());
    if (!size || *size < kChecksumBytes) {
        return ChecksumState::missing;
    }
    if (has_user_block(file.get()) || bytes_at(file.get(), 0, 8) == kChecksumMark) {
        return check_user_block(file.get(), *size);
    }
    const off_t end = *size - kChecksumBytes;
    const std::string checksum = bytes_at(file.get(), end, kChecksumBytes);
    if (!checksum.starts_with(kChecksumMark)) {
        return ChecksumState::missing;
    }
    const auto sum = sum_of(file.get(), 0, end, 0);
    return sum && checksum == std::string(kChecksumMark) + little_endian(*sum)
               ? ChecksumState::intact
               : ChecksumState::broken;
}

bool is_open_for_writing(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    return file.get() >= 0 && ::flock(file.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace gearpod::mc
