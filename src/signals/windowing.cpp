#include "signals/windowing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "signals/window_energy.hpp"

namespace gearpod::signals {

std::vector<double> tukey_window(int points, double taper) {
    if (points < 2 || !(taper >= 0.0 && taper <= 1.0)) {
        throw std::invalid_argument("Tukey window: needs two points and a taper in [0, 1]");
    }
    std::vector<double> window(points, 1.0);
    const double edge = 0.5 * taper * (points - 1);
    for (int n = 0; n < points; ++n) {
        const double from_end = std::min(n, points - 1 - n);  // the printed window is symmetric
        if (from_end < edge) {
            window[n] = 0.5 * (1.0 + std::cos(std::numbers::pi * (from_end / edge - 1.0)));
        }
    }
    return window;
}

Windowing::Windowing(const SpanLayout& layout, int phases, double taper)
    : layout_(layout), phases_(phases) {
    if (layout.meshes() < 1) {
        throw std::invalid_argument("windowing: the span has no meshes");
    }
    const std::vector<double> window = tukey_window(phases, taper);
    for (const double w : window) {
        weight_squared_.push_back(w * w);
    }
    const auto is_flat = [](double w) { return w == 1.0; };
    flat_first_ =
        static_cast<int>(std::find_if(window.begin(), window.end(), is_flat) - window.begin());
    flat_count_ = static_cast<int>(std::count_if(window.begin(), window.end(), is_flat));
    const std::size_t bins = static_cast<std::size_t>(layout.planet_teeth) * phases;
    extended_.resize(bins + phases - 1);
    scratch_.resize(2 * extended_.size());
    energy_.resize(bins);
}

int Windowing::search(std::span<const double> folded, std::span<double> tooth_rms) {
    if (folded.size() != energy_.size() ||
        tooth_rms.size() != static_cast<std::size_t>(layout_.planet_teeth)) {
        throw std::invalid_argument("windowing: folded squares or teeth disagree in number");
    }
    const auto again = std::copy(folded.begin(), folded.end(), extended_.begin());
    std::copy_n(folded.begin(), phases_ - 1, again);
    double largest = 0.0;
    WindowEnergyArguments a;
    a.bins = static_cast<long>(energy_.size());
    a.phases = phases_;
    a.flat_first = flat_first_;
    a.flat_count = flat_count_;
    a.weight_squared = weight_squared_.data();
    a.extended = extended_.data();
    a.scratch = scratch_.data();
    a.energy = energy_.data();
    a.largest = &largest;
    window_energy(a);

    int offset = phases_ - 1;
    for (std::size_t b = 0; b < energy_.size(); ++b) {
        if (energy_[b] == largest) {
            offset = std::min(offset, static_cast<int>(b % phases_));
        }
    }
    const double samples = static_cast<double>(phases_) * layout_.ring_teeth;
    for (int j = 0; j < layout_.planet_teeth; ++j) {
        const std::size_t first = static_cast<std::size_t>(j) * phases_ + offset;
        tooth_rms[j] = std::sqrt(energy_[first] / samples);
    }
    return offset;
}

}  // namespace gearpod::signals
