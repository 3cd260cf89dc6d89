#include <array>

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
};

}  // namespace

std::span<const Feature> all_features() {
    return kFeatures;
}

const Feature* find_feature(std::string_view name) {
    for (const Feature& feature : kFeatures) {
        if (feature.name == name) {
            return &feature;
        }
    }
    return nullptr;
}

}  // namespace gearpod::features
