// Checks studies/crack-in-*.toml: the windows of the cracked gear detect the crack, those of the
// others hardly do.
#include "tests/mc/study_file.hpp"

namespace gearpod::test_crack_studies {

using namespace test;

// Noise-free value for a 2 mm crack minus the value 1 of equal teeth.
double excess(const std::string& member, const std::string& feature) {
    const auto results =
        run(shipped_study("crack-in-" + member + ".toml",
                          {"fault.depth_mm=2", "sensor.noise_levels=[0]", "ensemble.instances=1",
                           "ensemble.threshold_instances=1"}));
    const auto& values = results.features[feature_index(results, feature)].values;
    return values.at(1) - 1.0;  // row 0 is the healthy gearbox
}

TEST_CASE(
    "The cracked gear's windows respond ten times more to a 2 mm crack than other gears' do") {
    const std::pair<const char*, const char*> gears[] = {
        {"planet", "window_ratio"}, {"sun", "sun_window_ratio"}, {"ring", "ring_window_ratio"}};
    for (const auto& [cracked, own_feature] : gears) {
        const double own = excess(cracked, own_feature);
        INFO(cracked << ": " << own);
        CHECK(own > 0.01);
        for (const auto& [other, feature] : gears) {
            if (std::string(other) != cracked) {
                INFO(feature);
                CHECK(excess(cracked, feature) < 0.1 * own);
            }
        }
    }
}

// A sun with more teeth than the planets needs a longer span than the planets': 31 x 81 meshes.
TEST_CASE("The signal lasts until every sun tooth has met the whole path") {
    const mc::Scene liang(shipped_study("crack-in-sun.toml"));
    CHECK(liang.record().signal_meshes == 31 * 81);
    const mc::Scene big_sun(
        shipped_study("crack-in-sun.toml", {"gearbox.sun.teeth=31", "gearbox.planet.teeth=25"}));
    CHECK(big_sun.record().span.meshes() == 25 * 81);
    CHECK(big_sun.record().signal_meshes == 31 * 81);
    const mc::Scene without(shipped_study(
        "crack-in-sun.toml",
        {"gearbox.sun.teeth=31", "gearbox.planet.teeth=25", "features.use=[\"window_ratio\"]"}));
    CHECK(without.record().signal_meshes == 25 * 81);
}

}  // namespace gearpod::test_crack_studies
