#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "features/feature.hpp"

namespace gearpod::features {
namespace {

constexpr std::array kFeatures{
    Feature{"te_rms", "rad", AlarmSide::high,
            "rms of the averaged transmission error; Park (2016), Table II", &te_rms},
    Feature{"te_kurtosis", "1", AlarmSide::high,
            "kurtosis of the averaged transmission error, normal = 3; Park (2016), Table II",
            &te_kurtosis},
    Feature{"te_fc", "order", AlarmSide::low,
            "frequency centre of the transmission error, cycles per planet turn; Park, Table II",
            &te_fc},
    Feature{"te_fm0", "1", AlarmSide::high,
            "peak-to-peak over the sum of the mesh harmonics' amplitudes; Park (2016), Table II",
            &te_fm0},
    Feature{"sensor_rms", "m/s^2", AlarmSide::high, "rms of the sensor signal over the span",
            &sensor_rms, true},
    Feature{"window_ratio", "1", AlarmSide::high,
            "largest tooth rms over the median tooth rms; after Liang (2016), Fig. 5.8",
            &window_ratio, true},
    Feature{"window_z", "1", AlarmSide::high,
            "worst tooth's rms against the other teeth, robust standard score", &window_z, true},

    Feature{"te_fm4", "1", AlarmSide::high,
            "kurtosis of the transmission error without mesh harmonics and first sidebands",
            &te_fm4, false, kTeParts},
    Feature{"te_m6a", "1", AlarmSide::high, "sixth standardised moment of the same", &te_m6a, false,
            kTeParts},
    Feature{"te_m8a", "1", AlarmSide::high, "eighth standardised moment of the same", &te_m8a,
            false, kTeParts},

    Feature{"crest_factor", "1", AlarmSide::high,
            "largest magnitude over rms of the sensor signal averaged over planet turns",
            &crest_factor, true, kSensorTurn},
    Feature{"fm4", "1", AlarmSide::high,
            "kurtosis of the difference signal: the average without mesh harmonics and first "
            "sidebands",
            &fm4, true, kSensorTurn},
    Feature{"m6a", "1", AlarmSide::high, "sixth standardised moment of the difference signal", &m6a,
            true, kSensorTurn},
    Feature{"m8a", "1", AlarmSide::high, "eighth standardised moment of the difference signal",
            &m8a, true, kSensorTurn},
    Feature{"na4", "1", AlarmSide::high,
            "fourth moment of the residual signal over the square of healthy gearboxes' variance",
            &na4, true, kSensorTurn | kHealthy},
    Feature{"nb4", "1", AlarmSide::high, "the same of the envelope around the first mesh harmonic",
            &nb4, true, kSensorTurn | kHealthy},
    Feature{"energy_ratio", "1", AlarmSide::high,
            "rms of the difference signal over that of mesh harmonics and first sidebands",
            &energy_ratio, true, kSensorTurn},
    Feature{"sideband_index", "m/s^2", AlarmSide::high,
            "mean amplitude of the first mesh harmonic's first sidebands", &sideband_index, true,
            kSensorTurn},
    Feature{"sideband_level", "1", AlarmSide::high,
            "sum of those amplitudes over the average's rms", &sideband_level, true, kSensorTurn},
    Feature{"frms", "m/s^2", AlarmSide::high,
            "rms of the sensor signal without its average over carrier turns; after Lei (2012)",
            &frms, true, kFiltered},
    Feature{"nsds", "1", AlarmSide::high,
            "how far the average's spectrum stands above healthy gearboxes'; after Lei (2012)",
            &nsds, true, kSensorTurn | kHealthy},

    Feature{"window_kurtosis", "1", AlarmSide::high,
            "largest planet tooth kurtosis over the median one", &window_kurtosis, true,
            kPlanetMoments},
    Feature{"window_crest", "1", AlarmSide::high,
            "largest planet tooth crest factor over the median one", &window_crest, true,
            kPlanetMoments},
    Feature{"window_m8a", "1", AlarmSide::high, "largest planet tooth M8A over the median one",
            &window_m8a, true, kPlanetMoments},

    Feature{"sun_window_ratio", "1", AlarmSide::high, "largest sun tooth rms over the median one",
            &sun_window_ratio, true, kSunRms},
    Feature{"sun_window_z", "1", AlarmSide::high,
            "worst sun tooth's rms against the others, robust standard score", &sun_window_z, true,
            kSunRms},
    Feature{"sun_window_kurtosis", "1", AlarmSide::high,
            "largest sun tooth kurtosis over the median one", &sun_window_kurtosis, true,
            kSunMoments},
    Feature{"sun_window_crest", "1", AlarmSide::high,
            "largest sun tooth crest factor over the median one", &sun_window_crest, true,
            kSunMoments},
    Feature{"sun_window_m8a", "1", AlarmSide::high, "largest sun tooth M8A over the median one",
            &sun_window_m8a, true, kSunMoments},

    Feature{"ring_window_ratio", "1", AlarmSide::high, "largest ring tooth rms over the median one",
            &ring_window_ratio, true, kRingRms},
    Feature{"ring_window_z", "1", AlarmSide::high,
            "worst ring tooth's rms against the others, robust standard score", &ring_window_z,
            true, kRingRms},
    Feature{"ring_window_kurtosis", "1", AlarmSide::high,
            "largest ring tooth kurtosis over the median one", &ring_window_kurtosis, true,
            kRingMoments},
    Feature{"ring_window_crest", "1", AlarmSide::high,
            "largest ring tooth crest factor over the median one", &ring_window_crest, true,
            kRingMoments},
    Feature{"ring_window_m8a", "1", AlarmSide::high, "largest ring tooth M8A over the median one",
            &ring_window_m8a, true, kRingMoments},
};

// Features computed from the change since the baseline record: its energy, and its location on the
// gears.
constexpr std::string_view kChangeFeatures[] = {
    "sensor_rms",   "window_ratio",      "window_z",     "sun_window_ratio",
    "sun_window_z", "ring_window_ratio", "ring_window_z"};

class Catalogue {
  public:
    Catalogue() : all_(kFeatures.begin(), kFeatures.end()) {
        for (const std::string_view name : kChangeFeatures) {
            Feature own = *std::find_if(kFeatures.begin(), kFeatures.end(),
                                        [&](const Feature& f) { return f.name == name; });
            own.name = text("change_", own.name, "");
            own.doc = text("", own.doc, ", of the record less the gearbox's own baseline record");
            own.needs |= kChange;
            own.baseline_use = BaselineUse::change;
            all_.push_back(own);
        }
        for (Feature own : kFeatures) {
            own.name = text("own_", own.name, "");
            own.doc =
                text("", own.name.substr(4), " over that of the gearbox's own baseline record");
            own.unit = "1";
            own.needs |= kBaseline;
            own.baseline_use = BaselineUse::baseline;
            all_.push_back(own);
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

}  // namespace

double Feature::value(const FeatureInput& input) const {
    switch (baseline_use) {
        case BaselineUse::change:
            return compute(*input.change);
        case BaselineUse::baseline:
            return compute(input) / compute(*input.baseline);
        case BaselineUse::nothing:
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
    return nullptr;
}

}  // namespace gearpod::features
