// FRMS, root mean square of the filtered signal, after Lei, Kong, Lin and Zuo, Meas. Sci. Technol.
// 23 (2012) 055605: what is left of a planetary gearbox's signal without its regular lines. Those
// are the mesh harmonics and the sidebands that the carrier's turning gives them, all at whole
// multiples of the carrier's frequency, so the filter takes away the average over the carrier's
// turns. Lines that sun and planet teeth make are at other orders; a tooth of a held ring hides
// among the regular ones.
#include "features/feature.hpp"

namespace gearpod::features {

double frms(const FeatureInput& input) {
    return input.filtered_rms;
}

}  // namespace gearpod::features
