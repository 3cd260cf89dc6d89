// Checks options with several values after one name.
#include "tests/mc/program.hpp"

namespace test_several_values {

using namespace gearpod;
using test::Folder;
using test::Outcome;
using test::program;

TEST_CASE("`pod` takes several inspectors after one --hit, before or after the table") {
    const Folder folder;
    const std::string table = folder.file("t.csv");
    std::string text = "x,A,B\n";
    for (int i = 1; i <= 40; ++i) {
        const int a = 7 * i % 40 + i > 38, b = 11 * i % 40 + i > 42;
        text += std::to_string(0.1 * i) + "," + std::to_string(a) + "," + std::to_string(b) + "\n";
    }
    test::write_bytes(table, text);
    const Outcome expected = program("pod " + table + " --size x --hit A --hit B --json -");
    INFO(expected.output);
    REQUIRE(expected.code == 0);
    // Without another word that can be the table, it is the last word after an option.
    for (const std::string& words :
         {table + " --size x --hit A B", "--hit A B " + table + " --size x",
          "--size x --hit A B " + table, table + " --hit A --size x --hit B",
          "--size x --hit A B -- " + table, "--hit A --size x --hit B " + table,
          "--hit=A --hit B " + table + " --size x"}) {
        const Outcome outcome = program("pod --json - " + words);
        INFO(words);
        CHECK(outcome.code == 0);
        CHECK(outcome.output == expected.output);
    }
    // Responses likewise, and settings of a study.
    const Outcome responses = program("pod " + table + " --size x --response A B --threshold 1");
    CHECK_FALSE(responses.mentions("unexpected argument"));
    const Outcome study = program("describe " + test::study("planet-crack-ideal.toml") +
                                  " --set ensemble.seed=nan ensemble.instances=nan");
    CHECK(study.mentions("ensemble.seed: must be"));
    CHECK(study.mentions("ensemble.instances: must be"));
}

TEST_CASE("A word that an option cannot take is not its value") {
    const Folder folder;
    const std::string table = folder.file("t.csv"), study = test::study("planet-crack-ideal.toml");
    std::string text = "size,hit\n";
    for (int i = 1; i <= 40; ++i) {
        text += std::to_string(0.1 * i) + "," + std::to_string(7 * i % 40 + i > 38) + "\n";
    }
    test::write_bytes(table, text);
    const Outcome links = program("pod " + table + " --link logit --link probit");
    REQUIRE(links.code == 0);
    for (const std::string& words :
         {"--link logit probit " + table, "--link logit,probit " + table,
          table + " --link logit probit", "--link logit probit " + table + " --confidence 0.95"}) {
        INFO(words);
        CHECK(program("pod " + words).output == links.output);
    }
    CHECK(program("pod " + table + " --link logit cauchit").mentions("cauchit"));
    // A setting has an equals sign, a row is a number.
    const std::string settings = " --set operation.torque_N_m=300 sensor.gain=2 ";
    const Outcome after = program("stiffness " + study + settings),
                  before = program("stiffness" + settings + study);
    INFO(before.output);
    CHECK(after.code == 0);
    CHECK(before.output == after.output);
    CHECK(program("run --signals 0 x " + study + " --out " + folder.file("r.h5")).code == 2);
    CHECK(program("run " + study + settings + "--signals 0 99999999 --out " + folder.file("r.h5"))
              .mentions("--signals 99999999: is not a row"));
    // One option of several files keeps one value for each name, because signals are files, too.
    CHECK(program("features --help").mentions("--healthy FILE "));
}

}  // namespace test_several_values
