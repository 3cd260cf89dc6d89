// Selects the reader of a signal file by the extension of its name.
#include <algorithm>
#include <filesystem>

#include "mc/files/isolated_signal.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/input_file.hpp"

namespace gearpod::mc {

std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    std::string kind = std::filesystem::path(path).extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    const bool hdf5 = kind == ".h5" || kind == ".hdf5";
    if (row && !hdf5) {
        throw SignalError(path + ": has no rows to select from; only HDF5 files can have rows");
    }
    if (kind == ".csv") {
        return open_signal_csv(path);
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
