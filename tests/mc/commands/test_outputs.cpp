// Checks that no command overwrites its inputs or files of another kind, and no run the results of
// another study.
#include <sys/stat.h>
#include <unistd.h>

#include "tests/mc/program.hpp"

namespace gearpod::test_outputs {

using namespace test;
namespace fs = std::filesystem;

constexpr const char* kSmall = " --instances 2 --set ensemble.threshold_instances=1";

// A folder with a study, its results and a recording.
struct Workplace {
    Folder folder;
    std::string study = folder.file("s.toml"), results = folder.file("r.h5"),
                signal = folder.file("x.csv");
    Workplace() {
        fs::copy_file(test::study("planet-crack-ideal.toml"), study);
        require_success("run " + study + kSmall + " --quiet --out " + results);
        require_success("simulate " + study + " --instance 0 --out " + signal);
        fs::create_symlink("s.toml", folder.file("link.toml"));
        fs::create_hard_link(study, folder.file("hard.toml"));
        fs::create_symlink(results, folder.file("link.h5"));
    }
};

TEST_CASE("A command refuses to overwrite a file that it reads, under any name") {
    const Workplace place;
    const std::string study = bytes_of(place.study), results = bytes_of(place.results),
                      signal = bytes_of(place.signal);
    const auto at = [&](const std::string& name) { return place.folder.file(name); };
    const std::string measured =
        "features " + place.signal + " --study " + place.study + " --sensor sensor ";
    const std::string commands[] = {
        "run " + place.study + kSmall + " --out " + place.study,
        "run " + place.study + kSmall + " --force --out " + place.study,
        "run " + place.study + kSmall + " --out " + at("link.toml"),
        "run " + place.study + kSmall + " --out " + at("hard.toml"),
        "run " + at("link.toml") + kSmall + " --out " + at("./hard.toml"),
        "report " + place.results + " --json " + place.results,
        "report " + place.results + " --html " + at("link.h5"),
        "report " + at("link.h5") + " --html " + place.results,
        "report " + place.results + " --json " + at("a") + " --html " + at("./a"),
        "report " + place.results + " --pdf " + at("link.h5"),
        "report " + place.results + " --html " + at("a") + " --pdf " + at("./a"),
        "sweep " + place.study + " --vary sensor.gain=[1] --html " + at("hard.toml"),
        "sweep " + place.study + " --vary sensor.gain=[1] --out " + at(".") + " --html " +
            at("gain=1.h5"),
        "stiffness " + place.study + " --csv " + place.study,
        "modes " + place.study + " --json " + at("link.toml"),
        "accuracy " + place.study + " --json " + place.study,
        "accuracy " + place.study + " --peers " + place.signal + " --json " + place.signal,
        measured + "--json " + place.signal,
        measured + "--json " + place.study,
        measured + "--healthy " + place.results + " --json " + place.results,
    };
    const long files = place.folder.files();
    for (const std::string& command : commands) {
        check_refused(command, {"would overwrite"});
        CHECK(bytes_of(place.study) == study);
        CHECK(bytes_of(place.results) == results);
        CHECK(bytes_of(place.signal) == signal);
        CHECK(place.folder.files() == files);
    }
    // A study with the names of a run's auxiliary files.
    for (const char* ending : {".new", ".part"}) {
        const std::string out = at("z.h5");
        fs::copy_file(place.study, out + ending);
        check_refused("run " + out + ending + kSmall + " --out " + out);
        CHECK(bytes_of(out + ending) == study);
        fs::remove(out + ending);
    }
}

TEST_CASE("An empty output name is bad input") {
    const Workplace place;
    for (const std::string& command :
         {"run " + place.study + kSmall + " --out ''", "report " + place.results + " --json ''",
          "report " + place.results + " --html ''", "report " + place.results + " --pdf ''",
          "stiffness " + place.study + " --csv ''",
          "simulate " + place.study + " --instance 0 --out ''"}) {
        check_refused(command, {"empty"});
    }
}

TEST_CASE("Results of another study and other files are overwritten with --force only") {
    const Workplace place;
    const std::string run = "run " + place.study + kSmall + " --quiet --out " + place.results;
    const std::string before = bytes_of(place.results);
    require_success(run);  // the same study again
    for (const std::string& other : {run + " --set operation.torque_N_m=400", run + " --seed 99"}) {
        check_refused(other, {"--force"});
        CHECK(mc::read_results(place.results).status.size() == 3);
    }
    require_success(run + " --seed 99 --force");
    CHECK(mc::read_frame(place.results).provenance_value("seed") == "99");
    const std::string notes = place.folder.file("notes.dat");
    write_bytes(notes, "years of work\n");
    const std::string over = "run " + place.study + kSmall + " --quiet --out " + notes;
    check_refused(over);
    CHECK(bytes_of(notes) == "years of work\n");
    require_success(over + " --force");
}

TEST_CASE("An existing file under the temporary output name is refused and not opened") {
    const Workplace place;
    const std::string out = place.folder.file("n.h5"), pending = out + ".new",
                      precious = place.folder.file("precious");
    write_bytes(precious, "years of work\n");
    const auto in_the_way = [&](auto make) {
        make();
        check_refused(shell("timeout 60 " + std::string(GEARPOD_PROGRAM) + " run " + place.study +
                            kSmall + " --quiet --out " + out),
                      {"n.h5.new has the name of the temporary file"});
        CHECK(bytes_of(precious) == "years of work\n");
        CHECK_FALSE(fs::exists(out));
        fs::remove_all(pending);
    };
    in_the_way([&] { fs::create_symlink("precious", pending); });
    in_the_way([&] { fs::create_hard_link(precious, pending); });
    in_the_way([&] { REQUIRE(::mkfifo(pending.c_str(), 0600) == 0); });
    in_the_way([&] { fs::create_directory(pending); });
    write_bytes(pending, "what a killed writer left");
    require_success("run " + place.study + kSmall + " --quiet --out " + out);
    CHECK_FALSE(fs::exists(pending));
}

TEST_CASE("A file of another kind than the output is replaced with --force only") {
    const Workplace place;
    const auto at = [&](const std::string& name) { return place.folder.file(name); };
    const std::string other = at("other.h5"), notes = at("notes.txt"), table = at("table.csv");
    fs::copy_file(place.results, other);
    write_bytes(notes, "years of work\n");
    write_bytes(table, "size,hit\n1,0\n2,1\n3,0\n4,1\n5,1\n6,1\n");
    const std::string measured = "features " + place.signal + " --study " + place.study;
    struct Output {
        std::string command, file;
    };
    std::vector<Output> outputs{
        {measured + " --quiet --out ", other},
        {measured + " --quiet --csv ", other},
        {measured + " --quiet --csv ", notes},
        {measured + " --json ", notes},
        {"simulate " + place.study + " --instance 0 --out ", other},
        {"simulate " + place.study + " --instance 0 --out ", table},
        {"stiffness " + place.study + " --points 10 --csv ", other},
        {"stiffness " + place.study + " --points 10 --csv ", place.signal},
        {"modes " + place.study + " --json ", other},
        {"pod " + table + " --firth --json ", other},
        {"compare " + place.results + " " + at("link.h5") + " --json ", notes},
        {"report " + place.results + " --json ", other},
    };
    for (const Output& output : outputs) {
        const std::string before = bytes_of(output.file);
        check_refused(output.command + output.file, {"--force"});
        CHECK(bytes_of(output.file) == before);
        require_success(output.command + output.file + " --force");
        CHECK(bytes_of(output.file) != before);
        // The next output of the same kind replaces the first one.
        require_success(output.command + output.file);
        write_bytes(output.file, before);
    }
    for (const char* option : {"--html", "--pdf"}) {
        check_refused("report " + place.results + " " + option + " " + other, {"--force"});
    }
    // Tables of a folder.
    const std::string folder = at("tables");
    require_success("report " + place.results + " --csv " + folder);
    require_success("report " + place.results + " --csv " + folder);
    const std::string first = fs::directory_iterator(folder)->path().string();
    fs::copy_file(other, first, fs::copy_options::overwrite_existing);
    check_refused("report " + place.results + " --csv " + folder, {"another kind"});
    CHECK(bytes_of(first) == bytes_of(other));
    require_success("report " + place.results + " --force --csv " + folder);
    CHECK(bytes_of(first) != bytes_of(other));
}

TEST_CASE("An input that is a pipe or a device is refused by every command") {
    const Workplace place;
    const std::string pipe = place.folder.file("pipe.h5"), csv = place.folder.file("pipe.csv");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    REQUIRE(::mkfifo(csv.c_str(), 0600) == 0);
    const std::string measured = "features --study " + place.study + " ";
    std::vector<std::string> commands{"compare " + place.results + " " + pipe,
                                      "merge " + pipe + " --out " + place.folder.file("m.h5"),
                                      "misses " + pipe + " --feature window_z --size 1",
                                      "rare " + pipe + " --feature window_z --rate 0.01",
                                      "describe /dev/zero",
                                      "accuracy " + place.study + " --seconds 1 --peers " + csv,
                                      measured + csv,
                                      measured + pipe,
                                      measured + "--manifest " + csv + " --csv -",
                                      "features " + place.signal + " --study " + csv,
                                      "calibrate " + place.study + " --features " + csv,
                                      "simulate " + place.study + " --instance 0 --out " + pipe,
                                      "run " + place.study + kSmall + " --resume --out " + pipe};
    for (const char* command : {"run ", "describe ", "modes ", "lives ", "stiffness ", "pod "}) {
        commands.push_back(command + csv);
    }
    for (const char* command : {"report ", "repair "}) {
        commands.push_back(command + pipe);
    }
    for (const char* option : {" --against ", " --healthy ", " --baseline "}) {
        commands.push_back(measured + place.signal + option + pipe);
    }
    for (const std::string& command : commands) {
        check_refused(shell("timeout 60 " + std::string(GEARPOD_PROGRAM) + " " + command),
                      {"a regular file is needed"});
    }
    // A shell's pipe is an input like a file.
    require_success(
        shell("cat " + place.study + " | " + GEARPOD_PROGRAM + " stiffness /dev/stdin"));
}

TEST_CASE("Outputs on a full disk are bad output, not failed gearboxes") {
    const Workplace place;
    const std::string full = "ulimit -f 1; ";
    for (const std::string& command :
         {"simulate " + place.study + " --instance 0 --out " + place.folder.file("s.h5"),
          "simulate " + place.study + " --instance 0 --out " + place.folder.file("s.csv"),
          "stiffness " + place.study + " --csv " + place.folder.file("s.csv")}) {
        check_refused(shell(full + GEARPOD_PROGRAM + " " + command),
                      {"cannot be written (File too large)"});
        CHECK_FALSE(fs::exists(place.folder.file("s.h5")));
        CHECK_FALSE(fs::exists(place.folder.file("s.csv")));
    }
}

TEST_CASE("Messages and tables that cannot be written neither abort a run nor end by a signal") {
    const Workplace place;
    const std::string out = place.folder.file("full.h5"), text = place.folder.file("none.txt");
    // 8 healthy gearboxes are too few for the false-alarm rate, which gives a warning.
    const std::string run =
        "run " + place.study + " --force --set ensemble.threshold_instances=8 --out " + out;
    const auto code = [](const std::string& command, const std::string& redirection) {
        return shell(std::string(GEARPOD_PROGRAM) + " " + command + redirection).code;
    };
    for (const char* quiet : {" --instances 2", " --instances 2 --quiet"}) {
        CHECK(code(run + quiet, " 2>/dev/full >/dev/null") == 0);
        CHECK(fs::remove(out));
    }
    CHECK(code("check nosuch.toml", " 2>/dev/full") == 2);
    CHECK(code("report " + place.results, " >/dev/full") == 2);
    const std::string head = "{ " + std::string(GEARPOD_PROGRAM) + " report " + place.results +
                             "; echo $? >" + text + "; } | true";
    CHECK(shell(head).output.empty());
    CHECK((bytes_of(text) == "2\n" || bytes_of(text) == "0\n"));
}

TEST_CASE("Names of conditions that a results file cannot hold are refused before measuring") {
    const Workplace place;
    const std::string manifest = place.folder.file("m.csv"), out = place.folder.file("f.h5");
    write_bytes(manifest, "file,N/m,group,.,noise_weight,load\nx.csv,1,2,3,4,5\n");
    const std::string command =
        "features --manifest " + manifest + " --study " + place.study + " --quiet ";
    const Outcome outcome = check_refused(command + "--out " + out);
    for (const char* name : {"N/m", "group", ".", "noise_weight"}) {
        CHECK(outcome.mentions("m.csv: " + std::string(name) + ": the name of this column"));
    }
    CHECK_FALSE(outcome.mentions("load: the name"));
    CHECK_FALSE(fs::exists(out));
    // A table holds any name.
    require_success(command + "--csv -");
}

TEST_CASE("Signals that need more memory than a job may use are refused before they are computed") {
    const test::Outcome refused =
        test::shell("ulimit -v 8000000; " GEARPOD_PROGRAM " simulate " +
                    test::study("planet-crack-ideal.toml") +
                    " --instance 0 --meshes 2000 --set sensor.sampling_Hz=100000");
    CHECK(refused.code == 2);
    test::check_mentions(refused, {"--meshes 2000: the signals need at least", "GB are available"});
}

}  // namespace gearpod::test_outputs
