// Checks that real gear sets give the same study from a REXS model as from options.
#include <fmt/format.h>

#include <fstream>

#include "mc/study/new/planetary.hpp"
#include "mc/study/new/rexs_study.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study/new/gear_sets.hpp"
#include "tests/mc/study/new/rexs_example.hpp"

namespace test_rexs_gear_sets {

using namespace gearpod;

namespace {

// Model with the values that a datasheet gives. The ring's teeth and helix have a negative sign, as
// some programs write them.
std::string model_of(const mc::PlanetaryDatasheet& data) {
    test::RexsExample m;
    m.add(1, "planetary_stage");
    for (const int shaft : {50, 51, 52, 60}) {
        m.add(shaft, "shaft");
    }
    m.relate("planet_carrier_shaft", {{"planetary_stage", 1}, {"shaft", 52}});
    const auto number = [](double value) { return fmt::format("{}", value); };
    const auto gear = [&](int id, const char* type, int shaft, int teeth, double sign,
                          const std::optional<double>& shift, const std::optional<double>& tip_mm) {
        m.add(id, type);
        m.set(id, "number_of_teeth", "none", number(sign * teeth));
        m.set(id, "normal_module", "mm", number(data.module_mm));
        m.set(id, "normal_pressure_angle", "deg", number(data.pressure_angle_deg));
        m.set(id, "helix_angle_reference_diameter", "deg", number(sign * data.helix_deg));
        m.relate("assembly", {{"assembly", shaft}, {"part", id}});
        if (shift) {
            m.set(id, "addendum_modification_coefficient", "none", number(*shift));
        }
        if (data.face_width_mm) {
            m.set(id, "face_width", "mm", number(*data.face_width_mm));
        }
        if (tip_mm) {
            m.set(id, "tip_diameter", "mm", number(*tip_mm));
        }
    };
    gear(10, "cylindrical_gear", 50, data.sun, 1, data.sun_shift, data.sun_tip_mm);
    gear(11, "ring_gear", 51, data.ring.value_or(0), -1, data.ring_shift, data.ring_tip_mm);
    for (int i = 1; i <= data.planets; ++i) {
        const int planet = 100 + i;
        gear(planet, "cylindrical_gear", 60, data.planet, 1, data.planet_shift, data.planet_tip_mm);
        for (const auto& [pair, first, second] :
             {std::tuple{200 + i, 10, planet}, std::tuple{300 + i, planet, 11}}) {
            m.add(pair, "cylindrical_stage");
            if (data.centre_distance_mm) {
                m.set(pair, "center_distance", "mm", number(*data.centre_distance_mm));
            }
            m.relate("assembly", {{"assembly", 1}, {"part", pair}});
            m.relate("stage", {{"stage", pair}, {"gear_1", first}, {"gear_2", second}});
        }
    }
    return m.text();
}

// Helicopters, three wind turbines (spur and helical) and five rigs.
std::vector<test::GearSet> some_sets() {
    constexpr std::ptrdiff_t kTurbines = 3, kRigs = 5;
    std::vector<test::GearSet> sets = test::helicopters();
    const auto turbines = test::wind_turbines(), rigs = test::test_rigs();
    sets.insert(sets.end(), turbines.begin(), turbines.begin() + kTurbines);
    sets.insert(sets.end(), rigs.begin(), rigs.begin() + kRigs);
    return sets;
}

// Text after the first comment.
std::string body(const std::string& text) {
    const std::size_t at = text.find("\ntitle = ");
    return at == std::string::npos ? "" : text.substr(at);
}

}  // namespace

TEST_CASE("Real gear sets have the same study from a REXS model as from options") {
    for (const test::GearSet& set : some_sets()) {
        INFO(set.name);
        const test::Folder folder;
        const std::string file = folder.file("model.rexs");
        std::ofstream(file) << model_of(set.data);
        mc::RexsChoices choices;
        choices.input = set.data.input;
        choices.power_kW = set.data.power_kW;
        choices.speed_rpm = set.data.speed_rpm;
        choices.torque_N_m = set.data.torque_N_m;
        const mc::NewStudy by_options = new_planetary(set.data, "new"),
                           by_model = new_from_rexs(file, choices, "new");
        INFO(format(by_model.problems));
        REQUIRE(!by_options.text.empty());
        CHECK(body(by_model.text) == body(by_options.text));
    }
}

}  // namespace test_rexs_gear_sets
