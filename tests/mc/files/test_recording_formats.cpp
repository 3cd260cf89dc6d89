// Checks recordings in MAT and HDF5 files: values read equal values written.
#include <matio.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <vector>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"

namespace test_recording_formats {

using namespace gearpod;
using namespace gearpod::test;

namespace {

std::vector<double> sines(std::size_t count, double size) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(size * std::sin(0.37 * static_cast<double>(i)));
    }
    return values;
}

std::string written(const Folder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder.file(name), std::ios::binary) << bytes;
    return folder.file(name);
}

std::string refusal(const std::string& path) {
    try {
        const auto file = mc::open_signal_file(path);
        for (const std::string& name : file->names()) {
            static_cast<void>(file->read(name));
        }
        static_cast<void>(file->find({"sensor"}));
        static_cast<void>(file->sampling_Hz());
    } catch (const mc::SignalError& error) {
        return error.what();
    }
    return "";
}

// A struct with the vectors of a signal, as in MATLAB files from data loggers.
std::string mat_struct(const Folder& folder, mat_ft version, const std::vector<double>& sensor) {
    const std::string path = folder.file("s.mat");
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    const char* names[] = {"sensor", "sampling_Hz", "comment"};
    std::size_t one[2] = {1, 1}, column[2] = {sensor.size(), 1}, words[2] = {1, 4};
    std::vector<double> values = sensor;
    double rate = 280.0;
    char text[] = "rig1";
    matvar_t* whole = Mat_VarCreateStruct("test", 2, one, names, 3);
    Mat_VarSetStructFieldByName(
        whole, "sensor", 0,
        Mat_VarCreate("sensor", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, column, values.data(), 0));
    Mat_VarSetStructFieldByName(
        whole, "sampling_Hz", 0,
        Mat_VarCreate("sampling_Hz", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &rate, 0));
    Mat_VarSetStructFieldByName(
        whole, "comment", 0, Mat_VarCreate("comment", MAT_C_CHAR, MAT_T_UINT8, 2, words, text, 0));
    Mat_VarWrite(file, whole, MAT_COMPRESSION_NONE);
    Mat_VarFree(whole);
    Mat_Close(file);
    return path;
}

TEST_CASE("the numeric fields of a MATLAB struct are columns") {
    for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
        const Folder folder;
        const auto sensor = sines(50, 2.0);
        const auto file = mc::open_signal_file(mat_struct(folder, version, sensor));
        CHECK(file->names() == std::vector<std::string>{"test.sensor", "test.sampling_Hz"});
        CHECK(file->read("test.sensor") == sensor);
        CHECK(file->sampling_Hz() == 280.0);
    }
}

TEST_CASE("a truncated MATLAB file is refused, compressed or not") {
    const Folder folder;
    std::vector<double> values = sines(4000, 2.0);
    std::size_t size[2] = {values.size(), 1};
    for (const matio_compression form : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
        const std::string path = folder.file("whole.mat");
        mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
        for (const char* name : {"sensor", "te"}) {
            matvar_t* vector = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size,
                                             values.data(), MAT_F_DONT_COPY_DATA);
            REQUIRE(Mat_VarWrite(file, vector, form) == 0);
            Mat_VarFree(vector);
        }
        Mat_Close(file);
        CHECK(mc::open_signal_file(path)->read("te") == values);
        const std::string bytes = bytes_of(path);
        for (const double share : {0.3, 0.6, 0.9, 0.999}) {
            const auto kept = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
            INFO(form << " " << share);
            CHECK(refusal(written(folder, "cut.mat", bytes.substr(0, kept))).find("is truncated") !=
                  std::string::npos);
        }
    }
}

TEST_CASE("a MATLAB table is refused with a remedy") {
    const Folder folder;
    const std::string path = folder.file("t.mat");
    Mat_Close(Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73));
    {
        const mc::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path);
        // Layout as MATLAB writes it: an identifying word and the positions of its parts.
        const hsize_t size[2] = {1, 6};
        const std::uint32_t words[] = {0xDD000000, 2, 1, 1, 1, 1};
        const mc::Hdf5Handle space(H5Screate_simple(2, size, nullptr), H5Sclose, "T");
        const mc::Hdf5Handle table(H5Dcreate2(file.get(), "T", H5T_NATIVE_UINT32, space.get(),
                                              H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                   H5Dclose, "T");
        H5Dwrite(table.get(), H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, words);
        const mc::Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "T");
        H5Tset_size(text.get(), 5);
        const mc::Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "T");
        const mc::Hdf5Handle name(H5Acreate2(table.get(), "MATLAB_class", text.get(), scalar.get(),
                                             H5P_DEFAULT, H5P_DEFAULT),
                                  H5Aclose, "T");
        H5Awrite(name.get(), text.get(), "table");
    }
    const std::string why = refusal(path);
    INFO(why);
    CHECK(why.find("T is a table, timetable or object") != std::string::npos);
    CHECK(why.find("table2struct") != std::string::npos);
}

TEST_CASE("links out of an HDF5 file are refused by name and not opened") {
    const Folder folder;
    const auto make = [&](const std::string& name, auto add) {
        const std::string path = folder.file(name);
        const mc::Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                                  H5Fclose, path);
        mc::write_numbers(file.get(), "time", {3}, {0.0, 1.0, 2.0});
        add(file.get());
        return path;
    };
    // Opening the pipe would block until a writer appears.
    const std::string pipe = folder.file("pipe.h5");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const std::string link = make("link.h5", [&](hid_t file) {
        H5Lcreate_external(pipe.c_str(), "/sensor", file, "sensor", H5P_DEFAULT, H5P_DEFAULT);
    });
    CHECK(refusal(link).find("sensor is stored in another file") != std::string::npos);
    const std::string group = make("group.h5", [&](hid_t file) {
        H5Lcreate_external(pipe.c_str(), "/", file, "signals", H5P_DEFAULT, H5P_DEFAULT);
    });
    CHECK(refusal(group).empty());
    CHECK_THROWS_WITH(mc::open_signal_file(group)->find({"signals"}),
                      Catch::Contains("signals is stored in another file"));
    CHECK(mc::open_signal_file(group)->contents() == "signals (in another file), time (3)");
    const std::string raw = make("raw.h5", [&](hid_t file) {
        const hsize_t count = 3;
        const mc::Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "raw");
        const mc::Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "raw");
        H5Pset_external(made.get(), "/etc/passwd", 0, 24);
        const mc::Hdf5Handle dataset(H5Dcreate2(file, "sensor", H5T_NATIVE_DOUBLE, space.get(),
                                                H5P_DEFAULT, made.get(), H5P_DEFAULT),
                                     H5Dclose, "raw");
    });
    CHECK(refusal(raw).find("sensor is stored in another file") != std::string::npos);
    // A link within the file is equivalent to the dataset.
    const std::string soft = make("soft.h5", [&](hid_t file) {
        H5Lcreate_soft("/time", file, "sensor", H5P_DEFAULT, H5P_DEFAULT);
    });
    CHECK(refusal(soft).empty());
    CHECK(mc::open_signal_file(soft)->read("sensor") == std::vector<double>{0.0, 1.0, 2.0});
}

TEST_CASE("rate and scale of an HDF5 file may be integers") {
    const Folder folder;
    const std::string path = folder.file("whole.h5");
    {
        const mc::Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                                  H5Fclose, path);
        mc::write_numbers(file.get(), "sensor", {3}, {0.0, 1.0, 2.0});
        const mc::Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "scalar");
        const std::pair<const char*, std::int64_t> numbers[] = {{"sampling_Hz", 5000},
                                                                {"scale", 2}};
        for (const auto& [name, value] : numbers) {
            const std::string of = std::string(name) == "scale" ? "sensor" : "/";
            const mc::Hdf5Handle attribute(
                H5Acreate_by_name(file.get(), of.c_str(), name, H5T_STD_I64LE, scalar.get(),
                                  H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose, name);
            H5Awrite(attribute.get(), H5T_NATIVE_INT64, &value);
        }
    }
    const auto file = mc::open_signal_file(path);
    CHECK(file->sampling_Hz() == 5000.0);
    CHECK(file->read("sensor") == std::vector<double>{0.0, 2.0, 4.0});
}

}  // namespace

}  // namespace test_recording_formats
