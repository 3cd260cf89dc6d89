// Checks the results file: complete or absent, readable by other programs, foreign files refused.
#include <fcntl.h>
#include <hdf5.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "mc/files/hdf5_data.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/results/small_results.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_results_file {

using namespace test;
namespace fs = std::filesystem;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Results example() {
    Results r;
    r.provenance = {{"version", "0.1.0"}, {"study", "title = \"x\"\n"}, {"author", "é"}};
    r.parameters = {{"fault_depth_m", "m", {0.0, 0.0, 0.001}},
                    {"torque_N_m", "N m", {1.0, 2.0, 3.0}}};
    r.group = {0, 1, 1};
    r.status = {0, 0, 2};
    r.noise_levels = {0.0, 1.0};
    r.features = {{"te_rms", "rad", analysis::Alarm::high, {1, 2, 3, 4, kNaN, kNaN}},
                  {"te_fc", "order", analysis::Alarm::low, {6, 5, 4, 3, 2, 1}}};
    r.request = {
        0.05, 0.95, r.noise_levels, {{0.0, 0.0}, {0.001, 0.001}, {0.002, 0.003}}, "fault_depth_m",
        "m"};
    for (const FeatureResult& feature : r.features) {
        analysis::FeatureDetection detection;
        detection.feature = feature.name;
        detection.alarm = feature.alarm;
        detection.warnings = {"first", "second"};
        for (const double noise : r.noise_levels) {
            analysis::LevelDetection level{noise, noise + 0.5, 10, 1, {}, {}, {}};
            for (const analysis::SizeGroup& size : r.request.groups) {
                level.cells.push_back({size, 10, 5, 1, 0.5 + noise / 4, 0.25, 0.75});
            }
            detection.levels.push_back(level);
        }
        r.detection.push_back(detection);
    }
    r.timing = {{"integration", 1.5}, {"total", 2.5}};
    return r;
}

std::string reason_of(const std::string& path) {
    return message_of([&] { read_results(path); });
}

TEST_CASE("Results read back as they were written") {
    const auto [folder, path] = TemporaryFile("r.h5");
    const Results r = example();
    write_results(path, r);
    CHECK(folder.files() == 1);
    const Results back = read_results(path);
    CHECK(back.provenance == r.provenance);
    CHECK(back.provenance_value("author") == "é");
    REQUIRE(back.parameters.size() == 2);
    CHECK(back.parameters[0].name == "fault_depth_m");
    CHECK(back.parameters[0].values == r.parameters[0].values);
    CHECK(back.parameters[1].unit == "N m");
    CHECK(back.group == r.group);
    CHECK(back.status == r.status);
    CHECK(back.noise_levels == r.noise_levels);
    REQUIRE(back.features.size() == 2);
    CHECK(back.features[1].values == r.features[1].values);
    CHECK(back.features[1].alarm == analysis::Alarm::low);
    CHECK(std::isnan(back.features[0].values[4]));
    REQUIRE(back.request.groups.size() == 3);
    CHECK(back.request.groups[2].high == 0.003);
    CHECK(back.request.confidence == 0.95);
    CHECK(back.request.size.name == "fault_depth_m");
    CHECK(back.request.size.unit == "m");
    REQUIRE(back.detection.size() == 2);
    CHECK(back.detection[0].feature == "te_rms");
    CHECK(back.detection[1].warnings == r.detection[1].warnings);
    const analysis::LevelDetection& level = back.detection[1].levels[1];
    CHECK(level.threshold == 1.5);
    CHECK(level.threshold_sample == 10);
    CHECK(level.cells[2].size.low == 0.002);
    CHECK(level.cells[2].pd == 0.75);
    CHECK(level.cells[2].detected == 5);
    REQUIRE(back.timing.size() == 2);
    CHECK(back.timing[0].name == "integration");
    CHECK(back.timing[1].seconds == 2.5);
}

TEST_CASE("Rows read in parts equal those of the whole file") {
    const Folder folder;
    Results large = example();
    large.group.clear();
    large.status.clear();
    for (auto& parameter : large.parameters) {
        parameter.values.clear();
    }
    for (auto& feature : large.features) {
        feature.values.clear();
    }
    // More rows than writer and reader process at once.
    for (int row = 0; row < 9001; ++row) {
        large.group.push_back(row < 100 ? 0 : 1);
        large.status.push_back(row % 3);
        for (auto& parameter : large.parameters) {
            parameter.values.push_back(row + 0.25);
        }
        for (auto& feature : large.features) {
            feature.values.push_back(row);
            feature.values.push_back(-row);
        }
    }
    const std::string path = folder.file("r.h5");
    write_results(path, large);
    CHECK(bits(read_results(path)) == bits(large));
    Results frame = read_frame(path);
    CHECK(frame.status.empty());
    const FileRows rows(path, frame);
    CHECK(rows.rows() == 9001);
    fill_columns(frame, rows);
    CHECK(bits(frame) == bits(large));
}

TEST_CASE("The same results give the same bytes") {
    const Folder folder;
    write_results(folder.file("a.h5"), example());
    write_results(folder.file("b.h5"), example());
    CHECK(bytes_of(folder.file("a.h5")) == bytes_of(folder.file("b.h5")));
}

TEST_CASE("h5dump shows the documented layout") {
    if (std::system("command -v h5dump > /dev/null") != 0) {
        WARN("h5dump (hdf5-tools) is not installed");
        return;
    }
    const Folder folder;
    write_results(folder.file("r.h5"), example());
    const std::string command = "h5dump -n 1 '" + folder.file("r.h5") + "' > '" +
                                folder.file("dump") + "' 2>&1 && h5dump -d /detection/te_rms/pd '" +
                                folder.file("r.h5") + "' >> '" + folder.file("dump") + "' 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    const std::string dump = bytes_of(folder.file("dump"));
    for (const char* name : {"attribute  /format_version",
                             "attribute  /study",
                             "/instances/fault_depth_m",
                             "/instances/fault_depth_m/unit",
                             "/instances/group",
                             "/features/te_rms",
                             "/status",
                             "/status/meanings",
                             "/noise_levels",
                             "/detection/size_name",
                             "/detection/size_unit",
                             "/detection/te_fc/size_low",
                             "/detection/te_fc/size_high",
                             "/detection/te_fc/noise_level",
                             "/detection/te_fc/threshold",
                             "/detection/te_fc/threshold_sample",
                             "/detection/te_fc/lower",
                             "/detection/te_fc/upper",
                             "/detection/te_fc/detected",
                             "/detection/te_fc/tested",
                             "/detection/te_fc/failed",
                             "/timing/integration"}) {
        INFO(name);
        CHECK(contains(dump, name));
    }
    CHECK(contains(dump, "SIMPLE { ( 2, 3 ) / ( 2, 3 ) }"));
    CHECK(contains(dump, "(0,0): 0.5, 0.5, 0.5,"));
    CHECK(contains(dump, "(1,0): 0.75, 0.75, 0.75"));
}

TEST_CASE("A results file that is missing, foreign, damaged or newer is refused with the reason") {
    const Folder folder;
    const std::string good = folder.file("good.h5"), bad = folder.file("bad.h5");
    write_results(good, example());

    CHECK(contains(reason_of(folder.file("none.h5")), "No such file"));
    CHECK(contains(reason_of(folder.file(".")), "is a folder"));
    write_bytes(bad, "a,b\n1,2\n");
    CHECK(contains(reason_of(bad), "is not a results file"));
    write_bytes(bad, "");
    CHECK(contains(reason_of(bad), "is not a results file"));
    const std::string bytes = bytes_of(good);
    for (const double share : {0.05, 0.3, 0.6, 0.99}) {
        write_bytes(
            bad,
            bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
        CHECK(contains(reason_of(bad), "bad.h5: is truncated"));
    }
    write_bytes(bad, bytes.substr(0, bytes.size() - 16));
    CHECK(contains(reason_of(bad), "is truncated"));

    write_file(bad, file_bytes(create_memory_file()));
    CHECK(contains(reason_of(bad), "not a gearpod results file"));
    {
        const Hdf5Handle newer = create_memory_file();
        write_text(newer.get(), "/", "format", "gearpod results");
        write_text(newer.get(), "/", "format_version", "99");
        write_file(bad, file_bytes(newer));
    }
    CHECK(contains(reason_of(bad), "version 99"));
    CHECK(contains(reason_of(bad), "versions 2 to 3"));
}

TEST_CASE("Every damaged byte of a results file is detected") {
    const Folder folder;
    const std::string good = folder.file("good.h5"), bad = folder.file("bad.h5");
    write_results(good, example());
    const std::string bytes = bytes_of(good);
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(~damaged[i]);
        write_bytes(bad, damaged);
        CHECK(contains(reason_of(bad), "bad.h5: is "));
    }
}

TEST_CASE("A failed write leaves only the old file") {
    const Folder folder;
    const std::string path = folder.file("r.h5");
    write_results(path, example());
    const std::string before = bytes_of(path);

    const std::string reason = message_of_full_disk(1000, [&] { write_results(path, example()); });
    CHECK(contains(reason, path + ": cannot be written (File too large)"));
    CHECK(bytes_of(path) == before);
    CHECK(folder.files() == 1);
}

TEST_CASE("An output that cannot be written is reported before the run") {
    const auto [folder, path] = TemporaryFile("r.h5");
    CHECK(why_not_writable(path).empty());
    CHECK(folder.files() == 0);
    write_bytes(path, "old");
    CHECK(why_not_writable(path).empty());
    CHECK(bytes_of(path) == "old");
    CHECK(contains(why_not_writable(folder.file("no/r.h5")), "No such file"));
    CHECK(contains(why_not_writable(folder.file(".")), "folder"));
    CHECK(contains(why_not_writable(folder.file("r.h5/x.h5")), "folder"));
    CHECK_FALSE(why_not_writable("").empty());
    CHECK(contains(why_not_writable(folder.file(std::string(250, 'r'))), "too long"));
    CHECK_THROWS_AS(write_results(folder.file("no/r.h5"), example()), std::runtime_error);
}

TEST_CASE("A file whose writer is killed before it is renamed leaves nothing") {
    const Folder folder;
    const int unnamed = ::open(folder.file(".").c_str(), O_TMPFILE | O_RDWR, 0600);
    if (unnamed < 0) {
        WARN("the file system has no files without a name");
        return;
    }
    ::close(unnamed);
    const pid_t child = ::fork();
    if (child == 0) {
        create_exclusively(folder.file("r.part"), {}, [](int) { ::kill(::getpid(), SIGKILL); });
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
    CHECK(folder.files() == 0);
    // The next writer succeeds, and the one after it finds the file in use.
    const int fd = create_exclusively(folder.file("r.part"), {}, [](int) {});
    CHECK(fd >= 0);
    ::close(fd);
    CHECK(create_exclusively(folder.file("r.part"), {}, [](int) {}) == -1);
    CHECK(errno == EEXIST);
    CHECK(folder.files() == 1);
}

TEST_CASE("An output that is not a regular file is refused and kept") {
    const Folder folder;
    const std::string fifo = folder.file("fifo"), socket_path = folder.file("socket");
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    REQUIRE(socket_path.size() < sizeof address.sun_path);
    socket_path.copy(address.sun_path, socket_path.size());
    REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    ::close(socket);
    fs::create_symlink("fifo", folder.file("link"));
    const long files = folder.files();
    for (const std::string& path : {fifo, socket_path, folder.file("link")}) {
        const fs::file_type before = fs::symlink_status(path).type();
        CHECK(contains(why_not_writable(path), "a regular file is needed"));
        const std::string reason = message_of([&] { write_results(path, example()); });
        CHECK(contains(reason, path + ": cannot be written ("));
        CHECK(contains(reason, "a regular file is needed"));
        CHECK(fs::symlink_status(path).type() == before);
    }
    CHECK(folder.files() == files);
    CHECK(contains(why_not_writable("/dev/null"), "a regular file is needed"));
}

TEST_CASE("A symbolic link is kept, and its target is written") {
    const Folder folder;
    fs::create_directory(folder.file("far"));
    write_bytes(folder.file("far/old.h5"), "old");
    fs::create_symlink("far/old.h5", folder.file("old"));
    fs::create_symlink("old", folder.file("chain"));
    fs::create_symlink(folder.file("far/new.h5"), folder.file("dangling"));
    for (const char* link : {"chain", "dangling"}) {
        CHECK(why_not_writable(folder.file(link)).empty());
    }
    CHECK(bytes_of(folder.file("far/old.h5")) == "old");
    CHECK_FALSE(fs::exists(folder.file("far/new.h5")));
    for (const char* link : {"chain", "dangling"}) {
        write_results(folder.file(link), example());
        CHECK(fs::is_symlink(folder.file(link)));
        CHECK(read_results(folder.file(link)).status == example().status);
    }
    CHECK(fs::is_symlink(folder.file("old")));
    CHECK(fs::is_regular_file(folder.file("far/new.h5")));
    // The content is equal to the bit; modification times in the files may differ.
    CHECK(bits(folder.file("far/new.h5")) == bits(folder.file("far/old.h5")));
    CHECK(fs::file_size(folder.file("far/new.h5")) == fs::file_size(folder.file("far/old.h5")));
    CHECK(std::distance(fs::directory_iterator(folder.file("far")), fs::directory_iterator{}) == 2);

    fs::create_symlink("far", folder.file("to-folder"));
    CHECK(contains(why_not_writable(folder.file("to-folder")), "folder"));
    fs::create_symlink("no/r.h5", folder.file("astray"));
    CHECK(contains(why_not_writable(folder.file("astray")), "No such file"));
    fs::create_symlink("ring", folder.file("ring"));
    CHECK(contains(why_not_writable(folder.file("ring")), "symbolic links"));
    CHECK_THROWS_AS(write_results(folder.file("ring"), example()), std::runtime_error);
}

TEST_CASE("Results of inconsistent shapes are not written") {
    const Folder folder;
    Results r = example();
    r.status.pop_back();
    CHECK_THROWS_AS(write_results(folder.file("r.h5"), r), std::invalid_argument);
    r = example();
    r.features[0].values.pop_back();
    CHECK_THROWS_AS(write_results(folder.file("r.h5"), r), std::invalid_argument);
    r = example();
    r.detection[0].levels[0].cells.pop_back();
    CHECK_THROWS_AS(write_results(folder.file("r.h5"), r), std::invalid_argument);
    CHECK(folder.files() == 0);
}

TEST_CASE("A study without instances or detections still gives a readable file") {
    const Folder folder;
    write_results(folder.file("r.h5"), Results{});
    CHECK(read_results(folder.file("r.h5")).features.empty());
}

// Checks contact loss ratios and the error of the time steps in the results file.

Results example(int rows) {
    Results r;
    r.parameters = {{"fault_depth_m", "m", {}}};
    r.noise_levels = {0.0, 1.0};
    r.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    r.contact_loss = {{"sun-planet", {}}, {"ring-planet", {}}};
    r.request.size = {"fault_depth_m", "m"};
    for (int row = 0; row < rows; ++row) {
        r.group.push_back(row < rows / 2 ? 0 : 1);
        r.status.push_back(row % 5 == 4 ? 1 : 0);
        r.parameters[0].values.push_back(row * 1e-6);
        r.features[0].values.insert(r.features[0].values.end(), {1.0 * row, -1.0 * row});
        r.contact_loss[0].values.push_back(row % 5 == 4 ? kNaN : row / (2.0 * rows));
        r.contact_loss[1].values.push_back(row % 5 == 4 ? kNaN : row / (1.0 * rows));
    }
    r.step_error = StepError{3.5e-3, 2e-4, 240, 960, 8, 16};
    return r;
}

bool has_group(const std::string& path, const char* name) {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening");
    return H5Lexists(file.get(), name, H5P_DEFAULT) > 0;
}

// More rows than writer and reader process at once.
TEST_CASE("Contact loss ratios read back as they were written, at once and in parts") {
    const auto [folder, path] = TemporaryFile("r.h5");
    const Results r = example(9001);
    write_results(path, r);
    CHECK(bits(read_results(path)) == bits(r));
    Results frame = read_frame(path);
    REQUIRE(frame.contact_loss.size() == 2);
    CHECK(frame.contact_loss[0].name == "sun-planet");
    CHECK(frame.contact_loss[1].name == "ring-planet");
    CHECK(frame.contact_loss[0].values.empty());
    const FileRows rows(path, frame);
    fill_columns(frame, rows);
    CHECK(bits(frame) == bits(r));
    REQUIRE(frame.step_error.has_value());
    CHECK(frame.step_error->sensor == 3.5e-3);
    CHECK(frame.step_error->te == 2e-4);
    CHECK(frame.step_error->steps == 240);
    CHECK(frame.step_error->finer_steps == 960);
    CHECK(frame.step_error->gearboxes == 8);
    CHECK(frame.step_error->meshes == 16);
}

TEST_CASE("The datasets of contact loss have descriptions") {
    const auto [folder, path] = TemporaryFile("r.h5");
    write_results(path, example(10));
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening");
    CHECK(read_text(file.get(), "contact_loss/sun-planet", "unit") == "1");
    CHECK(contains(read_text(file.get(), "contact_loss/ring-planet", "description"),
                   "carries no load"));
}

// Files of versions before 0.3, and of studies whose teeth cannot separate.
TEST_CASE("Results without contact loss have no value instead of zero") {
    const auto [folder, path] = TemporaryFile("r.h5");
    Results r = example(10);
    r.contact_loss.clear();
    r.step_error.reset();
    write_results(path, r);
    CHECK_FALSE(has_group(path, "contact_loss"));
    CHECK_FALSE(has_group(path, "step_error"));
    const Results back = read_results(path);
    CHECK(back.contact_loss.empty());
    CHECK_FALSE(back.step_error.has_value());
    CHECK(bits(back) == bits(r));
}

TEST_CASE("Contact loss with a wrong number of rows is not written") {
    const Folder folder;
    Results r = example(10);
    r.contact_loss[1].values.pop_back();
    CHECK_THROWS_AS(write_results(folder.file("r.h5"), r), std::invalid_argument);
    CHECK(folder.files() == 0);
}

// Checks that the group /numerical of earlier versions, whose attribute `rung` is `setting` now, is
// read.

TEST_CASE("The solver setting is read under its present and its earlier name") {
    Results results;
    results.noise_levels = {0.0, 1.0};
    results.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    results.numerical = NumericalError{"rk4", "rk4, finer", 8, {0.1, 0.2}, {0.3, 0.4}};
    const Hdf5Handle file = create_memory_file();
    write_numerical_groups(file.get(), results);

    const auto setting_read = [&] {
        Results back;
        back.noise_levels = results.noise_levels;
        back.features = results.features;
        read_numerical_groups(file.get(), 2, back);
        REQUIRE(back.numerical);
        CHECK(back.numerical->largest == results.numerical->largest);
        return back.numerical->setting;
    };
    CHECK(setting_read() == "rk4");
    const Hdf5Handle group = open_group(file.get(), "numerical");
    REQUIRE(H5Arename(group.get(), "setting", "rung") >= 0);
    CHECK(setting_read() == "rk4");
}

}  // namespace gearpod::mc::test_results_file
