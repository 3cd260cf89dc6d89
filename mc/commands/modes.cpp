#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "mc/commands/commands.hpp"
#include "mc/files/json_text.hpp"
#include "mc/library/natural_frequencies.hpp"
#include "mc/run/support.hpp"
#include "mc/scene/scene_error.hpp"

namespace gearpod::mc {
namespace {

// Relative difference below which frequencies are printed as one mode with a multiplicity.
constexpr double kSameMode = 1e-6;

}  // namespace

int modes_command(const ModesOptions& options) {
    const bool writable = can_write({"--json", options.json}, {{"the study", options.study.path}},
                                    {json_output(), options.force});
    const auto study = load_study(options.study);
    if (!study || !writable) {
        return kBadInput;
    }
    std::vector<double> frequencies;
    try {
        frequencies = natural_frequencies_Hz(*study);
    } catch (const SceneError& error) {
        print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
        return kBadInput;
    }

    if (!options.json.empty()) {
        const nlohmann::json json{{"frequencies_Hz", frequencies}};
        return write_text_to(options.json, json_text(json, 2) + "\n") ? kDone : kBadInput;
    }
    fmt::print("natural frequencies at mean mesh stiffness, {} degrees of freedom\n",
               frequencies.size());
    fmt::print("{:>12}  {}\n", "Hz", "multiplicity");
    for (std::size_t i = 0; i < frequencies.size();) {
        std::size_t end = i + 1;
        while (end < frequencies.size() &&
               std::abs(frequencies[end] - frequencies[i]) <= kSameMode * frequencies[end]) {
            ++end;
        }
        fmt::print("{:>12.1f}  {}\n", frequencies[i], end - i);
        i = end;
    }
    return kDone;
}

}  // namespace gearpod::mc
