// Checks the integrity hash of results files that other programs open, change, copy or cut.
#include <fcntl.h>
#include <sys/stat.h>

#include "mc/results/layout.hpp"
#include "tests/mc/edited_results.hpp"
#include "tests/mc/results/small_results.hpp"

namespace gearpod::test_integrity {

using namespace test;
namespace fs = std::filesystem;

constexpr std::size_t kTrailingBytes = 16;

// Results of a run with three gearboxes, computed once.
const std::string& genuine() {
    static const SmallRun run(test::study("planet-crack-ideal.toml") +
                              " --instances 2 --set ensemble.threshold_instances=1");
    return run.path;
}

std::string reason(const std::string& path) {
    return message_of([&] { mc::read_results(path); });
}

mc::Hdf5Handle open_for_writing(const std::string& path) {
    return {H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path};
}

// A file as format version 2 had it: without user block, the hash in its last bytes.
void write_version_2(const std::string& path) {
    write_bytes(path, bytes_of(genuine()).substr(mc::kUserBlockBytes));
    {
        const mc::Hdf5Handle file = open_for_writing(path);
        mc::check(H5Adelete(file.get(), "format_version"), "format_version");
        mc::write_text(file.get(), ".", "format_version", "2");
    }
    update_checksum(path);
}

TEST_CASE("A results file keeps its integrity when other programs open it for writing") {
    const auto [folder, path] = TemporaryFile("r.h5");
    fs::copy_file(genuine(), path);
    const std::string before = bytes_of(path);
    { const mc::Hdf5Handle file = open_for_writing(path); }
    CHECK(bytes_of(path) == before);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::intact);
    CHECK(bits(path) == bits(genuine()));
    // A program that is killed leaves HDF5's mark of an open file.
    std::string marked = before;
    marked[mc::kUserBlockBytes + 20] = 1;
    write_bytes(path, marked);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::intact);
    CHECK(bits(path) == bits(genuine()));
}

TEST_CASE("A results file that is being written, cut or changed is refused with the true reason") {
    const auto [folder, path] = TemporaryFile("r.h5");
    fs::copy_file(genuine(), path);
    {
        const mc::Hdf5Handle file = open_for_writing(path);
        CHECK(contains(reason(path), "is open for writing in another program"));
    }
    CHECK(reason(path).empty());
    const std::string bytes = bytes_of(genuine());
    write_bytes(path, bytes.substr(0, bytes.size() - 1));
    CHECK(contains(reason(path), "is truncated"));
    write_bytes(path, bytes + "x");
    CHECK(contains(reason(path), "another program has changed it"));
    std::string changed = bytes;
    changed[bytes.size() / 2] ^= 1;
    write_bytes(path, changed);
    CHECK(contains(reason(path), "wrong integrity hash"));
    CHECK(contains(reason(path), "gearpod repair"));
    REQUIRE(::mkfifo(folder.file("pipe.h5").c_str(), 0600) == 0);
    CHECK(contains(reason(folder.file("pipe.h5")), "a regular file is needed"));
}

// Anyone can compute the hash. HDF5 crashes on a text of 2^51 bytes.
TEST_CASE("A changed byte under a valid hash ends no command by a crash of HDF5") {
    const auto [folder, path] = TemporaryFile("r.h5");
    std::string bytes = bytes_of(genuine());
    bytes.at(bytes.find(mc::kResultsFormat) - 2) = 8;
    write_bytes(path, bytes);
    update_checksum(path);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::intact);
    CHECK(contains(reason(path), "is damaged"));
    for (const std::string& command :
         {"report " + path, "compare " + genuine() + " " + path, "repair " + path,
          "merge " + path + " --out " + folder.file("m.h5"),
          "run " + study("planet-crack-ideal.toml") + " --resume --out " + path}) {
        check_refused(command, {"r.h5: is damaged"});
    }
}

TEST_CASE("Files of version 2 are read, without their trailing hash with a note") {
    const auto [folder, path] = TemporaryFile("old.h5");
    write_version_2(path);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::intact);
    const Outcome whole = require_success("report " + path);
    CHECK_FALSE(whole.mentions("integrity hash"));
    // HDF5 cuts bytes after its own end.
    const auto size = fs::file_size(path);
    { const mc::Hdf5Handle file = open_for_writing(path); }
    CHECK(fs::file_size(path) == size - kTrailingBytes);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::missing);
    check_mentions(require_success("report " + path),
                   {"has no integrity hash", "changes of its contents cannot be detected"});
    CHECK(bits(path) == bits(genuine()));
    // A damaged byte of a file with the trailing hash is detected.
    write_version_2(path);
    std::string damaged = bytes_of(path);
    damaged[damaged.size() / 2] ^= 4;
    write_bytes(path, damaged);
    CHECK(contains(reason(path), "wrong integrity hash"));
}

TEST_CASE("`repair` renews the hash of a readable file and of no other") {
    const auto [folder, path] = TemporaryFile("r.h5");
    fs::copy_file(genuine(), path);
    CHECK(program("repair " + path).mentions("nothing to repair"));
    {
        const mc::Hdf5Handle file = open_for_writing(path);
        mc::write_text(file.get(), ".", "remark", "rig 7");
        mc::write_number(file.get(), ".", "rig", 7.0);
    }
    check_refused("report " + path);
    const Outcome repaired = require_success("repair " + path);
    CHECK(repaired.mentions("changes of its contents before now cannot be detected"));
    require_success("report " + path);
    CHECK(bits(path) == bits(genuine()));

    write_version_2(path);
    { const mc::Hdf5Handle file = open_for_writing(path); }
    require_success("repair " + path);
    CHECK(mc::check_file_checksum(path) == mc::ChecksumState::intact);

    // Missing data, values that no run writes, and other files cannot be repaired.
    const std::string bytes = bytes_of(genuine());
    write_bytes(path, bytes.substr(0, bytes.size() - 100));
    check_refused("repair " + path);
    CHECK(bytes_of(path).size() == bytes.size() - 100);
    fs::copy_file(genuine(), path, fs::copy_options::overwrite_existing);
    {
        const mc::Hdf5Handle file = open_for_writing(path);
        replace_numbers(file.get(), "noise_levels", {1}, {7.0});
    }
    const std::string before = bytes_of(path);
    check_refused("repair " + path);
    CHECK(bytes_of(path) == before);
    write_bytes(path, "a,b\n1,2\n");
    check_refused("repair " + path);
}

}  // namespace gearpod::test_integrity
