// Importance sampling of sensor noise by exponential tilting.
//
// An alarm of the window features is a loud stretch of the folded signal, a missed fault a quiet
// one. The energy of a stretch of n bins, over sigma^2, is noncentral chi-square with n Z_r degrees
// of freedom and lambda = sum F / sigma^2 (sensor_noise.hpp). Tilting by exp(k q / 2) leaves bins
// independent and (Z, G) of the same type. With x = 1 / (1 - k)
//
//     Z' = (x - 1) sqrt F / sigma + sqrt x Z,    G' = x G,
//
// and k is chosen so that the mean of the energy is a given level u. Records of several levels,
// including no tilting, and of all stretches that may be the loudest are pooled. Each record has
//
//     weight = 1 / (sum over kinds of its share times its density over the untilted one)
//
// (the balance heuristic: E. Veach, L. J. Guibas, SIGGRAPH 95, 419-428), so that means of weighted
// records estimate those of plain records. Stretches are chosen with probabilities proportional to
// the bound exp(K(k) - k u / 2) of their exceedance of u, where K is the logarithm of the moment
// generating function: A. B. Owen, Y. Maximov, M. Chertkov, Electron. J. Stat. 13 (2019), 231-254.
// A weight is at most 1 over the share of untilted records.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "signals/noise/sensor_noise.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

class NoiseImportanceSampler {
  public:
    // Rare event that becomes frequent. `loud`: a stretch is louder than all stretches without
    // noise. `quiet`: the loudest stretch is quiet.
    enum class TargetTail { loud, quiet };

    // Shifts of the energy, in standard deviations, of each kind of record. Kind 0 is untilted,
    // kinds 1 to kStrengths.size() are tilted; all have the same share of the records.
    static constexpr std::array kStrengths{2.0, 3.5, 5.0};
    static constexpr std::size_t kKinds = kStrengths.size() + 1;

    // Stretches have the length of a window of windowing.hpp with this taper, and eight begin in
    // every mesh period. Throws std::invalid_argument as Windowing does.
    NoiseImportanceSampler(const SpanLayout& layout, int phases, double taper);

    // Takes a gearbox's folded squares (Z_p P bins, (m/s^2)^2) and the noise levels (rms in m/s^2)
    // at which its windows are evaluated. Nothing is tilted unless a level is above 0. Throws
    // std::invalid_argument if the number of bins disagrees with the layout.
    void load(std::span<const double> folded, std::span<const double> sigmas, TargetTail towards);

    // Turns plain noise into noise of the given kind. `pick`, uniform in [0, 1), selects level
    // and stretch.
    void sample(std::size_t kind, double pick, NoiseVariates& draw) const;
    // Importance weight of noise of any kind.
    double weight(const NoiseVariates& draw) const;

  private:
    // Parameters that raise the expected energy of a stretch to u by exponential tilting.
    struct Stretch {
        double tilting_parameter = 0.0;  // k / 2
        double growth = 1.0;             // x
        double share = 0.0;              // fraction of the records of its kind and level
    };
    struct Level {
        double sigma = 0.0;
        std::array<double, kStrengths.size()> energy{};  // u
        std::array<double, kStrengths.size()> bounds{};  // sum of exp(K - k u / 2)
        std::array<std::vector<Stretch>, kStrengths.size()> stretches;
    };

    Level make_level(double sigma, TargetTail towards) const;
    // Sums of the values over every stretch of the circle of bins.
    std::vector<double> stretch_sums(std::span<const double> bins) const;

    std::size_t bins_;
    double degrees_;  // degrees of freedom of a stretch
    std::size_t length_ = 1;
    std::vector<std::size_t> starts_;
    std::vector<double> root_;     // sqrt F
    std::vector<double> squares_;  // sum of F per stretch
    std::vector<Level> levels_;
};

}  // namespace gearpod::signals
