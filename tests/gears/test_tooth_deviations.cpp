// Checks tolerances of ISO 1328, and the rate at which random gears meet them.
#include "gears/tooth_deviations.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_tooth_deviations {

constexpr double kAngle = 20 * std::numbers::pi / 180;

// Random gears from other random numbers than those used to determine the scales.
class RandomGears {
  public:
    WaveNumbers waves() {
        WaveNumbers numbers;
        for (double* list : {numbers.centre, numbers.cosine, numbers.sine}) {
            std::generate_n(list, list == numbers.centre ? 2 : 3, [&] { return normal(); });
        }
        return numbers;
    }
    double normal() { return normal_(engine_); }

  private:
    std::mt19937 engine_{20261122};
    std::normal_distribution<double> normal_;
};

TEST_CASE("The formulas reproduce the standard's tables at the means of its ranges") {
    // Diameters of 50 to 125 mm, modules of 2 to 3.5 mm, in um. Sources: ISO 1328-1:1995, Tables 1
    // to 3 and ISO 1328-2:1997, Table B.1, rounded to 0.5 um below 10 and to 1 um above.
    const double m = std::sqrt(2.0 * 3.5) * 1e-3, d = std::sqrt(50.0 * 125.0) * 1e-3;
    const auto rounded = [](double value_m) {
        const double um = 1e6 * value_m;
        return um < 10.0 ? std::round(2.0 * um) / 2.0 : std::round(um);
    };
    const ToothTolerances five = tooth_tolerances(m, d, 5.0);
    CHECK(rounded(five.single_pitch) == 6.0);
    CHECK(rounded(five.cumulative_pitch) == 19.0);
    CHECK(rounded(five.profile) == 8.0);
    CHECK(rounded(five.runout) == 15.0);
    const ToothTolerances seven = tooth_tolerances(m, d, 7.0);
    CHECK(seven.single_pitch == Approx(2.0 * five.single_pitch));
    CHECK(rounded(seven.cumulative_pitch) == 38.0);
}

TEST_CASE(
    "An eccentric gear has a runout of twice its eccentricity, and deviations that vary over the "
    "turn") {
    constexpr int kTeeth = 360;
    DeviationScales scales;
    scales.eccentricity = 10e-6;
    WaveNumbers numbers;
    numbers.centre[0] = std::numbers::sqrt2;  // so that the eccentricity equals the scale
    const auto along = wave_deviations(kTeeth, kAngle, scales, numbers, 1);
    const auto against = wave_deviations(kTeeth, kAngle, scales, numbers, -1);
    const ToothTolerances found = measured_deviations(kAngle, along.index_m, against.index_m);
    CHECK(found.runout == Approx(20e-6).epsilon(1e-3));
    CHECK(found.cumulative_pitch == Approx(20e-6 / std::cos(kAngle)).epsilon(1e-3));
    for (int t = 1; t + 1 < kTeeth; ++t) {
        const auto at = static_cast<std::size_t>(t);
        const double slope = 0.5 * (along.index_m[at + 1] - along.index_m[at - 1]);
        CHECK(along.drift_m[at] == Approx(slope).margin(1e-10));
    }
}

TEST_CASE("Waves rotate the teeth about the axis: a probe on both flanks does not detect them") {
    constexpr int kTeeth = 400;
    DeviationScales scales;
    scales.waves = 5e-6;
    RandomGears random;
    double squares = 0.0;
    constexpr int kGears = 400;
    for (int g = 0; g < kGears; ++g) {
        const WaveNumbers numbers = random.waves();
        const auto along = wave_deviations(kTeeth, kAngle, scales, numbers, 1);
        const auto against = wave_deviations(kTeeth, kAngle, scales, numbers, -1);
        const ToothTolerances found = measured_deviations(kAngle, along.index_m, against.index_m);
        CHECK(found.runout < 1e-9 * found.cumulative_pitch);
        for (const double index : along.index_m) {
            squares += index * index / (kGears * kTeeth);
        }
    }
    CHECK(std::sqrt(squares) == Approx(5e-6).epsilon(0.1));
}

TEST_CASE("Nine gears in ten meet each tolerance of their grade") {
    struct Case {
        double module_mm;
        int teeth;
        double grade;
    };
    for (const Case& c :
         {Case{3.175, 19, 5.0}, Case{3.175, 31, 6.0}, Case{3.175, 81, 6.0}, Case{1.0, 20, 4.0},
          Case{1.0, 100, 8.0}, Case{8.0, 150, 7.0}, Case{0.5, 60, 3.0}, Case{16.0, 25, 10.0}}) {
        const double m = 1e-3 * c.module_mm;
        const ToothTolerances allowed = tooth_tolerances(m, c.teeth * m, c.grade);
        const DeviationScales scales =
            scaled(scales_of(tooth_tolerances(m, c.teeth * m, 5.0), c.teeth, kAngle),
                   std::pow(2.0, 0.5 * (c.grade - 5.0)));
        RandomGears random;
        constexpr int kGears = 3000;
        int single = 0, cumulative = 0, runout = 0, profile = 0;
        for (int g = 0; g < kGears; ++g) {
            const WaveNumbers numbers = random.waves();
            std::vector<double> sides[2];
            for (const int s : {0, 1}) {
                sides[s] =
                    wave_deviations(c.teeth, kAngle, scales, numbers, s == 0 ? 1 : -1).index_m;
                for (double& index : sides[s]) {
                    index += scales.pitch * random.normal();
                }
            }
            double slope = 0.0;
            const double common = scales.common_slope * random.normal();
            for (int t = 0; t < c.teeth; ++t) {
                slope = std::max(slope, std::abs(common + scales.slope * random.normal()));
            }
            const ToothTolerances found = measured_deviations(kAngle, sides[0], sides[1]);
            single += found.single_pitch <= allowed.single_pitch ? 1 : 0;
            cumulative += found.cumulative_pitch <= allowed.cumulative_pitch ? 1 : 0;
            runout += found.runout <= allowed.runout ? 1 : 0;
            profile += slope <= allowed.profile ? 1 : 0;
        }
        INFO("module " << c.module_mm << " mm, " << c.teeth << " teeth, grade " << c.grade);
        for (const int kept : {single, cumulative, runout, profile}) {
            CHECK(static_cast<double>(kept) / kGears == Approx(kFractionWithin).margin(0.03));
        }
    }
}

}  // namespace gearpod::gears::test_tooth_deviations
