// Checks parts of a study from separate runs: merged they equal one run, or they are refused by
// name.
#include "tests/mc/program.hpp"

namespace gearpod::test_merge {

using namespace test;

// Three tiles of the threshold group and four test gearboxes; the last tile of each group is not
// full.
const std::string kRun = "run " + study("planet-crack-ideal.toml") +
                         " --instances 50 --set ensemble.threshold_instances=35"
                         " --set sensor.noise_levels=[0,1] --quiet";

std::string part(const Folder& folder, const std::string& which, const std::string& more = "") {
    std::string name = which + ".h5";
    name[name.find('/')] = '-';
    require_success(kRun + " --part " + which + " --out " + folder.file(name) + " " + more);
    return folder.file(name);
}

// Dataset names, where h5dump is installed.
std::string datasets(const std::string& file) {
    return shell("h5dump -n " + file + " | tail -n +2").output;
}

TEST_CASE("Four merged parts equal one run, bit by bit", "[merge]") {
    const Folder folder;
    std::string parts;
    for (const char* which : {"3/4", "1/4", "4/4", "2/4"}) {  // an arbitrary order
        parts += " " + part(folder, which);
    }
    const std::string merged = folder.file("merged.h5"), whole = folder.file("whole.h5");
    // An interrupted merge or run of the study leaves this file.
    CHECK(program(kRun + " --time-limit 00:00:00 --out " + merged).code == 4);
    REQUIRE(std::filesystem::exists(merged + ".part"));
    const Outcome merge = require_success("merge" + parts + " --force --out " + merged);
    CHECK(merge.mentions("results: " + merged));
    require_success(kRun + " --out " + whole);
    CHECK(bits(merged) == bits(whole));
    CHECK(datasets(merged) == datasets(whole));
    // The report is the same as well.
    const std::string rates = " --section rates --section pod";
    CHECK(require_success("report " + merged + rates).output ==
          require_success("report " + whole + rates).output);
    CHECK(!std::filesystem::exists(merged + ".part"));
    // A repeated part is refused.
    check_refused("merge " + merged + " " + whole + " --out " + folder.file("t.h5"),
                  {"whole.h5: cannot be merged: rows 0 to 15 and more are also in "});
}

TEST_CASE("Parts have their own gearboxes and are labelled as parts", "[merge]") {
    const Folder folder;
    const std::string first = part(folder, "1/2"), second = part(folder, "2/2");
    const std::string whole = folder.file("whole.h5");
    require_success(kRun + " --out " + whole);
    const mc::Results one = mc::read_results(first), two = mc::read_results(second),
                      all = mc::read_results(whole);
    CHECK(one.status.size() + two.status.size() == all.status.size());
    // Tiles 0, 2, 4, 6 and 1, 3, 5: rows from 0, 32, 51, 83 and 16, 35, 67.
    const auto depth = [](const mc::Results& r, std::size_t row) {
        return r.features.back().values[2 * row + 1];
    };
    CHECK(depth(two, 0) == depth(all, 16));
    CHECK(depth(one, 16) == depth(all, 32));
    CHECK(depth(one, 16 + 3) == depth(all, 35 + 16));
    const Outcome report = program("report " + first);
    CHECK(report.output.starts_with("Part 1/2 of the study only"));
    // Examples on the page are gearboxes of the part.
    CHECK(program("report " + second + " --json -").mentions("\"same_bits\": true"));
    // Another part cannot resume this one.
    check_refused(kRun + " --part 2/2 --resume --out " + first, {"has part 1/2, this is part 2/2"});
}

TEST_CASE("Parts that do not match are refused by name, all at once", "[merge]") {
    const Folder folder;
    const std::string first = part(folder, "1/3"), second = part(folder, "2/3");
    const std::string out = " --out " + folder.file("m.h5");
    check_refused(
        "merge " + first + " " + second + out,
        {"are in none of the files, first rows 32 to 34; compute them", "run --part 3/3"});
    const std::string seed = part(folder, "3/3", "--seed 77");
    check_refused("merge " + first + " " + second + " " + seed + out,
                  {"3-3.h5: cannot be merged: it has seed 77"});
    const std::string third = part(folder, "3/3", "--force --set gearbox.mesh_damping_ratio=0.08");
    check_refused("merge " + first + " " + third + " /none/there.h5" + out,
                  {"belongs to another study", "/none/there.h5"});
    check_refused("merge " + first + " " + second + " --out " + first, {"would overwrite"});
    CHECK(!std::filesystem::exists(folder.file("m.h5")));
    for (const char* bad : {"0/4", "5/4", "2", "a/b", "2/4x", "1/0"}) {
        check_refused(kRun + " --part " + bad + out, {"must be K/N"});
    }
    CHECK(program(kRun + " --part 9/9" + out).mentions("this part has none"));
}

TEST_CASE("Parts from another version of the program are refused", "[merge]") {
    const Folder folder;
    const std::string first = part(folder, "1/2"), second = part(folder, "2/2");
    mc::Results older = mc::read_results(second);
    for (auto& [name, value] : older.provenance) {
        value = name == "git_hash" ? "0123456789abcdef" : value;
    }
    mc::write_results(second, older);
    check_refused("merge " + first + " " + second + " --out " + folder.file("m.h5"),
                  {"2-2.h5: cannot be merged: it was made by gearpod", "git 0123456789ab"});
}

TEST_CASE("An interrupted part is resumed before it is merged; progress is available as JSON",
          "[merge]") {
    const Folder folder;
    const std::string first = part(folder, "1/2", "--progress json");
    check_mentions(
        require_success(kRun + " --part 2/2 --progress json --out " + folder.file("b.h5")),
        {"\"finished\":true", "\"done\":48,", "\"of\":48,", "\"counted\":\"gearboxes\""});
    const Outcome records = program(kRun +
                                    " --part 2/2 --progress json --set "
                                    "ensemble.threshold_records=2 --out " +
                                    folder.file("records.h5"));
    CHECK(records.mentions("\"counted\":\"records\""));
    CHECK(program("report " + folder.file("records.h5") + " --full").mentions("alarms/records"));
    check_refused(kRun + " --progress xml --out " + folder.file("c.h5"));
    // The first rows of a part, as in a snapshot.
    mc::Results some = mc::read_results(first);
    for (auto& parameter : some.parameters) {
        parameter.values.resize(16);
    }
    for (auto& feature : some.features) {
        feature.values.resize(32);
    }
    some.group.resize(16);
    some.status.resize(16);
    mc::write_results(first, some);
    check_refused("merge " + first + " " + folder.file("b.h5") + " --out " + folder.file("m.h5"),
                  {"1-2.h5: contains 16 of its 37 gearboxes"});
}

TEST_CASE("A merge on a full disk leaves nothing and can be repeated", "[merge]") {
    const Folder folder;
    const std::string parts = part(folder, "1/2") + " " + part(folder, "2/2");
    const std::string out = folder.file("m.h5");
    const long files = folder.files();
    // Limits in blocks of 512 bytes: too small for the checkpoint, and for the results only.
    bool results_failed = false;
    for (int blocks = 4; blocks <= 1024; blocks *= 2) {
        const Outcome full = shell("ulimit -f " + std::to_string(blocks) + "; " + GEARPOD_PROGRAM +
                                   " merge " + parts + " --out " + out);
        INFO(blocks << "\n" << full.output);
        results_failed = results_failed || full.mentions("m.h5: cannot be written");
        if (full.code == 0) {
            break;
        }
        CHECK(full.code == 2);
        CHECK(full.mentions("(File too large)"));
        CHECK_FALSE(full.mentions("--resume"));
        CHECK(folder.files() == files);
    }
    CHECK(results_failed);
    require_success("merge " + parts + " --force --out " + out);
    CHECK(folder.files() == files + 1);
}

}  // namespace gearpod::test_merge
