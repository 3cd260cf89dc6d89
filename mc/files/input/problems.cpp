#include "mc/files/input/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <stdexcept>
#include <tuple>

#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {

std::string exception_text(const std::exception& error) {
    const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
                           dynamic_cast<const std::length_error*>(&error) != nullptr;
    return no_memory ? "out of memory; reduce numerics.threads, or the size of the study "
                       "(ensemble.instances, sensor.noise_levels, sensor.sampling_Hz)"
                     : error.what();
}

std::string format(const Problem& problem) {
    std::string text = printable(problem.file);
    if (problem.line > 0) {
        text += ":" + std::to_string(problem.line);
    }
    if (!problem.key.empty()) {
        text += ": " + printable(problem.key);
    }
    text += ": " + printable(problem.what);
    if (!problem.remedy.empty()) {
        text += "; " + printable(problem.remedy);
    }
    return text;
}

std::string format(const Problems& problems, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < std::min(most, problems.size()); ++i) {
        text += format(problems[i]) + "\n";
    }
    return most < problems.size()
               ? text + fmt::format("{}: and {} more\n", printable(problems[most].file),
                                    problems.size() - most)
               : text;
}

void sort_problems(Problems& problems) {
    std::map<std::string, int> order;
    for (const Problem& problem : problems) {
        const int next = static_cast<int>(order.size());
        order.try_emplace(problem.file, problem.file == "--set" ? 1 << 30 : next);
    }
    std::stable_sort(problems.begin(), problems.end(), [&](const Problem& a, const Problem& b) {
        return std::tuple(order.at(a.file), a.line) < std::tuple(order.at(b.file), b.line);
    });
}

}  // namespace gearpod::mc
