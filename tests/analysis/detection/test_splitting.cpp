// Checks rates of rare values by multilevel splitting where the rates are known: gearboxes with
// independent normal inputs whose sum is the value.
#include <boost/math/distributions/normal.hpp>

#include "analysis/detection/splitting.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_splitting {

constexpr int kInputs = 20;
const boost::math::normal kNormal;

std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9;
    word = (word ^ (word >> 27)) * 0x94d049bb133111eb;
    return word ^ (word >> 31);
}

struct Gearboxes {
    std::uint64_t seed = 1;
    double sign = 1.0;

    double uniform(std::uint64_t index, int of) const {
        const std::uint64_t word = mixed(mixed(mixed(seed) + index) + static_cast<unsigned>(of));
        return (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
    }
    double normal(std::uint64_t index, int draw) const {
        return std::sqrt(-2.0 * std::log(uniform(index, 3 * draw))) *
               std::cos(2.0 * std::numbers::pi * uniform(index, 3 * draw + 1));
    }
    // Input after an exchange step: every second input is mixed in part, the others are exchanged
    // as a whole or kept.
    double exchanged(double own, const InputExchange& with, int draw) const {
        if (draw % 2 == 0) {
            const double kept = 1.0 - with.share;
            return kept * own + std::sqrt(1.0 - kept * kept) * normal(with.index, draw);
        }
        return uniform(with.index, 3 * draw + 2) < with.share ? normal(with.index, draw) : own;
    }
    // Sum of the inputs, scaled to the standard normal law.
    double value(const SplitMember& member) const {
        double sum = 0.0;
        for (int draw = 0; draw < kInputs; ++draw) {
            double number = normal(member.index, draw);
            for (const InputExchange& with : member.exchanged) {
                number = exchanged(number, with, draw);
            }
            sum += number;
        }
        return sign * sum / std::sqrt(kInputs);
    }
    SplitValues values() const {
        return [*this](std::span<const SplitMember> members) {
            return test::mapped(members, [&](const SplitMember& member) { return value(member); });
        };
    }
    SplitTail::Settings settings(long members) const {
        return {members, sign > 0.0 ? Alarm::high : Alarm::low};
    }
};

double truth_of(double rate) {
    return quantile(complement(kNormal, rate));
}
double rate_beyond(double value) {
    return cdf(complement(kNormal, value));
}

TEST_CASE("Splitting finds the values whose rates go down to 1e-6") {
    for (const double sign : {1.0, -1.0}) {
        const Gearboxes gearboxes{3, sign};
        for (const double rate : {1e-1, 1e-3, 1e-4, 1e-6}) {
            const auto settings = gearboxes.settings(3000);
            const SplitTail tail = SplitTail::to_rate(settings, rate, gearboxes.values());
            CHECK(tail.computed() == SplitTail::values_for(settings, rate));
            const auto found = tail.threshold(rate, 0.95);
            REQUIRE(found);
            INFO(rate << ": " << sign * found->threshold << ", in truth " << truth_of(rate));
            CHECK(sign * found->threshold == Approx(truth_of(rate)).margin(0.15));
            CHECK(found->expected <= rate * (1.0 + 1e-9));
            CHECK(found->rate.lower < rate_beyond(sign * found->threshold));
            CHECK(found->rate.upper > rate_beyond(sign * found->threshold));
            const Interval bounds = tail.threshold_interval(rate, *found);
            CHECK(bounds.lower < sign * truth_of(rate));
            CHECK(bounds.upper > sign * truth_of(rate));
        }
    }
}

TEST_CASE("Splitting finds the rate at which a value is exceeded") {
    const Gearboxes gearboxes;
    for (const double rate : {0.4, 2e-2, 1e-4}) {
        const SplitTail tail =
            SplitTail::to_value(gearboxes.settings(1000), truth_of(rate), 1e-8, gearboxes.values());
        const auto found = tail.at(truth_of(rate), 0.95);
        REQUIRE(found);
        INFO(rate << ": " << found->expected);
        CHECK(found->threshold == truth_of(rate));
        CHECK(found->rate.lower < rate);
        CHECK(found->rate.upper > rate);
        CHECK(std::sqrt(found->variance) < 0.3);
    }
    // The error of a plain sample is binomial.
    const SplitTail plain =
        SplitTail::to_value(gearboxes.settings(1000), truth_of(0.4), 1e-8, gearboxes.values());
    CHECK(plain.levels() == 1);
    const auto found = plain.at(truth_of(0.4), 0.95);
    CHECK(found->variance == Approx((1.0 - found->expected) / (found->expected * 999.0)));
    // A value that no gearbox reaches ends at the rarest requested level.
    const SplitTail never =
        SplitTail::to_value(gearboxes.settings(100), 50.0, 1e-5, gearboxes.values());
    CHECK(never.last_rate() < 1e-5);
    CHECK_FALSE(never.at(50.0, 0.95));
}

TEST_CASE("Splitting refuses values that few families reach and values that are all equal") {
    const Gearboxes gearboxes;
    const SplitTail few = SplitTail::to_rate(gearboxes.settings(12), 1e-6, gearboxes.values());
    CHECK_FALSE(few.threshold(1e-6, 0.95));
    const auto same = [](std::span<const SplitMember> members) {
        return std::vector<double>(members.size(), 2.0);
    };
    const SplitTail constant = SplitTail::to_rate({100, Alarm::high}, 1e-4, same);
    CHECK(constant.levels() == 1);
    CHECK_FALSE(constant.threshold(1e-4, 0.95));
}

TEST_CASE("Gearboxes without a value raise no alarm in a split sample") {
    const Gearboxes gearboxes;
    // Nine in ten gearboxes have no value: a rate of 1e-3 is a rate of 1e-2 of the others.
    const auto values = [&](std::span<const SplitMember> members) {
        std::vector<double> all = gearboxes.values()(members);
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = gearboxes.uniform(members[i].index, 999) < 0.9 ? kNan : all[i];
        }
        return all;
    };
    const SplitTail tail = SplitTail::to_rate({4000, Alarm::high}, 1e-3, values);
    const auto found = tail.threshold(1e-3, 0.95);
    REQUIRE(found);
    CHECK(found->rate.lower < 0.1 * rate_beyond(found->threshold));
    CHECK(found->rate.upper > 0.1 * rate_beyond(found->threshold));
}

TEST_CASE("Interval coverage of rates by splitting", "[.rare-coverage][splitting-rates]") {
    constexpr int kStudies = 500;
    struct Case {
        long members;
        double rate;
    };
    for (const Case& one : {Case{400, 1e-3}, Case{500, 1e-4}, Case{1000, 1e-6}}) {
        int covered = 0, refused = 0;
        double squares = 0.0;
        long computed = 0;
        for (int study = 0; study < kStudies; ++study) {
            const Gearboxes gearboxes{static_cast<std::uint64_t>(1000 + study)};
            const SplitTail tail =
                SplitTail::to_rate(gearboxes.settings(one.members), one.rate, gearboxes.values());
            const auto found = tail.threshold(one.rate, 0.95);
            computed = tail.computed();
            if (!found) {
                ++refused;
                continue;
            }
            const double truth = rate_beyond(found->threshold);
            covered += found->rate.lower <= truth && truth <= found->rate.upper ? 1 : 0;
            squares += std::pow(std::log(truth / found->expected), 2);
        }
        const int known = kStudies - refused;
        const double share = static_cast<double>(covered) / known;
        WARN("1 in " << 1.0 / one.rate << " from " << one.members << " a level: " << 100.0 * share
                     << " % of " << known << " hold it, scatter of its logarithm "
                     << std::sqrt(squares / known) << ", counting takes "
                     << known / squares / one.rate / static_cast<double>(computed)
                     << " times as many");
        CHECK(known > kStudies / 4);
        CHECK(share > 0.93);
        CHECK(share < 0.99);
    }
}

}  // namespace gearpod::analysis::test_splitting
