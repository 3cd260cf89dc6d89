// Checks the summary's order of smallest faults on random results, and its fallback bound.
#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/reliability.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_smallest_fault {

using Engine = std::mt19937_64;

// Faulty gearboxes and groups of their sizes.
struct Sizes {
    std::vector<double> size;
    std::vector<SizeGroup> groups;
};

Sizes sizes(Engine& engine, bool continuous) {
    constexpr int kGroups = 5, kEach = 24;
    std::uniform_real_distribution<double> share;
    Sizes made;
    for (int g = 0; g < kGroups; ++g) {
        made.groups.push_back({continuous ? g + 0.2 : g + 1.0, g + (continuous ? 1.2 : 1.0)});
        for (int i = 0; i < kEach; ++i) {
            const SizeGroup& group = made.groups.back();
            made.size.push_back(group.low + share(engine) * (group.high - group.low));
        }
    }
    return made;
}

// A POD between none and all, steep or flat, with a few undetectable faults.
std::vector<int> outcomes_of(Engine& engine, const std::vector<double>& size) {
    std::uniform_real_distribution<double> share;
    const double middle = 5.0 * share(engine) - 0.5,
                 width = 0.02 + 1.5 * std::pow(share(engine), 3);
    const double ceiling = share(engine) < 0.7 ? 1.0 : 0.8 + 0.2 * share(engine);
    std::vector<int> hit;
    for (const double a : size) {
        const double pod = ceiling / (1.0 + std::exp((middle - a) / width));
        hit.push_back(share(engine) < std::max(0.05, pod) ? 1 : 0);
    }
    return hit;
}

LevelReliability level_of(const Sizes& made, const std::vector<int>& hit, double noise) {
    LevelDetection detection;
    detection.healthy_rate = 0.05;
    const std::vector<std::size_t> group = groups_of(made.size, made.groups);
    for (const SizeGroup& of : made.groups) {
        detection.cells.push_back({of});
    }
    for (std::size_t i = 0; i < hit.size(); ++i) {
        count(detection.cells[group[i]], hit[i], 0.5, Alarm::high);
    }
    LevelReliability level;
    level.noise_level = noise;
    for (DetectionCell& cell : detection.cells) {
        rate(cell, true, 0.95);
        level.pd.push_back(cell.pd);
    }
    level.hit_miss = pod_of_outcomes(made.size, hit, detection, 0.95, 2);
    level.demonstrated_size = demonstrated_size(detection, made.size, hit, 0.9, 0.95);
    return level;
}

// Two features at two noise levels. With `nested`, more noise and the second feature can only lose
// hits.
Reliability made_up(Engine& engine, bool continuous, bool nested) {
    const Sizes made = sizes(engine, continuous);
    std::uniform_real_distribution<double> share;
    std::vector<int> first = outcomes_of(engine, made.size);
    Reliability result;
    for (int f = 0; f < 2; ++f) {
        result.features.push_back({f == 0 ? "first" : "second", Alarm::high, {}});
        std::vector<int> hit = f == 0 ? first : outcomes_of(engine, made.size);
        for (int n = 0; n < 2; ++n) {
            const auto lose = [&](const std::vector<int>& from) {
                const double until = 5.0 * share(engine), some = share(engine);
                hit = from;
                for (std::size_t i = 0; i < hit.size(); ++i) {
                    hit[i] = made.size[i] < until && share(engine) < some ? 0 : hit[i];
                }
            };
            if (nested && (f > 0 || n > 0)) {
                lose(n > 0 ? hit : first);
            } else if (n > 0) {
                hit = outcomes_of(engine, made.size);
            }
            result.features.back().levels.push_back(level_of(made, hit, n + 1.0));
        }
    }
    result.rankings.resize(2);
    for (FeatureRanking& ranking : result.rankings) {
        ranking.ranks.resize(2);
        ranking.ranks[0].name = share(engine) < 0.5 ? "first" : "second";
        ranking.ranks[1].name = ranking.ranks[0].name == "first" ? "second" : "first";
    }
    return result;
}

double size_of(const std::optional<SmallestFault>& fault) {
    return fault ? fault->size : HUGE_VAL;
}

bool no_less(const LevelReliability& a, const LevelReliability& b) {
    return std::equal(a.pd.begin(), a.pd.end(), b.pd.begin(), std::greater_equal<>());
}

TEST_CASE(
    "The smallest fault grows with noise where no rate rises, and no feature ranks below a worse "
    "one") {
    Engine engine(20);
    long pairs = 0, wrong = 0, beaten = 0, curves_wrong = 0;
    // Four thousand results, four per study.
    for (int r = 0; r < 1000; ++r) {
        const Reliability result = made_up(engine, r % 8 == 0, r % 4 != 3);
        // Each bound alone, without support from the others.
        const auto alone = [&](std::size_t f, std::size_t n) {
            Reliability only;
            only.features.push_back({result.features[f].feature, Alarm::high, {}});
            only.features[0].levels.push_back(result.features[f].levels[n]);
            return size_of(smallest_fault(only, 0, 0));
        };
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const auto at = [&](std::size_t k) -> const LevelReliability& {
                    return result.features[k / 2].levels[k % 2];
                };
                if (i == j || !no_less(at(i), at(j))) {
                    continue;
                }
                ++pairs;
                wrong += size_of(smallest_fault(result, i % 2, i / 2)) >
                         size_of(smallest_fault(result, j % 2, j / 2));
                curves_wrong += alone(i / 2, i % 2) > alone(j / 2, j % 2);
                // At the same level the worse of two is not named.
                if (i % 2 == j % 2 && at(i).pd != at(j).pd) {
                    const auto named = smallest_fault(result, i % 2);
                    beaten += named && named->feature == result.features[j / 2].feature;
                }
            }
        }
        const auto quiet = smallest_fault(result, 0), loud = smallest_fault(result, 1);
        if (no_less(result.features[0].levels[0], result.features[0].levels[1]) &&
            no_less(result.features[1].levels[0], result.features[1].levels[1])) {
            wrong += size_of(quiet) > size_of(loud);
        }
    }
    CHECK(pairs > 1200);
    CHECK(wrong == 0);
    CHECK(beaten == 0);
    CHECK(curves_wrong > 40);  // result of each curve alone
}

TEST_CASE("A transferred bound names its origin, a bound of its own names itself") {
    Engine engine(3);
    const Sizes made = sizes(engine, false);
    const std::vector<int> all(made.size.size(), 1);
    std::vector<int> some = all;
    std::fill(some.begin(), some.begin() + 30, 0);
    Reliability result;
    result.features.push_back({"te_fm0", Alarm::high, {}});
    result.features[0].levels = {level_of(made, all, 1.0), level_of(made, some, 3.0)};
    // A curve whose a90 is less than the smallest size demonstrated by tested rates.
    result.features[0].levels[1].hit_miss.refusal.clear();
    result.features[0].levels[1].hit_miss.a90.upper = {SizeEstimate::Where::reached, 0.7};
    result.features[0].levels[1].hit_miss.doubtful = false;
    result.rankings.resize(2);
    const auto quiet = smallest_fault(result, 0), loud = smallest_fault(result, 1);
    REQUIRE(quiet);
    CHECK(quiet->size == 0.7);
    CHECK(!quiet->from_itself);
    CHECK(quiet->source == SmallestFault::Source{"te_fm0", 3.0});
    CHECK(loud->from_itself);
    CHECK(loud->size == 0.7);
}

TEST_CASE("Sizes beyond the misses: 29 in a row, and the confidence holds") {
    CHECK(hits_in_a_row(0.9, 0.95) == 29);  // MIL-HDBK-1823A's 29 of 29
    CHECK(hits_in_a_row(0.9, 0.975) == 36);
    std::vector<double> size;
    std::vector<int> hit;
    for (int i = 1; i <= 60; ++i) {
        size.push_back(i);
        hit.push_back(i == 10 ? 0 : i == 15 ? -1 : 1);
    }
    CHECK(size_beyond_misses(size, hit, 0.9, 0.95) == 40.0);  // 11 to 40 without 15
    hit[31] = 0;
    CHECK(std::isnan(size_beyond_misses(size, hit, 0.9, 0.95)));
    // For POD(a) = 1 - exp(-a), a90 = ln 10. At most 5 % of the bounds are below it.
    Engine engine(8);
    std::uniform_real_distribution<double> share;
    int below = 0, reached = 0;
    constexpr int kStudies = 4000;
    for (int s = 0; s < kStudies; ++s) {
        std::vector<double> drawn;
        std::vector<int> found;
        for (int i = 0; i < 400; ++i) {
            drawn.push_back(8.0 * share(engine));
            found.push_back(share(engine) < 1.0 - std::exp(-drawn.back()) ? 1 : 0);
        }
        const double bound = size_beyond_misses(drawn, found, 0.9, 0.95);
        reached += !std::isnan(bound);
        below += bound < std::log(10.0);
    }
    CHECK(reached > kStudies / 2);
    CHECK(below < 0.05 * kStudies);
}

}  // namespace gearpod::analysis::test_smallest_fault
