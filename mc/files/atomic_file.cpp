#include "mc/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "mc/files/file_descriptor.hpp"

namespace gearpod::mc {
namespace {

std::string temporary_name(const std::string& path) {
    return path + ".new-" + std::to_string(::getpid());
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// errno of the first failure, 0 if the bytes are safely on the disk under the temporary's name.
int write_temporary(const std::string& name, std::span<const std::byte> bytes) {
    Descriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) {
        return errno;
    }
    const bool good = write_at(file.get(), bytes, 0) && ::fsync(file.get()) == 0 && file.close();
    return good ? 0 : errno;
}

// A rename is on the disk once its folder is; some file systems cannot sync folders, and need not.
void sync_folder(const std::string& path) {
    const Descriptor folder(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() >= 0) {
        ::fsync(folder.get());
    }
}

// Why nothing may be renamed to this name, or "". A name that is free, or a dangling link, is good.
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

std::string behind_links(std::string path) {
    constexpr int kMostLinks = 40;  // as the kernel follows
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
    const std::string target = behind_links(path);
    const std::string temporary = temporary_name(target);
    int error = write_temporary(temporary, bytes);
    if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        ::unlink(temporary.c_str());
        throw std::runtime_error(path + ": cannot be written (" + std::strerror(error) + ")");
    }
    sync_folder(target);
}

PendingFile::PendingFile(const std::string& path)
    : path_(path), target_(behind_links(path)), name_(target_ + ".new") {
    const std::string kind = why_not_replaceable(path);
    if (!kind.empty()) {
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

std::string why_not_writable(const std::string& name) {
    const std::string kind = why_not_replaceable(name);
    if (!kind.empty()) {
        return kind;
    }
    struct stat status {};
    const std::string path = behind_links(name);
    const std::string folder = folder_of(path);
    if (::stat(folder.c_str(), &status) != 0) {
        return "its folder " + folder + " cannot be used (" + std::strerror(errno) + ")";
    }
    if (!S_ISDIR(status.st_mode)) {
        return folder + " is not a folder";
    }
    const std::string temporary = temporary_name(path);
    const int error = write_temporary(temporary, {});
    ::unlink(temporary.c_str());
    return error == 0 ? "" : std::strerror(error);
}

}  // namespace gearpod::mc
