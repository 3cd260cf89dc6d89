// Selects the reader of a signal file by the extension of its name.
#include <algorithm>
#include <filesystem>

#include "mc/files/isolated_signal.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

// Extension in lower case.
std::string extension_of(const std::filesystem::path& path) {
    std::string kind = path.extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    return kind;
}

}  // namespace

std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw SignalError(path + (std::filesystem::is_directory(path, error) ? ": is a folder"
                                                                             : ": no such file"));
    }
    std::string kind = extension_of(path);
    const bool compressed = kind == ".gz";
    if (compressed) {
        kind = extension_of(std::filesystem::path(path).stem());
    }
    const bool hdf5 = kind == ".h5" || kind == ".hdf5";
    if (row && !hdf5) {
        throw SignalError(path + ": has no rows to select from; only HDF5 files can have rows");
    }
    if (kind == ".csv" || kind == ".txt" || kind == ".tsv" || kind == ".dat" || kind == ".asc") {
        return open_signal_csv(path);
    }
    if (compressed) {
        throw SignalError(path +
                          ": only text files are read compressed (.csv.gz, .txt.gz); decompress it "
                          "with gunzip");
    }
    if (hdf5) {
        return isolated_signal(path, [&] { return open_signal_hdf5(path, row); });
    }
    if (kind == ".mat") {
        return isolated_signal(path, [&] { return open_signal_mat(path); });
    }
    if (kind == ".wav") {
        return open_signal_wav(path);
    }
    if (kind == ".uff" || kind == ".unv") {
        return open_signal_uff(path);
    }
    if (kind == ".tdms") {
        throw SignalError(path +
                          ": TDMS files are not supported; export it as HDF5 or CSV, in Python "
                          "with nptdms: TdmsFile.read(FILE).as_hdf(OUT)");
    }
    throw SignalError(
        path +
        ": unknown file type; its name must end in .csv, .h5, .hdf5, .mat, .wav, .uff or .unv");
}

}  // namespace gearpod::mc
