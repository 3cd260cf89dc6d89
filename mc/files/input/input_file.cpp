#include "mc/files/input/input_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace gearpod::mc {

std::string why_not_readable(const std::string& path, StandardInput pipe) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return std::string("cannot be read (") + std::strerror(errno) + ")";
    }
    if (S_ISDIR(status.st_mode)) {
        return "is a folder";
    }
    const bool descriptor =
        path == "/dev/stdin" || path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/");
    const bool open_pipe =
        pipe == StandardInput::accepted && S_ISFIFO(status.st_mode) && descriptor;
    if (!S_ISREG(status.st_mode) && !open_pipe) {
        return "is a pipe, a socket or a device; a regular file is needed";
    }
    return ::access(path.c_str(), R_OK) == 0
               ? ""
               : std::string("cannot be read (") + std::strerror(errno) + ")";
}

// Source: RFC 3629, section 4 (neither overlong forms nor surrogates).
std::size_t utf8_length(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned first = byte(at);
    if (first < 0x80) {
        return at < text.size() ? 1 : 0;
    }
    const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                               : first >= 0xe0 && first < 0xf0 ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    const unsigned least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    for (std::size_t i = 1; i < length; ++i) {
        if (byte(at + i) < (i == 1 ? least : 0x80) || byte(at + i) > (i == 1 ? most : 0xbf)) {
            return 0;
        }
    }
    return length;
}

void append_utf8(std::string& text, std::uint32_t code) {
    const auto more = [&](int shift) {
        text += static_cast<char>(0x80 | ((code >> shift) & 0x3f));
    };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xc0 | (code >> 6));
        more(0);
    } else if (code < 0x10000) {
        text += static_cast<char>(0xe0 | (code >> 12));
        more(6);
        more(0);
    } else {
        text += static_cast<char>(0xf0 | (code >> 18));
        more(12);
        more(6);
        more(0);
    }
}

std::string utf8_text(std::string_view bytes) {
    std::string text;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = utf8_length(bytes, at);
        if (length > 0) {
            text += bytes.substr(at, length);
            at += length;
            continue;
        }
        append_utf8(text, static_cast<unsigned char>(bytes[at++]));
    }
    return text;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return lower;
}

}  // namespace gearpod::mc
