#include "mc/gearbox/span_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "mc/scene/feature_needs.hpp"
#include "mc/study/gears.hpp"
#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

features::TurnSignals views(std::span<const double> turn, const signals::MeshSeparation& parts) {
    return {turn,
            parts.regular(),
            parts.residual(),
            parts.difference(),
            parts.envelope(),
            parts.amplitude()};
}

features::ToothSignals views(const signals::ToothStatistics& teeth) {
    return {teeth.rms, teeth.kurtosis, teeth.crest, teeth.m8a};
}

// Divides the statistics by their trend along the path; the squared RMS becomes a ratio, too.
// Statistics that were not needed are empty.
void remove_path_trend(int planets, signals::ToothStatistics& teeth) {
    for (double& rms : teeth.rms) {
        rms *= rms;
    }
    for (std::vector<double>* values : {&teeth.rms, &teeth.kurtosis, &teeth.crest, &teeth.m8a}) {
        signals::remove_path_trend(*values, planets);
    }
    for (double& rms : teeth.rms) {
        rms = std::sqrt(rms);
    }
}

}  // namespace

SpanAnalysis::SpanAnalysis(const Scene& scene, unsigned needs) : scene_(scene), needs_(needs) {
    const int teeth = scene.span().planet_teeth;
    if (needs_samples(needs)) {
        window_ =
            signals::tukey_window(scene.samples_per_mesh(), scene.study().features.tukey_taper);
    }
    if ((needs & features::kSensorTurn) != 0) {
        sensor_turn_ =
            std::make_unique<signals::MeshSeparation>(teeth * scene.samples_per_mesh(), teeth);
    }
    if ((needs & features::kTeParts) != 0) {
        te_turn_ =
            std::make_unique<signals::MeshSeparation>(teeth * scene.te_samples_per_mesh(), teeth);
    }
}

void SpanAnalysis::te(std::span<const double> turn, features::FeatureInput& input) {
    if (te_turn_) {
        te_turn_->load(turn);
        input.te = views(turn, *te_turn_);
    }
}

void SpanAnalysis::sensor(std::span<const double> samples, int planet_turns, int planet_offset,
                          features::FeatureInput& input) {
    const auto phases = static_cast<std::size_t>(scene_.samples_per_mesh());
    const signals::GearTurns planet{scene_.span().planet_teeth, planet_turns};
    const auto span = samples.first(static_cast<std::size_t>(planet.meshes()) * phases);
    if (sensor_turn_) {
        average_ = signals::synchronous_average(
            span, static_cast<std::size_t>(scene_.span().planet_teeth) * phases);
        sensor_turn_->load(average_);
        input.sensor = views(average_, *sensor_turn_);
    }
    if ((needs_ & features::kFiltered) != 0) {
        input.filtered_rms = signals::rms_without_average(
            span, static_cast<std::size_t>(scene_.path_meshes()) * phases);
    }
    if ((needs_ & features::kPlanetMoments) != 0) {
        planet_ = signals::tooth_statistics(span, planet, window_, planet_offset);
        input.planet = views(planet_);
    }
    if ((needs_ & features::kSun) != 0) {
        input.sun = central_teeth(samples, *teeth_of(scene_.study(), Member::sun),
                                  (needs_ & features::kSunMoments) != 0, sun_);
    }
    if ((needs_ & features::kRing) != 0) {
        input.ring = central_teeth(samples, *teeth_of(scene_.study(), Member::ring),
                                   (needs_ & features::kRingMoments) != 0, ring_);
    }
}

// The teeth of a fixed gear have constant positions along the path; their statistics are freed of
// its trend.
features::ToothSignals SpanAnalysis::central_teeth(std::span<const double> samples, int teeth,
                                                   bool moments,
                                                   signals::ToothStatistics& statistics) {
    const signals::GearTurns gear = central_turns(scene_.span(), teeth);
    const auto phases = static_cast<std::size_t>(scene_.samples_per_mesh());
    const auto span = samples.first(static_cast<std::size_t>(gear.meshes()) * phases);
    signals::Windowing windowing(gear.layout(), scene_.samples_per_mesh(),
                                 scene_.study().features.tukey_taper);
    std::vector<double> rms(static_cast<std::size_t>(teeth));
    windowing.load(signals::fold_of_squares(span, static_cast<std::size_t>(teeth) * phases));
    const int offset = windowing.search(0.0, rms);
    if (moments) {
        statistics = signals::tooth_statistics(span, gear, window_, offset);
    }
    statistics.rms = std::move(rms);
    if (scene_.path_meshes() == teeth) {
        remove_path_trend(scene_.study().gearbox.planets, statistics);
    }
    return views(statistics);
}

}  // namespace gearpod::mc
