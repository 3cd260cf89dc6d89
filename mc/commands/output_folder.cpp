#include "mc/commands/output_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "mc/files/atomic_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"

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

bool write_json_and_page(const nlohmann::json& json, const std::string& file,
                         const std::string& html, const std::string& figures) {
    if (!file.empty() && !write_text_to(file, json_text(json, 2) + "\n")) {
        return false;
    }
    write_report_page(json_text(json), html, figures);
    return true;
}

void print_findings(const analysis::Report& report, bool full) {
    fmt::print("{}", full ? report_text(report)
                          : screen_text(report, {"All findings: the same command with --full"}));
}

void print_written(const char* what, const std::string& path) {
    if (!path.empty()) {
        fmt::print("\n{}: {}\n", what, path);
    }
}

std::string columns_csv(const std::vector<SignalColumn>& columns, int digits, bool units) {
    std::string text;
    for (const SignalColumn& column : columns) {
        text += (text.empty() ? "" : ",") + column.name + (units ? " [" + column.unit + "]" : "");
    }
    for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
        for (const SignalColumn& column : columns) {
            fmt::format_to(std::back_inserter(text), "{}{:.{}g}",
                           &column == columns.data() ? "\n" : ",", column.values[row], digits);
        }
    }
    return text + "\n";
}

bool can_write_folders(const std::vector<OutputFolder>& folders,
                       const std::vector<FileRole>& others, bool force) {
    bool good = true;
    for (const auto& [folder, files] : folders) {
        for (const NamedFile& file : files) {
            const std::string path = path_in(folder.path, file.name);
            const auto refuse = [&](const std::string& why) {
                fmt::print(stderr, "{} {}: {}\n", folder.role, printable(path), why);
                good = false;
            };
            if (const std::string why =
                    why_not_replaced(path, {kind_in_folder(folder.role, file), force});
                !why.empty()) {
                refuse(why);
            }
            for (const FileRole& other : others) {
                if (!other.path.empty() && other.path != "-" && same_file(path, other.path)) {
                    refuse("would overwrite " + other.role + "; choose another folder");
                }
            }
        }
    }
    return good;
}

void write_files(const OutputFolder& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder.role.path, failed);
    if (failed) {
        throw std::runtime_error(folder.role.path + ": " + failed.message());
    }
    for (const NamedFile& file : folder.files) {
        write_file(path_in(folder.role.path, file.name), std::as_bytes(std::span(file.bytes)));
    }
}

}  // namespace gearpod::mc
