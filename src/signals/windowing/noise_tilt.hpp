// Noise drawn towards what is rare: importance sampling of sensor noise by exponential tilting.
//
// An alarm of the window features is a loud stretch of the folded signal, a miss a quiet one. The
// energy of a stretch of n bins, over sigma^2, is noncentral chi-square with n Z_r degrees of
// freedom and lambda = sum F / sigma^2 (sensor_noise.hpp). Its exponential tilt exp(k q / 2) leaves
// bins independent and (Z, G) of the same kind: with x = 1 / (1 - k)
//
//     Z' = (x - 1) sqrt F / sigma + sqrt x Z,    G' = x G,
//
// and k is such that the energy's mean is at a chosen level u. Records of several levels, from
// untilted ones on, and of all stretches that may be the loudest count together, each with
//
//     weight = 1 / (sum over kinds of its share times its density over the untilted one)
//
// (the balance heuristic: E. Veach, L. J. Guibas, SIGGRAPH 95, 419-428), so that means of weighted
// records are those of plain ones. Stretches are drawn as often as the bound exp(K(k) - k u / 2) of
// their exceeding u says, K the logarithm of the moment generating function: A. B. Owen, Y.
// Maximov, M. Chertkov, Electron. J. Stat. 13 (2019), 231-254. A weight is at most 1 over the share
// of untilted records.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "signals/noise/sensor_noise.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

class NoiseTilt {
  public:
    // Which records become frequent: those with a stretch louder than all are without noise, or
    // those whose loudest stretch is quiet.
    enum class Towards { loud, quiet };

    // Standard deviations by which a kind of record is tilted. Kinds are 0, untilted, and 1 to
    // kStrengths.size(); all have the same share of the records.
    static constexpr std::array kStrengths{2.0, 3.5, 5.0};
    static constexpr std::size_t kKinds = kStrengths.size() + 1;

    // Stretches are as long as a window of windowing.hpp with this taper, eight begin in every mesh
    // period. Throws std::invalid_argument as Windowing does.
    NoiseTilt(const SpanLayout& layout, int phases, double taper);

    // A gearbox's folded squares (Z_p P bins, (m/s^2)^2) and the noise levels, rms in m/s^2, whose
    // windows are looked at; without one above 0 nothing is tilted. Throws std::invalid_argument
    // if the bins disagree in number.
    void load(std::span<const double> folded, std::span<const double> sigmas, Towards towards);

    // An untilted draw becomes one of a kind; `pick`, uniform in [0, 1), says which level and
    // stretch.
    void tilt(std::size_t kind, double pick, NoiseDraw& draw) const;
    // Of a draw, whatever its kind.
    double weight(const NoiseDraw& draw) const;

  private:
    // Stretch c tilted to energy u.
    struct Stretch {
        double tilt = 0.0;    // k / 2
        double growth = 1.0;  // x
        double share = 0.0;   // of the records of its kind and level
    };
    struct Level {
        double sigma = 0.0;
        std::array<double, kStrengths.size()> energy{};  // u
        std::array<double, kStrengths.size()> bounds{};  // sum of exp(K - k u / 2)
        std::array<std::vector<Stretch>, kStrengths.size()> stretches;
    };

    Level make_level(double sigma, Towards towards) const;
    // Sums of every stretch of values on the circle of bins.
    std::vector<double> stretch_sums(std::span<const double> bins) const;

    std::size_t bins_;
    double degrees_;  // of freedom of a stretch
    std::size_t length_ = 1;
    std::vector<std::size_t> starts_;
    std::vector<double> root_;     // sqrt F
    std::vector<double> squares_;  // sum of F by stretch
    std::vector<Level> levels_;
};

}  // namespace gearpod::signals
