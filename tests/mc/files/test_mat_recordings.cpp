// Checks MAT files of other programs: structs, cells, matrices, repeated variables and statements.
#include <matio.h>

#include <catch2/catch.hpp>
#include <vector>

#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"

namespace test_mat_recordings {

using namespace gearpod;
using namespace gearpod::test;
using Values = std::vector<double>;

namespace {

const Values kSix = {1.0, -2.0, 3.0, -4.0, 5.0, -6.0};

matvar_t* numbers(const char* name, Values values, std::size_t rows, std::size_t columns) {
    std::size_t size[2] = {rows, columns};
    return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, values.data(), 0);
}

matvar_t* text(const char* name, std::string value) {
    std::size_t size[2] = {1, value.size()};
    return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UINT8, 2, size, value.data(), 0);
}

matvar_t* structure(const char* name, std::vector<std::pair<const char*, matvar_t*>> fields) {
    std::vector<const char*> names;
    for (const auto& field : fields) {
        names.push_back(field.first);
    }
    std::size_t one[2] = {1, 1};
    matvar_t* whole =
        Mat_VarCreateStruct(name, 2, one, names.data(), static_cast<unsigned>(names.size()));
    for (const auto& [field, value] : fields) {
        Mat_VarSetStructFieldByName(whole, field, 0, value);
    }
    return whole;
}

std::string written(const Folder& folder, const std::vector<matvar_t*>& variables,
                    mat_ft version = MAT_FT_MAT5, matio_compression form = MAT_COMPRESSION_NONE) {
    const std::string path = folder.file("a.mat");
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    REQUIRE(file != nullptr);
    for (matvar_t* variable : variables) {
        REQUIRE(Mat_VarWrite(file, variable, form) == 0);
        Mat_VarFree(variable);
    }
    Mat_Close(file);
    return path;
}

std::string refusal(const std::string& path, const std::string& name) {
    try {
        static_cast<void>(mc::open_signal_file(path)->find({name}));
    } catch (const mc::SignalError& error) {
        return error.what();
    }
    return "";
}

TEST_CASE("The last variable of a name counts, which is reported") {
    for (const matio_compression form : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
        const Folder folder;
        // matio writes no variable twice, so the variables of two files are joined.
        constexpr std::size_t kHeader = 128;
        const std::string first = bytes_of(
            written(folder, {numbers("sensor", Values(6, 0.0), 6, 1), numbers("te", kSix, 1, 6)},
                    MAT_FT_MAT5, form));
        const std::string path =
            written(folder, {numbers("sensor", kSix, 6, 1)}, MAT_FT_MAT5, form);
        write_bytes(path, first + bytes_of(path).substr(kHeader));
        const auto file = mc::open_signal_file(path);
        CHECK(file->find({"sensor"}) == "sensor");
        CHECK(file->read("sensor") == kSix);
        CHECK(file->read("te") == kSix);
        REQUIRE(file->notes().size() == 1);
        CHECK(file->notes()[0] ==
              "the variable sensor occurs more than once; the last one is used, as in MATLAB");
    }
}

TEST_CASE("Structs in structs, matrices and rates are read in all versions") {
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        const Folder folder;
        const std::string path = written(
            folder,
            {structure("run", {{"acc", structure("acc", {{"sensor", numbers("sensor", kSix, 1, 6)},
                                                         {"time", numbers("time", kSix, 6, 1)}})},
                               {"Fs", numbers("Fs", {5120.0}, 1, 1)}}),
             numbers("data", kSix, 3, 2), numbers("wide", kSix, 2, 3), numbers("dt", {1.0}, 1, 1)},
            version);
        const auto file = mc::open_signal_file(path);
        CHECK(file->find({"sensor", "", false}) == "run.acc.sensor");
        CHECK(file->find({"run.acc.sensor"}) == "run.acc.sensor");
        CHECK(file->read("run.acc.sensor") == kSix);
        CHECK(file->find({"time", "run.acc.sensor", false}) == "run.acc.time");
        CHECK(file->find({"time", "data:1", false}).empty());
        CHECK(file->sampling_Hz_of("run.acc.sensor") == 5120.0);
        CHECK(file->sampling_Hz_of("data:1") == 1.0);
        // MATLAB stores columns: 3 x 2 has the columns (1, -2, 3) and (-4, 5, -6).
        CHECK(file->find({"data:2"}) == "data:2");
        CHECK(file->read("data:1") == Values{1.0, -2.0, 3.0});
        CHECK(file->read("data:2") == Values{-4.0, 5.0, -6.0});
        CHECK(file->read("wide:1") == Values{1.0, 3.0, 5.0});
        CHECK(refusal(path, "data").find("data is a matrix of 3 x 2; choose one of its columns") !=
              std::string::npos);
        CHECK(refusal(path, "data:3").find("2 columns, counted from 1") != std::string::npos);
        CHECK(file->contents().find("data (3 x 2; data:1 to data:2)") != std::string::npos);
    }
}

TEST_CASE("Elements of struct arrays and cells are named as in MATLAB") {
    const Folder folder;
    std::size_t two[2] = {1, 2};
    const char* names[] = {"Name", "Data"};
    matvar_t* array = Mat_VarCreateStruct("Y", 2, two, names, 2);
    Mat_VarSetStructFieldByName(array, "Name", 0, text("Name", "force"));
    Mat_VarSetStructFieldByName(array, "Data", 0, numbers("Data", Values(6, 7.0), 6, 1));
    Mat_VarSetStructFieldByName(array, "Name", 1, text("Name", "vibration"));
    Mat_VarSetStructFieldByName(array, "Data", 1, numbers("Data", kSix, 6, 1));
    matvar_t* cells[] = {numbers("a", Values(6, 8.0), 1, 6), numbers("b", kSix, 1, 6)};
    matvar_t* cell = Mat_VarCreate("c", MAT_C_CELL, MAT_T_CELL, 2, two, cells, 0);
    const std::string path = written(folder, {array, cell});
    const auto file = mc::open_signal_file(path);
    CHECK(file->find({"Y(2).Data"}) == "Y(2).Data");
    CHECK(file->read("Y(2).Data") == kSix);
    CHECK(file->read("c{2}") == kSix);
    CHECK(refusal(path, "Data").find("several columns are named Data: Y(1).Data, Y(2).Data") !=
          std::string::npos);
}

TEST_CASE("The unit next to a column is read") {
    const Folder folder;
    const auto file = mc::open_signal_file(
        written(folder, {numbers("sensor", kSix, 6, 1), text("sensor_unit", "g"),
                         structure("s", {{"data", numbers("data", kSix, 6, 1)},
                                         {"units", text("units", "mm/s^2")}}),
                         structure("t", {{"a", numbers("a", kSix, 6, 1)},
                                         {"b", numbers("b", kSix, 6, 1)},
                                         {"unit", text("unit", "V")}})}));
    CHECK(file->unit("sensor") == "g");
    CHECK(file->unit("s.data") == "mm/s^2");
    CHECK(file->unit("t.a").empty());
    REQUIRE(file->notes().size() == 1);
    CHECK(file->notes()[0] == "t.unit = V is not used, because it may belong to several columns");
}

TEST_CASE("Complex and sparse matrices, text and contradictory rates are refused by name") {
    const Folder folder;
    std::size_t size[2] = {6, 1};
    Values re = kSix, im = kSix;
    mat_complex_split_t parts{re.data(), im.data()};
    matvar_t* complex =
        Mat_VarCreate("z", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, &parts, MAT_F_COMPLEX);
    const std::string path =
        written(folder, {complex, text("word", "hello"), numbers("sensor", kSix, 6, 1),
                         numbers("fs", {5120.0}, 1, 1), numbers("dt", {1.0 / 5000.0}, 1, 1)});
    CHECK(refusal(path, "z").find("z is complex") != std::string::npos);
    CHECK(refusal(path, "word").find("word (text) is not a column of numbers") !=
          std::string::npos);
    const auto file = mc::open_signal_file(path);
    CHECK(file->read("sensor") == kSix);
    CHECK_THROWS_WITH(file->sampling_Hz_of("sensor"),
                      Catch::Contains("fs states a sampling rate of 5120 Hz, but dt one of 5000"));
    for (const auto& [begin, why] :
         {std::pair{"\x89HDF\r\n\x1a\n", "is an HDF5 file, but its name ends in .mat"},
          {"# Created by Octave 8.4", "is a text file of Octave"}}) {
        write_bytes(folder.file("b.mat"), begin + std::string(300, ' '));
        CHECK(refusal(folder.file("b.mat"), "x").find(why) != std::string::npos);
    }
}

}  // namespace

}  // namespace test_mat_recordings
