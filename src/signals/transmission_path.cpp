#include "signals/transmission_path.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {

PathGrid::PathGrid(const PathWindow& window, int planets, int phases, const SpanLayout& layout)
    : planets_(planets), phases_(phases), positions_(layout.carrier_meshes) {
    if (planets < 1 || phases < 1 || positions_ < 1) {
        throw std::invalid_argument(
            "path grid: planets, phases and meshes per carrier turn must be positive");
    }
    // Carrier and planet angles in whole steps of 1/(N M_c P) turn, so that the wrap is exact.
    const long mesh = static_cast<long>(planets_) * phases_;
    const long turn = mesh * positions_;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(turn);
    const bool turns = positions_ > 1;
    for (int p = 0; p < phases_; ++p) {
        for (int c = 0; c < positions_; ++c) {
            const long carrier = turns ? (static_cast<long>(c) * phases_ + p) * planets_ : 0;
            sine_.push_back(std::sin(step * static_cast<double>(carrier)));
            cosine_.push_back(std::cos(step * static_cast<double>(carrier)));
            for (int n = 0; n < planets_; ++n) {
                const long planet = (carrier + turn / planets_ * n) % turn;
                window_.push_back(window.weight(step * static_cast<double>(planet)));
            }
        }
        for (int n = 0; n < planets_; ++n) {
            const long at_zero =
                (turns ? static_cast<long>(p) * planets_ : 0) + turn / planets_ * n;
            const long half = positions_ / 2;
            const double odd = positions_ % 2 == 1 ? 0.5 : 0.0;
            fraction_.push_back(static_cast<double>(at_zero % mesh) / static_cast<double>(mesh) -
                                odd);
            const long centre = half - at_zero / mesh;
            centre_.push_back(static_cast<int>((centre + positions_) % positions_));
        }
    }
}

}  // namespace gearpod::signals
