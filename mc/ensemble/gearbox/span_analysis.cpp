#include "mc/ensemble/gearbox/span_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

features::SeparatedTurn views(std::span<const double> turn, const signals::MeshSeparation& parts,
                              int mesh_order) {
    return {turn,      parts.regular(), parts.residual(), parts.difference(), parts.amplitude(),
            mesh_order};
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

SpanAnalysis::SpanAnalysis(const RecordPlan& record, const FeaturePlan& features,
                           features::SignalSet needs)
    : record_(record), features_(features), needs_(needs) {
    const int teeth = record.span.planet_teeth;
    if (needs_samples(needs)) {
        window_ = signals::tukey_window(record.samples, features.tukey_taper);
    }
    if (needs.has<features::SensorTurn>()) {
        sensor_turn_ = std::make_unique<signals::MeshSeparation>(teeth * record.samples, teeth);
    }
    if (needs.has<features::TeParts>()) {
        te_turn_ = std::make_unique<signals::MeshSeparation>(teeth * record.te_samples, teeth);
    }
}

void SpanAnalysis::te(std::span<const double> turn, features::FeatureInput& input) {
    if (te_turn_) {
        te_turn_->load(turn);
        input.get<features::TeParts>() = {views(turn, *te_turn_, record_.span.planet_teeth)};
    }
}

void SpanAnalysis::sensor(std::span<const double> samples, int planet_turns, int planet_offset,
                          features::FeatureInput& input) {
    const auto phases = static_cast<std::size_t>(record_.samples);
    const signals::GearTurns planet{record_.span.planet_teeth, planet_turns};
    const auto span = samples.first(static_cast<std::size_t>(planet.meshes()) * phases);
    input.get<features::SensorSamples>() = {span};
    if (sensor_turn_) {
        average_ = signals::synchronous_average(span, record_.turn_samples());
        sensor_turn_->load(average_);
        input.get<features::SensorTurn>() = {
            views(average_, *sensor_turn_, record_.span.planet_teeth)};
    }
    if (needs_.has<features::FilteredSensor>()) {
        const std::size_t path = static_cast<std::size_t>(record_.path_meshes()) * phases;
        input.get<features::FilteredSensor>().rms =
            span.size() < 2 * path ? std::nan("") : signals::rms_without_average(span, path);
    }
    if (needs_.has<features::ToothMoments<Member::planet>>()) {
        planet_ = signals::tooth_statistics(span, planet, window_, planet_offset);
        input.get<features::ToothMoments<Member::planet>>() = {planet_.kurtosis, planet_.crest,
                                                               planet_.m8a};
    }
    if (needs_.has<features::WhitenedToothRms>()) {
        whitened_teeth(span, planet, input);
    }
    central_teeth<Member::sun>(samples, sun_, input);
    central_teeth<Member::ring>(samples, ring_, input);
}

int SpanAnalysis::search_window(std::span<const double> span, const signals::GearTurns& gear,
                                std::vector<double>& rms) const {
    signals::Windowing windowing(gear.layout(), record_.samples, features_.tukey_taper);
    windowing.load(signals::fold_of_squares(
        span, static_cast<std::size_t>(gear.teeth) * static_cast<std::size_t>(record_.samples)));
    rms.resize(static_cast<std::size_t>(gear.teeth));
    return windowing.search(0.0, rms);
}

void SpanAnalysis::whitened_teeth(std::span<const double> span, const signals::GearTurns& planet,
                                  features::FeatureInput& input) {
    if (!prewhitening_ || static_cast<std::size_t>(prewhitening_->points()) != span.size()) {
        prewhitening_ = std::make_unique<signals::Prewhitening>(static_cast<int>(span.size()));
    }
    search_window(prewhitening_->whitened(span), planet, whitened_rms_);
    input.get<features::WhitenedToothRms>() = {whitened_rms_};
}

// The teeth of a fixed gear have constant positions along the path; their statistics are freed of
// its trend.
template <Member kGear>
void SpanAnalysis::central_teeth(std::span<const double> samples,
                                 signals::ToothStatistics& statistics,
                                 features::FeatureInput& input) {
    using Rms = features::ToothRms<kGear>;
    using Moments = features::ToothMoments<kGear>;
    if (!needs_.has<Rms, Moments>()) {
        return;
    }
    const auto phases = static_cast<std::size_t>(record_.samples);
    const signals::GearTurns gear =
        features_.central_turns(kGear, static_cast<int>(samples.size() / phases));
    const int teeth = gear.teeth;
    if (gear.turns == 0) {
        const std::vector<double> none(static_cast<std::size_t>(teeth), std::nan(""));
        statistics = {none, none, none, none};
        input.get<Rms>() = {statistics.rms};
        input.get<Moments>() = {statistics.kurtosis, statistics.crest, statistics.m8a};
        return;
    }
    const auto span = samples.first(static_cast<std::size_t>(gear.meshes()) * phases);
    std::vector<double> rms;
    const int offset = search_window(span, gear, rms);
    if (needs_.has<Moments>()) {
        statistics = signals::tooth_statistics(span, gear, window_, offset);
    }
    statistics.rms = std::move(rms);
    if (record_.path_meshes() == teeth) {
        remove_path_trend(features_.planets, statistics);
    }
    input.get<Rms>() = {statistics.rms};
    input.get<Moments>() = {statistics.kurtosis, statistics.crest, statistics.m8a};
}

}  // namespace gearpod::mc
