#include "mc/commands/output_folder.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <span>
#include <stdexcept>

#include "mc/files/atomic_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"

namespace gearpod::mc {
namespace {

std::string path_in(const std::string& folder, const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
}

OutputKind kind_in_folder(const std::string& role, const NamedFile& file) {
    const auto extension = std::filesystem::path(file.name).extension();
    if (extension == ".pdf") {
        return sheet_output();
    }
    if (extension == ".json") {
        return json_output();
    }
    if (extension == ".csv") {
        return text_output("a table of `report` (CSV)",
                           file.bytes.substr(0, file.bytes.find_first_of(",\n")));
    }
    return text_output("a file of `" + role + "`", file.bytes.substr(0, file.bytes.find('\n')));
}

}  // namespace

bool can_write_folder(const FileRole& folder, const std::vector<NamedFile>& files,
                      const std::vector<FileRole>& others, bool force) {
    bool good = true;
    for (const NamedFile& file : files) {
        const std::string path = path_in(folder.path, file.name);
        if (const std::string why =
                why_not_replaced(path, {kind_in_folder(folder.role, file), force});
            !why.empty()) {
            fmt::print(stderr, "{} {}: {}\n", folder.role, printable(path), why);
            good = false;
        }
        for (const FileRole& other : others) {
            if (!other.path.empty() && other.path != "-" && same_file(path, other.path)) {
                fmt::print(stderr, "{} {}: would overwrite {}; choose another folder\n",
                           folder.role, printable(path), other.role);
                good = false;
            }
        }
    }
    return good;
}

void write_files(const std::string& folder, const std::vector<NamedFile>& files) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        throw std::runtime_error(folder + ": " + failed.message());
    }
    for (const NamedFile& file : files) {
        write_file(path_in(folder, file.name), std::as_bytes(std::span(file.bytes)));
    }
}

bool write_evidence(const std::string& folder, const std::vector<NamedFile>& files,
                    const std::vector<FileRole>& others, bool force) {
    if (!can_write_folder({"--evidence", folder}, files, others, force)) {
        return false;
    }
    write_files(folder, files);
    return true;
}

}  // namespace gearpod::mc
