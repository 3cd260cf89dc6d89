// Checks compare: which gearboxes are paired, what is refused, and zero differences of a file from
// itself.
#include <nlohmann/json.hpp>

#include "tests/mc/program.hpp"

namespace gearpod::test_compare_command {

using namespace test;
using Json = nlohmann::json;

// Results of 96 gearboxes.
std::string run(const Folder& folder, const std::string& name, const std::string& options) {
    const std::string file = folder.file(name);
    require_success("run " + study("planet-crack-ideal.toml") +
                    " --quiet --set ensemble.threshold_instances=40 "
                    "--set ensemble.instances=56 --set numerics.threads=2 --out " +
                    file + " " + options);
    return file;
}

// Results of the study without options, computed once.
const std::string& plain_results() {
    static const Folder folder;
    static const std::string file = run(folder, "a.h5", "");
    return file;
}

Json compared(const std::string& files, const std::string& json) {
    require_success("compare " + files + " --json " + json);
    return Json::parse(bytes_of(json));
}

TEST_CASE("Comparisons pair the same gearboxes, and only these") {
    const Folder folder;
    const std::string a = plain_results(),
                      more = run(folder, "more.h5", "--set ensemble.instances=84"),
                      noisy = run(folder, "noisy.h5", "--set sensor.noise_m_s2=3"),
                      other = run(folder, "other.h5", "--seed 5");
    const std::string out = folder.file("c.json");

    const Json itself = compared(a + " " + a, out)["files"][1];
    CHECK(itself["pairs"] == 56);
    for (const Json& feature : itself["features"]) {
        CHECK(feature["same"] == true);
        CHECK(feature["auc"]["difference"] == 0.0);
        for (const Json& size : feature["sizes"]) {
            CHECK(size["difference"] == 0.0);
            CHECK(size["only"] == Json({0, 0}));
        }
    }
    // Sensor noise does not change the transmission error of the same gearboxes.
    const Json all = compared(a + " " + noisy + " " + more + " " + other, out);
    const Json& sensor = all["files"][1];
    CHECK(sensor["pairs"] == 56);
    int same = 0, changed = 0;
    for (const Json& feature : sensor["features"]) {
        const bool of_te = feature["name"].get<std::string>().starts_with("te_");
        const bool noisy_level = feature["noise_level"] != 0.0;
        CHECK(feature["same"] == (of_te || !noisy_level));
        same += feature["same"] == true;
        changed += feature["same"] == false;
    }
    CHECK(same > 0);
    CHECK(changed > 0);
    CHECK(all["files"][2]["pairs"] == 56);
    CHECK(all["files"][2]["unpaired"].is_null());
    CHECK(all["files"][3]["pairs"] == 0);
    CHECK(all["files"][3]["unpaired"] == "seed 2 and 5");
}

TEST_CASE("Gearboxes with several records are counted once") {
    const Folder folder;
    const std::string file = run(folder, "r.h5",
                                 "--set ensemble.threshold_records=4 --set "
                                 "'features.use=[\"te_rms\"]'");
    const Json comparison = compared(file + " " + file, folder.file("c.json"));
    CHECK(comparison["files"][0]["gearboxes"] == 96);
    CHECK(comparison["first_records"] == true);
    CHECK(program("compare --full " + file + " " + file)
              .mentions("the first record of each healthy"));
    const Json report = Json::parse(program("report " + file + " --json -").output);
    CHECK(report["gearboxes"] == 96);
    CHECK(report["provenance"]["gearboxes_asked_for"] == "96");
}

TEST_CASE("compare reports everything that cannot be compared") {
    const Folder folder;
    const std::string a = run(folder, "a.h5", "--set sensor.noise_levels=[1]"),
                      b = run(folder, "b.h5",
                              "--set detection.false_alarm_rate=0.1 "
                              "--set sensor.noise_levels=[2]");
    check_refused("compare " + a, {"give two or more"});
    check_refused("compare " + a + " " + b,
                  {"its false-alarm rate is 0.1", "no noise level in common"});
    check_refused("compare " + a + " " + b + " --json " + a);
    CHECK_THAT(program("compare " + a + " " + folder.file("none.h5")).output,
               Catch::Contains("none.h5"));
}

TEST_CASE("compare reports every missing or incomplete file") {
    const Folder folder;
    const std::string a = plain_results(), part = run(folder, "p.h5", "--part 1/2"),
                      text = folder.file("text.h5"), cut = folder.file("cut.h5");
    write_bytes(text, "size,hit\n1,0\n");
    const std::string whole = bytes_of(a);
    write_bytes(cut, whole.substr(0, whole.size() / 2));
    const Outcome refused = check_refused("compare " + text + " " + a + " " + cut + " " +
                                          folder.file("none.h5") + " " + cut);
    CHECK(std::count(refused.output.begin(), refused.output.end(), '\n') == 3);
    check_mentions(refused, {"text.h5: is not a results file", "cut.h5: is truncated",
                             "none.h5: cannot be read"});

    check_mentions(require_success("compare --full " + a + " " + part), {"part 1/2 only"});
}

}  // namespace gearpod::test_compare_command
