#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mc/command_support.hpp"

namespace gearpod::mc {
namespace {

// Frequencies that agree to this belong to one mode, which shows as its multiplicity.
constexpr double kSameMode = 1e-6;

std::vector<double> mean_stiffness(const Study& study) {
    const Gearbox& g = study.gearbox;
    if (g.tooth_profile == ToothProfile::constant) {
        std::vector<double> k(static_cast<std::size_t>(g.planets), *g.sun_planet_stiffness_N_m);
        k.resize(2 * k.size(), *g.ring_planet_stiffness_N_m);
        return k;
    }
    return Scene(study).mean_pairs();
}

}  // namespace

int modes_command(const ModesOptions& options) {
    const auto study = load_study(options.study);
    if (!study) {
        return kBadInput;
    }
    const auto inputs = body_inputs(Sampler(*study).nominal());
    dynamics::PlanetaryLayout at_rest = layout(*study);
    at_rest.inertial_terms = false;  // natural frequencies are those of the standing gearbox
    const std::vector<double> frequencies = dynamics::natural_frequencies_Hz(
        dynamics::assemble(at_rest, inputs, mean_stiffness(*study)));

    if (!options.json.empty()) {
        const nlohmann::json json{{"frequencies_Hz", frequencies}};
        return write_text_to(options.json, json.dump(2) + "\n") ? kDone : kBadInput;
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
