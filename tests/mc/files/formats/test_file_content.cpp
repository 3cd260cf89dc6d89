// Checks that files of other formats are called by their name, whatever they are called.
#include "tests/mc/files/recorded.hpp"
#include "tests/mc/recording_bytes.hpp"

namespace test_file_content {

using namespace gearpod;
using namespace gearpod::test;

namespace {

using Catch::Contains;
using std::string_literals::operator""s;

TEST_CASE("a format that is not supported is called by its name") {
    const Folder folder;
    const std::string rest(200, '\x01');
    const std::pair<std::string, const char*> formats[] = {
        {"PK\x03\x04"s + rest, "is a ZIP archive, which is not supported; unpack it"},
        {"PK\x03\x04"s + rest.substr(0, 26) + "[Content_Types].xml", "an Excel workbook (.xlsx)"},
        {"PK\x03\x04"s + rest.substr(0, 26) + "sensor.npy", "an archive of NumPy arrays (.npz)"},
        {"PAR1" + rest, "is a Parquet file, which is not supported; in Python: pandas"},
        {"\x93NUMPY\x01" + rest, "is a NumPy array (.npy)"},
        {"\x80\x04\x95"s + rest, "is a Python pickle"},
        {"CDF\x01"s + rest, "is a netCDF classic file"},
        {"SQLite format 3\0"s + rest, "is an SQLite database"},
        {"%PDF-1.7\n" + rest, "is a PDF document"},
        {"\x89PNG\r\n" + rest, "is a PNG picture"},
        {"root\0\0"s + rest, "is a ROOT file"},
        {"|CF,2,1,1;|CK,1,3,1,1;", "is an imc FAMOS file"},
        {"DIAEXTENDED  {@:ENGLISH\n#BEGINGLOBALHEADER\n", "is a DIAdem DAT header"},
        {"MDF     4.10    " + rest, "is an MDF measurement file"},
        {"RIFF\x10\0\0\0AVI LIST"s + rest, "is a RIFF file other than WAV"},
        {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + rest, "is an Excel 97 workbook"},
        {"OggS" + rest, "is an Ogg sound file"},
        {"TDSh" + rest, "give the .tdms file next to it"},
        {"<!DOCTYPE html><html>", "is an HTML page"},
        {"\x28\xB5\x2F\xFD" + rest, "compressed by Zstandard"},
    };
    for (const auto& [bytes, words] : formats) {
        for (const char* name : {"a.csv", "a.h5", "a.mat", "a.wav", "a.tdms", "a.uff", "a.xlsx"}) {
            INFO(name);
            CHECK_THAT(reading_error(file_with(folder, name, bytes)),
                       Contains(words) && Contains("which is not supported; "));
        }
    }
    CHECK_THAT(reading_error(file_with(folder, "a.bin", "\x92\x13"s + rest)),
               Contains("is a binary file of HBM catman"));
    CHECK_THAT(reading_error(file_with(folder, "a.h5.gz", "\x1f\x8b\x08"s + rest)),
               Contains("decompress it: gunzip FILE"));
    CHECK_THAT(reading_error(file_with(folder, "a.csv", "\x1f\x8b\x08"s + rest)),
               Contains("is compressed by gzip, but its name ends in .csv; rename it"));
}

TEST_CASE("a name that does not fit the content is named") {
    const Folder folder;
    const std::string table = "time [s],sensor [m/s^2]\n0,1\n1,2\n";
    for (const char* name : {"a.h5", "a.hdf5", "a.mat", "a.wav", "a.flac", "a.tdms"}) {
        const std::string extension = std::string(name).substr(1);
        CHECK(reading_error(file_with(folder, name, table)) ==
              folder.file(name) + ": is text, but its name ends in " + extension +
                  "; rename it to end in .csv if it is a table");
    }
    const std::string wav = wav_bytes(sine_values(20, 0.5), 1, 5000, WavForm::whole_16);
    const std::string uff = uff_bytes(sine_values(20, 0.5), 0.1, "g", UffForm::text_single);
    for (const char* name : {"a.csv", "a.h5", "a.tdms", "a.dat", "a"}) {
        CHECK_THAT(reading_error(file_with(folder, name, wav)),
                   Contains(": is a sound file (WAV), but its name ends in ") &&
                       Contains("rename it to end in .wav"));
        CHECK_THAT(reading_error(file_with(folder, name, uff)),
                   Contains(": is a universal file, but its name ends in ") &&
                       Contains("rename it to end in .uff"));
    }
    for (const char* name : {"a.wav", "a.WAV", "a.bwf", "a.rf64"}) {
        CHECK(reading_error(file_with(folder, name, wav)).empty());
    }
    for (const char* name : {"a.unv", "a.UF58", "a.ufb"}) {
        CHECK(reading_error(file_with(folder, name, uff)).empty());
    }
    CHECK(reading_error(file_with(folder, "a.csv", "ID3,BZh,PK\n1,2,3\n")).empty());
    CHECK_THAT(reading_error(file_with(folder, "a.xyz", table)),
               Contains("unknown file type; its name must end in .csv, "));
}

}  // namespace

}  // namespace test_file_content
