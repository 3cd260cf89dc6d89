// Checks the interpolation of signals between integrated torques and speeds, and how their numbers
// are chosen.
#include "mc/lives/campaign.hpp"
#include "mc/lives/interpolation.hpp"
#include "tests/mc/lives/campaign_in_memory.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_interpolation {

using namespace test;

const std::vector<std::string> kVarying{"life.torque_scatter=0.05", "life.speed_scatter=0.02",
                                        "life.interpolation_tolerance=0.5", "ensemble.instances=8"};

mc::Study varying(std::vector<std::string> more) {
    more.insert(more.begin(), kVarying.begin(), kVarying.end());
    return life_study(more);
}

double interpolated(const mc::LoadAxis& axis, double factor, const auto& function) {
    const std::vector<double> weights = axis.weights(factor);
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i] * function(axis.factors()[i]);
    }
    return sum;
}

mc::InterpolationChoice choice_of(const mc::Study& study) {
    const mc::Scene scene(study);
    return mc::choose_interpolation(scene.tile(), scene.life());
}

TEST_CASE("Leja nodes are nested, and the fourth lies where x (1 - x^2) is largest") {
    CHECK(mc::leja_nodes(3) == std::vector<double>{0.0, 1.0, -1.0});
    const auto five = mc::leja_nodes(5), nine = mc::leja_nodes(9);
    CHECK(five[3] == Approx(1.0 / std::sqrt(3.0)).epsilon(1e-3));
    CHECK(five[4] == -five[3]);
    CHECK(std::equal(five.begin(), five.end(), nine.begin()));
}

TEST_CASE("A polynomial axis reproduces polynomials and continues them as a line") {
    const mc::RecordDistribution law(life_study(), mc::RecordQuantity::speed, 0.02);
    const mc::LoadAxis axis(law, {5});
    REQUIRE(axis.factors().size() == 5);
    CHECK(axis.factors().front() == Approx(std::exp(-0.05)));
    CHECK(axis.factors().back() == Approx(std::exp(0.05)));
    const auto quartic = [](double x) { return 1.0 + x * (2.0 - x * (3.0 - x * (1.0 + x))); };
    for (const double factor : {0.96, 0.99, 1.0, 1.013, 1.05}) {
        CHECK(interpolated(axis, factor, quartic) == Approx(quartic(factor)).epsilon(1e-10));
        const auto weights = axis.weights(factor);
        CHECK(std::accumulate(weights.begin(), weights.end(), 0.0) == Approx(1.0));
    }
    const double end = axis.factors().back();
    const double slope = 2.0 - end * (6.0 - end * (3.0 + 4.0 * end));
    CHECK(interpolated(axis, end + 0.02, quartic) ==
          Approx(quartic(end) + 0.02 * slope).epsilon(1e-9));
    // A resonance of 3 % damping: more nodes converge geometrically.
    const auto resonance = [](double x) { return 1.0 / std::hypot(1.0 - x * x, 2.0 * 0.03 * x); };
    double last = 1e9;
    for (const int nodes : {5, 9, 13, 17}) {
        const mc::LoadAxis finer(law, {nodes});
        double worst = 0.0;
        for (const double check : finer.checks()) {
            worst = std::fmax(worst,
                              std::abs(interpolated(finer, check, resonance) - resonance(check)));
        }
        CHECK(worst < 0.5 * last);
        last = worst;
    }
}

TEST_CASE("Numbers of torques and speeds are raised until the tolerance is kept") {
    const auto choice = choice_of(varying({}));
    CHECK(choice.error <= 0.5);
    // A gearbox that keeps contact is linear in its torque.
    CHECK_FALSE(choice.plan.torques.nodes);
    REQUIRE(choice.plan.speeds.nodes);
    // Where no number keeps the tolerance, that of the least error is taken.
    const auto least = choice_of(varying({"life.interpolation_tolerance=0.001"}));
    CHECK(least.error > 0.001);
    CHECK(least.error <= choice.error);
    CHECK(least.loads >= choice.loads);
    // Numbers that are given stay.
    const auto given =
        choice_of(varying({"life.integrated_torques=3", "life.integrated_speeds=5"}));
    CHECK(given.plan.torques == mc::LoadNumber{3, true});
    CHECK(given.plan.speeds == mc::LoadNumber{5, true});
    CHECK(given.error > 0.0);
    CHECK(choice_of(life_study()).error == 0.0);
    // Without the key, a tenth of the crack's change is accepted.
    const auto by_default =
        choice_of(life_study({"life.speed_scatter=0.005", "ensemble.instances=8"}));
    CHECK(by_default.plan.speeds.nodes > 2);
    CHECK(by_default.error <= 0.1);
}

TEST_CASE(
    "Distinct torques are equally frequent, have the stated scatter and need no interpolation") {
    const mc::RecordDistribution law(life_study(), mc::RecordQuantity::torque, 0.05, 5);
    const std::vector<double> factors = law.distinct_factors();
    REQUIRE(factors.size() == 5);
    CHECK(factors[2] == Approx(1.0));
    // Means of a normal number over its fifths (D. R. Cox, J. Am. Stat. Assoc. 52 (1957), 543-547):
    // 1.400 and 0.532; their variance is 0.897 of the whole.
    CHECK(std::log(factors[4]) == Approx(0.05 * 1.400 / 0.9471).epsilon(2e-3));
    CHECK(std::log(factors[3]) == Approx(0.05 * 0.532 / 0.9471).epsilon(2e-3));
    double square = 0.0;
    for (const double factor : factors) {
        square += std::log(factor) * std::log(factor) / 5.0;
    }
    CHECK(std::sqrt(square) == Approx(0.05).epsilon(1e-12));
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    std::map<double, int> counts;
    for (int i = 0; i < 50000; ++i) {
        ++counts[law.factor(normal(engine))];
    }
    REQUIRE(counts.size() == 5);
    for (const auto& [factor, count] : counts) {
        CHECK(std::ranges::find(factors, factor) != factors.end());
        CHECK(count == Approx(10000).margin(450));  // 5 standard deviations
    }
    const mc::LoadAxis axis(law, {});
    CHECK(axis.factors() == factors);
    for (std::size_t i = 0; i < factors.size(); ++i) {
        std::vector<double> one(factors.size(), 0.0);
        one[i] = 1.0;
        CHECK(axis.weights(factors[i]) == one);
    }
    const std::vector<std::string> distinct{"life.torque_scatter=0.05", "life.distinct_torques=3",
                                            "life.speed_scatter=0.02", "life.distinct_speeds=3",
                                            "ensemble.instances=8"};
    const auto conflict = mc::read_study(study_path("planet-life.toml"),
                                         {"life.distinct_torques=3", "life.integrated_torques=3"});
    REQUIRE(conflict.problems.size() == 1);
    CHECK(conflict.problems[0].key == "life.distinct_torques");
    const mc::Scene scene(life_study(distinct));
    CHECK(mc::choose_interpolation(scene.tile(), scene.life()).error == 0.0);
    CHECK(mc::LifeTiles(scene.tile(), scene.life()).load_count() == 9);
    const mc::Scene alike(life_study({"life.distinct_torques=3"}));
    CHECK(mc::LifeTiles(alike.tile(), alike.life()).load_count() == 1);
    // Each record is the solution at its own load.
    const mc::Campaign campaign = mc::run_campaign(mc::LifeTiles(scene.tile(), scene.life()));
    CHECK(campaign.interpolation.load == 0.0);
}

using Samples = std::vector<double>;

TEST_CASE("Records at random loads are off by no more than stated in 95 % of 200 trials",
          "[.long][interpolation-trials]") {
    const mc::Study study = varying({});
    const mc::Scene scene(study);
    const auto choice = mc::choose_interpolation(scene.tile(), scene.life());
    const auto error_of = [](std::vector<std::string> keys) {
        keys.insert(keys.end(), {"life.integrated_torques=3", "life.integrated_speeds=3"});
        return choice_of(varying(keys)).error;
    };
    CHECK(error_of({"numerics.lanes=1"}) == error_of({}));
    const mc::RecordDistributions laws(study);
    const mc::LoadAxis torques(laws.torque, choice.plan.torques),
        speeds(laws.speed, choice.plan.speeds);
    const mc::LifeTiles tiles(scene.tile(), scene.life());
    std::mt19937_64 engine(46);
    std::normal_distribution<double> normal;
    constexpr std::uint64_t kTiles = 2, kLanes = 8;
    constexpr int kTrials = 13;
    int within = 0, tried = 0;
    for (std::uint64_t tile = 0; tile < kTiles; ++tile) {
        std::vector<mc::Realization> gearboxes;
        for (std::uint64_t lane = 0; lane < kLanes; ++lane) {  // gearboxes that were no pilots
            gearboxes.push_back(tiles.draw({mc::Group::test, 100 + tile * kLanes + lane}));
        }
        const auto signals = [&](double torque, double speed) {
            std::vector<Samples> all;
            const auto solution = tiles.healthy_solution(gearboxes, {torque, speed});
            for (const auto& lane : solution.healthy().lane) {
                all.push_back(lane.sensor);
            }
            return all;
        };
        const mc::HealthySolution own = tiles.healthy_solution(gearboxes, {});
        const auto faulty = own.with_fault(mc::smallest_depth_m(study.life));
        std::vector<double> change = test::tabulated(kLanes, [&](std::size_t lane) {
            return rms_of(difference(faulty.lane[lane].sensor, own.healthy().lane[lane].sensor));
        });
        std::vector<std::vector<Samples>> nodes;
        for (const double torque : torques.factors()) {
            for (const double speed : speeds.factors()) {
                nodes.push_back(signals(torque, speed));
            }
        }
        for (int trial = 0; trial < kTrials; ++trial) {
            const double torque = laws.torque.factor(normal(engine)),
                         speed = laws.speed.factor(normal(engine));
            std::vector<Samples> misses = signals(torque, speed);
            std::size_t node = 0;
            for (const double of_torque : torques.weights(torque)) {
                for (const double of_speed : speeds.weights(speed)) {
                    for (std::size_t lane = 0; lane < kLanes; ++lane) {
                        for (std::size_t i = 0; i < misses[lane].size(); ++i) {
                            misses[lane][i] -= of_torque * of_speed * nodes[node][lane][i];
                        }
                    }
                    ++node;
                }
            }
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                ++tried;
                within += rms_of(misses[lane]) <= choice.error * change[lane] ? 1 : 0;
            }
        }
    }
    INFO(within << " of " << tried);
    CHECK(tried >= 200);
    CHECK(within >= 0.95 * tried);
}

}  // namespace gearpod::test_interpolation
