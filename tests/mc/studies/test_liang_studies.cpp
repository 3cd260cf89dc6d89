// Checks the shipped studies of Liang's figures (2016) against the statements of their headings.
#include "tests/mc/liang_signals.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_liang_studies {

using namespace gearpod::test;

// Lowest mesh stiffness during the contact of the cracked tooth, at each crack level of a study.
std::vector<double> lowest_stiffness(const mc::Scene& scene, const std::vector<double>& depths_m) {
    const auto& healthy =
        scene.gearbox().pairs().curve(scene.gearbox().fault().pattern().passages[0].pair);
    std::vector<double> lowest;
    for (const double depth : depths_m) {
        const auto cracked = depth > 0 ? scene.gearbox().fault().mesh(0, depth) : nullptr;
        double least = stiffness::total_at(healthy, 0.0);
        for (int i = 0; i < 1000; ++i) {
            const double tau = healthy.contact_ratio() * (i + 0.5) / 1000.0;
            least =
                std::min(least, cracked ? stiffness::total_at(*cracked, healthy.transitions(), tau)
                                        : total_at(healthy, tau));
        }
        lowest.push_back(least);
    }
    return lowest;
}

struct SunMotion {
    std::vector<double> x, y;  // m, over one turn of the sun relative to the planets
    int samples = 0;           // per mesh period
};

SunMotion sun_motion(const mc::Scene& scene, std::uint64_t number = 0) {
    const auto motion = motion_of(scene, number, 19, {6, 7});
    return {motion[0], motion[1], scene.record().samples};
}

// Root mean square of the rate of change over that of the values, a measure of frequency.
double quickness(const std::vector<double>& values) {
    std::vector<double> next = values;
    std::ranges::rotate(next, next.begin() + 1);
    return rms_of(difference(next, values)) / rms_of(values);
}

TEST_CASE(
    "Figs. 3.12, 3.14, 3.16: each crack level lowers the stiffness, a missing tooth leaves 0") {
    const std::map<std::string, std::vector<double>> levels{
        {"published/liang-fig-3-12.toml", {0, 1.95e-3, 3.9e-3, 5.85e-3, 7.8e-3}},
        {"published/liang-fig-3-14.toml", {0, 2.15e-3, 4.28e-3, 6.43e-3, 8.57e-3}},
        {"published/liang-fig-3-16.toml", {0, 2.15e-3, 4.28e-3, 6.43e-3, 8.57e-3}}};
    for (const auto& [name, depths] : levels) {
        INFO(name);
        const mc::Scene scene(shipped_study(name));
        const auto lowest = lowest_stiffness(scene, depths);
        for (std::size_t i = 1; i < lowest.size(); ++i) {
            CHECK(lowest[i] < lowest[i - 1]);
        }
        // Contact ratios are below 2, so a single pair is in contact somewhere.
        CHECK(lowest.back() == 0.0);
        CHECK(lowest[lowest.size() - 2] < 0.7 * lowest.front());
    }
}

TEST_CASE(
    "Cracks of all four levels can be integrated, and have the larger effect the deeper they are") {
    // A planet's crack has its effect on its own tooth; a sun's meets all planet teeth in turn.
    const std::map<std::string, std::string> shown{
        {"published/liang-fig-3-12.toml", "sensor_rms"},
        {"published/liang-fig-3-14.toml", "window_ratio"},
        {"published/liang-fig-3-16.toml", "window_ratio"}};
    for (const auto& [name, feature] : shown) {
        INFO(name);
        const mc::Results results = run(shipped_study(name));
        for (const auto status : results.status) {
            CHECK(status == 0);
        }
        const auto& values = results.features[feature_index(results, feature)].values;
        REQUIRE(values.size() == 6);  // a healthy gearbox for the threshold, then 0 to 100 %
        for (std::size_t i = 2; i < values.size(); ++i) {
            CHECK(values[i] > 1.02 * values[i - 1]);
        }
    }
}

TEST_CASE(
    "Fig. 4.6: a cracked sun tooth displaces the sun as it meets each planet, every 4.75 meshes") {
    const mc::Scene scene(shipped_study("published/liang-fig-4-6.toml"));
    const SunMotion healthy = sun_motion(scene, 0);
    const auto rise = [&](std::uint64_t number) {
        const SunMotion sun = sun_motion(scene, number);
        return test::tabulated(sun.x.size(), [&](std::size_t i) {
            return std::hypot(sun.x[i] - healthy.x[i], sun.y[i] - healthy.y[i]);
        });
    };
    const auto small = rise(1), large = rise(2);
    // The four largest peaks, one in each quarter of the turn, are 4.75 meshes apart.
    std::vector<std::size_t> peaks;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        const auto first = large.begin() + static_cast<std::ptrdiff_t>(quarter * large.size() / 4);
        const auto last = first + static_cast<std::ptrdiff_t>(large.size() / 4);
        peaks.push_back(static_cast<std::size_t>(std::max_element(first, last) - large.begin()));
    }
    for (std::size_t i = 1; i < 4; ++i) {
        CHECK(static_cast<double>(peaks[i] - peaks[i - 1]) / healthy.samples ==
              Approx(4.75).margin(2.0 / healthy.samples));
        CHECK(large[peaks[i]] == Approx(large[peaks[0]]).epsilon(0.01));
    }
    // Thesis: "clearly" visible at 3.90 mm, "very weak" at 0.78 mm.
    const double usual = *std::max_element(healthy.x.begin(), healthy.x.end());
    CHECK(large[peaks[0]] > 2.0 * usual);
    CHECK(*std::max_element(small.begin(), small.end()) < 0.25 * usual);
}

TEST_CASE("Fig. 4.8: inertial terms are negligible at 8.87 rpm, and slow the sun at 950 rpm") {
    const auto sun_y = [](const char* name, bool inertial) {
        mc::Study study = shipped_study(name);
        study.effects.inertial_terms = inertial;
        return sun_motion(mc::Scene(study)).y;
    };
    const auto slow = sun_y("published/liang-fig-4-8-slow.toml", false);
    CHECK(rms_of(difference(sun_y("published/liang-fig-4-8-slow.toml", true), slow)) <
          0.005 * rms_of(slow));
    const auto without = sun_y("published/liang-fig-4-8-fast.toml", false);
    const auto with = sun_y("published/liang-fig-4-8-fast.toml", true);
    CHECK(rms_of(difference(with, without)) > 0.05 * rms_of(without));
    CHECK(quickness(with) < 0.98 * quickness(without));
    // The thesis also finds a smaller value. Here it grows by 4 % at 950 rpm.
    CHECK(rms_of(with) / rms_of(without) == Approx(1.04).margin(0.01));
}

TEST_CASE("Fig. 4.13: sizable sidebands lie at f_main +- k f_scrack +- m f_s, not symmetric") {
    // Band 42 f_m to 44 f_m in lines of f_m / (19 x 81); k up to 4, m up to 2 as in the thesis.
    const int meshes = 19 * 81, carrier = 19, mesh = meshes, crack = 4 * 81, sun = 100;
    const mc::Scene scene(shipped_study("published/liang-fig-4-12.toml"));
    const auto healthy = spectrum(scene, meshes, 0), cracked = spectrum(scene, meshes, 2);
    const double top = *std::max_element(healthy.begin(), healthy.end());

    std::vector<bool> expected(healthy.size(), false);
    for (int n = 1; n < 60; ++n) {
        for (const int sign : {-1, 1}) {
            const int main = n * mesh + sign * carrier * (n % 4 == 0 ? 0 : n % 2 == 1 ? 1 : 2);
            if (healthy[static_cast<std::size_t>(main)] < 1e-3 * top) {
                continue;
            }
            for (int k = -4; k <= 4; ++k) {
                for (int m = -2; m <= 2; ++m) {
                    expected[static_cast<std::size_t>(std::max(main + k * crack + m * sun, 0))] =
                        true;
                }
            }
        }
    }
    const auto first = static_cast<std::size_t>(42 * mesh),
               last = static_cast<std::size_t>(44 * mesh);
    double largest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
        largest = std::max(largest, cracked[i]);
    }
    int sizable = 0, possible = 0;
    for (std::size_t i = first; i <= last; ++i) {
        possible += expected[i] ? 1 : 0;
        if (cracked[i] > 0.05 * largest) {
            ++sizable;
            INFO("line at " << static_cast<double>(i) / mesh << " f_m");
            CHECK(expected[i]);
        }
    }
    CHECK(sizable >= 15);
    // Most of the lines that four planets leave, every fourth, are not sidebands.
    CHECK(possible < 2 * mesh / 4 / 2);
    // The sidebands one f_scrack below and above 43 f_m + f_c differ.
    const auto centre = static_cast<std::size_t>(43 * mesh + carrier);
    CHECK(std::abs(cracked[centre - crack] / cracked[centre + crack] - 1.0) > 0.2);
}

TEST_CASE("Fig. 4.11: the cracked sun tooth causes 17 spikes in a carrier turn, some attenuated") {
    const mc::Scene scene(shipped_study("published/liang-fig-4-12.toml"));
    const auto healthy = sensor_signal(scene, 81, 0), cracked = sensor_signal(scene, 81, 2);
    const auto rise = difference(cracked, healthy);
    // The tooth meets a planet every 19/4 meshes, 17.05 times in 81.
    const double meeting = 19.0 / 4.0 * scene.record().samples;
    std::vector<double> spikes;
    for (int i = 0; i < 17; ++i) {
        const auto first = rise.begin() + static_cast<std::ptrdiff_t>(i * meeting);
        const auto [low, high] =
            std::minmax_element(first, first + static_cast<std::ptrdiff_t>(meeting));
        spikes.push_back(std::max(-*low, *high));
    }
    const auto [least, most] = std::minmax_element(spikes.begin(), spikes.end());
    const double usual = *std::max_element(healthy.begin(), healthy.end());
    CHECK(*least > 0.4 * usual);
    CHECK(*most > 2.0 * usual);
    CHECK(*least < 0.25 * *most);
}

TEST_CASE("Section 2.3: with the carrier or the sun fixed the shipped gearboxes mesh as stated") {
    const mc::Scene carrier(shipped_study("published/liang-fig-2-10.toml"));
    CHECK(carrier.gearbox().mesh_frequency_Hz == Approx(19 * 46.68 / 60));
    const auto still = spectrum(carrier, 2 * 31, 1);
    const double largest = *std::max_element(still.begin(), still.end());
    for (std::size_t i = 1; i < still.size(); i += 2) {
        CHECK(still[i] < kNothing * largest);
    }
    const mc::Scene sun(shipped_study("published/liang-sun-fixed.toml"));
    CHECK(sun.gearbox().mesh_frequency_Hz == Approx(19 * 8.87 / 60));
    CHECK(sun.record().path_meshes() == 19);
    // A cracked planet tooth repeats every 31 meshes, the carrier every 19.
    const auto held = spectrum(sun, 19 * 31, 1);
    const double top = *std::max_element(held.begin(), held.end());
    double sidebands = 0.0;
    for (std::size_t i = 0; i < held.size(); ++i) {
        sidebands = i % 31 == 0 ? sidebands : std::max(sidebands, held[i]);
    }
    CHECK(sidebands > 0.01 * top);
}

}  // namespace gearpod::test_liang_studies
