// Checks HDF5 files of other programs: their structure, and their statements of units, scales and
// rates. tests/recordings has links, integers and text of fixed length.
#include "mc/files/hdf5_data.hpp"
#include "tests/mc/files/recorded.hpp"

namespace gearpod::test_hdf5_recordings {

using namespace test;
using Values = std::vector<double>;

const Values kSix = {1.0, -2.0, 3.0, -4.0, 5.0, -6.0};

// A file that the test fills through its handle, and then reads.
class Made {
  public:
    template <class Fill>
    explicit Made(Fill fill, bool latest = false) {
        const mc::Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
        if (latest) {
            H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
        }
        const mc::Hdf5Handle file(
            H5Fcreate(path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose, path());
        fill(file.get());
    }
    std::string path() const { return folder_.file("a.h5"); }
    std::unique_ptr<mc::SignalFile> open() const { return mc::open_signal_file(path()); }
    // Message of the error that choosing and reading a column causes, else "".
    std::string refusal(const std::string& name) const {
        return error_in([&] {
            const auto file = open();
            const std::string found = file->find({name});
            if (!found.empty()) {
                static_cast<void>(file->read(found));
                static_cast<void>(file->sampling_Hz_of(found));
            }
        });
    }

  private:
    Folder folder_;
};

void check_contains(const std::string& text, const std::string& part) {
    CHECK_THAT(text, Catch::Contains(part));
}

// Unit of a column with these attributes.
std::string unit_of(const std::map<std::string, std::string>& attributes) {
    const Made made([&](hid_t file) {
        mc::write_numbers(file, "sensor", {6}, kSix);
        for (const auto& [name, text] : attributes) {
            mc::write_text(file, "sensor", name, text);
        }
    });
    return made.open()->unit("sensor");
}

TEST_CASE("Attributes state the unit under usual names") {
    for (const char* name : {"unit", "units", "Units", "unit_string", "engineering_units"}) {
        INFO(name);
        CHECK(unit_of({{name, "g"}}) == "g");
    }
    CHECK(unit_of({{"unit", "m/s^2"}, {"units", "m/s²"}}) == "m/s^2");
    CHECK(unit_of({{"unit", "g"}, {"units", "m/s^2"}}) ==
          "g (attribute unit) but m/s^2 (attribute units)");
}

TEST_CASE("The unit of a group belongs to its only signal, and is named if there are more") {
    const auto fill = [](hid_t file, bool two) {
        const mc::Hdf5Handle run = mc::create_group(file, "run");
        mc::write_text(file, "run", "units", "g");
        mc::write_numbers(run.get(), "sensor", {6}, kSix);
        if (two) {
            mc::write_numbers(run.get(), "te", {6}, kSix);
        }
    };
    const Made one([&](hid_t file) { fill(file, false); });
    CHECK(one.open()->unit("run/sensor") == "g");
    const Made two([&](hid_t file) { fill(file, true); });
    const auto file = two.open();
    CHECK(file->unit("run/sensor").empty());
    REQUIRE(file->notes().size() == 1);
    check_contains(file->notes()[0], "unit g of the group of run/sensor is not used");
}

TEST_CASE("Scale and offset are applied, and contradictory ones refused") {
    using Numbers = std::map<std::string, double>;
    const auto made = [](const Numbers& numbers) {
        return Made([&](hid_t file) {
            mc::write_integers(file, "sensor", {3}, {10, 20, -5});
            for (const auto& [name, value] : numbers) {
                mc::write_number(file, "sensor", name, value);
            }
        });
    };
    const auto values = [&](const Numbers& numbers) {
        return made(numbers).open()->read("sensor");
    };
    CHECK(values({{"scale", 0.5}}) == Values{5.0, 10.0, -2.5});
    CHECK(values({{"scale_factor", 0.5}, {"add_offset", 1.0}}) == Values{6.0, 11.0, -1.5});
    CHECK(values({{"conversion", 2.0}, {"offset", 1.0}}) == Values{21.0, 41.0, -9.0});
    CHECK(values({{"scale", 2.0}, {"scale_factor", 2.0}}) == Values{20.0, 40.0, -10.0});
    CHECK(values({{"offset", -1.0}}) == Values{9.0, 19.0, -6.0});
    const Values missing = values({{"_FillValue", 20.0}, {"scale_factor", 0.1}});
    CHECK(std::isnan(missing[1]));
    CHECK(missing[0] == 1.0);
    check_contains(made({{"scale", 2.0}, {"scale_factor", 3.0}}).refusal("sensor"),
                   "scale = 2 and scale_factor = 3; they differ");
    check_contains(made({{"scale", 2.0}, {"offset", 1.0}}).refusal("sensor"),
                   "in an order that is not defined");
    const Made gain = made({{"gain", 10.0}});
    const auto file = gain.open();
    CHECK(file->read("sensor") == Values{10.0, 20.0, -5.0});
    REQUIRE(file->notes().size() == 1);
    CHECK(file->notes()[0] == "attribute gain = 10 of sensor is not used");
}

TEST_CASE("Usual names of a sampling rate or interval are read next to the column first") {
    const std::map<std::string, double> names = {{"sampling_Hz", 5120.0},
                                                 {"fs", 5120.0},
                                                 {"Fs", 5120.0},
                                                 {"SamplingRate", 5120.0},
                                                 {"sample_rate", 5120.0},
                                                 {"Sampling Frequency (Hz)", 5120.0},
                                                 {"sampling_rate_kHz", 5.12},
                                                 {"dt", 1.0 / 5120.0},
                                                 {"wf_increment", 1.0 / 5120.0},
                                                 {"sample_interval_ms", 1e3 / 5120.0}};
    for (const auto& [name, value] : names) {
        INFO(name);
        const Made made([&](hid_t file) {
            const mc::Hdf5Handle run = mc::create_group(file, "run");
            mc::write_numbers(run.get(), "sensor", {6}, kSix);
            mc::write_number(file, "run", name, value);
            mc::write_number(file, ".", "sampling_Hz", 99.0);  // of other groups
        });
        CHECK(*made.open()->sampling_Hz_of("run/sensor") == Approx(5120.0).epsilon(1e-12));
    }
    const Made two([](hid_t file) {
        mc::write_numbers(file, "sensor", {6}, kSix);
        mc::write_number(file, ".", "fs", 5120.0);
        mc::write_number(file, "sensor", "wf_increment", 1.0 / 5000.0);
        mc::write_number(file, "sensor", "sampling_rate", 5120.0);
    });
    const std::string why = two.refusal("sensor");
    check_contains(why, "5120 Hz");
    check_contains(why, "5000 Hz; give --sampling-Hz");
    const Made dataset([](hid_t file) {
        mc::write_numbers(file, "sensor", {6, 1}, kSix);
        mc::write_numbers(file, "fs", {1, 1}, {5120.0});
    });
    CHECK(dataset.open()->sampling_Hz_of("sensor") == 5120.0);
    const Made zero([](hid_t file) {
        mc::write_numbers(file, "sensor", {6}, kSix);
        mc::write_number(file, ".", "fs", 0.0);
    });
    check_contains(zero.refusal("sensor"), "fs = 0 is not a sampling rate");
}

TEST_CASE("Columns are found in groups by path or name, and others next to them") {
    const Made made([](hid_t file) {
        for (const char* name : {"run1", "run2"}) {
            const mc::Hdf5Handle run = mc::create_group(file, name);
            const mc::Hdf5Handle inner = mc::create_group(run.get(), "acc");
            mc::write_numbers(inner.get(), "sensor", {1, 6}, kSix);
            mc::write_numbers(run.get(), "time", {6, 1}, {0, 1, 2, 3, 4, 5});
        }
        mc::write_numbers(file, "extra", {6}, kSix);
        mc::write_numbers(file, "te", {6}, kSix);
    });
    const auto file = made.open();
    CHECK(file->find({"run2/acc/sensor"}) == "run2/acc/sensor");
    CHECK(file->find({"/run2/acc/sensor"}) == "run2/acc/sensor");
    CHECK(file->read("run2/acc/sensor") == kSix);
    CHECK(file->find({"time", "run2/acc/sensor", false}) == "run2/time");
    CHECK(file->find({"te", "run2/acc/sensor", false}) == "te");
    CHECK(file->find({"speed_rpm", "run2/acc/sensor", false}).empty());
    CHECK(file->find({"time", "extra", false}).empty());  // the times are of other groups
    CHECK(file->find({"sensor", "", false}).empty());
    CHECK(file->find({"nothing"}).empty());
    check_contains(made.refusal("sensor"),
                   "several columns are named sensor: run1/acc/sensor, run2/acc/sensor");
    CHECK(file->contents() ==
          "extra (6), run1/acc/sensor (1 x 6), run1/time (6 x 1), run2/acc/sensor (1 x 6), "
          "run2/time (6 x 1), te (6)");
    const Made one([](hid_t root) {
        const mc::Hdf5Handle run = mc::create_group(root, "Vibration");
        mc::write_numbers(run.get(), "sensor", {6}, kSix);
    });
    const auto single = one.open();
    CHECK(single->find({"sensor", "", false}) == "Vibration/sensor");
    CHECK(single->notes() == std::vector<std::string>{"column sensor is Vibration/sensor"});
}

TEST_CASE("Columns of a matrix are chosen by their number from 1, along the longer dimension") {
    const Made made([](hid_t file) {
        mc::write_numbers(file, "tall", {3, 2}, kSix);
        mc::write_numbers(file, "wide", {2, 3}, kSix);
        mc::write_numbers(file, "square", {2, 2}, {1.0, 2.0, 3.0, 4.0});
        mc::write_numbers(file, "cube", {1, 2, 3}, kSix);
    });
    const auto file = made.open();
    CHECK(file->names().empty());
    CHECK(file->find({"tall:1"}) == "tall:1");
    CHECK(file->read("tall:1") == Values{1.0, 3.0, 5.0});
    CHECK(file->read("tall:2") == Values{-2.0, -4.0, -6.0});
    CHECK(file->read("wide:2") == Values{-4.0, 5.0, -6.0});
    CHECK(file->read("cube:1") == Values{1.0, -2.0, 3.0});
    check_contains(made.refusal("tall"), "tall is a matrix of 3 x 2; choose one of its columns");
    check_contains(made.refusal("tall:0"), "2 columns, counted from 1");
    check_contains(made.refusal("tall:3"), "2 columns, counted from 1");
    check_contains(made.refusal("square:1"), "has the shape 2 x 2");
    check_contains(file->contents(), "tall (3 x 2; tall:1 to tall:2)");
}

TEST_CASE("Datasets that are not columns of numbers do not prevent reading, and are named") {
    const Made made([](hid_t file) {
        mc::write_numbers(file, "sensor", {6}, kSix);
        const hsize_t two = 2;
        const mc::Hdf5Handle space(H5Screate_simple(1, &two, nullptr), H5Sclose, "space");
        const mc::Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "text");
        H5Tset_size(text.get(), 10);
        const mc::Hdf5Handle pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose, "pair");
        H5Tinsert(pair.get(), "re", 0, H5T_NATIVE_DOUBLE);
        H5Tinsert(pair.get(), "im", 8, H5T_NATIVE_DOUBLE);
        for (const auto& [name, type] : {std::pair{"time", text.get()}, {"pairs", pair.get()}}) {
            const mc::Hdf5Handle dataset(
                H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Dclose, name);
        }
        H5Lcreate_soft("/nowhere", file, "dangling", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_hard(file, "/", file, "circle", H5P_DEFAULT, H5P_DEFAULT);
    });
    const auto file = made.open();
    CHECK(file->names() == std::vector<std::string>{"pairs/im", "pairs/re", "sensor"});
    CHECK(file->read("sensor") == kSix);
    CHECK(file->read("pairs/im") == Values{0.0, 0.0});
    CHECK(file->find({"time", "sensor", false}).empty());
    REQUIRE(file->notes().size() == 1);
    CHECK(file->notes()[0] == "time (text) is not a column of numbers; it is not used");
    check_contains(made.refusal("pairs"), "pairs (compound) is not a column of numbers");
    check_contains(file->contents(),
                   "pairs (compound), pairs/im (2), pairs/re (2), sensor (6), time (text)");
}

TEST_CASE("A file of 20,000 datasets is read, and its list is short") {
    for (const bool latest : {false, true}) {
        const Made made(
            [](hid_t file) {
                for (int i = 0; i < 20000; ++i) {
                    mc::write_numbers(file, "c" + std::to_string(i), {1}, {1.0});
                }
                mc::write_numbers(file, "sensor", {6}, kSix);
            },
            latest);
        const auto file = made.open();
        CHECK(file->find({"sensor"}) == "sensor");
        CHECK(file->read("sensor") == kSix);
        check_contains(file->contents(), "and 19981 more");
        CHECK(file->contents().size() < 400);
    }
}

TEST_CASE("Files that cannot be opened as HDF5 are refused with the true reason") {
    const Folder folder;
    const std::string path = folder.file("a.h5");
    const auto refusal = [&](const std::string& bytes) {
        write_bytes(path, bytes);
        return error_in([&] { static_cast<void>(mc::open_signal_file(path)->names()); });
    };
    const Made made([](hid_t file) { mc::write_numbers(file, "sensor", {6}, kSix); }, true);
    std::string bytes = bytes_of(made.path());
    CHECK(refusal(bytes).empty());
    check_contains(refusal(bytes.substr(0, bytes.size() - 20)), "is truncated");
    // Superblock version 3: a flag states that the file is open for writing. Its checksum follows
    // from the other bytes, so the flag alone is set by the library.
    {
        const mc::Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
        H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
        const mc::Hdf5Handle open(H5Fopen(made.path().c_str(), H5F_ACC_RDWR, access.get()),
                                  H5Fclose, "open");
        H5Fflush(open.get(), H5F_SCOPE_GLOBAL);
        bytes = bytes_of(made.path());
    }
    const std::string unclosed = refusal(bytes);
    check_contains(unclosed, "the program that wrote it did not close it");
    check_contains(unclosed, "h5clear -s " + path);
    check_contains(refusal(std::string("CDF\x01", 4) + std::string(200, '\0')),
                   "netCDF classic: nccopy");
    check_contains(refusal("\x0e\x03\x13\x01" + std::string(200, 'x')), "is not an HDF5 file");
    check_contains(refusal(""), "is empty");
    check_contains(refusal(std::string(2000, '\0')), "begins with zeros");
    check_contains(refusal("<html><body>not found</body></html>"), "is an HTML or XML text");
    check_contains(refusal("time,sensor\n"), "is not an HDF5 file");
}

}  // namespace gearpod::test_hdf5_recordings
