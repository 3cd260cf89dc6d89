#include "mc/files/atomic_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

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

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// Renames a file unless the new name exists. Returns errno or 0.
int rename_to_free(const std::string& from, const std::string& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
        return 0;
    }
    if (errno != EINVAL && errno != ENOSYS) {
        return errno;
    }
    // The file system or the kernel does not support renameat2; most support hard links.
    const int error = ::link(from.c_str(), to.c_str()) == 0 ? 0 : errno;
    if (error == 0) {
        ::unlink(from.c_str());
    }
    return error;
}

// New file in the folder of `path`. It has no name while it is written, so that nothing remains if
// the writer is killed. Where the file system does not support this (NFS), it has a temporary name
// from the start.
class Temporary {
  public:
    explicit Temporary(const std::string& path)
        : name_(name_for(path)),
          file_(::open(folder_of(path).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666)) {
        // Linking an unnamed file requires /proc.
        if (file_.get() < 0 || ::access(source().c_str(), F_OK) != 0) {
            // An existing file of this name was left by a process with the same id, or was planted:
            // it is removed, not opened.
            ::unlink(name_.c_str());
            file_ = Descriptor(::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
            error_ = file_.get() < 0 ? errno : 0;
            named_ = error_ == 0;
        }
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (named_) {
            ::unlink(name_.c_str());
        }
    }

    static std::string name_for(const std::string& path) {
        return path + ".new-" + std::to_string(::getpid());
    }

    // Reason why the file could not be created (errno), or 0.
    int error() const { return error_; }
    int fd() const { return file_.get(); }
    Descriptor release() { return std::move(file_); }

    // Returns the errno of the first failure, or 0 if the bytes are safely on the disk.
    int write(std::span<const std::byte> bytes) {
        return write_at(fd(), bytes, 0) && ::fsync(fd()) == 0 ? 0 : errno;
    }

    // Renames to `path` unless that name exists. Returns errno or 0.
    int take_free(const std::string& path) {
        const int error = named_ ? rename_to_free(name_, path) : link_as(path);
        named_ = named_ && error != 0;
        return error;
    }

    // Renames to `path`, replacing an existing file. Returns errno or 0.
    int take(const std::string& path) {
        if (!named_) {
            ::unlink(name_.c_str());
            const int error = link_as(name_);
            named_ = error == 0;
            if (error != 0) {
                return error;
            }
        }
        if (std::rename(name_.c_str(), path.c_str()) != 0) {
            return errno;
        }
        named_ = false;
        return 0;
    }

  private:
    std::string source() const { return "/proc/self/fd/" + std::to_string(fd()); }
    int link_as(const std::string& path) const {
        return ::linkat(AT_FDCWD, source().c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0
                   ? 0
                   : errno;
    }

    std::string name_;
    Descriptor file_;
    int error_ = 0;
    bool named_ = false;
};

// Makes a rename permanent by syncing the folder. Some file systems cannot sync folders and do not
// need it.
void sync_folder(const std::string& path) {
    const Descriptor folder(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() >= 0) {
        ::fsync(folder.get());
    }
}

// Reason why no file may be renamed to this name, or "". A free name or a dangling link is
// acceptable.
std::string why_not_replaceable(const std::string& path) {
    struct stat status {};
    if (path.empty()) {
        return "the file name is empty";
    }
    if (path.back() == '/') {
        return "it is a folder";
    }
    if (::stat(path.c_str(), &status) != 0) {
        return errno == ELOOP ? std::strerror(ELOOP) : "";
    }
    if (S_ISDIR(status.st_mode)) {
        return "it is a folder";
    }
    return S_ISREG(status.st_mode) ? ""
                                   : "it is a device, a pipe or a socket; a regular file is needed";
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

std::string resolve_links(std::string path) {
    constexpr int kMostLinks = 40;  // the kernel's limit
    for (int i = 0; i < kMostLinks; ++i) {
        std::error_code error;
        const std::string next = std::filesystem::read_symlink(path, error).string();
        if (error) {
            break;
        }
        path = next.front() == '/' ? next : folder_of(path) + "/" + next;
    }
    return path;
}

void write_file(const std::string& path, std::span<const std::byte> bytes) {
    const std::string kind = why_not_replaceable(path);
    if (!kind.empty()) {
        throw std::runtime_error(path + ": cannot be written (" + kind + ")");
    }
    const std::string target = resolve_links(path);
    Temporary file(target);
    int error = file.error();
    if (error == 0) {
        error = file.write(bytes);
    }
    if (error == 0) {
        error = file.take(target);
    }
    if (error != 0) {
        throw std::runtime_error(path + ": cannot be written (" + std::strerror(error) + ")");
    }
    sync_folder(target);
}

PendingFile::PendingFile(const std::string& path)
    : path_(path), target_(resolve_links(path)), name_(target_ + ".new") {
    std::string kind = why_not_replaceable(path);
    if (kind.empty()) {
        kind = why_not_pending(path);
    }
    if (!kind.empty()) {
        name_.clear();
        throw std::runtime_error(path + ": cannot be written (" + kind + ")");
    }
}

PendingFile::~PendingFile() {
    if (!name_.empty()) {
        ::unlink(name_.c_str());
    }
}

void PendingFile::commit(int fd) {
    if (::fsync(fd) != 0 || std::rename(name_.c_str(), target_.c_str()) != 0) {
        fail(errno);
    }
    name_.clear();
    sync_folder(target_);
}

void PendingFile::fail(int error) const {
    throw std::runtime_error(path_ + ": cannot be written (" + std::strerror(error) + ")");
}

std::string why_not_pending(const std::string& path) {
    const std::string name = resolve_links(path) + ".new";
    struct stat status {};
    if (::lstat(name.c_str(), &status) != 0) {
        return "";
    }
    const bool own = S_ISREG(status.st_mode) && status.st_nlink == 1;
    return own ? ""
               : name +
                     " has the name of the temporary file, but is a link, a folder, a pipe or a "
                     "device; remove it";
}

bool same_file(const std::string& one, const std::string& other) {
    struct stat a {
    }, b{};
    const bool has_a = ::stat(one.c_str(), &a) == 0, has_b = ::stat(other.c_str(), &b) == 0;
    if (has_a && has_b) {
        return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
    }
    const auto place = [](const std::string& path) {
        std::error_code none;
        const std::filesystem::path end = resolve_links(path);
        const auto whole = std::filesystem::weakly_canonical(end, none);
        return none ? end : whole;
    };
    return has_a == has_b && !one.empty() && !other.empty() && place(one) == place(other);
}

int create_exclusively(const std::string& path, std::span<const std::byte> bytes,
                       const std::function<void(int)>& prepare) {
    Temporary file(path);
    int error = file.error();
    if (error == 0) {
        prepare(file.fd());
        error = file.write(bytes);
    }
    if (error == 0) {
        error = file.take_free(path);
    }
    if (error != 0) {
        errno = error;
        return -1;
    }
    sync_folder(path);
    return file.release().release();
}

std::string why_not_writable(const std::string& name) {
    const std::string kind = why_not_replaceable(name);
    if (!kind.empty()) {
        return kind;
    }
    struct stat status {};
    const std::string path = resolve_links(name);
    const std::string folder = folder_of(path);
    if (::stat(folder.c_str(), &status) != 0) {
        return "its folder " + folder + " cannot be used (" + std::strerror(errno) + ")";
    }
    if (!S_ISDIR(status.st_mode)) {
        return folder + " is not a folder";
    }
    // The temporary name is the longest one.
    if (::lstat(Temporary::name_for(path).c_str(), &status) != 0 && errno == ENAMETOOLONG) {
        return std::strerror(ENAMETOOLONG);
    }
    const int error = Temporary(path).error();
    return error == 0 ? "" : std::strerror(error);
}

}  // namespace gearpod::mc
