#include "signals/windowing/windowing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "signals/windowing/window_energy.hpp"

namespace gearpod::signals {
namespace {

constexpr std::size_t kPadding = static_cast<std::size_t>(kSegments) * (kOutputsAtOnce - 1);

bool is_flat(double weight) {
    return weight == 1.0;
}

// Ends of the blocks of a mesh period: as few blocks as possible, none longer than `longest`.
std::vector<int> block_ends(int phases, int longest) {
    const int blocks = (phases + longest - 1) / longest;
    const int length = (phases + blocks - 1) / blocks;
    std::vector<int> ends;
    for (int end = length; end < phases; end += length) {
        ends.push_back(end);
    }
    ends.push_back(phases);
    return ends;
}

}  // namespace

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
    const auto index_of = [&](auto found) { return static_cast<int>(found - window.begin()); };
    first_ = index_of(std::ranges::find_if(window, [](double w) { return w != 0.0; }));
    flat_first_ = index_of(std::ranges::find_if(window, is_flat));
    flat_count_ = static_cast<int>(std::ranges::count_if(window, is_flat));

    periods_ = (layout.planet_teeth + kSegments - 1) / kSegments;
    const std::vector<int> ends = block_ends(phases, std::max(flat_count_, 1));
    for (int period = 0; period <= periods_; ++period) {
        for (const int end : ends) {
            block_end_.push_back(static_cast<long>(period) * phases + end);
        }
    }
    for (int bin = 0; bin < 2 * phases; ++bin) {
        end_of_bin_.push_back(static_cast<int>(
            *std::upper_bound(block_end_.begin(), block_end_.end(), static_cast<long>(bin))));
    }

    const std::size_t period = static_cast<std::size_t>(phases) * kSegments;
    const std::size_t extended = period * (static_cast<std::size_t>(periods_) + 1);
    upwards_.resize(extended);
    downwards_.resize(extended);
    for (machine::AlignedVector& bins : bins_) {
        bins.resize(extended + kPadding);
    }
    for (Term& term : terms_) {
        term.energy.resize(extended - period + kPadding);
    }
}

// Segment i begins with tooth i * periods_. The last segments wrap around to the first teeth.
void Windowing::spread(std::span<const double> bins, machine::AlignedVector& spread) const {
    const auto phases = static_cast<std::size_t>(phases_);
    if (bins.size() != static_cast<std::size_t>(layout_.planet_teeth) * phases) {
        throw std::invalid_argument("windowing: bins and layout disagree in number");
    }
    double* out = spread.data();
    for (int period = 0; period <= periods_; ++period) {
        std::array<const double*, kSegments> tooth;
        for (int i = 0; i < kSegments; ++i) {
            tooth[i] = bins.data() + (i * periods_ + period) % layout_.planet_teeth * phases;
        }
        for (std::size_t p = 0; p < phases; ++p, out += kSegments) {
            for (int i = 0; i < kSegments; ++i) {
                out[i] = tooth[i][p];
            }
        }
    }
}

void Windowing::window(const machine::AlignedVector& bins, Term& term) {
    WindowEnergyArguments a;
    a.phases = phases_;
    a.first = first_;
    a.flat_first = flat_first_;
    a.flat_count = flat_count_;
    a.outputs = static_cast<long>(periods_) * phases_;
    a.blocks = static_cast<long>(block_end_.size());
    a.block_end = block_end_.data();
    a.end_of_bin = end_of_bin_.data();
    a.weight_squared = weight_squared_.data();
    a.bins = bins.data();
    a.upwards = upwards_.data();
    a.downwards = downwards_.data();
    a.energy = term.energy.data();
    window_energy(a);
    term.total = total();
}

// Sum of the bins that were windowed last, from the block sums. Every tooth counts once.
double Windowing::total() const {
    double sum = 0.0;
    for (const long end : block_end_) {
        const int period = static_cast<int>((end - 1) / phases_);
        for (int i = 0; i < kSegments && period < periods_; ++i) {
            if (i * periods_ + period < layout_.planet_teeth) {
                sum += upwards_[static_cast<std::size_t>(end - 1) * kSegments + i];
            }
        }
    }
    return sum;
}

void Windowing::load(std::span<const double> folded) {
    spread(folded, bins_[kSignal]);
    window(bins_[kSignal], terms_[kSignal]);
    noisy_ = false;
}

void Windowing::load(std::span<const double> folded, const NoiseVariates& noise) {
    load(folded);
    spread(noise.along, bins_[kCross]);
    spread(noise.across, bins_[kNoise]);
    mix_noise(static_cast<long>(bins_[kSignal].size()), bins_[kSignal].data(), bins_[kCross].data(),
              bins_[kNoise].data());
    window(bins_[kCross], terms_[kCross]);
    window(bins_[kNoise], terms_[kNoise]);
    noisy_ = true;
}

void Windowing::check(double sigma) const {
    if (sigma != 0.0 && !noisy_) {
        throw std::invalid_argument("windowing: there is no noise to add");
    }
}

double Windowing::energy_at_level(double sigma, double signal, double cross, double noise) const {
    return sigma == 0.0 ? signal : noisy_energy(sigma, signal, cross, noise);
}

int Windowing::search(double sigma, std::span<double> tooth_rms) const {
    check(sigma);
    if (tooth_rms.size() != static_cast<std::size_t>(layout_.planet_teeth)) {
        throw std::invalid_argument("windowing: teeth disagree in number");
    }
    const auto& [signal, cross, noise] = terms_;
    alignas(64) double largest[kSegments], phase[kSegments];
    LargestEnergyArguments a;
    a.phases = phases_;
    a.periods = periods_;
    a.sigma = sigma;
    a.signal = signal.energy.data();
    a.cross = cross.energy.data();
    a.noise = noise.energy.data();
    a.largest = largest;
    a.phase = phase;
    largest_energy(a);

    const double most = *std::max_element(largest, largest + kSegments);
    int offset = phases_ - 1;
    for (int i = 0; i < kSegments; ++i) {
        if (largest[i] == most) {
            offset = std::min(offset, static_cast<int>(phase[i]));
        }
    }
    const double samples = static_cast<double>(phases_) * layout_.ring_teeth;
    for (int j = 0; j < layout_.planet_teeth; ++j) {
        const int t = j % periods_ * phases_ + offset;
        const std::size_t index = static_cast<std::size_t>(t) * kSegments + j / periods_;
        tooth_rms[j] = std::sqrt(
            energy_at_level(sigma, signal.energy[index], cross.energy[index], noise.energy[index]) /
            samples);
    }
    return offset;
}

double Windowing::mean_square(double sigma) const {
    check(sigma);
    const auto& [signal, cross, noise] = terms_;
    const double samples = static_cast<double>(phases_) * layout_.planet_teeth * layout_.ring_teeth;
    return energy_at_level(sigma, signal.total, cross.total, noise.total) / samples;
}

}  // namespace gearpod::signals
