// How rare values are of which gearboxes make the rare ones, not noise: multilevel splitting
// (H. Kahn, T. E. Harris 1951; F. Cerou, A. Guyader, Stoch. Anal. Appl. 25 (2007), 417-443). Of a
// sample the quarter nearest to an alarm goes on: each member four times, each time with a share of
// its draws exchanged for those of another gearbox, kept where it stays beyond the quarter's limit.
// That leaves gearboxes as they are beyond the limit, so their share beyond the next is a share of
// the first one's, and so on. The share exchanged follows what the last exchange kept
// (I. Papaioannou et al., Probab. Eng. Mech. 41 (2015), 89-103): small ones are kept more often,
// large ones lead further.
//
// Members that come from the same one of the first sample, a family, are not independent. The
// variance of a rate follows from how it is shared among families (A. Lee, N. Whiteley, Biometrika
// 105 (2018), 609-625); its interval is lognormal, wider for few families by Student's t. There is
// none from fewer than kLeastFamilies.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/draw_exchange.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

inline constexpr double kLeastFamilies = 5.0;

// A gearbox of its own draws and those exchanged, in this order.
struct SplitMember {
    std::uint64_t index = 0;  // also its family
    std::vector<DrawExchange> exchanged;
};
// A value of every member; what is not finite raises no alarm.
using SplitValues = std::function<std::vector<double>(std::span<const SplitMember>)>;

class SplitTail {
  public:
    struct Settings {
        long members = 0;  // of a level; at least 8
        Alarm alarm = Alarm::high;
    };
    // Levels until a quarter or more of the last one's members makes up the rate.
    static SplitTail to_rate(const Settings& settings, double rate, const SplitValues& values);
    // Levels until a quarter or more of the last one's members lies beyond the value, or the rate
    // of a level is below `rarest`.
    static SplitTail to_value(const Settings& settings, double value, double rarest,
                              const SplitValues& values);
    // Values that to_rate() and to_value() ask for at most, for a rate.
    static long values_for(const Settings& settings, double rate);

    struct Estimate {
        double threshold = 0.0;
        double expected = 0.0;  // rate beyond it
        Interval rate;          // of the same
        double families = 0.0;  // that make it up, (sum n)^2 / sum n^2 of their members
        double variance = 0.0;  // of `expected`, relative
    };
    // The value with the largest estimated rate that is not above `rate`. Empty where too few
    // families reach it.
    std::optional<Estimate> threshold(double rate, double confidence) const;
    // Of any threshold. Empty likewise.
    std::optional<Estimate> at(double threshold, double confidence) const;
    // Where the value may lie whose rate is exactly `rate`; `estimate` is threshold()'s.
    Interval threshold_interval(double rate, const Estimate& estimate) const;

    std::size_t levels() const { return levels_.size(); }
    long computed() const { return computed_; }  // values
    // The last level: of how many gearboxes its members are typical, how many families they are,
    // and they themselves.
    double last_rate() const { return levels_.back().rate; }
    double last_families() const;
    std::span<const SplitMember> last() const { return members_; }
    // Share of a level's exchanges; 1 without any.
    double least_kept() const { return least_kept_; }

  private:
    static constexpr double kFirstShare = 0.1;
    struct Place {
        double value;  // away from the alarm negated
        std::uint64_t family;
    };
    struct Level {
        double rate;                 // of gearboxes like these
        std::vector<Place> falling;  // by value
    };
    // How many of a level's members lie beyond a rate or a value.
    struct Beyond {
        std::size_t level, count;
    };

    explicit SplitTail(const Settings& settings) : settings_(settings) {}
    static SplitTail until(const Settings& settings, const SplitValues& values,
                           const std::function<bool(const Level&)>& last);
    // Adds the members' values as the next level.
    void add_level(double rate, const std::vector<double>& values);
    // Makes the next level's members and their values out of the last one's beyond `limit`.
    std::vector<double> split(double limit, const std::vector<double>& values,
                              const SplitValues& of);
    std::vector<double> signed_values(const SplitValues& of, std::span<const SplitMember> members);

    static double squared_shares(std::span<const Place> places);
    Beyond beyond_rate(double rate) const;
    // The threshold that so many lie beyond, away from the alarm negated.
    double value_before(const Beyond& beyond) const;
    std::optional<Estimate> estimate(const Beyond& beyond, double threshold,
                                     double confidence) const;

    Settings settings_;
    std::vector<Level> levels_;
    std::vector<SplitMember> members_;  // of the last level
    long computed_ = 0;
    double share_ = kFirstShare;  // of draws, in the next exchange
    double least_kept_ = 1.0;
};

}  // namespace gearpod::analysis
