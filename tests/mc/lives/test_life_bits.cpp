// Checks that a gearbox's life has the same bits in any tile, for every shipped study with lives.
// The lives of several gearboxes with cracks decay at different mesh periods.
#include <fmt/format.h>

#include "mc/lives/life_tile.hpp"
#include "tests/mc/gearbox_bits.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_life_bits {

using namespace test;

std::vector<std::string> studies_with_lives() {
    std::vector<std::string> names = shipped_studies();
    std::erase_if(names, [](const std::string& name) {
        return !shipped_study(name).life.interval_h.has_value();
    });
    return names;
}

// Overrides for lives of few records, depths and loads, at a speed with few steps per mesh.
const std::vector<std::string> kShort{"life.records=12",
                                      "monitoring.baseline_records=4",
                                      "life.healthy_lives=1",
                                      "life.depth_steps=1",
                                      "life.torque_scatter=0",
                                      "life.speed_scatter=0",
                                      "operation.carrier_speed_rpm=300",
                                      "ensemble.threshold_instances=1",
                                      "ensemble.instances=8"};

Bits bits_of(const mc::GearboxLife& life, const mc::InterpolationErrors& errors) {
    Bits bits = gearpod::test::bits_of(std::vector{errors.first, errors.last, errors.load});
    bits.push_back(static_cast<std::uint64_t>(life.status));
    for (const auto& feature : life.values) {
        const Bits own = gearpod::test::bits_of(feature);
        bits.insert(bits.end(), own.begin(), own.end());
    }
    return bits;
}

// Lives of the first gearboxes of a study, in tiles of these lanes.
class TileLives {
  public:
    TileLives(const std::string& name, std::vector<std::string> changes, int lanes)
        : lanes_(static_cast<std::size_t>(lanes)), scene_([&] {
              changes.push_back(fmt::format("numerics.lanes={}", lanes));
              return shipped_study(name, changes);
          }()) {}

    std::vector<Bits> first(std::size_t count) const {
        std::vector<Bits> all;
        for (std::size_t begin = 0; begin < count; begin += lanes_) {
            std::vector<mc::Realization> gearboxes;
            for (std::size_t i = begin; i < std::min(begin + lanes_, count); ++i) {
                gearboxes.push_back(tiles_.draw({mc::Group::test, i}));
            }
            mc::LifeCosts costs;
            std::vector<mc::InterpolationErrors> errors(gearboxes.size());
            const auto lives = tiles_.run(gearboxes, true, costs, errors);
            for (std::size_t g = 0; g < lives.size(); ++g) {
                all.push_back(bits_of(lives[g], errors[g]));
            }
        }
        return all;
    }

  private:
    const std::size_t lanes_;
    const mc::Scene scene_;
    const mc::LifeTiles tiles_{scene_.tile(), scene_.life()};
};

void check(const std::string& name, const std::vector<std::string>& overrides,
           const std::vector<TileFilling>& fillings) {
    INFO(name);
    std::unique_ptr<TileLives> lives;
    check_same_bits(fillings, [&, lanes = 0](const TileFilling& filling) mutable {
        if (filling.lanes != lanes) {
            lanes = filling.lanes;
            lives = std::make_unique<TileLives>(name, overrides, lanes);
        }
        return lives->first(filling.gearboxes);
    });
}

TEST_CASE("Every shipped study gives a gearbox's life the same bits in any tile") {
    const auto names = studies_with_lives();
    REQUIRE(names.size() >= 2);
    for (const std::string& name : names) {
        check(name, kShort, {{8, 3}, {8, 1}});
    }
}

TEST_CASE("Every shipped study gives a gearbox's life the same bits in all tiles",
          "[.equal-bits]") {
    for (const std::string& name : studies_with_lives()) {
        auto two_steps = kShort;
        two_steps.emplace_back("life.depth_steps=2");
        check(name, two_steps,
              {{8, 8},
               {8, 1},
               {8, 2},
               {8, 5},
               {16, 1},
               {16, 2},
               {16, 5},
               {16, 8},
               {4, 1},
               {4, 2},
               {4, 5},
               {4, 8},
               {1, 2}});
    }
}

}  // namespace gearpod::test_life_bits
