// Checks links and integers in HDF5 files of recordings.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <vector>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"

namespace test_recording_formats {

using namespace gearpod;
using namespace gearpod::test;

namespace {

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
