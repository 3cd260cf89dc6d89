// Attacks by options: hostile numbers, pipes as inputs, outputs over files of another kind.
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "attack.hpp"
#include "dice.hpp"

namespace gearpod::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::array kHostile{"nan",  "-nan",   "inf",   "-inf", "NAN(1)", "1e400",
                              "0x10", "1,5",    "",      " 5",   "5 ",     "5x",
                              "+-1",  "1e-320", "1e308", "-1",   "0",      "99999999999999999999",
                              "1e18", "0.5",    "2",     "1e3",  ".",      "\x1b[2J"};

void write_file_of(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// A command with one or two numeric options.
Attack numbers(const Arsenal& arsenal, const std::string& folder, Dice& dice) {
    const std::string table = folder + "/t.csv", signal = folder + "/x.csv",
                      results = folder + "/r.h5", study = arsenal.small_study;
    write_file_of(table, dice.one_of(arsenal.inspections));
    write_file_of(signal, arsenal.csv);
    write_file_of(results, arsenal.results);
    struct Command {
        Words words;
        std::vector<const char*> options;
    };
    const std::vector<Command> commands{
        {{"pod", table, "--json", "-"},
         {"--floor", "--confidence", "--target", "--threshold", "--false-call-rate", "--left",
          "--right", "--response-scale"}},
        {{"features", signal, "--study", study},
         {"--sampling-Hz", "--samples-per-mesh", "--pulses-per-turn", "--noise-level"}},
        {{"new", "planetary", "--sun=19", "--planet=31", "--module=2", "--torque=100"},
         {"--speed", "--power", "--helix", "--pressure-angle", "--face-width", "--addendum",
          "--sun-shift", "--centre-distance", "--sun-tip", "--quality", "--planets", "--ring"}},
        {{"report", results}, {"--alarm-cost", "--miss-cost", "--fault-share"}},
        {{"simulate", study}, {"--instance"}},
        {{"stiffness", study}, {"--points"}},
        {{"describe", study}, {"--ranks", "--seed", "--instances", "--set=operation.torque_N_m"}}};
    const Command& command = dice.one_of(commands);
    Attack attack{command.words, false, {results, signal, table}};
    for (std::size_t i = 0; i < 1 + dice.below(2); ++i) {
        const std::string option = dice.one_of(command.options);
        const std::string value = dice.one_of(kHostile);
        if (value.empty()) {
            attack.arguments.insert(attack.arguments.end(), {option, value});
        } else {
            attack.arguments.push_back(option + "=" + value);
        }
    }
    return attack;
}

// A pipe without a writer in the place of an input.
Attack pipes(const Arsenal& arsenal, const std::string& folder, Dice& dice) {
    constexpr std::array kEndings{".h5", ".csv", ".toml", ".mat", ".wav", ".uff", ""};
    const std::string pipe = folder + "/pipe" + dice.one_of(kEndings), study = arsenal.small_study,
                      signal = folder + "/x.csv", results = folder + "/r.h5";
    ::mkfifo(pipe.c_str(), 0600);
    write_file_of(signal, arsenal.csv);
    write_file_of(results, arsenal.results);
    const std::vector<Words> commands{
        {"run", pipe},
        {"describe", pipe},
        {"modes", pipe},
        {"lives", pipe},
        {"report", pipe},
        {"repair", pipe},
        {"pod", pipe},
        {"compare", results, pipe},
        {"merge", results, pipe, "--out", folder + "/m.h5"},
        {"misses", pipe, "--feature", "te_rms", "--size", "1"},
        {"rare", pipe, "--feature", "te_rms", "--rate", "0.1"},
        {"features", pipe, "--study", study},
        {"features", signal, "--study", pipe},
        {"features", signal, "--study", study, "--healthy", pipe},
        {"features", signal, "--study", study, "--against", pipe},
        {"features", signal, "--study", study, "--baseline", pipe},
        {"features", "--manifest", pipe, "--study", study, "--csv", "-"},
        {"calibrate", study, "--features", pipe},
        {"accuracy", study, "--seconds", "1", "--peers", pipe},
        {"simulate", study, "--instance", "0", "--out", pipe},
        {"run", study, "--out", pipe, "--resume"}};
    return {dice.one_of(commands), false, {results, signal}};
}

// An output over a file of another kind. The file must stay unchanged.
Attack other_kinds(const Arsenal& arsenal, const std::string& folder, Dice& dice) {
    const std::string study = folder + "/s.toml", signal = folder + "/x.csv",
                      results = folder + "/r.h5", table = folder + "/t.csv";
    fs::copy_file(arsenal.small_study, study);
    write_file_of(signal, arsenal.csv);
    write_file_of(results, arsenal.results);
    write_file_of(table, arsenal.inspections.front());
    constexpr std::array kEndings{".h5", ".csv", ".json", ".html", ".dat"};
    const std::array contents{arsenal.results, arsenal.csv, arsenal.hdf5.substr(0, 500),
                              std::string("years of work\n"), arsenal.wav};
    const std::string aim = folder + "/aim" + dice.one_of(kEndings);
    write_file_of(aim, dice.one_of(contents));
    const std::vector<Words> commands{
        {"features", signal, "--study", study, "--quiet", "--out", aim},
        {"features", signal, "--study", study, "--quiet", "--csv", aim},
        {"features", signal, "--study", study, "--json", aim},
        {"stiffness", study, "--points", "10", "--csv", aim},
        {"modes", study, "--json", aim},
        {"report", results, "--json", aim},
        {"report", results, "--html", aim},
        {"report", results, "--pdf", aim},
        {"compare", results, results, "--html", aim},
        {"pod", table, "--json", aim}};
    return {dice.one_of(commands), false, {aim, study, signal, results, table}};
}

}  // namespace

Attack attack_by_options(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    switch (dice.below(3)) {
        case 0:
            return numbers(arsenal, folder, dice);
        case 1:
            return pipes(arsenal, folder, dice);
        default:
            return other_kinds(arsenal, folder, dice);
    }
}

}  // namespace gearpod::test
