#include "mc/files/foreign_file.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "mc/files/atomic_file.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "python_sources.hpp"

namespace gearpod::mc {
namespace {

using std::string_view_literals::operator""sv;

constexpr int kRefused = 3;  // exit code of the process that has printed a reason

struct KindBytes {
    std::size_t at;
    std::string_view bytes;
    FileKind kind;
};
constexpr KindBytes kKindBytes[] = {{0, "\x89HDF\r\n\x1a\n"sv, FileKind::hdf5},
                                    {0, "MATLAB 5.0 MAT-file"sv, FileKind::mat},
                                    {0, "MATLAB 7.3 MAT-file"sv, FileKind::mat},
                                    {0, "TDSm"sv, FileKind::tdms},
                                    {8, "WAVE"sv, FileKind::sound},
                                    {0, "RF64"sv, FileKind::sound},
                                    {0, "riff\x2e\x91\xcf\x11"sv, FileKind::sound},
                                    {0, "fLaC"sv, FileKind::sound},
                                    {8, "AIFF"sv, FileKind::sound},
                                    {8, "AIFC"sv, FileKind::sound},
                                    {0, ".snd"sv, FileKind::sound},
                                    {0, "caff"sv, FileKind::sound},
                                    {0, "CDF\x01"sv, FileKind::unknown},
                                    {0, "PK\x03\x04"sv, FileKind::unknown}};

struct KindExtensions {
    std::string_view extensions;
    FileKind kind;
};
constexpr KindExtensions kKindExtensions[] = {
    {" .csv .txt .tsv .dat .asc ", FileKind::text},
    {" .h5 .hdf5 .nc .nc4 ", FileKind::hdf5},
    {" .mat ", FileKind::mat},
    {" .wav .wave .bwf .rf64 .w64 .flac .aif .aiff .aifc .au .snd .caf ", FileKind::sound},
    {" .tdms ", FileKind::tdms},
    {" .uff .unv .uf58 .uf .ufb ", FileKind::uff}};

// Universal files begin with a line "-1" and the number of a dataset.
bool is_universal_file(std::string_view head) {
    const std::size_t end = head.find('\n');
    return head.starts_with("    -1") && end != head.npos &&
           head.substr(end + 1, 6).find_first_not_of(" 0123456789") == head.npos;
}

}  // namespace

FileKind file_kind(const std::string& path) {
    std::string head;
    // Reading a pipe or a device might never end.
    if (std::error_code error; std::filesystem::is_regular_file(path, error)) {
        head.resize(4096);
        std::ifstream stream(path, std::ios::binary);
        stream.read(head.data(), static_cast<std::streamsize>(head.size()));
        head.resize(static_cast<std::size_t>(stream.gcount()));
    }
    std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension == ".gz") {
        extension = lower_case(std::filesystem::path(path).stem().extension().string());
        return extension.empty() || kKindExtensions[0].extensions.find(extension) == head.npos
                   ? FileKind::unknown
                   : FileKind::text;
    }
    const auto named = std::ranges::find_if(kKindExtensions, [&](const KindExtensions& known) {
        return !extension.empty() &&
               known.extensions.find(" " + extension + " ") != std::string_view::npos;
    });
    const FileKind kind = named == std::end(kKindExtensions) ? FileKind::unknown : named->kind;
    for (const KindBytes& start : kKindBytes) {
        const bool container =
            start.at == 0 || head.starts_with("RIFF") || head.starts_with("FORM");
        if (container && head.size() > start.at &&
            std::string_view(head).substr(start.at).starts_with(start.bytes)) {
            // MATLAB 7.3 files are HDF5 files after a header of their own.
            return start.kind == FileKind::mat && kind == FileKind::hdf5 ? kind : start.kind;
        }
    }
    return is_universal_file(head) ? FileKind::uff : kind;
}

std::string unknown_format_text(const std::string& path) {
    return path +
           ": is not a file that gearpod reads: CSV and other text (.csv, .txt, .tsv, .dat, .asc, "
           "also .gz), HDF5 (.h5, .hdf5, .nc), MAT (.mat), TDMS (.tdms), universal files (.uff, "
           ".unv) or sound without loss (.wav, .flac, .aiff, .rf64, .w64, .au, .caf). Convert it: "
           "spreadsheets: save the sheet as CSV; ZIP archives and compressed files: unpack them "
           "(unzip, gunzip); Parquet, Arrow, SQLite, pickle: pandas, to_csv(OUT, index=False); "
           "NumPy: numpy.savetxt(OUT, numpy.load(FILE)); MDF (.mf4): asammdf, "
           "MDF(FILE).export('csv'); netCDF classic: nccopy -k nc4 FILE OUT.nc; Octave: save -v7 "
           "FILE; LabVIEW, DIAdem, FAMOS, catman: export TDMS, MAT, UFF 58 or CSV; web pages: "
           "download the recording itself";
}

PythonOutputFile::PythonOutputFile(const std::string& path)
    : name_((std::filesystem::temp_directory_path() / "gearpod-recording-XXXXXX").string()) {
    const Descriptor created(::mkstemp(name_.data()));
    if (created.get() < 0) {
        throw SignalError(fmt::format("{}: cannot be read: no temporary file {} ({})", path, name_,
                                      std::strerror(errno)));
    }
}

PythonOutputFile::PythonOutputFile(const std::string& path, const std::string& reader)
    : PythonOutputFile(path) {
    PythonOutput output;
    try {
        // -B: write no compiled files; -s: ignore the user's own packages.
        output = run_python({"-Bs", "-c", kSignalFilesSource, reader, path, name_}, "", true);
    } catch (const PythonError& error) {
        throw SignalError(
            fmt::format("{}: this kind of file is read by Python: {}", path, error.what()));
    }
    if (WIFEXITED(output.status) && WEXITSTATUS(output.status) == kRefused) {
        throw SignalError(path + printable(output.text));
    }
    if (output.status != 0) {
        throw SignalError(
            fmt::format("{}: is damaged: reading it {}", path, ended_text(output.status)));
    }
}

PythonOutputFile::~PythonOutputFile() {
    ::unlink(name_.c_str());
}

}  // namespace gearpod::mc
