// Attacks the built program with mutated studies, damaged files with valid checksums, hostile
// signals, files in two roles and hostile options. Checks: no signal, no hang, no memory above 2
// GB, only documented exit codes, no NaN or infinity among the numbers of a success, no input
// overwritten, no refusal that names neither a file nor a key nor an option. Usage:
// attack PROGRAM all|study|results|checkpoint|signal|table|rexs|roles|options SEED SECONDS [MOST]
#include "attack.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <regex>
#include <thread>

#include "tests/mc/recording_bytes.hpp"
#include "tests/mc/tdms_bytes.hpp"
#include "tests/shipped_studies.hpp"

namespace {

using namespace gearpod::test;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr rlim_t kMemory = rlim_t{2} << 30;
// A call that needs more processor time, or does nothing for so long, does not end.
constexpr rlim_t kLongestProcessor_s = 25;
constexpr double kLongest_s = 600.0;
constexpr std::uint64_t kNumbersOfSeed = 1000000000;

std::string bytes_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Ending {
    int status = 0;
    bool hung = false;
    std::string output;
};

[[noreturn]] void become(const std::vector<char*>& words, const std::string& log) {
    const rlimit limit{kMemory, kMemory}, none{0, 0},
        processor{kLongestProcessor_s, kLongestProcessor_s + 5};
    setrlimit(RLIMIT_AS, &limit);
    setrlimit(RLIMIT_CPU, &processor);
    setrlimit(RLIMIT_CORE, &none);
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execv(words[0], words.data());
    std::_Exit(127);
}

// Runs the program; both output streams go into `log`.
Ending call(const std::string& program, const std::vector<std::string>& arguments,
            const std::string& log) {
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        become(words, log);
    }
    Ending ending;
    const auto start = Clock::now();
    while (waitpid(child, &ending.status, WNOHANG) == 0) {
        if (std::chrono::duration<double>(Clock::now() - start).count() > kLongest_s) {
            ending.hung = true;
            kill(child, SIGKILL);
            waitpid(child, &ending.status, 0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ending.output = bytes_of(log);
    return ending;
}

bool names_no_number(std::string text) {
    for (char& c : text) {
        c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : ' ';
    }
    text = " " + text + " ";
    return text.find(" nan ") != std::string::npos || text.find(" inf ") != std::string::npos;
}

// True if a message names an argument of the call, a file, an option or a key of a study.
bool names_its_cause(const std::string& message, const Attack& attack) {
    static const std::regex option_or_key("--[a-z]|[a-z_]+\\.[a-z_]+|\\[[a-z_]+\\]");
    return std::ranges::any_of(attack.arguments,
                               [&](const std::string& argument) {
                                   return !argument.empty() &&
                                          message.find(argument) != std::string::npos;
                               }) ||
           std::regex_search(message, option_or_key);
}

// Description of a violated promise, or "".
std::string verdict(const Ending& ending, const Attack& attack) {
    if (ending.hung || (WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGXCPU)) {
        return "does not end";
    }
    if (WIFSIGNALED(ending.status)) {
        return "ends by signal " + std::to_string(WTERMSIG(ending.status));
    }
    const int code = WEXITSTATUS(ending.status);
    if (code != 0 && code != 2 && code != 3 && code != 4) {
        return "ends with " + std::to_string(code);
    }
    for (const char* raw : {"std::", "bad_alloc", "json.exception", "Traceback", "terminate"}) {
        if (ending.output.find(raw) != std::string::npos) {
            return std::string("says ") + raw;
        }
    }
    if (code == 2 && ending.output.empty()) {
        return "refuses and says nothing";
    }
    if (code == 2 && !names_its_cause(ending.output, attack)) {
        return "refuses and names neither a file nor a key";
    }
    if (code == 0 && attack.prints_numbers && names_no_number(ending.output)) {
        return "prints a number that is none";
    }
    return "";
}

using Maker = Attack (*)(const Arsenal&, const std::string&, std::uint64_t);

const std::map<std::string, Maker> kKinds{
    {"study", attack_by_study},           {"results", attack_by_results},
    {"checkpoint", attack_by_checkpoint}, {"signal", attack_by_signal},
    {"table", attack_by_table},           {"rexs", attack_by_rexs},
    {"roles", attack_by_roles},           {"options", attack_by_options}};

// Runs attacks first, first + 1, ... in several threads until the time is over or all are done.
class Campaign {
  public:
    Campaign(const Arsenal& arsenal, Maker make, std::uint64_t first, std::uint64_t most,
             double seconds)
        : arsenal_(arsenal),
          make_(make),
          next_(first),
          end_(first + most),
          until_(Clock::now() + std::chrono::milliseconds(static_cast<long>(1e3 * seconds))) {}

    void work(int worker) {
        const std::string folder = arsenal_.folder + "/w" + std::to_string(worker);
        while (Clock::now() < until_) {
            const std::uint64_t number = next_++;
            if (number >= end_) {
                return;
            }
            fs::remove_all(folder);
            fs::create_directory(folder);
            attack(number, folder);
        }
    }

    int report(const std::string& kind) const {
        std::printf("%s: %llu attacks, %llu failures; exit codes", kind.c_str(),
                    static_cast<unsigned long long>(tried_), static_cast<unsigned long long>(bad_));
        for (const auto& [code, count] : codes_) {
            std::printf(" %d: %llu", code, static_cast<unsigned long long>(count));
        }
        std::printf("\n");
        return bad_ == 0 && tried_ > 0 ? 0 : 1;
    }

  private:
    void attack(std::uint64_t number, const std::string& folder) {
        const Attack attack = make_(arsenal_, folder, number);
        std::vector<std::string> before;
        for (const std::string& input : attack.inputs) {
            before.push_back(bytes_of(input));
        }
        const Ending ending = call(attack.program.empty() ? arsenal_.program : attack.program,
                                   attack.arguments, folder + "/log");
        std::string what = verdict(ending, attack);
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (bytes_of(attack.inputs[i]) != before[i]) {
                what = "writes over " + attack.inputs[i];
            }
        }
        note(number, attack, ending, what);
    }

    void note(std::uint64_t number, const Attack& attack, const Ending& ending,
              const std::string& what) {
        const std::lock_guard lock(mutex_);
        ++tried_;
        ++codes_[WIFEXITED(ending.status) ? WEXITSTATUS(ending.status) : -WTERMSIG(ending.status)];
        if (what.empty()) {
            return;
        }
        ++bad_;
        std::string line;
        for (const std::string& argument : attack.arguments) {
            line += " " + argument;
        }
        std::fprintf(stderr, "attack %llu: gearpod%s\n%s:\n%s\n",
                     static_cast<unsigned long long>(number), line.c_str(), what.c_str(),
                     ending.output.substr(0, 2000).c_str());
    }

    const Arsenal& arsenal_;
    const Maker make_;
    std::atomic<std::uint64_t> next_;
    const std::uint64_t end_;
    const Clock::time_point until_;
    std::mutex mutex_;
    std::uint64_t tried_ = 0, bad_ = 0;
    std::map<int, std::uint64_t> codes_;
};

// Creates valid files with the program itself. Returns false if it fails.
bool arm(Arsenal& arsenal) {
    const std::string at = arsenal.folder + "/genuine";
    fs::create_directory(at);
    arsenal.small_study = GEARPOD_SOURCE_DIR "/tests/features/reference/small.toml";
    bool good = true;
    const auto make = [&](const std::vector<std::string>& arguments, int code) {
        const Ending ending = call(arsenal.program, arguments, at + "/log");
        const bool exited_as_requested =
            WIFEXITED(ending.status) && WEXITSTATUS(ending.status) == code;
        std::fputs(exited_as_requested ? "" : ending.output.c_str(), stderr);
        good = good && exited_as_requested;
    };
    const std::string& study = arsenal.small_study;
    make({"run", study, "--instances", "4", "--out", at + "/r.h5"}, 0);
    make({"run", study, "--instances", "200000", "--time-limit", "00:00:01", "--out", at + "/p.h5"},
         4);
    make({"simulate", study, "--instance", "0", "--meshes", "400", "--out", at + "/x.csv"}, 0);
    make({"simulate", study, "--instance", "0", "--meshes", "400", "--out", at + "/x.h5"}, 0);
    arsenal.results = bytes_of(at + "/r.h5");
    arsenal.checkpoint = bytes_of(at + "/p.h5.part");
    arsenal.csv = bytes_of(at + "/x.csv");
    arsenal.hdf5 = bytes_of(at + "/x.h5");
    std::vector<double> sensor(4000);
    for (std::size_t i = 0; i < sensor.size(); ++i) {
        sensor[i] = 0.5 * std::sin(0.7 * static_cast<double>(i));
    }
    arsenal.wav = wav_bytes(sensor, 1, 280, WavForm::whole_16);
    const TdmsBytes tdms;
    arsenal.tdms = tdms.segment(kTdmsMeta | kTdmsNew | kTdmsRaw,
                                {tdms.object("/'g'/'sensor'", tdms.index(10, 2000),
                                             {tdms.property("wf_increment", 1.0 / 280),
                                              tdms.property("unit_string", "g")})},
                                tdms.reals(sensor));
    arsenal.uff = uff_bytes(sensor, 1.0 / 280, "g", UffForm::text_single);
    for (const char* model : {"planetary", "two_pairs"}) {
        const Ending printed = call("/usr/bin/python3",
                                    {"-c",
                                     std::string("import sys; sys.path.insert(0, sys.argv[1]); "
                                                 "import rexs_models; print(rexs_models.") +
                                         model + "().text())",
                                     GEARPOD_SOURCE_DIR "/tests/python"},
                                    at + "/log");
        good = good && printed.output.find("</model>") != std::string::npos;
        arsenal.gear_units.push_back(printed.output);
    }
    for (const char* table : {"inspections_hits.csv", "inspections_responses.csv"}) {
        arsenal.inspections.push_back(
            bytes_of(std::string(GEARPOD_SOURCE_DIR "/tests/analysis/reference/") + table));
    }
    for (const std::string& name : shipped_studies()) {
        arsenal.studies.push_back(bytes_of(study_path(name)));
    }
    return good;
}

int campaign(const Arsenal& arsenal, const std::string& kind, std::uint64_t seed,
             std::uint64_t most, double seconds) {
    // A seed this large is the number of an attack.
    const std::uint64_t first = seed < kNumbersOfSeed ? seed * kNumbersOfSeed : seed;
    Campaign campaign(arsenal, kKinds.at(kind), first, most, seconds);
    std::vector<std::thread> workers;
    const unsigned count = std::max(1u, std::thread::hardware_concurrency());
    for (unsigned i = 0; i < count; ++i) {
        workers.emplace_back([&campaign, i] { campaign.work(static_cast<int>(i)); });
    }
    for (std::thread& worker : workers) {
        worker.join();
    }
    return campaign.report(kind);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string all = "all";
    if (argc < 5 || (argv[2] != all && !kKinds.contains(argv[2]))) {
        std::fprintf(stderr,
                     "attack PROGRAM all|study|results|checkpoint|signal|table|rexs|roles|options "
                     "SEED SECONDS [MOST]\n");
        return 2;
    }
    std::string folder = (fs::temp_directory_path() / "gearpod-attack-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
        return 2;
    }
    Arsenal arsenal;
    arsenal.program = argv[1];
    arsenal.folder = folder;
    int code = 2;
    if (arm(arsenal)) {
        const std::uint64_t most = argc > 5 ? std::strtoull(argv[5], nullptr, 10) : kNumbersOfSeed;
        const std::uint64_t seed = std::strtoull(argv[3], nullptr, 10);
        const double seconds = std::atof(argv[4]);
        code = 0;
        for (const auto& [kind, attack] : kKinds) {
            if (argv[2] == kind || argv[2] == all) {
                const double share = argv[2] == all ? static_cast<double>(kKinds.size()) : 1.0;
                code = std::max(code, campaign(arsenal, kind, seed, most, seconds / share));
            }
        }
    } else {
        std::fprintf(stderr, "the program does not make the genuine files\n");
    }
    fs::remove_all(folder);
    return code;
}
