#include "mc/commands/support.hpp"

#include <fmt/core.h>

#include <exception>
#include <span>

#include "machine/dispatch.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

void print_problems(const Problems& problems) {
    fmt::print(stderr, "{}", format(problems));
}

std::optional<Study> load_study(const StudyOptions& options) {
    StudyReading reading = read_study(options.path, options.overrides);
    if (!reading.study) {
        print_problems(reading.problems);
    }
    return std::move(reading.study);
}

std::unique_ptr<Scene> make_scene(const std::string& name, StudyReading reading,
                                  Problems& problems) {
    if (!reading.study) {
        problems = std::move(reading.problems);
        return nullptr;
    }
    const Study& study = *reading.study;
    if (!has_gears(study)) {
        problems = {{name, 0, "gearbox.sun_teeth",
                     "no tooth numbers or no module (only modes and describe do without)",
                     "give sun_teeth, planet_teeth, ring_teeth and module_mm"}};
        return nullptr;
    }
    try {
        machine::use_instruction_set(
            study.numerics.instruction_set.value_or(machine::best_instruction_set()));
    } catch (const std::exception& error) {
        problems = {{name, 0, "numerics.instruction_set", error.what(), "use auto"}};
        return nullptr;
    }
    try {
        return std::make_unique<Scene>(study);
    } catch (const SceneError& error) {
        problems = {{name, 0, error.key(), error.what(), error.remedy()}};
        return nullptr;
    }
}

std::unique_ptr<Scene> make_scene(const StudyOptions& options, Problems& problems) {
    return make_scene(options.path, read_study(options.path, options.overrides), problems);
}

std::unique_ptr<Scene> load_scene(const StudyOptions& options) {
    Problems problems;
    auto scene = make_scene(options, problems);
    if (!scene) {
        print_problems(problems);
    }
    return scene;
}

bool can_write(const std::string& path) {
    const std::string reason = why_not_writable(path);
    if (!reason.empty()) {
        fmt::print(stderr, "{}: cannot be written: {}\n", path, reason);
    }
    return reason.empty();
}

bool write_text_to(const std::string& path, const std::string& text) {
    if (path == "-") {
        fmt::print("{}", text);
        return true;
    }
    try {
        write_file(path, std::as_bytes(std::span(text)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return false;
    }
    return true;
}

}  // namespace gearpod::mc
