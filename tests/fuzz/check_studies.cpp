// Reads study files from stdin, each after a line with its number of bytes, and prints one line for
// each: "refused", "accepted", "set up" in full, or what is wrong. fuzz_studies.py makes the files.
#include <sys/resource.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/scene.hpp"
#include "mc/study/schema/schema.hpp"

namespace {

using namespace gearpod;

constexpr int kSceneEvery = 5;  // one in so many accepted files is built in full

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

std::string answer(const std::string& text) {
    static int accepted = 0;
    const mc::StudyReading reading = mc::read_study_text(text, "fuzz.toml");
    if (!reading.study) {
        return reading.problems.empty() ? "refused without a reason" : "refused";
    }
    const std::string bad = nonsense(*reading.study);
    if (!bad.empty() || ++accepted % kSceneEvery != 0) {
        return bad.empty() ? "accepted" : bad;
    }
    // Repeats what `describe` does.
    try {
        if (reading.study->gearbox.has_teeth() && reading.study->gearbox.module_m) {
            const mc::Scene scene = mc::resolved_plan(*reading.study);
            return "set up";
        }
    } catch (const mc::SceneError&) {
    }
    return "accepted";
}

}  // namespace

int main() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they map far more memory
    const rlim_t memory = rlim_t{2} << 30;
    const rlimit limit{memory, memory};
    setrlimit(RLIMIT_DATA, &limit);
#endif
    for (std::string count, text; std::getline(std::cin, count);) {
        text.resize(std::stoul(count));
        std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
        std::string line = answer(text);
        std::replace(line.begin(), line.end(), '\n', ' ');
        std::cout << line << std::endl;
    }
    return 0;
}
