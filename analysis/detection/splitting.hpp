// Multilevel splitting (subset simulation): rare false-alarm rates from gearboxes that exchange
// random inputs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Replaces a share s of the random inputs by those of another gearbox. A normal number becomes (1 -
// s) own + sqrt(1 - (1 - s)^2) other; an input that is not built from normal numbers is replaced
// with probability s. Both keep the distribution of the inputs and are reversible.
struct InputExchange {
    std::uint64_t index = 0;  // number of the other gearbox
    double share = 0.0;
};

// Probability of rare values caused by rare gearboxes rather than by noise: multilevel splitting
// (H. Kahn, T. E. Harris 1951; F. Cerou, A. Guyader, Stoch. Anal. Appl. 25 (2007), 417-443), also
// known as subset simulation. The quarter of a sample nearest to an alarm is continued: each member
// is copied four times, and each copy exchanges a share of its random inputs for those of another
// gearbox. An exchange is accepted if the value stays beyond the quarter's limit. This preserves
// the distribution of gearboxes beyond the limit, so the rate of each level is a product of the
// levels' fractions. The share exchanged adapts to the last acceptance rate (I. Papaioannou et al.,
// Probab. Eng. Mech. 41 (2015), 89-103): small exchanges are accepted more often, large ones move
// further.
//
// Members descended from the same initial member, a family, are not independent. The variance of a
// rate follows from its division among families (A. Lee, N. Whiteley, Biometrika 105 (2018),
// 609-625). Its interval is lognormal, widened for few families by Student's t. There is no
// estimate from fewer than kLeastFamilies families.

inline constexpr double kLeastFamilies = 5.0;

// Gearbox with its own random inputs and the exchanges applied to them, in this order.
struct SplitMember {
    std::uint64_t index = 0;  // also the number of its family
    std::vector<InputExchange> exchanged;
};
// Computes the value of every member. A value that is not finite raises no alarm.
using SplitValues = std::function<std::vector<double>(std::span<const SplitMember>)>;

class SplitTail {
  public:
    struct Settings {
        long members = 0;  // per level; at least 8
        Alarm alarm = Alarm::high;
    };
    // Adds levels until at least a quarter of the last level's members corresponds to the rate.
    static SplitTail to_rate(const Settings& settings, double rate, const SplitValues& values);
    // Adds levels until at least a quarter of the last level's members lies beyond the value, or
    // the rate of a level is below `rarest`.
    static SplitTail to_value(const Settings& settings, double value, double rarest,
                              const SplitValues& values);
    // Upper bound on the number of values that to_rate() computes for a rate.
    static long values_for(const Settings& settings, double rate);

    struct Estimate {
        double threshold = 0.0;
        double expected = 0.0;  // estimated rate beyond the threshold
        Interval rate;          // interval of that rate
        // Effective number of families beyond it, (sum n)^2 / sum n^2 over their members.
        double families = 0.0;
        double variance = 0.0;  // relative variance of `expected`
    };
    // Value with the largest estimated rate that does not exceed `rate`. Empty if too few families
    // reach it.
    std::optional<Estimate> threshold(double rate, double confidence) const;
    // Estimate at a given threshold. Empty if too few families reach it.
    std::optional<Estimate> at(double threshold, double confidence) const;
    // Interval of the value whose rate is exactly `rate`; `estimate` is the result of threshold().
    Interval threshold_interval(double rate, const Estimate& estimate) const;

    std::size_t levels() const { return levels_.size(); }
    long computed() const { return computed_; }  // number of values
    // Last level: rate of the gearboxes that its members represent, effective number of families
    // (members with the same ancestor), and the members themselves.
    double last_rate() const { return levels_.back().rate; }
    double last_families() const;
    std::span<const SplitMember> last() const { return members_; }
    // Smallest acceptance rate of a level's exchanges; 1 without any.
    double least_kept() const { return least_kept_; }

  private:
    static constexpr double kFirstShare = 0.1;
    struct LevelMember {
        double value;  // times alarm_sign()
        std::uint64_t family;
    };
    struct Level {
        double rate;                       // probability of gearboxes beyond the level's limit
        std::vector<LevelMember> falling;  // by falling value
    };
    // Number of a level's members beyond a rate or a value.
    struct Beyond {
        std::size_t level, count;
    };

    explicit SplitTail(const Settings& settings) : settings_(settings) {}
    static SplitTail until(const Settings& settings, const SplitValues& values,
                           const std::function<bool(const Level&)>& last);
    void add_level(double rate, const std::vector<double>& values);
    // Creates the next level's members from those of the last level beyond `limit`, and returns
    // their values.
    std::vector<double> split(double limit, const std::vector<double>& values,
                              const SplitValues& of);
    std::vector<double> signed_values(const SplitValues& of, std::span<const SplitMember> members);

    static double squared_shares(std::span<const LevelMember> members);
    Beyond beyond_rate(double rate) const;
    // Threshold exceeded by that many members, times alarm_sign().
    double value_before(const Beyond& beyond) const;
    std::optional<Estimate> estimate(const Beyond& beyond, double threshold,
                                     double confidence) const;

    Settings settings_;
    std::vector<Level> levels_;
    std::vector<SplitMember> members_;  // of the last level
    long computed_ = 0;
    double share_ = kFirstShare;  // share of random inputs in the next exchange
    double least_kept_ = 1.0;
};

}  // namespace gearpod::analysis
