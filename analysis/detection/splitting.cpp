#include "analysis/detection/splitting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/statistics/distributions.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kPart = 4;  // one of kPart members is continued
constexpr int kExchanges = 2;     // successive exchanges per member
constexpr double kNever = -std::numeric_limits<double>::infinity();

// Share of the next exchange, adapted in steps towards an acceptance rate of 44 %.
double next_share(double share, double kept) {
    constexpr double kTargetAcceptance = 0.44, kStep = 1.4, kLeast = 0.005;
    return std::clamp(share * std::clamp(kept / kTargetAcceptance, 1.0 / kStep, kStep), kLeast,
                      1.0);
}

}  // namespace

SplitTail SplitTail::to_rate(const Settings& settings, double rate, const SplitValues& values) {
    return until(settings, values, [&](const Level& level) {
        return level.rate <= rate * static_cast<double>(kPart);
    });
}

SplitTail SplitTail::to_value(const Settings& settings, double value, double rarest,
                              const SplitValues& values) {
    const double limit = alarm_sign(settings.alarm) * value;
    return until(settings, values, [&](const Level& level) {
        return level.rate < rarest || level.falling[level.falling.size() / kPart].value > limit;
    });
}

long SplitTail::values_for(const Settings& settings, double rate) {
    long levels = 0;
    for (double of_level = 1.0; of_level > rate * static_cast<double>(kPart); ++levels) {
        of_level /= static_cast<double>(kPart);
    }
    return settings.members * (1 + kExchanges * levels);
}

SplitTail SplitTail::until(const Settings& settings, const SplitValues& of,
                           const std::function<bool(const Level&)>& last) {
    SplitTail tail(settings);
    const auto count = static_cast<std::size_t>(settings.members);
    for (std::size_t i = 0; i < count; ++i) {
        tail.members_.push_back({i, {}});
    }
    std::vector<double> values = tail.signed_values(of, tail.members_);
    for (double rate = 1.0;;) {
        tail.add_level(rate, values);
        const Level& level = tail.levels_.back();
        // Members equal to the limit are not beyond it.
        const double limit = level.falling[count / kPart].value;
        const auto beyond = std::ranges::count_if(values, [&](double v) { return v > limit; });
        if (last(level) || beyond == 0) {
            return tail;
        }
        rate *= static_cast<double>(beyond) / static_cast<double>(count);
        values = tail.split(limit, values, of);
    }
}

void SplitTail::add_level(double rate, const std::vector<double>& values) {
    Level level{rate, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
        level.falling.push_back({values[i], members_[i].index});
    }
    std::ranges::stable_sort(level.falling, std::greater<>(), &LevelMember::value);
    levels_.push_back(std::move(level));
}

std::vector<double> SplitTail::signed_values(const SplitValues& of,
                                             std::span<const SplitMember> members) {
    std::vector<double> values = of(members);
    for (double& value : values) {
        value = std::isfinite(value) ? alarm_sign(settings_.alarm) * value : kNever;
    }
    computed_ += static_cast<long>(members.size());
    return values;
}

std::vector<double> SplitTail::split(double limit, const std::vector<double>& values,
                                     const SplitValues& of) {
    std::vector<std::size_t> parents;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] > limit) {
            parents.push_back(i);
        }
    }
    std::vector<SplitMember> members;
    std::vector<double> found_values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t parent = parents[i * parents.size() / values.size()];
        members.push_back(members_[parent]);
        found_values.push_back(values[parent]);
    }
    std::size_t all_kept = 0;
    for (int exchange = 0; exchange < kExchanges; ++exchange) {
        std::vector<SplitMember> tried = members;
        // Every value uses a gearbox that takes part in no other exchange.
        for (std::size_t i = 0; i < tried.size(); ++i) {
            tried[i].exchanged.push_back({static_cast<std::uint64_t>(computed_) + i, share_});
        }
        const std::vector<double> found = signed_values(of, tried);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < tried.size(); ++i) {
            if (found[i] > limit) {
                members[i] = std::move(tried[i]);
                found_values[i] = found[i];
                ++kept;
            }
        }
        share_ = next_share(share_,
                            static_cast<double>(kept) / static_cast<double>(found_values.size()));
        all_kept += kept;
    }
    least_kept_ = std::min(least_kept_, static_cast<double>(all_kept) /
                                            static_cast<double>(kExchanges * found_values.size()));
    members_ = std::move(members);
    return found_values;
}

double SplitTail::squared_shares(std::span<const LevelMember> members) {
    std::map<std::uint64_t, double> shares;
    for (const LevelMember& member : members) {
        shares[member.family] += 1.0 / static_cast<double>(members.size());
    }
    double squares = 0.0;
    for (const auto& [family, share] : shares) {
        squares += share * share;
    }
    return squares;
}

SplitTail::Beyond SplitTail::beyond_rate(double rate) const {
    std::size_t level = levels_.size() - 1;
    while (level > 0 && levels_[level].rate < rate) {
        --level;
    }
    const std::vector<LevelMember>& falling = levels_[level].falling;
    const auto all = static_cast<double>(falling.size());
    auto count = static_cast<std::size_t>(rate / levels_[level].rate * all * (1.0 + 1e-12));
    count = std::min(count, falling.size() - 1);
    // Members equal to the threshold do not alarm.
    while (count > 0 && falling[count - 1].value == falling[count].value) {
        --count;
    }
    return {level, count};
}

double SplitTail::value_before(const Beyond& beyond) const {
    return levels_[beyond.level].falling[beyond.count].value;
}

double SplitTail::last_families() const {
    return 1.0 / squared_shares(levels_.back().falling);
}

std::optional<SplitTail::Estimate> SplitTail::estimate(const Beyond& beyond, double threshold,
                                                       double confidence) const {
    const Level& level = levels_[beyond.level];
    const double squares = squared_shares(std::span(level.falling).first(beyond.count));
    if (!(squares > 0.0) || 1.0 / squares < kLeastFamilies) {
        return std::nullopt;
    }
    const auto members = static_cast<double>(level.falling.size());
    Estimate found;
    found.threshold = threshold;
    found.expected = level.rate * static_cast<double>(beyond.count) / members;
    found.families = 1.0 / squares;
    found.variance = std::max(
        0.0, 1.0 - std::pow(members / (members - 1.0), static_cast<double>(beyond.level + 1)) *
                       (1.0 - squares));
    // The mean of the estimate is the rate, so the mean of its logarithm is lower by half the
    // variance.
    const double variance = std::log1p(found.variance);
    const double middle = found.expected * std::exp(0.5 * variance);
    const double factor =
        std::exp(student_quantile(0.5 * (found.families - 1.0), 0.5 * (1.0 + confidence)) *
                 std::sqrt(variance));
    found.rate = {middle / factor, std::min(1.0, middle * factor)};
    return found;
}

std::optional<SplitTail::Estimate> SplitTail::threshold(double rate, double confidence) const {
    const Beyond beyond = beyond_rate(rate);
    const double value = value_before(beyond);
    return std::isfinite(value) ? estimate(beyond, alarm_sign(settings_.alarm) * value, confidence)
                                : std::nullopt;
}

std::optional<SplitTail::Estimate> SplitTail::at(double threshold, double confidence) const {
    const double limit = alarm_sign(settings_.alarm) * threshold;
    // If all members of a level lie beyond the value, an earlier level determines the rate.
    for (std::size_t level = levels_.size(); level-- > 0;) {
        const std::vector<LevelMember>& falling = levels_[level].falling;
        const auto count = static_cast<std::size_t>(
            std::ranges::count_if(falling, [&](const LevelMember& p) { return p.value > limit; }));
        if (count < falling.size() || level == 0) {
            return estimate({level, count}, threshold, confidence);
        }
    }
    return std::nullopt;
}

Interval SplitTail::threshold_interval(double rate, const Estimate& estimate) const {
    const double sign = alarm_sign(settings_.alarm);
    const auto value_at = [&](double estimated) {
        return sign * value_before(beyond_rate(std::min(1.0, estimated)));
    };
    const double near = value_at(rate * estimate.expected / estimate.rate.lower);
    const double far = value_at(rate * estimate.expected / estimate.rate.upper);
    return {std::min(near, far), std::max(near, far)};
}

}  // namespace gearpod::analysis
