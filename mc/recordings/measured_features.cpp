#include "mc/recordings/measured_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/span_analysis.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/recordings/quantisation.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/spectra/synchronous_average.hpp"
#include "signals/windowing/folded_signal.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {
namespace {

using features::Feature;
using PlanetRms = features::ToothRms<Member::planet>;

constexpr int kFewestOfParts = 4;  // samples per mesh period that order_spectrum.hpp needs

// Reason why a feature cannot be computed from this signal; "" if it can.
std::string why_unavailable(const Feature& feature, const MeasurementPlan& plan,
                            const MeasuredSignal& signal, bool has_reference) {
    if (feature.needs.overlaps(features::kCentralGears) && !plan.features.sun) {
        return "the gearbox has no sun and no ring";
    }
    if (feature.from_sensor && !plan.features.sensor) {
        return "the study has no sensor (effects.motion)";
    }
    if (!(feature.from_sensor ? signal.has_sensor : signal.has_te)) {
        return feature.from_sensor ? "no sensor signal" : "no transmission error";
    }
    const int has = feature.from_sensor ? signal.sensor_meshes : signal.te_meshes;
    const int needed = plan.features.least_meshes(feature);
    if (has < needed) {
        return fmt::format("{} mesh periods, but {} are needed", has, needed);
    }
    if (feature.needs.has<features::TeParts>() && plan.record.te_samples < kFewestOfParts) {
        return fmt::format(
            "the study's encoders take {} samples per mesh period, but {} are needed",
            plan.record.te_samples, kFewestOfParts);
    }
    if (feature.needs.has<features::HealthyRecords>() && !has_reference) {
        return "no healthy reference at this noise level: give --healthy or --noise-level";
    }
    return "";
}

// Prepares the signals of a recording for feature computation.
class MeasuredInput {
  public:
    MeasuredInput(const MeasurementPlan& plan, features::SignalSet needs)
        : plan_(plan), span_(plan.record.span), analysis_(plan.record, plan.features, needs) {}

    features::FeatureInput of(const MeasuredSignal& signal) {
        features::FeatureInput input;
        if (signal.te_meshes >= span_.planet_teeth) {
            add_te(signal, input);
        }
        if (const int turns = signal.planet_turns(span_); turns > 0) {
            add_sensor(signal, turns, input);
        }
        return input;
    }

    // First sample of the best window of the planets' teeth.
    int tooth_offset() const { return tooth_offset_; }

  private:
    // Averages over all available planet turns, at most those of the span.
    void add_te(const MeasuredSignal& signal, features::FeatureInput& input) {
        const std::size_t turn = static_cast<std::size_t>(span_.planet_teeth) *
                                 static_cast<std::size_t>(plan_.record.te_samples);
        const std::size_t span = turn * static_cast<std::size_t>(span_.ring_teeth);
        te_ = signals::synchronous_average(
            std::span(signal.te).first(std::min(signal.te.size(), span)), turn);
        const auto largest = [&] {
            return std::accumulate(te_.begin(), te_.end(), 0.0, [](double most, double value) {
                return std::max(most, std::abs(value));
            });
        };
        const double before = largest();
        remove_mean(te_);
        // The remainder is rounding error; its ratios are meaningless.
        if (largest() <= kRounding * before) {
            std::fill(te_.begin(), te_.end(), 0.0);
        }
        signals::OrderSpectrum spectrum(static_cast<int>(turn));
        spectrum.load(te_);
        amplitude_.resize(static_cast<std::size_t>(spectrum.orders()));
        spectrum.amplitudes(0.0, amplitude_);
        input.get<features::TeTurn>() = {te_, amplitude_, span_.planet_teeth,
                                         plan_.features.te_harmonics};
        analysis_.te(te_, input);
    }

    void add_sensor(const MeasuredSignal& signal, int turns, features::FeatureInput& input) {
        const std::size_t turn = plan_.record.turn_samples();
        auto folded = signals::fold_of_squares(
            std::span(signal.sensor).first(turn * static_cast<std::size_t>(turns)), turn);
        // Scales to the sum over a whole span, because the windows divide by the number of squares
        // in it.
        if (turns < span_.ring_teeth) {
            for (double& sum : folded) {
                sum *= static_cast<double>(span_.ring_teeth) / turns;
            }
        }
        signals::Windowing windowing(span_, plan_.record.samples, plan_.features.tukey_taper);
        tooth_rms_.resize(static_cast<std::size_t>(span_.planet_teeth));
        windowing.load(folded);
        tooth_offset_ = windowing.search(0.0, tooth_rms_);
        input.get<PlanetRms>() = {tooth_rms_};
        input.get<features::SensorPower>() = {windowing.mean_square(0.0)};
        analysis_.sensor(signal.sensor, turns, tooth_offset_, input);
    }

    static constexpr double kRounding = 1e-13;

    const MeasurementPlan& plan_;
    const signals::SpanLayout span_;
    SpanAnalysis analysis_;
    std::vector<double> te_, amplitude_, tooth_rms_;
    int tooth_offset_ = 0;
};

// Reason why a feature has no finite value although its signal exists.
std::string why_no_value(const Feature& feature, const features::FeatureInput& input,
                         const RecordPlan& plan) {
    const auto zero = [](std::span<const double> values) {
        return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
    };
    if (!feature.from_sensor && zero(input.get<features::TeTurn>().turn)) {
        return "the transmission error is constant";
    }
    if (feature.name.ends_with("te_fm0") && plan.te_samples <= 2) {
        return fmt::format("no mesh harmonic: the study's encoders take {} samples per mesh period",
                           plan.te_samples);
    }
    if (feature.from_sensor && input.get<features::SensorPower>().mean_square == 0.0) {
        return "the sensor's signal is zero";
    }
    return "not finite: its definition divides by a quantity that is zero in this signal";
}

WorstTooth worst_tooth(const char* gear, std::span<const double> rms) {
    const auto worst = std::max_element(rms.begin(), rms.end());
    return {gear, static_cast<int>(worst - rms.begin()) + 1, static_cast<int>(rms.size()),
            features::worst_to_median(rms)};
}

// Teeth of the signal whose best window begins `offset` samples and `shift` mesh periods after the
// start of the map.
ToothMap tooth_map(std::span<const double> rms, double offset_meshes, double shift) {
    ToothMap map{{rms.begin(), rms.end()}, 0.0};
    if (!map.rms.empty()) {
        const double first = offset_meshes + shift;
        const double whole = std::floor(first);
        map.first = first - whole;
        // Tooth j of the signal passes `whole` + j periods after the start.
        const auto teeth = static_cast<long>(rms.size());
        const long by = ((static_cast<long>(whole) % teeth) + teeth) % teeth;
        std::rotate(map.rms.begin(), map.rms.end() - by, map.rms.end());
    }
    return map;
}

// Reason why the value is one of rounding, of the record, of its change or of the baseline.
std::string why_rounding(const Feature& feature, const features::FeatureInput& input,
                         const MeasuredSignal& signal, const MeasuredBaseline* baseline,
                         const std::optional<MeasuredChange>& change) {
    const auto of = [&](const features::FeatureInput& input_of, double rounding, const char* what) {
        const std::string why = rounding_reason(feature, input_of, rounding);
        return why.empty() ? why : what + why;
    };
    switch (feature.baseline_use) {
        case features::BaselineUse::change:
            return of(*input.change, change->signal.sensor_rounding, "of the change, ");
        case features::BaselineUse::baseline: {
            const std::string present = of(input, signal.sensor_rounding, "");
            return present.empty()
                       ? of(*input.baseline, baseline->signal.sensor_rounding, "of the baseline, ")
                       : present;
        }
        case features::BaselineUse::nothing:
        case features::BaselineUse::record_and_change:
            break;
    }
    return of(input, signal.sensor_rounding, "");
}

// Computes the features in Python. The inputs of a recording are not known: they are nominal.
void measure_in_python(const MeasurementPlan& plan, std::span<const Feature* const> available,
                       const features::FeatureInput& input, std::vector<MeasuredFeature>& all) {
    PythonFeatures python(plan.record, plan.features, available);
    if (python.empty()) {
        return;
    }
    python.add(1.0, plan.nominal, input);
    const std::vector<double> values = python.compute("a recording");
    auto next = values.begin();
    for (MeasuredFeature& measured : all) {
        if (measured.missing.empty() && measured.feature->external) {
            measured.value = *next++;
            if (!std::isfinite(measured.value)) {
                measured.missing = "its function in Python returns no finite number";
            }
        }
    }
    for (const PythonProblem& problem : python.problems()) {
        std::ranges::find(all, problem.feature, [](const MeasuredFeature& measured) {
            return measured.feature->name;
        })->missing = fmt::format("{}: {}", problem.line, problem.what);
    }
}

}  // namespace

double ToothMap::worst() const {
    return rms.empty() ? kNan
                       : first + static_cast<double>(std::max_element(rms.begin(), rms.end()) -
                                                     rms.begin());
}

std::optional<MeasuredBaseline> measured_baseline(const SignalSource& source,
                                                  const SignalColumns& columns,
                                                  const MeasurementPlan& plan) {
    if (source.empty()) {
        return std::nullopt;
    }
    return MeasuredBaseline{source.name, read_measured_signal(source, columns, plan), false};
}

std::vector<const Feature*> measurable(const FeaturePlan& plan, bool with_baseline) {
    std::vector<const Feature*> all;
    for (const Feature& feature :
         with_baseline ? features::all_features() : features::record_features()) {
        all.push_back(&feature);
    }
    for (const PythonFeature& function : plan.python) {
        if (with_baseline || function.feature->baseline_use == features::BaselineUse::nothing) {
            all.push_back(function.feature);
        }
    }
    return all;
}

Measurement measure(const MeasurementPlan& plan, const MeasuredSignal& signal,
                    const HealthyReference& healthy, const MeasuredBaseline* baseline) {
    Measurement measurement;
    const bool has_reference = !healthy.residual_variance.empty();
    std::string no_change;
    if (baseline != nullptr) {
        try {
            measurement.change = measured_change(plan.record, signal, *baseline);
        } catch (const SignalError& error) {
            no_change = error.what();
        }
    }
    std::vector<MeasuredFeature>& all = measurement.features;
    std::vector<const Feature*> available;
    for (const Feature* feature : measurable(plan.features, baseline != nullptr)) {
        const bool of_change = feature->baseline_use == features::BaselineUse::change ||
                               feature->baseline_use == features::BaselineUse::record_and_change;
        std::string why = why_unavailable(*feature, plan, signal, has_reference);
        if (why.empty() && of_change) {
            why = measurement.change
                      ? why_unavailable(*feature, plan, measurement.change->signal, true)
                      : no_change;
        } else if (why.empty() && feature->baseline_use == features::BaselineUse::baseline) {
            why = why_unavailable(*feature, plan, baseline->signal, has_reference);
            why = why.empty() ? why : baseline->file + ": " + why;
        }
        all.push_back({feature, 0.0, why});
        if (why.empty()) {
            available.push_back(feature);
        }
    }
    const ComparedNeeds needs = compared_needs(available);
    MeasuredInput present(plan, needs.record), earlier(plan, needs.baseline),
        changed(plan, needs.change);
    features::FeatureInput input = present.of(signal), before, change;
    if (baseline != nullptr) {
        before = earlier.of(baseline->signal);
        input.baseline = &before;
    }
    if (measurement.change) {
        change = changed.of(measurement.change->signal);
        input.change = &change;
    }
    if (has_reference) {
        input.get<features::HealthyRecords>() = before.get<features::HealthyRecords>() =
            healthy.at(0);
    }
    measure_in_python(plan, available, input, all);
    for (MeasuredFeature& measured : all) {
        if (measured.missing.empty() && !measured.feature->external) {
            measured.value = measured.feature->value(input);
            if (!std::isfinite(measured.value)) {
                measured.missing = why_no_value(*measured.feature, input, plan.record);
            } else {
                measured.missing =
                    why_rounding(*measured.feature, input, signal, baseline, measurement.change);
            }
        }
    }
    const features::FeatureInput& shown = measurement.change ? change : input;
    const double per_mesh = plan.record.samples;
    measurement.map = tooth_map(shown.get<PlanetRms>().rms,
                                (measurement.change ? changed : present).tooth_offset() / per_mesh,
                                measurement.change ? measurement.change->meshes : 0.0);
    const std::pair<const char*, std::span<const double>> gears[] = {
        {"planet", shown.get<PlanetRms>().rms},
        {"sun", shown.get<features::ToothRms<Member::sun>>().rms},
        {"ring", shown.get<features::ToothRms<Member::ring>>().rms}};
    for (const auto& [gear, rms] : gears) {
        if (!rms.empty()) {
            measurement.teeth.push_back(worst_tooth(gear, rms));
        }
    }
    return measurement;
}

std::vector<double> measured_values(const MeasurementPlan& plan, const MeasuredSignal& signal,
                                    std::span<const Feature* const> requested) {
    features::SignalSet needs;
    std::vector<char> available;
    for (const Feature* feature : requested) {
        available.push_back(why_unavailable(*feature, plan, signal, false).empty() ? 1 : 0);
        needs |= available.back() != 0 ? feature->needs : features::SignalSet();
    }
    MeasuredInput measured(plan, needs);
    const features::FeatureInput input = measured.of(signal);
    std::vector<double> values;
    for (std::size_t f = 0; f < requested.size(); ++f) {
        values.push_back(available[f] != 0 ? requested[f]->compute(input) : kNan);
    }
    return values;
}

HealthyReference measured_reference(const std::vector<SignalSource>& recordings,
                                    const SignalColumns& columns, const MeasurementPlan& plan,
                                    int turns, std::vector<std::string>& notes) {
    HealthyRecordsMean mean(1);
    for (const SignalSource& recording : recordings) {
        const MeasuredSignal signal = read_measured_signal(recording, columns, plan);
        add_notes(signal, recording.name, notes);
        if (signal.planet_turns(plan.record.span) < std::max(1, turns)) {
            throw SignalError(fmt::format(
                "{}: {} mesh periods of sensor signal, but a healthy record must have at least {}, "
                "as many planet turns as the signal",
                recording.name, signal.sensor_meshes,
                std::max(1, turns) * plan.record.span.planet_teeth));
        }
        MeasuredInput input(plan, features::SignalSet::of<features::SensorTurn>());
        mean.add(0, input.of(signal));
    }
    return mean.mean();
}

void add_notes(const MeasuredSignal& signal, const std::string& name,
               std::vector<std::string>& notes) {
    for (const std::string& note : signal.notes) {
        notes.push_back(fmt::format("{}: {}", name, note));
    }
}

}  // namespace gearpod::mc
