// Checks the program from a user's view: exit codes, output and files.
#include "mc/library/stiffness_modes.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_program {

using namespace test;
namespace fs = std::filesystem;

TEST_CASE("A run ends with the table and a file from which report prints the same numbers") {
    const auto [folder, out] = TemporaryFile("r.h5");
    const Outcome run =
        require_success("run " + study("planet-crack-ideal.toml") +
                        " --instances 14 --set ensemble.threshold_instances=40 --out " + out);
    check_mentions(run, {"window_ratio", "Time: ", out});
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
    CHECK(require_success("report " + out + " --full").mentions("against fault depth at noise"));
    const Outcome pod = require_success("report " + out + " --section pod");
    CHECK(pod.mentions("against fault depth at noise"));
    CHECK(!pod.mentions("Alarm thresholds"));
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
    CHECK(described.mentions("torques out of balance"));
    CHECK(described.mentions("sdirk3"));
}

TEST_CASE("The keys of study files are described without a study") {
    const Outcome keys = require_success("describe --keys");
    CHECK(keys.mentions("growth_depth_mm"));
    check_refused("describe");
    const Outcome some = require_success("describe --keys growth_depth");
    CHECK(some.mentions("growth_depth_mm"));
    CHECK(!some.mentions("noise_levels"));
    CHECK(program("chek").mentions("chek: unknown command; did you mean check?"));
    const Outcome fault = program("describe --keys fault");  // not every "default"
    CHECK(fault.mentions("\n  depth_mm\n"));
    CHECK_FALSE(fault.mentions("planet_positions_deg"));
    check_mentions(program("describe --keys weibull"),
                   {"distribution = \"weibull\"", "with scale (number > 0), shape (number"});
    CHECK(program("describe --keys empirical").mentions("column"));
    const Outcome none = check_refused("describe --keys nonsense");
    CHECK(
        none.mentions("--keys nonsense: no word of a section, key or explanation begins with it"));
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
    const auto [folder, out] = TemporaryFile("r.h5");
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
    CHECK(outcome.mentions("27 of 27 gearboxes failed: 0 diverged, 27 did not converge"));
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

TEST_CASE("check reports the problems of every study and simulates none") {
    const Folder folder;
    const std::string wrong = folder.file("wrong.toml"), unmeshed = folder.file("unmeshed.toml");
    std::ofstream(wrong) << "[gearbox]\nsun.teeth = -3\nplanets = \"four\"\n";
    std::ofstream(unmeshed) << "[gearbox]\nsun.teeth = 19\nplanet.teeth = 31\nring.teeth = 80\n";
    const std::string sound = study("planet-crack.toml");
    const Outcome all =
        check_refused("check " + wrong + " " + sound + " " + unmeshed,
                      {wrong + ":2: gearbox.sun.teeth", wrong + ":3: gearbox.planets",
                       sound + ": can be simulated", unmeshed + ":"});
    CHECK_FALSE(all.mentions(wrong + ": can be simulated"));
    CHECK_FALSE(all.mentions(unmeshed + ": can be simulated"));
    CHECK(folder.files() == 2);
}

TEST_CASE("check of sound studies ends with code 0, unless a changed key is wrong") {
    const std::string files = study("planet-crack.toml") + " " + study("bell-206b.toml");
    require_success("check " + files);
    check_refused("check " + files + " --set sensor.noise_m_s2=-1", {"sensor.noise_m_s2"});
}

TEST_CASE("check and describe take a study with [life] as one for lives") {
    const std::string life = study("planet-crack-ideal.toml") + life_arguments();
    const std::string refused =
        " --set life.record_s=10 --set 'features.use=[\"te_kurtosis\"]'"
        " --set 'sensor.noise_levels=[1,2]'";
    CHECK(require_success("check " + life).mentions("can be simulated by `lives`"));
    check_refused("check " + life + refused, {"\"te_kurtosis\" averages the transmission error",
                                              "a life has one noise level"});
    check_mentions(require_success("describe " + life + " --seconds 0.1"),
                   {"forecast of lives", "records of a crack"});
    CHECK(program("describe " + life + refused).mentions("refused by `lives`"));
}

TEST_CASE("Critical speeds lie where a mesh harmonic crosses a natural frequency") {
    // Mesh frequency 10 Hz per rad/s; one mode at 50 Hz, two that rise from 20 to 40 Hz.
    std::vector<mc::SpeedFrequencies> speeds;
    for (int i = 0; i <= 10; ++i) {
        const double rising = 20.0 + 2.0 * i;
        speeds.push_back({static_cast<double>(i), 10.0 * i, {rising, rising, 50.0}});
    }
    const auto found = critical_speeds(speeds, 2);
    REQUIRE(found.size() == 4);
    // Second harmonic: 20 s = 20 + 2 s, then 20 s = 50. First: 10 s = 20 + 2 s and 10 s = 50.
    const double expected[][4] = {
        {20.0 / 18.0, 200.0 / 9.0, 2, 2}, {2.5, 25.0, 1, 2}, {2.5, 50.0, 2, 1}, {5.0, 50.0, 1, 1}};
    for (std::size_t i = 0; i < found.size(); ++i) {
        INFO(i);
        CHECK(found[i].speed_rad_s == Approx(expected[i][0]));
        CHECK(found[i].frequency_Hz == Approx(expected[i][1]));
        CHECK(found[i].harmonic == expected[i][2]);
        CHECK(found[i].modes == expected[i][3]);
    }
}

TEST_CASE("modes writes a Campbell diagram, and prints the critical speeds") {
    const auto [folder, html] = TemporaryFile("m.html");
    check_mentions(require_success("modes " + study("bell-206b.toml") + " --html " + html +
                                   " --json " + folder.file("m.json")),
                   {"speeds of the carrier at which mesh harmonics 1 to 5"});
    const auto json = json_of_file(folder.file("m.json"));
    const auto& campbell = json["campbell"];
    CHECK(campbell["nominal_rpm"].get<double>() == Approx(343.8));
    const auto at_rest = campbell["speeds"][0]["frequencies_Hz"];
    for (std::size_t i = 0; i < at_rest.size(); ++i) {
        CHECK(at_rest[i].get<double>() ==
              Approx(json["frequencies_Hz"][i].get<double>()).epsilon(1e-5).margin(1e-2));
    }
    for (const auto& one : campbell["critical_speeds"]) {
        // The mesh frequency is proportional to the speed.
        const auto& last = campbell["speeds"].back();
        const double mesh_Hz =
            last["mesh_Hz"].get<double>() * one["rpm"].get<double>() / last["rpm"].get<double>();
        CHECK(one["harmonic"].get<int>() * mesh_Hz ==
              Approx(one["frequency_Hz"].get<double>()).epsilon(1e-9));
    }
    CHECK(contains(bytes_of(html), "Campbell diagram"));
    // A study without tooth numbers has no mesh frequency, and an existing file is kept.
    check_refused("modes " + study("bell-206b.toml") + " --html " + folder.file("m.json"));
}

}  // namespace gearpod::test_program
