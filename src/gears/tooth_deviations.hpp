// Deviations of a gear's teeth from ideal ones: tolerances of the standard, and random gears that
// just meet them.
//
// ISO 1328-1:1995 (pitch and profile) and ISO 1328-2:1997 (runout). The formulas are evaluated at
// the gear's own module and diameter, not at the geometric means of the standard's ranges, and are
// not rounded.
#pragma once

#include <vector>

namespace gearpod::gears {

// Tolerances, m.
struct ToothTolerances {
    double single_pitch = 0.0;      // f_pt: from tooth to tooth, on the pitch circle
    double cumulative_pitch = 0.0;  // F_p: between any two teeth, on the pitch circle
    double profile = 0.0;           // F_alpha: along a flank
    double runout = 0.0;            // F_r: radial, of a probe on the teeth
};

// Tolerances of a grade, for example 6 or 6.5; each grade allows sqrt(2) times as much as the
// previous one.
ToothTolerances tooth_tolerances(double module_m, double pitch_diameter_m, double grade);

// Components of a random gear's deviations, rms over gears, m. Those of flanks are along the line
// of action.
//
// - Eccentricity: the centre of the toothing is offset from the axis by a vector with normal
//   components. A flank deviates by the part along the line of action, which changes while the
//   contact moves along the flank.
// - Waves: the teeth are rotated about the axis by harmonics 1, 2 and 3 of a turn, with amplitudes
//   1, 1/2 and 1/3. A gap of one flank is an excess of the opposite one.
// - Pitch scatter: independent for each flank.
struct DeviationScales {
    double eccentricity = 0.0;  // of the centre's distance from the axis
    double waves = 0.0;
    double pitch = 0.0;         // scatter from flank to flank
    double common_slope = 0.0;  // common to all profiles on a side, over the path from root to tip
    double slope = 0.0;         // independent addition for each profile
};

// Sum of both: independent deviations add in quadrature.
DeviationScales combined(const DeviationScales& a, const DeviationScales& b);
DeviationScales scaled(const DeviationScales& scales, double factor);

// Deviations of the flanks on one side, [tooth]; a gap is positive.
struct FlankDeviations {
    std::vector<double> index_m;
    std::vector<double> drift_m;  // change while the gear turns by one tooth
};

// Standard normal numbers that determine the waves and the eccentricity of a gear.
struct WaveNumbers {
    static constexpr int kHarmonics = 3;
    double centre[2] = {};
    double cosine[kHarmonics] = {}, sine[kHarmonics] = {};
};

// Deviations without the pitch scatter. `side` is 1 for flanks that face the direction of tooth
// numbering, -1 for the opposite ones.
FlankDeviations wave_deviations(int teeth, double pressure_angle_rad, const DeviationScales& scales,
                                const WaveNumbers& numbers, int side);

// Deviations that a measurement of both sides of a gear yields, m, from index deviations along the
// line of action.
ToothTolerances measured_deviations(double pressure_angle_rad, const std::vector<double>& along,
                                    const std::vector<double>& against);

// Scales of random gears that just meet the tolerances. 90 % of the gears meet each of f_pt, F_p
// and F_r individually. 90 % of the sides meet F_alpha (as slopes, without form deviations). If the
// scatter due to f_pt causes more runout than F_r, the gears have no eccentricity. Two thirds of a
// slope are common to a side, because one tool cut it. The result is the same for every call and on
// every machine.
inline constexpr double kFractionWithin = 0.9;
DeviationScales scales_of(const ToothTolerances& tolerances, int teeth, double pressure_angle_rad);

}  // namespace gearpod::gears
