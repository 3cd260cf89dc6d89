#include "gears/tooth_deviations.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numbers>

namespace gearpod::gears {
namespace {

using std::numbers::pi;

// Normalizes the sum of a wave's harmonics h to rms 1: each is (A cos + B sin) / h with standard
// normal A and B, of mean square 1 / h^2.
const double kWaveNorm = 1.0 / std::sqrt(1.0 + 1.0 / 4.0 + 1.0 / 9.0);

// Quantile kFractionWithin of values; partially sorts them.
double quantile(std::vector<double>& values) {
    const auto rank =
        static_cast<std::ptrdiff_t>(kFractionWithin * static_cast<double>(values.size()));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

// Sines and cosines of all waves at the teeth of a gear, for the flanks on one side.
class FlankWaves {
  public:
    FlankWaves(int teeth, double pressure_angle_rad, int side)
        : side_(side), turn_(2.0 * pi / teeth) {
        const double normal = side * (0.5 * pi - pressure_angle_rad);
        for (int t = 0; t < teeth; ++t) {
            const double angle = turn_ * t;
            Tooth tooth{std::cos(angle + normal), std::sin(angle + normal), {}, {}};
            for (int h = 1; h <= WaveNumbers::kHarmonics; ++h) {
                tooth.cosine[h - 1] = std::cos(h * angle);
                tooth.sine[h - 1] = std::sin(h * angle);
            }
            teeth_.push_back(tooth);
        }
    }

    FlankDeviations deviations(const DeviationScales& scales, const WaveNumbers& numbers) const {
        FlankDeviations flank;
        const double centre = scales.eccentricity / std::numbers::sqrt2;
        const double waves = side_ * scales.waves * kWaveNorm;
        for (const auto& [c, s, cosine, sine] : teeth_) {
            double index = -centre * (numbers.centre[0] * c + numbers.centre[1] * s);
            for (int h = 1; h <= WaveNumbers::kHarmonics; ++h) {
                index +=
                    waves / h *
                    (numbers.cosine[h - 1] * cosine[h - 1] + numbers.sine[h - 1] * sine[h - 1]);
            }
            flank.index_m.push_back(index);
            flank.drift_m.push_back(turn_ * centre *
                                    (numbers.centre[0] * s - numbers.centre[1] * c));
        }
        return flank;
    }

  private:
    struct Tooth {
        double c, s;  // cosine and sine of the angle to the flank's normal
        double cosine[WaveNumbers::kHarmonics], sine[WaveNumbers::kHarmonics];
    };
    int side_;
    double turn_;
    std::vector<Tooth> teeth_;
};

// Random gears of unit scales; weighted sums of their parts are gears of any scales.
class UnitScaleGears {
  public:
    UnitScaleGears(int teeth, double pressure_angle_rad) : angle_(pressure_angle_rad) {
        // Large enough for quantiles accurate to about one percent.
        const int gears = std::max(600, 60000 / teeth);
        boost::random::mt19937_64 engine(1328);
        boost::random::normal_distribution<double> normal;
        DeviationScales centre, waves;
        centre.eccentricity = 1.0;
        waves.waves = 1.0;
        const FlankWaves flanks[] = {{teeth, angle_, 1}, {teeth, angle_, -1}};
        for (int g = 0; g < gears; ++g) {
            WaveNumbers numbers;
            for (double* list : {numbers.centre, numbers.cosine, numbers.sine}) {
                std::generate_n(list, list == numbers.centre ? 2 : WaveNumbers::kHarmonics,
                                [&] { return normal(engine); });
            }
            Gear gear;
            for (const int s : {0, 1}) {
                gear.centre[s] = flanks[s].deviations(centre, numbers).index_m;
                gear.waves[s] = flanks[s].deviations(waves, numbers).index_m;
                for (int t = 0; t < teeth; ++t) {
                    gear.pitch[s].push_back(normal(engine));
                }
            }
            const double common = normal(engine);
            double least = 0.0, most = 0.0;
            for (int t = 0; t < teeth; ++t) {
                const double pitch = normal(engine);
                least = t == 0 ? pitch : std::min(least, pitch);
                most = t == 0 ? pitch : std::max(most, pitch);
            }
            worst_slope_.push_back(
                std::max(std::abs(kCommonSlope * common + kIndividualSlope * least),
                         std::abs(kCommonSlope * common + kIndividualSlope * most)));
            gears_.push_back(std::move(gear));
        }
    }

    static constexpr double kCommonSlope = 2.0 / 3.0, kIndividualSlope = 1.0 / 3.0;

    // Deviations that 90 % of gears with these scales do not exceed.
    ToothTolerances deviation_quantiles(const DeviationScales& scales) const {
        std::vector<double> single, cumulative, runout;
        std::vector<double> sides[2];
        for (const Gear& gear : gears_) {
            for (const int s : {0, 1}) {
                sides[s].resize(gear.pitch[s].size());
                for (std::size_t t = 0; t < sides[s].size(); ++t) {
                    sides[s][t] = scales.eccentricity * gear.centre[s][t] +
                                  scales.waves * gear.waves[s][t] + scales.pitch * gear.pitch[s][t];
                }
            }
            const ToothTolerances found = measured_deviations(angle_, sides[0], sides[1]);
            single.push_back(found.single_pitch);
            cumulative.push_back(found.cumulative_pitch);
            runout.push_back(found.runout);
        }
        return {quantile(single), quantile(cumulative), 0.0, quantile(runout)};
    }
    // Same for slopes with the rms kCommonSlope and kIndividualSlope.
    double slope_quantile() const {
        std::vector<double> worst = worst_slope_;
        return quantile(worst);
    }

  private:
    struct Gear {
        std::vector<double> centre[2], waves[2], pitch[2];  // [side][tooth]
    };
    double angle_;
    std::vector<Gear> gears_;
    std::vector<double> worst_slope_;
};

}  // namespace

ToothTolerances tooth_tolerances(double module_m, double pitch_diameter_m, double grade) {
    const double m = 1e3 * module_m, d = 1e3 * pitch_diameter_m, root = std::sqrt(d);
    const double um = 1e-6 * std::pow(2.0, 0.5 * (grade - 5.0));
    const double cumulative = 0.3 * m + 1.25 * root + 7.0;
    return {um * (0.3 * (m + 0.4 * root) + 4.0), um * cumulative,
            um * (3.2 * std::sqrt(m) + 0.22 * root + 0.7), um * 0.8 * cumulative};
}

DeviationScales combined(const DeviationScales& a, const DeviationScales& b) {
    return {std::hypot(a.eccentricity, b.eccentricity), std::hypot(a.waves, b.waves),
            std::hypot(a.pitch, b.pitch), std::hypot(a.common_slope, b.common_slope),
            std::hypot(a.slope, b.slope)};
}

DeviationScales scaled(const DeviationScales& s, double factor) {
    return {factor * s.eccentricity, factor * s.waves, factor * s.pitch, factor * s.common_slope,
            factor * s.slope};
}

FlankDeviations wave_deviations(int teeth, double pressure_angle_rad, const DeviationScales& scales,
                                const WaveNumbers& numbers, int side) {
    return FlankWaves(teeth, pressure_angle_rad, side).deviations(scales, numbers);
}

ToothTolerances measured_deviations(double pressure_angle_rad, const std::vector<double>& along,
                                    const std::vector<double>& against) {
    ToothTolerances found;
    const std::size_t teeth = along.size();
    for (const auto* side : {&along, &against}) {
        const auto [least, most] = std::minmax_element(side->begin(), side->end());
        found.cumulative_pitch = std::max(found.cumulative_pitch, *most - *least);
        for (std::size_t t = 0; t < teeth; ++t) {
            found.single_pitch =
                std::max(found.single_pitch, std::abs((*side)[(t + 1) % teeth] - (*side)[t]));
        }
    }
    found.single_pitch /= std::cos(pressure_angle_rad);
    found.cumulative_pitch /= std::cos(pressure_angle_rad);
    // A fork-shaped probe over a tooth sinks by an amount that depends on the deviations of both
    // flanks.
    double least = 0.0, most = 0.0;
    for (std::size_t t = 0; t < teeth; ++t) {
        const double both = along[t] + against[t];
        least = t == 0 ? both : std::min(least, both);
        most = t == 0 ? both : std::max(most, both);
    }
    found.runout = (most - least) / (2.0 * std::sin(pressure_angle_rad));
    return found;
}

DeviationScales scales_of(const ToothTolerances& tolerances, int teeth, double pressure_angle_rad) {
    constexpr int kMaxIterations = 30;
    // fraction of the remaining logarithmic error corrected in each round
    constexpr double kPart = 0.9;
    constexpr double kClose = 0.003;
    const UnitScaleGears gears(teeth, pressure_angle_rad);
    DeviationScales scales;
    scales.pitch = tolerances.single_pitch / 5.0;
    scales.waves = tolerances.cumulative_pitch / 5.0;
    scales.eccentricity = tolerances.runout / 4.0;
    bool close = false;
    for (int round = 0; round < kMaxIterations && !close; ++round) {
        const ToothTolerances kept = gears.deviation_quantiles(scales);
        close = true;
        const auto step = [&](double& scale, double target, double actual) {
            scale *= std::pow(target / actual, kPart);
            close = close && std::abs(actual / target - 1.0) < kClose;
        };
        step(scales.pitch, tolerances.single_pitch, kept.single_pitch);
        step(scales.waves, tolerances.cumulative_pitch, kept.cumulative_pitch);
        step(scales.eccentricity, tolerances.runout, kept.runout);
    }
    const double slope = tolerances.profile / gears.slope_quantile();
    scales.common_slope = UnitScaleGears::kCommonSlope * slope;
    scales.slope = UnitScaleGears::kIndividualSlope * slope;
    return scales;
}

}  // namespace gearpod::gears
