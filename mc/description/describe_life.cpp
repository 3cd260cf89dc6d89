#include "mc/description/describe_life.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mc/description/entries.hpp"
#include "mc/lives/life_tile.hpp"
#include "mc/scene/scene_error.hpp"

namespace gearpod::mc {
namespace {

// Describes how records at other torques or speeds are computed.
std::string load_text(const RecordDistribution& law, const std::optional<int>& evenly_spaced,
                      const std::optional<int>& nodes, double tolerance) {
    const char* const unit = law.given() ? "the study's value" : "the gearbox's value";
    if (const std::vector<double> distinct = law.distinct_factors(); distinct.size() > 1) {
        return fmt::format(
            "{}; {} values occur, equally often, and each is integrated: {:.4g} "
            "times {}",
            law.text(), distinct.size(), fmt::join(distinct, ", "), unit);
    }
    const LoadAxis axis(law, evenly_spaced.value_or(2), nodes);
    return law.text() +
           (axis.factors().size() > 1
                ? fmt::format(
                      "; records between are interpolated from solutions at {:.3g} times {}{}",
                      fmt::join(axis.factors(), ", "), unit,
                      evenly_spaced || nodes
                          ? ""
                          : fmt::format(", or at more if the error is above {:g} "
                                        "(life.interpolation_tolerance)",
                                        tolerance))
                : "");
}

// True for fault inputs, which only `run` uses: in a life the crack grows to its depth.
bool is_of_fault(const RandomInput& input) {
    return input.key.starts_with("fault.");
}

std::string growth_text(const Study& study) {
    std::string text = study.life.curve_h.empty()
                           ? "Paris law, with the torque and speed of the records"
                           : "along the given curve";
    for (const RandomInput& input : study.random) {
        text += is_of_fault(input) ? "; " + input.key + " in [random] is ignored" : "";
    }
    return text;
}

std::string of_gearbox(const Study& study) {
    std::string text = has_tooth_errors(study) ? "tooth errors" : "";
    for (const RandomInput& input : study_of_gearboxes(study).random) {
        if (!is_of_fault(input)) {
            text += (text.empty() ? "" : ", ") + input.key;
        }
    }
    return text.empty() ? "nothing: all gearboxes are identical" : text;
}

}  // namespace

void print_life(const Scene& scene) {
    const Study& study = scene.study();
    const Life& life = study.life;
    if (!life.interval_h) {
        return;
    }
    print_heading("lives");
    try {
        check_superposable(scene);
        print_entry("record", record_text(scene));
    } catch (const SceneError& error) {
        print_entry("no lives",
                    fmt::format("{}: {}; {}", error.key(), error.what(), error.remedy()));
        return;
    }
    print_entry("random per gearbox", of_gearbox(study));
    const RecordDistributions laws(study);
    print_entry("torque per record",
                load_text(laws.torque, life.given_torques, life.polynomial_torques,
                          life.interpolation_tolerance));
    print_entry("speed per record", load_text(laws.speed, life.given_speeds, life.polynomial_speeds,
                                              life.interpolation_tolerance));
    print_entry("gain per record", laws.gain.text());
    print_entry("noise per record", laws.noise.text());
    print_entry("crack growth", growth_text(study));
    print_entry("crack depths integrated",
                fmt::format("0 and {} depths up to {:g} mm, with interpolation in between",
                            life.depth_steps, 1e3 * *life.last_depth_m));
    print_entry("gearboxes", fmt::format("{} with a crack, {} healthy for the thresholds, {} "
                                         "healthy to count false alarms",
                                         study.ensemble.instances,
                                         study.ensemble.threshold_instances, life.healthy_lives));
}

}  // namespace gearpod::mc
