// Checks that the man page and the completion agree with --help for every command.
#include "tests/mc/program.hpp"

namespace gearpod::test_help {

using namespace test;

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
    const Folder folder;
    const std::string script = folder.file("ask.sh");
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

}  // namespace gearpod::test_help
