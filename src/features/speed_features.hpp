// Features of the speed error: kurtosis, largest tooth window, and the fault's order.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"
#include "signals/spectra/order_spectrum.hpp"

namespace gearpod::features {

// Kurtosis, normal = 3, of the speed error: signals/spectra/order_spectrum.hpp. At constant mean
// speed it is the jitter of the instantaneous angular speed that encoders show: Y. Li et al., Mech.
// Syst. Signal Process. 19 (2005) 786-805. A tooth fault changes the speed where the load passes to
// and from the tooth; the derivative weights these short changes more than te_features.hpp. NaN for
// a constant transmission error.
inline double te_speed_kurtosis(const TeParts& te) {
    return standardised_moment(signals::speed_error(te.turn), 4);
}

// Largest over median RMS of the speed error (signals/spectra/order_spectrum.hpp) in windows of one
// mesh period, one from every sample of the averaged turn on. It localises the change of speed at a
// faulty tooth: X. Song et al., Modern Mech. Eng. 14 (2024) 39-50. 1 for regular meshing. NaN if
// the median is zero.
inline double te_speed_window_ratio(const TeParts& te) {
    const std::vector<double> speed = signals::speed_error(te.turn);
    const std::size_t per_mesh = speed.size() / static_cast<std::size_t>(te.mesh_order);
    std::vector<double> rms;
    for (std::size_t first = 0; first < speed.size(); ++first) {
        double squares = 0.0;
        for (std::size_t i = 0; i < per_mesh; ++i) {
            const double value = speed[(first + i) % speed.size()];
            squares += value * value;
        }
        rms.push_back(std::sqrt(squares / static_cast<double>(per_mesh)));
    }
    const double largest = *std::ranges::max_element(rms);
    const double middle = median(std::move(rms));
    return middle > 0.0 ? largest / middle : kNan;
}

// Lines of the fault order in the instantaneous angular speed of the encoders, relative to the
// strongest mesh line:
//
//     sum over h of h s(h) / max over j of j Z_p s(j Z_p),   h = 1 to H,   j Z_p below the Nyquist
//     order,
//
// with the amplitudes s of the averaged transmission error, H = 5, or the largest order below
// Z_p / 2 if that is less. An amplitude s at order k is a speed error of amplitude k s. A faulty
// tooth changes the speed once per turn, so that the fault order is 1: Chinese J. Mech. Eng. 32
// (2019), doi:10.1186/s10033-019-0324-z, for the difference of two encoders; X. Song et al., Modern
// Mech. Eng. 14 (2024) 39-50, for planets and averages over their turns.
//
// The average over turns has the multiples of the fault order only. There are no neighbouring lines
// to compare with. The first mesh line may vanish because of the phases of the planets, hence the
// strongest one. NaN for a constant transmission error.
inline double te_speed_fault_order(const TeParts& te) {
    constexpr std::size_t kFaultHarmonics = 5;
    const auto teeth = static_cast<std::size_t>(te.mesh_order);
    double lines = 0.0, mesh = 0.0;
    for (std::size_t h = 1; h <= kFaultHarmonics && 2 * h < teeth; ++h) {
        lines += static_cast<double>(h) * te.amplitude[h];
    }
    for (std::size_t k = teeth; 2 * k < te.turn.size(); k += teeth) {
        mesh = std::max(mesh, static_cast<double>(k) * te.amplitude[k]);
    }
    return lines / mesh;
}

}  // namespace gearpod::features
