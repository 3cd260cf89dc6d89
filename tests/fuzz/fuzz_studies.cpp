// Reads mutated study files in child processes. Checks: no crash, no hang, no accepted file with
// invalid values.
// Usage: fuzz_studies SEED SECONDS
// Child processes try one file after another; the number of the current file is known if one dies
// or hangs.
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/scene.hpp"
#include "mc/study/schema/schema.hpp"
#include "mutation.hpp"
#include "tests/shipped_studies.hpp"

namespace {

using namespace gearpod;
using Clock = std::chrono::steady_clock;

constexpr double kLongest_s = 25.0;       // for one file; 10 s on an idle machine
constexpr std::uint64_t kSceneEvery = 5;  // one in so many accepted files is built in full

// State of a child process, readable after its death.
struct Shared {
    std::atomic<std::uint64_t> number;  // number of the current file
    std::atomic<std::uint64_t> tried, accepted, scenes;
};

std::vector<std::string> study_texts() {
    std::vector<std::string> texts;
    for (const std::string& name : test::shipped_studies()) {
        std::ifstream stream(test::study_path(name));
        texts.emplace_back(std::istreambuf_iterator<char>(stream),
                           std::istreambuf_iterator<char>());
    }
    return texts;
}

// Description of an invalid value: not a number, or outside the schema's range. Empty if there is
// none.
std::string nonsense(const mc::Study& study) {
    for (const mc::Key& key : mc::schema()) {
        const auto* access = std::get_if<mc::NumberAccess>(&key.access);
        if (access == nullptr || !access->get(study).has_value()) {
            continue;
        }
        const double value = *access->get(study);
        if (!std::isfinite(value)) {
            return key.path() + " is not finite";
        }
        const bool given = key.presence(study).need == mc::Need::required;
        if (given && !key.range.contains(value / key.unit.to_si) &&
            !key.range.contains(value / key.unit.to_si * (1 + 1e-12)) &&
            !key.range.contains(value / key.unit.to_si * (1 - 1e-12))) {
            return key.path() + " is out of its range";
        }
    }
    const std::string text = mc::resolved_text(study);
    const mc::StudyReading again = mc::read_study_text(text, "resolved");
    if (!again.study) {
        return "its resolved text is refused: " + mc::format(again.problems);
    }
    if (!(*again.study == study) || mc::resolved_text(*again.study) != text) {
        return "its resolved text reads to another study";
    }
    const mc::Sampler sampler(mc::DrawPlan{study});
    for (const mc::Group group : {mc::Group::threshold, mc::Group::test}) {
        const mc::Realization drawn = sampler.draw({group, 12345});
        std::vector<double> values = drawn.random_values;
        values.push_back(drawn.inputs.fault_size);
        for (const double value : values) {
            if (!std::isfinite(value)) {
                return "a gearbox is drawn that has a number that is not finite";
            }
        }
    }
    return "";
}

std::string reason_for_failure(const std::string& text, Shared& shared) {
    const mc::StudyReading reading = mc::read_study_text(text, "fuzz.toml");
    ++shared.tried;
    if (!reading.study) {
        return reading.problems.empty() ? "refused without a reason" : "";
    }
    ++shared.accepted;
    const std::string bad = nonsense(*reading.study);
    if (!bad.empty() || shared.accepted % kSceneEvery != 0) {
        return bad;
    }
    // Repeats what `describe` does.
    try {
        if (reading.study->gearbox.has_teeth() && reading.study->gearbox.module_m) {
            const mc::Scene scene = mc::resolved_plan(*reading.study);
            ++shared.scenes;
        }
    } catch (const mc::SceneError&) {
    }
    return "";
}

// Tries files first, first + step, ... until killed; prints and exits with 1 at a failure.
[[noreturn]] void try_files(const std::vector<std::string>& studies, std::uint64_t first,
                            std::uint64_t step, Shared& shared) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they map far more memory
    const rlim_t memory = rlim_t{2} << 30;
    const rlimit limit{memory, memory};
    setrlimit(RLIMIT_DATA, &limit);
#endif
    for (std::uint64_t number = first;; number += step) {
        shared.number = number;
        const std::string text = test::mutated(studies, number);
        const std::string reason = reason_for_failure(text, shared);
        if (!reason.empty()) {
            std::fprintf(stderr, "file %llu: %s\n%s\n", static_cast<unsigned long long>(number),
                         reason.c_str(), text.c_str());
            std::_Exit(1);
        }
    }
}

struct Child {
    pid_t pid;
    Shared* shared;
    std::uint64_t last = 0;
    Clock::time_point since = Clock::now();
};

Child start(const std::vector<std::string>& studies, std::uint64_t first, std::uint64_t step) {
    void* memory =
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    auto* shared = new (memory) Shared{};
    const pid_t pid = fork();
    if (pid == 0) {
        try_files(studies, first, step, *shared);
    }
    return {pid, shared};
}

// Returns false and prints the cause if the child died or hangs.
bool is_well(Child& child, const std::vector<std::string>& studies) {
    int status = 0;
    const bool died = waitpid(child.pid, &status, WNOHANG) == child.pid;
    const std::uint64_t number = child.shared->number;
    if (number != child.last) {
        child.last = number;
        child.since = Clock::now();
    }
    const std::chrono::duration<double> at_it = Clock::now() - child.since;
    if (!died && at_it.count() < kLongest_s) {
        return true;
    }
    if (!died || WIFSIGNALED(status)) {
        std::fprintf(stderr, "file %llu %s\n%s\n", static_cast<unsigned long long>(number),
                     died ? "ends the program" : "is not done with",
                     test::mutated(studies, number).c_str());
    }
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    const std::uint64_t seed = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 30.0;
    const auto studies = study_texts();
    const std::uint64_t count = std::max(1u, std::thread::hardware_concurrency());
    std::vector<Child> children;
    for (std::uint64_t i = 0; i < count; ++i) {
        children.push_back(start(studies, seed * 1000000000 + i, count));
    }
    const auto begin = Clock::now();
    bool well = true;
    while (well && std::chrono::duration<double>(Clock::now() - begin).count() < seconds) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        for (Child& child : children) {
            well = is_well(child, studies) && well;
        }
    }
    std::uint64_t tried = 0, accepted = 0, scenes = 0;
    for (Child& child : children) {
        kill(child.pid, SIGKILL);
        waitpid(child.pid, nullptr, 0);
        tried += child.shared->tried;
        accepted += child.shared->accepted;
        scenes += child.shared->scenes;
    }
    std::printf("%llu study files tried, %llu accepted, %llu of these set up in full\n",
                static_cast<unsigned long long>(tried), static_cast<unsigned long long>(accepted),
                static_cast<unsigned long long>(scenes));
    return well && accepted > 0 ? 0 : 1;
}
