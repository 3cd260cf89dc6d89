// Checks the program from a user's view: exit codes, output and files.
#include "tests/mc/program_json.hpp"

namespace gearpod::test_program {

using namespace test;
namespace fs = std::filesystem;

bool mentions(const Outcome& outcome, const std::string& text) {
    return outcome.mentions(text);
}

TEST_CASE("A run ends with the table and a file from which report prints the same numbers") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
    const Outcome run =
        require_success("run " + study("planet-crack-ideal.toml") +
                        " --instances 14 --set ensemble.threshold_instances=40 --out " + out);
    CHECK(mentions(run, "window_ratio"));
    CHECK(mentions(run, "Time: "));
    CHECK(mentions(run, out));
    const Outcome text = require_success("report " + out);
    CHECK(contains(run.output, text.output));
    CHECK(std::ranges::count(text.output, '\n') <= 40);
    const Outcome json = program("report " + out + " --json -");
    const auto parsed = nlohmann::json::parse(json.output);
    CHECK(parsed["gearboxes"] == 54);
    CHECK(parsed["failed"] == 0);
    CHECK(parsed["detection"]["features"].size() == 7);
    CHECK(parsed["provenance"]["seed"] == "2");
    CHECK(parsed["reliability"]["features"].size() == 7);
    CHECK(mentions(require_success("report " + out + " --full"), "against fault depth at noise"));
    const Outcome pod = require_success("report " + out + " --section pod");
    CHECK(mentions(pod, "against fault depth at noise"));
    CHECK(!mentions(pod, "Alarm thresholds"));
    check_refused("report --section fault_sizes " + out, {"fault_sizes", "pod, ranking"});
    check_refused("report --by gearbox_colour " + out, {"torque_N_m"});
}

TEST_CASE("Natural frequencies are written as JSON, with the published value") {
    const auto frequencies =
        json_of("modes " + study("published/lin-parker-n4.toml") + " --json -")["frequencies_Hz"];
    REQUIRE(frequencies.size() == 21);
    CHECK(frequencies[20].get<double>() == Approx(13071.1).margin(0.4));
}

TEST_CASE("Stiffness curves have the documented columns and the mean of the printed summary") {
    const Outcome csv = require_success("stiffness " + study("published/liang-fig-5-8.toml") +
                                        " --csv - --points 500");
    CHECK(csv.output.rfind("phase,sp1,sp2,sp3,sp4,rp1,rp2,rp3,rp4,", 0) == 0);
    CHECK(std::count(csv.output.begin(), csv.output.end(), '\n') == 501);
    const std::string cracked = study("planet-crack-ideal.toml");
    CHECK(
        require_success("stiffness --te " + cracked).mentions("errors are those of healthy teeth"));
}

TEST_CASE("A fixed-shaft gearbox has its own columns, frequencies and description") {
    const std::string chip = study("published/tian-fig-4-6.toml");
    const Outcome csv = require_success("stiffness " + chip + " --csv - --points 50");
    CHECK(csv.output.rfind("phase,m1,m1_chip_8mm_period1,m1_chip_8mm_period2", 0) == 0);
    const auto frequencies = json_of("modes " + chip + " --json -")["frequencies_Hz"];
    REQUIRE(frequencies.size() == 8);
    CHECK(frequencies[0].get<double>() < 1e-2);
    // Each gear vibrates on its bearing alone across the line of action.
    for (const double mass_kg : {0.96, 2.88}) {
        const double bearing = std::sqrt(6.56e7 / mass_kg) / (2 * M_PI);
        CHECK(std::any_of(frequencies.begin(), frequencies.end(), [&](const auto& f) {
            return std::abs(f.template get<double>() - bearing) < 1e-6 * bearing;
        }));
    }
    const Outcome described = require_success("describe " + chip);
    CHECK(mentions(described, "torques out of balance"));
    CHECK(mentions(described, "sdirk3"));
    check_refused("run " + chip + " --set numerics.integrator=rk4",
                  {"the damper of the motor coupling"});
}

TEST_CASE("The keys of study files are described without a study") {
    const Outcome keys = require_success("describe --keys");
    CHECK(mentions(keys, "growth_depth_mm"));
    check_refused("describe");
    const Outcome some = require_success("describe --keys growth_depth");
    CHECK(mentions(some, "growth_depth_mm"));
    CHECK(!mentions(some, "noise_levels"));
    CHECK(mentions(program("chek"), "chek: unknown command; did you mean check?"));
    const Outcome fault = program("describe --keys fault");  // not every "default"
    CHECK(mentions(fault, "\n  depth_mm\n"));
    CHECK_FALSE(mentions(fault, "planet_positions_deg"));
    check_mentions(program("describe --keys weibull"),
                   {"distribution = \"weibull\"", "with scale (number > 0), shape (number"});
    CHECK(mentions(program("describe --keys empirical"), "column"));
    const Outcome none = check_refused("describe --keys nonsense");
    CHECK(
        mentions(none, "--keys nonsense: no word of a section, key or explanation begins with it"));
}

TEST_CASE("Results under the name of another file type are refused with the right name") {
    const Folder folder;
    for (const auto& [name, right] :
         {std::pair{"x.csv", "x.h5 --csv DIR"}, std::pair{"x.json", "x.h5 --json F.json"},
          std::pair{"x.toml", "name"}}) {
        check_refused("run " + study("planet-crack-ideal.toml") + " --out " + folder.file(name),
                      {"the results are HDF5", right});
    }
    CHECK(folder.empty());
}

TEST_CASE("Bad input of any kind exits with 2, prints a message and leaves no files") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
    const std::string good = study("planet-crack-ideal.toml");
    const struct {
        std::string arguments, words;
    } cases[] = {
        {"run " + folder.file("missing.toml") + " --out " + out, "missing.toml"},
        {"run " + good + " --set gearbox.modul_mm=3 --out " + out, "module_mm"},
        {"run " + good + " --set gearbox.sun.mass_kg=-1 --out " + out, "sun.mass_kg"},
        {"run " + good + " --set gearbox.ring.teeth=80 --out " + out, "ring"},
        {"run " + good + " --set numerics.steps_per_mesh=500 --out " + out, "unstable"},
        {"run " + study("published/tian-fig-4-3.toml") +
             " --set 'numerics.integrator=\"rk4\"' --out " + out,
         "damper of the motor coupling"},
        {"run " + good + " --instances none --out " + out, "instances"},
        {"run " + good + " --out " + folder.file("no/such/folder/r.h5"), "no/such/folder"},
        {"run " + good + " --frobnicate", "frobnicate"},
        {"frobnicate", "frobnicate"},
        {"describ " + good, "describe"},
        {"report " + folder.file("missing.h5"), "missing.h5"},
        {"report " + good, "planet-crack-ideal.toml"},
        {"stiffness " + study("published/lin-parker-n4.toml"), "teeth"},
        {"simulate " + good + " --instance 99999999 --out " + folder.file("s.csv"), "--instance"},
        {"simulate " + good + " --instance 1 --out " + folder.file("s.xyz"), ".csv"},
    };
    for (const auto& c : cases) {
        check_refused(c.arguments, {c.words});
        CHECK(folder.empty());
    }
}

TEST_CASE("Problems of the study and of the output are reported together") {
    check_refused("run " + study("planet-crack-ideal.toml") +
                      " --set gearbox.sun.mass_kg=-1 --set gearbox.frob=1"
                      " --out /nonexistent-folder/r.h5",
                  {"sun.mass_kg", "frob", "/nonexistent-folder"});
}

TEST_CASE("Gearboxes that fail are counted; the run exits with 3 and keeps its file") {
    const Folder folder;
    const Outcome outcome = program("run " + study("planet-crack-ideal.toml") +
                                    " --instances 7 --set ensemble.threshold_instances=20"
                                    " --set numerics.max_meshes=1 --out " +
                                    folder.file("r.h5"));
    CHECK(outcome.code == 3);
    CHECK(mentions(outcome, "27 of 27 gearboxes failed: 0 diverged, 27 did not converge"));
    CHECK(fs::exists(folder.file("r.h5")));
}

TEST_CASE("A simulated gearbox has the features of its row in the ensemble") {
    const Folder folder;
    const std::string small = " --set ensemble.instances=14 --set ensemble.threshold_instances=5";
    const std::string good = study("planet-crack-ideal.toml");
    require_success("run " + good + small + " --out " + folder.file("r.h5"));
    require_success("simulate " + good + small + " --instance 18 --out " + folder.file("s.h5"));
    // Five noise levels of the row as printed by h5dump, from either file.
    const auto values = [&](const std::string& file, const std::string& subset) {
        const std::string command = "h5dump -y -w 0 -m %.17g -d /features/te_rms " + subset +
                                    folder.file(file) + " | sed -n '/DATA {/,/}/p' | tr -d ' \\n'";
        FILE* pipe = popen(command.c_str(), "r");
        REQUIRE(pipe != nullptr);
        std::array<char, 4096> line{};
        REQUIRE(fgets(line.data(), line.size(), pipe) != nullptr);
        pclose(pipe);
        const std::string text = line.data();  // the attributes follow the data
        return text.substr(0, text.find('}'));
    };
    const std::string from_run = values("r.h5", "-s 18,0 -c 1,5 ");
    CHECK(std::count(from_run.begin(), from_run.end(), ',') == 4);
    CHECK(values("s.h5", "") == from_run);
}

TEST_CASE("The C library's choice of elementary functions has no effect on the results") {
    // Simulates a processor without fused multiply-adds, for which the C library selects other
    // functions.
    const Folder folder;
    const std::string run = "run " + study("planet-crack-ideal.toml") +
                            " --quiet --instances 10 --set ensemble.threshold_instances=6 --out ";
    require_success(run + folder.file("a.h5"));
    REQUIRE(setenv("GLIBC_TUNABLES",
                   "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-FMA4_Usable,-AVX2_Usable",
                   1) == 0);
    require_success(run + folder.file("b.h5"));
    unsetenv("GLIBC_TUNABLES");
    for (const char* group : {"/features", "/instances"}) {
        const std::string command =
            "h5diff " + folder.file("a.h5") + " " + folder.file("b.h5") + " " + group + " " + group;
        CHECK(std::system(command.c_str()) == 0);
    }
}

}  // namespace gearpod::test_program
