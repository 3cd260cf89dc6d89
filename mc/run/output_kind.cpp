#include "mc/run/output_kind.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/isolated_trial.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

// Beginning of a file, after a byte order mark and blanks.
std::string beginning_of(const std::string& path) {
    constexpr std::size_t kRead = 4096;
    std::ifstream stream(path, std::ios::binary);
    std::string text(kRead, '\0');
    stream.read(text.data(), kRead);
    text.resize(static_cast<std::size_t>(stream.gcount()));
    text.erase(0, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

bool is_recordings(const std::string& path) {
    try {
        return read_unverified_results(path).provenance_value("kind") == kRecordingsKind;
    } catch (const std::exception&) {
        return false;
    }
}

bool has_simulated_signals(const std::string& path) {
    const SilentHdf5 silent;
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
    const auto attributes = attribute_names(file.get());
    const auto links = link_names(file.get());
    return std::ranges::count(attributes, "code_version") == 1 &&
           std::ranges::count(attributes, "format") == 0 &&
           std::ranges::count(links, "signals") == 1;
}

bool is_simulated(const std::string& path) {
    if (!survives_reading(path, [&] { has_simulated_signals(path); })) {
        return false;
    }
    try {
        return has_simulated_signals(path);
    } catch (const Hdf5Error&) {
        return false;
    }
}

}  // namespace

OutputKind text_output(const std::string& name, const std::string& beginning) {
    return {name, [beginning](const std::string& path) {
                return beginning_of(path).starts_with(beginning);
            }};
}

OutputKind json_output() {
    return text_output("JSON", "{");
}

OutputKind page_output() {
    return text_output("a page (HTML)", "<!DOCTYPE html>");
}

OutputKind sheet_output() {
    return text_output("a sheet (PDF)", "%PDF-");
}

OutputKind recordings_output() {
    return {"results of recordings (HDF5)", is_recordings};
}

OutputKind signals_output() {
    return {"signals of `simulate` (HDF5)", is_simulated};
}

std::string why_not_replaced(const std::string& path, const Overwriting& overwriting) {
    std::error_code none;
    const bool file = std::filesystem::is_regular_file(path, none);
    if (!file || std::filesystem::file_size(path, none) == 0 || overwriting.force ||
        overwriting.kind.matches(path)) {
        return "";
    }
    return "is a file of another kind than this output, " + overwriting.kind.name +
           "; name another file, or replace this one with --force";
}

}  // namespace gearpod::mc
