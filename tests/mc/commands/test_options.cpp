// Checks options with numbers, which have one reader for all commands, options with several values
// after one name, and that the man page and the completion agree with --help.
#include "mc/files/input/number_text.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_options {

using mc::NumberForm;
using namespace test;

TEST_CASE("A number is finite, in decimal notation, and in the range of its option") {
    const auto real = [](const std::string& text) {
        return mc::number_problem(text, NumberForm::real, mc::from_to(-1e6, 1e6, "Hz"));
    };
    for (const char* good : {"0", "-0.5", "+3", "1e3", "1E-3", ".5", "2.", "1000000"}) {
        INFO(good);
        CHECK(real(good).empty());
    }
    CHECK(mc::real_number("+1.5e2") == 150.0);
    for (const char* bad : {"nan", "NaN", "inf", "-inf", "infinity", "nan(1)"}) {
        INFO(bad);
        CHECK(contains(real(bad), "is not a finite number"));
    }
    CHECK(contains(real(""), "the number is missing"));
    CHECK(contains(real("1e400"), "beyond the range of numbers in double precision"));
    CHECK(contains(real("1,5"), "the decimal separator is a point"));
    for (const char* bad : {"0x10", "0x1p3", "5 ", " 5", "5Hz", "1e", "--5", "+-5", "1 000",
                            "1'000", "five", "1.2.3", "\x1b[2J"}) {
        INFO(bad);
        CHECK(contains(real(bad), "is not a number in decimal notation"));
        CHECK_FALSE(contains(real(bad), "\x1b"));
    }
    CHECK(real("2e6") == "must be -1000000 to 1000000 Hz, but is 2e6");
    CHECK(mc::number_problem("0", NumberForm::real, mc::above(0.0, "mm")) ==
          "must be above 0 mm, but is 0");
    CHECK(mc::number_problem("-1", NumberForm::real, mc::at_least(0.0)) ==
          "must be at least 0, but is -1");
}

TEST_CASE("A whole number has no fraction and fits into its type") {
    const auto whole = [](const std::string& text) {
        return mc::number_problem(text, NumberForm::whole, mc::from_to(-5, 1e6));
    };
    for (const char* good : {"0", "-3", "+7", "1000000"}) {
        CHECK(whole(good).empty());
    }
    CHECK(mc::whole_number("+7") == 7);
    CHECK(contains(whole("1.5"), "is not a whole number"));
    CHECK(contains(whole("1e3"), "write 1000"));
    CHECK(contains(whole("99999999999999999999"), "beyond the range of whole numbers"));
    CHECK(contains(whole("nan"), "is not a finite number"));
    CHECK(contains(whole("0x10"), "is not a number"));
    CHECK(contains(whole(""), "is missing"));
    CHECK(contains(whole("2000000"), "must be -5 to 1000000"));
}

TEST_CASE("Every numeric option of every command refuses what is no number, by its name") {
    const auto reference = json_of("--reference");
    int options = 0;
    for (const auto& command : reference["commands"]) {
        for (const auto& option : command["options"]) {
            const std::string type = option["type"];
            if (!type.starts_with("FLOAT") && !type.starts_with("INT")) {
                continue;
            }
            ++options;
            const std::string name = option["name"];
            for (const char* value : {"nan", "1e400"}) {
                check_refused(command["name"].get<std::string>() + " " + name + "=" + value,
                              {name + ": " + value + " is "});
            }
        }
    }
    CHECK(options > 40);
}

TEST_CASE("All refused values of a command line are printed together") {
    check_refused(
        "pod none.csv --floor nan --confidence 2 --target 0 --bounds exact",
        {"--floor: nan is not a finite number", "--confidence: must be 0.5 to 0.9999, but is 2",
         "--target: must be above 0, but is 0", "--bounds: exact not in {likelihood-ratio,wald}"});
    CHECK(program("features x.csv --study s.toml --sampling-Hz 0")
              .mentions("--sampling-Hz: must be above 0 Hz, but is 0"));
    check_mentions(program("new planetary --sun 1e1 --planet 3000000000 --module 2"),
                   {"--sun: 1e1 is not written as a whole number; write 10",
                    "--planet: 3000000000 is beyond the range of whole numbers"});
}

TEST_CASE("Every key of a study refuses numbers that are not finite") {
    const auto reference = json_of("--reference");
    for (const std::string value : {"nan", "inf"}) {
        std::vector<std::string> names;
        std::string settings;
        for (const auto& key : reference["keys"]) {
            const std::string type = key["type"];
            if (type == "number" || type == "integer" || type == "numbers") {
                names.push_back(key["section"].get<std::string>() + "." +
                                key["name"].get<std::string>());
                settings += " --set " + names.back() + "=" +
                            (type == "numbers" ? "[" + value + "]" : value);
            }
        }
        REQUIRE(names.size() > 200);
        const Outcome outcome =
            check_refused("describe " + test::study("planet-crack-ideal.toml") + settings);
        for (const std::string& name : names) {
            INFO(name);
            CHECK(contains(outcome.output, "--set: " + name + ": must be "));
        }
    }
}

TEST_CASE("`pod` takes several inspectors after one --hit, before or after the table") {
    const auto [folder, table] = TemporaryFile("t.csv");
    std::string text = "x,A,B\n";
    for (int i = 1; i <= 40; ++i) {
        const int a = 7 * i % 40 + i > 38, b = 11 * i % 40 + i > 42;
        text += std::to_string(0.1 * i) + "," + std::to_string(a) + "," + std::to_string(b) + "\n";
    }
    write_bytes(table, text);
    const Outcome expected = require_success("pod " + table + " --size x --hit A --hit B --json -");
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
    check_mentions(program("describe " + test::study("planet-crack-ideal.toml") +
                           " --set ensemble.seed=nan ensemble.instances=nan"),
                   {"ensemble.seed: must be", "ensemble.instances: must be"});
}

TEST_CASE("A word that an option cannot take is not its value") {
    const Folder folder;
    const std::string table = folder.file("t.csv"), study = test::study("planet-crack-ideal.toml");
    std::string text = "size,hit\n";
    for (int i = 1; i <= 40; ++i) {
        text += std::to_string(0.1 * i) + "," + std::to_string(7 * i % 40 + i > 38) + "\n";
    }
    write_bytes(table, text);
    const Outcome links = require_success("pod " + table + " --link logit --link probit");
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
    check_refused("run --signals 0 x " + study + " --out " + folder.file("r.h5"));
    CHECK(program("run " + study + settings + "--signals 0 99999999 --out " + folder.file("r.h5"))
              .mentions("--signals 99999999: is not a row"));
    // One option of several files keeps one value for each name, because signals are files, too.
    CHECK(program("features --help").mentions("--healthy FILE "));
}

const char* const kCommands[] = {"run",   "report",   "compare",  "describe", "stiffness",
                                 "modes", "accuracy", "simulate", "features", "pod",
                                 "lives", "merge",    "misses",   "rare",     "calibrate",
                                 "sweep", "new",      "repair"};

// Options in the help of a command: "  --json TEXT ..." begins with two spaces. Checks its lines,
// except those of the usage, which name the program by its path.
std::vector<std::string> options(const std::string& command) {
    std::istringstream help(program(command + " --help").output);
    std::vector<std::string> names;
    for (std::string line; std::getline(help, line);) {
        INFO(line);
        CHECK((line.size() <= 80 || line.starts_with("Usage: ")));
        const std::size_t at = line.find("--");
        if (line.starts_with("  ") && at != std::string::npos && at < 6) {
            names.push_back(line.substr(at, line.find_first_of(" ,", at) - at));
        }
    }
    return names;
}

std::string replaced(std::string text) {
    for (std::size_t at = 0; (at = text.find("\\-", at)) != std::string::npos;) {
        text.replace(at, 2, "-");
    }
    return text;
}

TEST_CASE("The man page and the completion hold every option of the help, of 80 columns") {
    options("");
    const auto man = require_success("--man"), completion = program("--completion");
    REQUIRE(completion.code == 0);
    const std::string page = replaced(man.output);
    for (const char* command : kCommands) {
        INFO(command);
        const auto names = options(command);
        CHECK_FALSE(names.empty());
        const std::size_t begin = page.find(std::string(".SS gearpod ") + command + "\n");
        REQUIRE(begin != std::string::npos);
        const std::string section = page.substr(begin, page.find("\n.SS", begin + 1) - begin);
        const std::size_t line = completion.output.find(std::string("        ") + command + ") ");
        REQUIRE(line != std::string::npos);
        const std::string words =
            completion.output.substr(line, completion.output.find('\n', line) - line);
        for (const std::string& name : names) {
            INFO(name);
            CHECK(contains(section, name));
            CHECK(contains(words, name));
        }
    }
}

TEST_CASE("bash completes commands, options and the values of options") {
    const auto [folder, script] = TemporaryFile("ask.sh");
    write_bytes(script, program("--completion").output + R"(
ask() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _gearpod; echo "${COMPREPLY[@]}"; }
ask gearpod com
ask gearpod compare --h
ask gearpod pod t.csv --alarm h
)");
    const auto completed = shell("bash " + script);
    CHECK(completed.output == "compare\n--help --html\nhigh\n");
}

TEST_CASE("The version states source revision and build") {
    const auto completed = require_success("--version");
    for (const char* word : {"gearpod ", "git ", "compiler: ", "kernels: ", "HDF5: "}) {
        CHECK_THAT(completed.output, Catch::Contains(word));
    }
}

}  // namespace gearpod::test_options
