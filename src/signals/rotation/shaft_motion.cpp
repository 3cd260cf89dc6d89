#include "signals/rotation/shaft_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace gearpod::signals {
namespace {

constexpr std::size_t kNeighbours = 4;  // on each side of an interval
constexpr double kJumpShare = 0.2, kJumpOfOthers = 3.0, kJumpTiming = 1.5;

// Speeds of the intervals of a motion, and their differences from those of their neighbours.
class IntervalSpeeds {
  public:
    IntervalSpeeds(std::span<const double> sample, std::span<const double> motion)
        : at_(sample), motion_(motion) {
        for (std::size_t k = 0; k + 1 < sample.size(); ++k) {
            speed_.push_back((motion[k + 1] - motion[k]) / (sample[k + 1] - sample[k]));
        }
        usual_ = speed_;
        std::vector<double> off;
        for (std::size_t k = 0; k < speed_.size(); ++k) {
            const std::size_t side = reach(k);
            if (side >= 2) {
                std::array<double, 2 * kNeighbours> near{};
                const auto end = copy_neighbours(k, side, near.begin());
                std::partial_sort(near.begin(),
                                  near.begin() + static_cast<std::ptrdiff_t>(side) + 1, end);
                usual_[k] = 0.5 * (near[side - 1] + near[side]);
                off.push_back(std::abs(speed_[k] - usual_[k]));
            }
        }
        if (off.size() > kFewest) {
            const std::size_t rank = std::max<std::size_t>(3, off.size() / 100);
            const auto at_rank = off.begin() + static_cast<std::ptrdiff_t>(rank);
            std::nth_element(off.begin(), at_rank, off.end(), std::greater<>());
            common_ = *at_rank;
        }
    }

    std::optional<MotionJump> first_jump(double timing, double least) const {
        if (speed_.size() <= kFewest) {
            return std::nullopt;
        }
        for (std::size_t k = 0; k < speed_.size(); ++k) {
            const double length = at_[k + 1] - at_[k], excess = (speed_[k] - usual_[k]) * length;
            if (std::abs(excess) > least && std::abs(excess) > kJumpTiming * timing * usual_[k] &&
                exceeds_others(k) && lasts(k, excess) && !is_count(excess)) {
                return MotionJump{k + 1, excess, usual_[k] * length};
            }
        }
        return std::nullopt;
    }

  private:
    static constexpr std::size_t kFewest = 8;

    std::size_t reach(std::size_t k) const {
        return std::min({kNeighbours, k, speed_.size() - 1 - k});
    }
    template <class Out>
    Out copy_neighbours(std::size_t k, std::size_t side, Out out) const {
        const auto here = speed_.begin() + static_cast<std::ptrdiff_t>(k);
        out = std::copy(here - static_cast<std::ptrdiff_t>(side), here, out);
        return std::copy(here + 1, here + 1 + static_cast<std::ptrdiff_t>(side), out);
    }

    bool exceeds_others(std::size_t k) const {
        const double off = std::abs(speed_[k] - usual_[k]);
        if (off <= kJumpShare * usual_[k] || off <= kJumpOfOthers * common_) {
            return false;
        }
        const std::size_t side = reach(k);
        std::array<double, 2 * kNeighbours> near{};
        const auto end = copy_neighbours(k, side, near.begin());
        std::for_each(near.begin(), end, [&](double& v) { v = std::abs(v - usual_[k]); });
        std::nth_element(near.begin(), near.begin() + 2, end, std::greater<>());
        return off > kJumpOfOthers * near[2];
    }

    // True if the next intervals on both sides do not undo half of the excess.
    bool lasts(std::size_t k, double excess) const {
        double sum = 0.0;
        for (std::size_t j = k - 2; j <= k + 2; ++j) {
            sum += (speed_[j] - usual_[k]) * (at_[j + 1] - at_[j]);
        }
        return sum / excess > 0.5;
    }

    // True if the motion advances by whole multiples of the excess: the count of an encoder, which
    // is added now and then.
    bool is_count(double excess) const {
        if (std::abs(excess - count_) < 0.05 * std::abs(excess)) {
            return true;
        }
        std::size_t whole = 0, similar = 0;
        for (std::size_t k = 0; k < speed_.size(); ++k) {
            const double step = motion_[k + 1] - motion_[k], counts = step / std::abs(excess);
            whole += std::round(counts) >= 1.0 && std::abs(counts - std::round(counts)) < 0.1;
            const double off = (speed_[k] - usual_[k]) * (at_[k + 1] - at_[k]);
            similar += std::abs(off - excess) < 0.1 * std::abs(excess);
        }
        const bool count = similar >= 3 && 20 * whole >= 19 * speed_.size();
        count_ = count ? excess : count_;
        return count;
    }

    std::span<const double> at_, motion_;
    std::vector<double> speed_, usual_;
    double common_ = 0.0;
    mutable double count_ = 0.0;  // excess that was found to be a count
};

// Removes the jumps of 2 pi, and makes the angle rise.
void unwrap(std::vector<double>& angle) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    double turns = 0.0, before = angle.front();
    for (double& value : angle) {
        turns -= std::round((value - before) / kTurn);
        before = value;
        value += turns * kTurn;
    }
    if (angle.back() < angle.front()) {
        for (double& value : angle) {
            value = -value;
        }
    }
}

// Looks for a jump between the samples at which the angle changes. Where an encoder repeats its
// counts, these are known to within a sample.
void find_angle_jump(const std::vector<double>& column, bool counts, double least,
                     ShaftAngle& angle) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    std::vector<double> sample, rad;
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (i > 0 && column[i] > column[i - 1]) {
            sample.push_back(static_cast<double>(i));
            rad.push_back(column[i]);
        }
    }
    const auto jump = motion_jump(sample, rad, counts ? 1.0 : 0.0, least);
    if (!jump) {
        return;
    }
    angle.problem_sample = static_cast<std::size_t>(sample[jump->index]) + 1;
    angle.problem = fmt::format(
        "{} by {:.3g} turn at sample {}: it advances by {:.3g} turn in {:.0f} sample(s), where its "
        "neighbours let expect {:.3g}; no gearbox moves like this; cut the recording there",
        jump->excess > 0.0 ? "jumps ahead" : "falls behind", std::abs(jump->excess) / kTurn,
        angle.problem_sample, (rad[jump->index] - rad[jump->index - 1]) / kTurn,
        sample[jump->index] - sample[jump->index - 1], jump->expected / kTurn);
}

}  // namespace

std::optional<MotionJump> motion_jump(std::span<const double> sample,
                                      std::span<const double> motion, double timing, double least) {
    return IntervalSpeeds(sample, motion).first_jump(timing, least);
}

std::string phase_jump_text(std::span<const double> phase, double least) {
    std::vector<double> samples(phase.size());
    std::iota(samples.begin(), samples.end(), 0.0);
    const auto jump = motion_jump(samples, phase, 0.0, least);
    return jump ? fmt::format("jumps by {:.3g} mesh periods at sample {}; cut the recording there",
                              jump->excess, jump->index + 1)
                : "";
}

Pulses tachometer_pulses(std::span<const double> column, double least) {
    constexpr std::size_t kFewest = 3;
    constexpr double kHysteresis = 0.2;  // relative to the height, on both sides of half the height
    constexpr double kIrregular = 1.5;
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    const double height = *high - *low, half = 0.5 * (*high + *low);
    Pulses pulses;
    bool armed = false;
    double crossing = 0.0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (i > 0 && column[i - 1] < half && column[i] >= half) {
            crossing = static_cast<double>(i) - (column[i] - half) / (column[i] - column[i - 1]);
        }
        if (column[i] < half - kHysteresis * height) {
            armed = true;
        } else if (armed && column[i] > half + kHysteresis * height) {
            armed = false;
            pulses.sample.push_back(crossing);
        }
    }
    if (pulses.sample.size() < kFewest) {
        pulses.problem =
            fmt::format("{} pulse(s), but {} are needed", pulses.sample.size(), kFewest);
        return pulses;
    }
    for (std::size_t i = 2; i < pulses.sample.size(); ++i) {
        const double here = pulses.sample[i] - pulses.sample[i - 1];
        const double before = pulses.sample[i - 1] - pulses.sample[i - 2];
        if (here > kIrregular * before || before > kIrregular * here) {
            pulses.problem = fmt::format(
                "the pulses at samples {:.0f}, {:.0f} and {:.0f} are unevenly spaced: one is "
                "missing or superfluous",
                pulses.sample[i - 2] + 1.0, pulses.sample[i - 1] + 1.0, pulses.sample[i] + 1.0);
            return pulses;
        }
    }
    std::vector<double> counts(pulses.sample.size());
    std::iota(counts.begin(), counts.end(), 0.0);
    if (const auto jump = motion_jump(pulses.sample, counts, 1.0, least)) {
        pulses.problem_sample = static_cast<std::size_t>(pulses.sample[jump->index]) + 1;
        pulses.problem = fmt::format(
            "jumps by {:.3g} of a pulse interval at sample {}: {:.4g} samples after the previous "
            "pulse, where the neighbours let expect {:.4g}; cut the recording there",
            jump->excess, pulses.problem_sample,
            pulses.sample[jump->index] - pulses.sample[jump->index - 1],
            (pulses.sample[jump->index] - pulses.sample[jump->index - 1]) / jump->expected);
    }
    return pulses;
}

PulseCount count_pulses(const std::vector<double>& pulses) {
    const std::size_t n = pulses.size();
    // Pulses per sample at each pulse, from its neighbours.
    std::vector<double> speed(n);
    for (std::size_t p = 0; p < n; ++p) {
        const std::size_t before = p == 0 ? 0 : p - 1, after = std::min(p + 1, n - 1);
        speed[p] = static_cast<double>(after - before) / (pulses[after] - pulses[before]);
    }
    PulseCount out;
    out.first = static_cast<std::size_t>(std::ceil(pulses.front()));
    std::size_t p = 0;
    for (auto sample = static_cast<double>(out.first); sample <= pulses.back(); sample += 1.0) {
        while (p + 2 < n && sample > pulses[p + 1]) {
            ++p;
        }
        const double length = pulses[p + 1] - pulses[p], t = (sample - pulses[p]) / length;
        // Cubic Hermite interpolation between p and p + 1.
        out.count.push_back(static_cast<double>(p) + t * t * (3.0 - 2.0 * t) +
                            length * t * (1.0 - t) * (speed[p] * (1.0 - t) - speed[p + 1] * t));
    }
    return out;
}

ShaftAngle shaft_angle(std::vector<double> column, double least) {
    unwrap(column);
    ShaftAngle angle;
    const auto fall = std::adjacent_find(column.begin(), column.end(), std::greater<>());
    const auto samples = [](auto from, auto to) { return static_cast<std::size_t>(to - from); };
    if (fall != column.end()) {
        angle.problem = fmt::format(
            "turns back by {:.3g} rad from sample {} to the next; cut the "
            "recording there",
            *fall - *(fall + 1), samples(column.begin(), fall) + 1);
        angle.problem_sample = samples(column.begin(), fall) + 1;
        return angle;
    }
    const bool counts = std::adjacent_find(column.begin(), column.end()) != column.end();
    find_angle_jump(column, counts, least, angle);
    if (!angle.problem.empty()) {
        return angle;
    }
    if (!counts) {
        angle.rad = std::move(column);
        return angle;
    }
    // The count changes between two samples: the shaft angle half a sample before the new count is
    // the mean of both counts.
    std::vector<double> sample, half_way;
    for (std::size_t i = 1; i < column.size(); ++i) {
        if (column[i] > column[i - 1]) {
            sample.push_back(static_cast<double>(i) - 0.5);
            half_way.push_back(0.5 * (column[i] + column[i - 1]));
        }
    }
    if (sample.size() < 3) {
        angle.problem = fmt::format("changes at only {} sample(s)", sample.size());
        return angle;
    }
    angle.first = static_cast<std::size_t>(std::ceil(sample.front()));
    std::size_t k = 0;
    for (auto i = static_cast<double>(angle.first); i <= sample.back(); i += 1.0) {
        while (i > sample[k + 1]) {
            ++k;
        }
        angle.rad.push_back(
            std::lerp(half_way[k], half_way[k + 1], (i - sample[k]) / (sample[k + 1] - sample[k])));
    }
    return angle;
}

}  // namespace gearpod::signals
