// Checks that recordings of other programs, read by Python, are columns of the program: names,
// rates, times and units, and the ends of the Python process. tests/python/test_signal_files.py
// checks the values.
#include <sys/stat.h>
#include <sys/wait.h>

#include "mc/files/signal_units.hpp"
#include "tests/mc/files/recorded.hpp"
#include "tests/mc/tdms_bytes.hpp"

namespace gearpod::test_foreign_recordings {

using namespace test;

using Catch::Contains;
using Names = std::vector<std::string>;
using Values = std::vector<double>;

constexpr unsigned kAll = kTdmsMeta | kTdmsNew | kTdmsRaw;

TEST_CASE("Channels of a group are found by their names, and different sampling is refused") {
    const Folder folder;
    const TdmsBytes to;
    const auto sampled = [&](double step, double start) {
        return std::vector{to.property("wf_increment", step),
                           to.property("wf_start_offset", start)};
    };
    const auto opened = [&](double step, double start) {
        return mc::open_signal_file(
            file_with(folder, "a.tdms",
                      to.segment(kAll,
                                 {to.object("/'it''s'/'a'", to.index(10, 2), sampled(0.5, 0.0)),
                                  to.object("/'h'/'a'", to.index(10, 2), sampled(step, start)),
                                  to.object("/'h'/'b'", to.index(10, 2), sampled(0.5, 0.0))},
                                 to.reals({1, 2, 3, 4, 5, 6}))));
    };
    const auto file = opened(0.5, 0.0);
    CHECK(file->names() == Names{"it's/a", "h/a", "h/b"});
    CHECK(file->find({"b"}) == "h/b");
    CHECK(file->find({"c"}).empty());
    CHECK(file->find({"a", "", false}).empty());
    CHECK(file->find({"a", "h/b", false}) == "h/a");
    CHECK(file->find({"b", "it's/a", false}).empty());
    CHECK(file->find({"b", "it's/a"}) == "h/b");
    CHECK_THROWS_WITH(file->find({"a"}), Contains("several columns are named a: it's/a, h/a"));
    CHECK(file->read("it's/a") == Values{1, 2});
    CHECK(file->read("h/a") == Values{3, 4});
    CHECK(file->sampling_Hz_of("h/a") == 2.0);
    const auto refusal = [&](double step, double start) {
        const auto other = opened(step, start);
        CHECK(other->read("h/b") == Values{5, 6});
        CHECK(other->sampling_Hz_of("h/b") == 2.0);  // a column that is not in use does not matter
        return error_in([&] { static_cast<void>(other->read("h/a")); });
    };
    CHECK_THAT(refusal(0.25, 0.0), Contains("have different time steps, 0.5 s and 0.25 s"));
    CHECK_THAT(refusal(0.5, 1.0), Contains("start at different times, 1 s apart"));
}

TEST_CASE("Titles are names, and a label that contradicts the file's units is no unit") {
    const Folder folder;
    const Values values = sine_values(20, 3.0);
    const std::string lengths = fmt::format(
        "    -1\n   164\n{:10}{:20}{:10}\n{:25.17e}{:25.17e}{:25.17e}\n{:25.17e}\n    -1\n", 5,
        "mm", 2, 1000.0, 1.0, 1.0, 0.0);
    const auto unit = [&](const std::string& before, const std::string& label) {
        const auto file = mc::open_signal_file(file_with(
            folder, "a.uff", before + uff_bytes(values, 0.5, label, UffForm::bytes_little)));
        CHECK(file->read("sensor") == values);
        return file->unit("sensor");
    };
    CHECK(unit("", "g") == "g");
    CHECK(unit(lengths, "mm/s^2") == "mm/s^2");
    CHECK(unit(lengths, "NONE") == "mm/s^2");
    CHECK(unit(lengths, "m/s^2") == "m/s^2 by the function's label, but mm/s^2 by dataset 164");
    CHECK_FALSE(mc::unit_factor(mc::Quantity::acceleration, unit(lengths, "g")));
    std::string second = uff_bytes(values, 0.5, "g", UffForm::text_double);
    second.replace(second.find("title"), 5, "Mic");
    const auto file = mc::open_signal_file(
        file_with(folder, "a.uff", uff_bytes(values, 0.5, "g", UffForm::text_single) + second));
    CHECK(file->contents() == "function1 (title), function2 (Mic)");
    CHECK(file->find({"Mic"}) == "function2");
}

TEST_CASE("Stored times belong to the column in use") {
    const Folder folder;
    const auto uneven = [](const std::string& times) {
        std::string bytes = uff_bytes(Values{5, 6, 7}, 0.5, "g", UffForm::text_single);
        const std::size_t at = bytes.find("         2         3         1");
        bytes.replace(at + 29, 1, "0");
        bytes.erase(bytes.find('\n', bytes.rfind("NONE")) + 1);
        return bytes + times + "    -1\n";
    };
    const std::string first = uneven(" 1.0 5.0 1.5 6.0 2.0 7.0\n");
    const auto file = mc::open_signal_file(
        file_with(folder, "a.uff", first + uneven(" 1.0 5.0 3.0 6.0 5.0 7.0\n")));
    CHECK(file->names() == Names{"function1", "function2", "time", "time of function2"});
    CHECK(file->read("function2") == Values{5, 6, 7});
    CHECK(file->find({"time", "function2", false}) == "time of function2");
    CHECK(file->read("time of function2") == Values{1, 3, 5});
    CHECK_THROWS_WITH(file->read("function1"), Contains("has other times than the first column"));
    const auto even = mc::open_signal_file(file_with(
        folder, "a.uff", first + uff_bytes(Values{1, 2}, 0.5, "g", UffForm::text_single)));
    CHECK(even->read("function2") == Values{1, 2});
    CHECK(even->find({"time", "function2", false}).empty());
    CHECK(even->sampling_Hz_of("function2") == 2.0);
}

// Matrix of MATLAB 4: type, rows, columns, no imaginary part, length of the name.
std::string matrix_bytes(const std::string& name, std::uint64_t columns, const Values& values) {
    std::string bytes;
    for (const std::uint64_t number :
         {std::uint64_t{0}, values.size() / columns, columns, std::uint64_t{0}, name.size() + 1}) {
        append_number(bytes, number, 4);
    }
    return bytes + name + '\0' + TdmsBytes().reals(values);
}

TEST_CASE("Columns of matrices and rates in variables are read") {
    const Folder folder;
    const auto file = mc::open_signal_file(
        file_with(folder, "a.mat",
                  matrix_bytes("data", 2, {1, 2, 3, 4, 5, 6}) + matrix_bytes("fs", 1, {5120})));
    CHECK(file->contents() == "data (3 x 2; data:1 to data:2), fs (1 x 1)");
    CHECK(file->find({"data:2"}) == "data:2");
    CHECK(file->read("data:2") == Values{4, 5, 6});
    CHECK(file->sampling_Hz_of("data:2") == 5120.0);
    CHECK_THROWS_WITH(file->find({"data"}), Contains("data is a matrix of 3 x 2; choose one"));
    CHECK_THROWS_WITH(file->find({"data:3"}), Contains("data has 2 columns, counted from 1"));
}

TEST_CASE("The content decides how a file is read, and one message names ways to convert others") {
    const Folder folder;
    const Values values = sine_values(20, 0.5);
    const std::string wav = wav_bytes(values, 1, 5000, WavForm::floating_64);
    for (const char* name : {"a.wav", "a.WAV", "a.csv", "a.h5", "a"}) {
        const auto file = mc::open_signal_file(file_with(folder, name, wav));
        CHECK(file->read("sensor") == values);
        CHECK(file->sampling_Hz() == 5000.0);
    }
    for (const auto& [name, bytes] : {std::pair{"a.xlsx", "PK\x03\x04"},
                                      {"a.csv", "PK\x03\x04"},
                                      {"a.csv", "<!DOCTYPE html>"},
                                      {"a.npy", "\x93NUMPY"},
                                      {"a.xyz", "sensor\n1\n2\n"}}) {
        CHECK_THAT(reading_error(file_with(folder, name, bytes)),
                   Contains("is not a file that gearpod reads") && Contains("asammdf"));
    }
    CHECK_THAT(reading_error(file_with(folder, "a.tdms", "sensor\n1\n2\n")),
               Contains("a.tdms: is damaged or truncated in the segment at byte 0"));
}

TEST_CASE("The end of the Python process is reported, and no process or file remains") {
    const Folder folder;
    const std::string file =
        file_with(folder, "a.wav", wav_bytes(sine_values(20, 0.5), 1, 5000, WavForm::whole_16));
    const auto error_with = [&](const std::string& script) {
        const std::string python = file_with(folder, "python", "#!/bin/sh\n" + script + "\n");
        chmod(python.c_str(), 0755);
        setenv("GEARPOD_PYTHON", script.empty() ? "/none" : python.c_str(), 1);
        const std::string error = reading_error(file);
        unsetenv("GEARPOD_PYTHON");
        return error;
    };
    setenv("TMPDIR", folder.file("temporary").c_str(), 1);
    std::filesystem::create_directory(folder.file("temporary"));
    CHECK_THAT(error_with(""), Contains("/none cannot be started") && Contains("GEARPOD_PYTHON"));
    CHECK_THAT(error_with("kill -SEGV $$"), Contains("a.wav: is damaged: reading it was ended by"));
    CHECK_THAT(error_with("exit 1"), Contains("ended with exit code 1"));
    CHECK_THAT(error_with("printf ': is made up'; exit 3"), Contains("a.wav: is made up"));
    CHECK_THAT(error_with("exit 0"), Contains("what Python has read cannot be taken over"));
    CHECK_THAT(error_with("exec /usr/bin/python3 -S \"$@\""),
               Contains("needs the Python packages numpy, h5py, soundfile") &&
                   Contains("apt-get install python3-numpy"));
    CHECK(reading_error(file).empty());
    CHECK(std::filesystem::is_empty(folder.file("temporary")));
    unsetenv("TMPDIR");
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

}  // namespace gearpod::test_foreign_recordings
