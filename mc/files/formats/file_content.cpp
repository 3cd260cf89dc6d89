#include "mc/files/formats/file_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/formats/signal_error.hpp"
#include "mc/files/input/file_text.hpp"

namespace gearpod::mc {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::size_t kHead = 4096;  // bytes that are looked at

// Format that is read, and the extensions of its files; the first one is usual.
struct SupportedFormat {
    std::size_t at;
    std::string_view bytes;
    const char* name;
    std::string_view extensions;
};
constexpr std::string_view kSoundExtensions =
    " .wav .wave .bwf .rf64 .w64 .flac .aif .aiff .aifc .au .caf ";
constexpr std::string_view kHdf5Extensions = " .h5 .hdf5 ";
constexpr std::string_view kMatExtensions = " .mat ";
constexpr std::string_view kUffExtensions = " .uff .unv .uf58 .uf .ufb ";
constexpr SupportedFormat kSupportedFormats[] = {
    {0, "\x89HDF\r\n\x1a\n"sv, "an HDF5 file", kHdf5Extensions},
    {0, "MATLAB 5.0 MAT-file"sv, "a MAT file", kMatExtensions},
    {0, "MATLAB 7.3 MAT-file"sv, "a MAT file", " .mat .h5 .hdf5 "},
    {0, "TDSm"sv, "a TDMS file", " .tdms "},
    {0, "RF64"sv, "a sound file (RF64)", " .wav .wave .bwf .rf64 "},
    {8, "WAVE"sv, "a sound file (WAV)", " .wav .wave .bwf .rf64 "},
    {0, "riff\x2e\x91\xcf\x11"sv, "a sound file (Wave64)", " .w64 .wav "},
    {0, "fLaC"sv, "a sound file (FLAC)", " .flac "},
    {8, "AIFF"sv, "a sound file (AIFF)", " .aiff .aif "},
    {8, "AIFC"sv, "a sound file (AIFF-C)", " .aifc .aiff .aif "},
    {0, ".snd"sv, "a sound file (AU)", " .au .snd "},
    {0, "caff"sv, "a sound file (CAF)", " .caf "},
};

// Format that is not read, and how its data can be converted.
struct OtherFormat {
    std::size_t at;
    std::string_view bytes;
    const char* name;
    const char* remedy;
};
constexpr const char* kUnpack = "unpack it, and give the file in it";
constexpr const char* kPicture = "give the numbers of the recording instead, for example as CSV";
constexpr OtherFormat kOtherFormats[] = {
    {30, "mimetypeapplication/vnd.oasis.opendocument.spreadsheet"sv, "an OpenDocument spreadsheet",
     "save its sheet as CSV"},
    {0, "PK\x03\x04"sv, "a ZIP archive", kUnpack},
    {0, "PK\x05\x06"sv, "an empty ZIP archive", kUnpack},
    {0, "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv, "an Excel 97 workbook or another OLE2 file",
     "save its sheet as CSV"},
    {0, "PAR1"sv, "a Parquet file",
     "in Python: pandas.read_parquet(FILE).to_csv(OUT, index=False)"},
    {0, "ARROW1"sv, "an Arrow or Feather file",
     "in Python: pandas.read_feather(FILE).to_csv(OUT, index=False)"},
    {0, "\x93NUMPY"sv, "a NumPy array (.npy)",
     "in Python: numpy.savetxt(OUT, numpy.load(FILE), delimiter=',', header='sensor', "
     "comments='')"},
    {0, "# Created by Octave"sv, "a text file of Octave", "in Octave, save it with: save -v7 FILE"},
    {0, "Octave-1"sv, "a binary file of Octave", "in Octave, save it with: save -v7 FILE"},
    {0, "CDF\x01"sv, "a netCDF classic file", "convert it to HDF5: nccopy -k nc4 FILE OUT.h5"},
    {0, "CDF\x02"sv, "a netCDF classic file", "convert it to HDF5: nccopy -k nc4 FILE OUT.h5"},
    {0, "CDF\x05"sv, "a netCDF classic file", "convert it to HDF5: nccopy -k nc4 FILE OUT.h5"},
    {0, "\x0e\x03\x13\x01"sv, "an HDF4 file", "convert it to HDF5: h4toh5 FILE OUT.h5"},
    {0, "SQLite format 3"sv, "an SQLite database",
     "export its table: sqlite3 -csv -header FILE 'SELECT * FROM TABLE' > OUT.csv"},
    {0, "root\0"sv, "a ROOT file",
     "in Python with uproot: uproot.open(FILE)[TREE].arrays(library='pd').to_csv(OUT)"},
    {0, "|CF,"sv, "an imc FAMOS file", "export it from FAMOS as CSV, MAT or TDMS"},
    {0, "#BEGINGLOBALHEADER"sv, "a DIAdem DAT header", "save it in DIAdem as TDMS"},
    {0, "DIAEXTENDED"sv, "a DIAdem DAT header", "save it in DIAdem as TDMS"},
    {0, "MDF     "sv, "an MDF measurement file (.mdf, .mf4)",
     "in Python with asammdf: MDF(FILE).export('csv', OUT)"},
    {0, "UnFinMF "sv, "an MDF measurement file that was not finished",
     "in Python with asammdf: MDF(FILE).export('csv', OUT)"},
    {0, "TDSh"sv, "the index of a TDMS file (.tdms_index)", "give the .tdms file next to it"},
    {0, "LabVIEW Measurement"sv, "a LabVIEW measurement file (.lvm)",
     "save it as TDMS, or its table as CSV"},
    {0, "OggS"sv, "an Ogg sound file", "convert it to WAV; recordings must not be lossy"},
    {0, "ID3"sv, "an MP3 sound file", "convert it to WAV; recordings must not be lossy"},
    {0, "%PDF-"sv, "a PDF document", kPicture},
    {0, "\x89PNG"sv, "a PNG picture", kPicture},
    {0, "\xFF\xD8\xFF"sv, "a JPEG picture", kPicture},
    {0, "GIF8"sv, "a GIF picture", kPicture},
    {0, "{\\rtf"sv, "an RTF document", kPicture},
    {0, "<usi:tdm"sv, "a TDM file of DIAdem", "save it in DIAdem as TDMS"},
    {0, "<?xml"sv, "an XML document", "export the recording as CSV, HDF5, MAT or TDMS"},
    {0, "<!DOCTYPE"sv, "an HTML page",
     "download the recording itself, which may require logging in"},
    {0, "<html"sv, "an HTML page", "download the recording itself, which may require logging in"},
    {0, "version https://git-lfs"sv, "a pointer to a file in Git LFS", "fetch it: git lfs pull"},
    {0, "BZh"sv, "a file compressed by bzip2", "decompress it: bunzip2 FILE"},
    {0, "\xFD\x37zXZ"sv, "a file compressed by xz", "decompress it: unxz FILE"},
    {0, "\x28\xB5\x2F\xFD"sv, "a file compressed by Zstandard", "decompress it: unzstd FILE"},
    {0, "7z\xBC\xAF\x27\x1C"sv, "a 7-Zip archive", kUnpack},
    {0, "Rar!"sv, "a RAR archive", kUnpack},
    {257, "ustar"sv, "a tar archive", kUnpack},
};

bool has_bytes_at(std::string_view head, std::size_t at, std::string_view bytes) {
    return at <= head.size() && head.substr(at).starts_with(bytes);
}
bool has_extension(const std::string& extension, std::string_view extensions) {
    return !extension.empty() && extensions.find(" " + extension + " ") != std::string_view::npos;
}

// Start of the names in a ZIP archive that tell its use.
OtherFormat zip_use(std::string_view head, const OtherFormat& archive) {
    if (head.find("[Content_Types].xml") != std::string_view::npos ||
        head.find("xl/") != std::string_view::npos) {
        return {0, "", "an Excel workbook (.xlsx) or another Office document",
                "save its sheet as CSV"};
    }
    if (head.find(".npy") != std::string_view::npos) {
        return {0, "", "an archive of NumPy arrays (.npz)",
                "write its arrays to an HDF5 file with h5py, or to CSV"};
    }
    return archive;
}

// Python pickles of protocol 2 and later: the protocol, then a frame or an opcode that begins an
// object.
bool is_pickle(std::string_view head) {
    return head.size() > 2 && head[0] == '\x80' && head[1] >= 2 && head[1] <= 5 &&
           "\x95}](cXK\x8c"sv.find(head[2]) != std::string_view::npos;
}

// Binary files of HBM catman begin with the version of the format, from 5010 on.
bool is_catman(std::string_view head) {
    return head.size() > 2 && unsigned_at(head, 0, 2) >= 5000 && unsigned_at(head, 0, 2) < 5100;
}

bool is_plain_text(std::string_view head) {
    return !head.empty() && std::ranges::all_of(head, [](char c) {
        return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r') || c == '\x1b';
    });
}

// Universal files begin with a line "-1" and the number of a dataset.
bool is_universal_file(std::string_view head) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    const std::string_view first = head.substr(0, end);
    const std::size_t from = first.find_first_not_of(" \t");
    if (from == std::string_view::npos || !first.substr(from).starts_with("-1") || from != 4 ||
        end == head.size()) {
        return false;
    }
    const std::string_view next = head.substr(end + 1, 6);
    return !next.empty() && std::ranges::all_of(next, [](char c) {
        return c == ' ' || std::isdigit(static_cast<unsigned char>(c)) != 0;
    });
}

[[noreturn]] void refuse_format(const std::string& path, const OtherFormat& format) {
    throw SignalError(
        fmt::format("{}: is {}, which is not supported; {}", path, format.name, format.remedy));
}
[[noreturn]] void refuse_name(const std::string& path, const std::string& extension,
                              const char* content, std::string_view rename) {
    throw SignalError(fmt::format("{}: is {}, but its name ends in {}; rename it to end in {}",
                                  path, content,
                                  extension.empty() ? "no known extension" : extension, rename));
}

void check_gzip(const std::string& path, const std::string& extension) {
    if (extension != ".gz") {
        refuse_name(path, extension, "compressed by gzip", ".csv.gz if it contains CSV");
    }
    if (!has_extension(lower_extension(std::filesystem::path(path).stem()),
                       " .csv .txt .tsv .dat .asc ")) {
        refuse_format(path, {0, "", "a file compressed by gzip that is no table of text",
                             "decompress it: gunzip FILE"});
    }
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
    return lower_case(path.extension().string());
}

void check_file_content(const std::string& path) {
    const std::string extension = lower_extension(path);
    std::string head(kHead, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(head.data(), kHead);
    head.resize(static_cast<std::size_t>(stream.gcount()));
    const bool text = is_plain_text(head);
    for (const OtherFormat& format : kOtherFormats) {
        // The names of a table's columns may begin with a few of these letters.
        const bool too_short = text && format.bytes.size() <= 3;
        if (has_bytes_at(head, format.at, format.bytes) && !too_short) {
            refuse_format(path, head.starts_with("PK") ? zip_use(head, format) : format);
        }
    }
    if (is_pickle(head)) {
        refuse_format(path, {0, "", "a Python pickle",
                             "in Python: pandas.read_pickle(FILE).to_csv(OUT, index=False)"});
    }
    if (extension == ".bin" && is_catman(head)) {
        refuse_format(path, {0, "", "a binary file of HBM catman",
                             "export it from catman as UFF 58, MAT or CSV"});
    }
    if (head.starts_with("\x1f\x8b")) {
        return check_gzip(path, extension);
    }
    const bool wave =
        head.starts_with("RIFF") || head.starts_with("FORM") || head.starts_with("RF64");
    if (head.starts_with("RIFF") && head.size() >= 12 && !has_bytes_at(head, 8, "WAVE")) {
        refuse_format(path, {0, "", "a RIFF file other than WAV, for example a video", kPicture});
    }
    for (const SupportedFormat& format : kSupportedFormats) {
        if (has_bytes_at(head, format.at, format.bytes) && (format.at == 0 || wave)) {
            if (!has_extension(extension, format.extensions) &&
                !(has_extension(extension, kSoundExtensions) &&
                  format.extensions.find(".wav") != std::string_view::npos)) {
                refuse_name(path, extension, format.name,
                            format.extensions.substr(1, format.extensions.find(' ', 1) - 1));
            }
            return;
        }
    }
    if (is_universal_file(head)) {
        if (!has_extension(extension, kUffExtensions)) {
            refuse_name(path, extension, "a universal file", ".uff");
        }
        return;
    }
    const bool binary = has_extension(extension, kSoundExtensions) ||
                        has_extension(extension, kHdf5Extensions) ||
                        has_extension(extension, kMatExtensions) || extension == ".tdms";
    if (binary && text) {
        refuse_name(path, extension, "text", ".csv if it is a table");
    }
}

}  // namespace gearpod::mc
