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

}  // namespace gearpod::mc
