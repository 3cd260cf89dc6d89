#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "features/healthy_comparison.hpp"
#include "features/kurtogram_peak.hpp"
#include "features/modulation_indicators.hpp"
#include "features/residual_indicators.hpp"
#include "features/speed_features.hpp"
#include "features/te_features.hpp"
#include "features/tooth_windows.hpp"
#include "features/vibration_statistics.hpp"

namespace gearpod::features {
namespace {

using gears::Member;

// Function of a feature as it is called, and the signals in its parameters.
template <auto kFunction>
struct Signature;
template <class... Signals, double (*kFunction)(const Signals&...)>
struct Signature<kFunction> {
    static constexpr SignalSet kNeeds = SignalSet::of<Signals...>();
    static double compute(const FeatureInput& input) { return kFunction(input.get<Signals>()...); }
};

template <auto kFunction>
constexpr Feature feature(std::string_view name, std::string_view title, std::string_view unit,
                          AlarmSide alarm, std::string_view doc) {
    using Function = Signature<kFunction>;
    constexpr bool kOfTe = Function::kNeeds.within(SignalSet::of<TeTurn, TeParts>());
    return {name, title, unit, alarm, doc, &Function::compute, Function::kNeeds, !kOfTe};
}

constexpr std::array kFeatures{
    feature<te_rms>("te_rms", "rms transmission error", "rad", AlarmSide::high,
                    "rms of the averaged transmission error; Park (2016), Table II"),
    feature<te_kurtosis>(
        "te_kurtosis", "kurtosis of the transmission error", "1", AlarmSide::high,
        "kurtosis of the averaged transmission error, normal = 3; Park (2016), Table II"),
    feature<te_fc>(
        "te_fc", "mean frequency of the transmission error", "order", AlarmSide::low,
        "frequency centre of the transmission error, cycles per planet turn; Park, Table II"),
    feature<te_fm0>(
        "te_fm0", "peak of the transmission error over its mesh harmonics", "1", AlarmSide::high,
        "peak-to-peak over the sum of the mesh harmonics' amplitudes; Park (2016), Table II"),
    feature<sensor_rms>("sensor_rms", "overall vibration level", "m/s^2", AlarmSide::high,
                        "rms of the sensor signal over the span"),
    feature<window_ratio<Member::planet>>(
        "window_ratio", "tooth ratio", "1", AlarmSide::high,
        "largest tooth rms over the median tooth rms; after Liang (2016), Fig. 5.8"),
    feature<window_z<Member::planet>>(
        "window_z", "tooth z-score", "1", AlarmSide::high,
        "worst tooth's rms against the other teeth, robust standard score"),
    feature<te_fm4>(
        "te_fm4", "kurtosis of the irregular part of the transmission error", "1", AlarmSide::high,
        "kurtosis of the transmission error without mesh harmonics and first sidebands"),
    feature<te_m6a>("te_m6a", "sixth moment of the irregular part of the transmission error", "1",
                    AlarmSide::high, "sixth standardised moment of the same"),
    feature<te_m8a>("te_m8a", "eighth moment of the irregular part of the transmission error", "1",
                    AlarmSide::high, "eighth standardised moment of the same"),
    feature<crest_factor>(
        "crest_factor", "crest factor of the averaged vibration", "1", AlarmSide::high,
        "largest magnitude over rms of the sensor signal averaged over planet turns"),
    feature<fm4>("fm4", "kurtosis of the irregular vibration", "1", AlarmSide::high,
                 "kurtosis of the difference signal: the average without mesh harmonics and first "
                 "sidebands"),
    feature<m6a>("m6a", "sixth moment of the irregular vibration", "1", AlarmSide::high,
                 "sixth standardised moment of the difference signal"),
    feature<m8a>("m8a", "eighth moment of the irregular vibration", "1", AlarmSide::high,
                 "eighth standardised moment of the difference signal"),
    feature<na4>(
        "na4", "residual vibration against healthy gearboxes", "1", AlarmSide::high,
        "fourth moment of the residual signal over the square of healthy gearboxes' variance"),
    feature<energy_ratio>(
        "energy_ratio", "irregular over regular vibration", "1", AlarmSide::high,
        "rms of the difference signal over that of mesh harmonics and first sidebands"),
    feature<sideband_index>("sideband_index", "sidebands of the mesh frequency", "m/s^2",
                            AlarmSide::high,
                            "mean amplitude of the first mesh harmonic's first sidebands"),
    feature<sideband_level>("sideband_level",
                            "sidebands of the mesh frequency over the averaged vibration", "1",
                            AlarmSide::high, "sum of those amplitudes over the average's rms"),
    feature<frms>(
        "frms", "vibration without its regular lines", "m/s^2", AlarmSide::high,
        "rms of the sensor signal without its average over carrier turns; after Lei (2012)"),
    feature<window_kurtosis<Member::planet>>(
        "window_kurtosis", "kurtosis at the worst tooth over that at the median tooth", "1",
        AlarmSide::high, "largest planet tooth kurtosis over the median one"),
    feature<window_crest<Member::planet>>(
        "window_crest", "crest factor at the worst tooth over that at the median tooth", "1",
        AlarmSide::high, "largest planet tooth crest factor over the median one"),
    feature<window_m8a<Member::planet>>(
        "window_m8a", "eighth moment at the worst tooth over that at the median tooth", "1",
        AlarmSide::high, "largest planet tooth M8A over the median one"),
    feature<window_ratio<Member::sun>>("sun_window_ratio", "sun tooth ratio", "1", AlarmSide::high,
                                       "largest sun tooth rms over the median one"),
    feature<window_z<Member::sun>>(
        "sun_window_z", "sun tooth z-score", "1", AlarmSide::high,
        "worst sun tooth's rms against the others, robust standard score"),
    feature<window_kurtosis<Member::sun>>(
        "sun_window_kurtosis", "kurtosis at the worst sun tooth over that at the median tooth", "1",
        AlarmSide::high, "largest sun tooth kurtosis over the median one"),
    feature<window_crest<Member::sun>>(
        "sun_window_crest", "crest factor at the worst sun tooth over that at the median tooth",
        "1", AlarmSide::high, "largest sun tooth crest factor over the median one"),
    feature<window_m8a<Member::sun>>(
        "sun_window_m8a", "eighth moment at the worst sun tooth over that at the median tooth", "1",
        AlarmSide::high, "largest sun tooth M8A over the median one"),
    feature<window_ratio<Member::ring>>("ring_window_ratio", "ring tooth ratio", "1",
                                        AlarmSide::high,
                                        "largest ring tooth rms over the median one"),
    feature<window_z<Member::ring>>(
        "ring_window_z", "ring tooth z-score", "1", AlarmSide::high,
        "worst ring tooth's rms against the others, robust standard score"),
    feature<window_kurtosis<Member::ring>>(
        "ring_window_kurtosis", "kurtosis at the worst ring tooth over that at the median tooth",
        "1", AlarmSide::high, "largest ring tooth kurtosis over the median one"),
    feature<window_crest<Member::ring>>(
        "ring_window_crest", "crest factor at the worst ring tooth over that at the median tooth",
        "1", AlarmSide::high, "largest ring tooth crest factor over the median one"),
    feature<window_m8a<Member::ring>>(
        "ring_window_m8a", "eighth moment at the worst ring tooth over that at the median tooth",
        "1", AlarmSide::high, "largest ring tooth M8A over the median one"),
    feature<fm0>("fm0", "peak of the averaged vibration over its mesh harmonics", "1",
                 AlarmSide::high,
                 "peak-to-peak of the average over the sum of its mesh harmonics' amplitudes; "
                 "Stewart (1977)"),
    feature<whitened_window_ratio>(
        "whitened_window_ratio", "tooth ratio after pre-whitening", "1", AlarmSide::high,
        "largest over median tooth rms after cepstral pre-whitening; Borghesani et al. (2013)"),
    feature<te_speed_kurtosis>("te_speed_kurtosis", "kurtosis of the speed error", "1",
                               AlarmSide::high,
                               "kurtosis of the derivative of the averaged transmission error"),
    feature<te_speed_fault_order>(
        "te_speed_fault_order", "lines of the fault order in the speed error", "1", AlarmSide::high,
        "sum of the first five lines of the planet turn over the strongest mesh line, in the "
        "derivative of the averaged transmission error"),
    feature<te_speed_window_ratio>(
        "te_speed_window_ratio", "speed error in the worst mesh period over that in the median one",
        "1", AlarmSide::high,
        "largest over median rms of the speed error in windows of a mesh period"),
    feature<kurtogram_peak>("kurtogram_peak", "largest kurtosis in a band of the vibration", "1",
                            AlarmSide::high,
                            "largest kurtosis of the complex envelope over the bands of the "
                            "kurtogram; Antoni (2007)"),
};

// Features computed from the change since the baseline record: its energy, its location on the
// gears, and how far it concentrates in few samples.
constexpr std::string_view kChangeFeatures[] = {"sensor_rms",    "window_ratio",
                                                "window_z",      "sun_window_ratio",
                                                "sun_window_z",  "ring_window_ratio",
                                                "ring_window_z", "crest_factor",
                                                "fm4",           "m6a"};

// Features of the change that no single record has, and of the record and its change together.
constexpr Feature kurtosis_of_change() {
    Feature change =
        feature<turn_kurtosis>("change_kurtosis", "kurtosis of the change", "1", AlarmSide::high,
                               "kurtosis, normal = 3, of the average of the record less "
                               "the gearbox's own baseline record");
    change.baseline_use = BaselineUse::change;
    return change;
}
constexpr Feature correlation_with_baseline() {
    Feature change = feature<turn_kurtosis>(
        "baseline_correlation", "correlation with the baseline record", "1", AlarmSide::low,
        "correlation coefficient of the averages of the record "
        "and of the gearbox's own baseline record");
    change.baseline_use = BaselineUse::record_and_change;
    change.compute = [](const FeatureInput& input) {
        return baseline_correlation(input.get<SensorTurn>(), input.change->get<SensorTurn>());
    };
    return change;
}

class Catalogue {
  public:
    Catalogue() : all_(kFeatures.begin(), kFeatures.end()) {
        for (const std::string_view name : kChangeFeatures) {
            Feature change = *std::find_if(kFeatures.begin(), kFeatures.end(),
                                           [&](const Feature& f) { return f.name == name; });
            change.name = text("change_", change.name, "");
            change.title = text("", change.title, " of the change");
            change.doc =
                text("", change.doc, ", of the record less the gearbox's own baseline record");
            change.baseline_use = BaselineUse::change;
            all_.push_back(change);
        }
        all_.push_back(kurtosis_of_change());
        all_.push_back(correlation_with_baseline());
        for (Feature ratio : kFeatures) {
            ratio.name = text("own_", ratio.name, "");
            ratio.title = text("", ratio.title, " relative to the baseline");
            ratio.doc =
                text("", ratio.name.substr(4), " over that of the gearbox's own baseline record");
            ratio.unit = "1";
            ratio.baseline_use = BaselineUse::baseline;
            all_.push_back(ratio);
        }
    }
    std::span<const Feature> all() const { return all_; }

  private:
    std::string_view text(std::string_view before, std::string_view of, std::string_view suffix) {
        return texts_.emplace_back(std::string(before).append(of).append(suffix));
    }
    std::deque<std::string> texts_;  // a deque, so that the strings never move
    std::vector<Feature> all_;
};

// External features, in the order of their declarations.
class DeclaredFeatures {
  public:
    const Feature& add(Feature feature) {
        const std::lock_guard lock(mutex_);
        const auto known = std::find(all_.begin(), all_.end(), feature);
        const std::size_t index = static_cast<std::size_t>(known - all_.begin());
        if (known == all_.end()) {
            for (std::string_view* text :
                 {&feature.name, &feature.title, &feature.unit, &feature.doc}) {
                *text = texts_.emplace_back(*text);
            }
            all_.push_back(feature);
        }
        std::erase(order_, index);
        order_.push_back(index);
        return all_[index];
    }
    const Feature* find(std::string_view name) {
        const std::lock_guard lock(mutex_);
        const auto last = std::find_if(order_.rbegin(), order_.rend(),
                                       [&](std::size_t index) { return all_[index].name == name; });
        return last == order_.rend() ? nullptr : &all_[*last];
    }

  private:
    std::mutex mutex_;
    std::deque<std::string> texts_;  // deques, so that the strings and features never move
    std::deque<Feature> all_;
    std::vector<std::size_t> order_;  // the feature declared last is at the end
};

DeclaredFeatures& declared_features() {
    static DeclaredFeatures declared;
    return declared;
}

double mean_of_baselines(const Feature& feature, const FeatureInput& input) {
    double sum = feature.compute(*input.baseline);
    for (int i = 1; i < input.baselines; ++i) {
        sum += feature.compute(input.baseline[i]);
    }
    return sum / input.baselines;
}

}  // namespace

double Feature::value(const FeatureInput& input) const {
    switch (baseline_use) {
        case BaselineUse::change:
            return compute(*input.change);
        case BaselineUse::baseline:
            return compute(input) / mean_of_baselines(*this, input);
        case BaselineUse::nothing:
        case BaselineUse::record_and_change:
            break;
    }
    return compute(input);
}

std::span<const Feature> all_features() {
    static const Catalogue catalogue;
    return catalogue.all();
}

std::span<const Feature> record_features() {
    return kFeatures;
}

const Feature* find_feature(std::string_view name) {
    for (const Feature& feature : all_features()) {
        if (feature.name == name) {
            return &feature;
        }
    }
    return declared_features().find(name);
}

const Feature& declare_feature(const Feature& feature) {
    return declared_features().add(feature);
}

}  // namespace gearpod::features
