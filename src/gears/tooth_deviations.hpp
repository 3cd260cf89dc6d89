// Deviations of a gear's teeth from perfect ones: what the standard allows, and random gears that
// have just that.
//
// ISO 1328-1:1995 (pitch and profile) and ISO 1328-2:1997 (runout). The formulas are evaluated at
// the gear's own module and diameter, not at the geometric means of the standard's ranges, and are
// not rounded.
#pragma once

#include <cstdint>
#include <vector>

namespace gearpod::gears {

// Tolerances, m.
struct ToothTolerances {
    double single_pitch = 0.0;      // f_pt: from tooth to tooth, on the pitch circle
    double cumulative_pitch = 0.0;  // F_p: between any two teeth, on the pitch circle
    double profile = 0.0;           // F_alpha: along a flank
    double runout = 0.0;            // F_r: of a probe on the teeth, radially
};

// Of a grade, as 6 or 6.5; each grade allows sqrt(2) times as much as the one before it.
ToothTolerances tooth_tolerances(double module_m, double pitch_diameter_m, double grade);

// What a random gear's deviations are made of, rms over gears, m. Those of flanks are along the
// line of action.
//
// The toothing's centre lies off the axis by a vector of which each component is normal: a flank is
// off by its part along the line of action, which goes on changing while the contact moves along
// the flank. Waves turn the teeth about the axis, harmonics 1, 2 and 3 of a turn with amplitudes as
// 1, 1/2 and 1/3; the gap of one flank is the other one's excess. Scatter is each flank's own.
struct DeviationScales {
    double eccentricity = 0.0;  // of the centre's distance from the axis
    double waves = 0.0;
    double pitch = 0.0;         // scatter from flank to flank
    double common_slope = 0.0;  // of all profiles on a side, from the root's end to the tip's
    double slope = 0.0;         // each profile's own, beside that
};

// Both together: independent deviations add up by their squares.
DeviationScales combined(const DeviationScales& a, const DeviationScales& b);
DeviationScales scaled(const DeviationScales& scales, double factor);

// Of the teeth's flanks on one side, [tooth]; a gap is positive.
struct FlankDeviations {
    std::vector<double> index_m;
    std::vector<double> drift_m;  // by which it changes while the gear turns by a tooth
};

// The waves of a gear and its eccentricity: standard normal numbers.
struct WaveNumbers {
    static constexpr int kHarmonics = 3;
    double centre[2] = {};
    double cosine[kHarmonics] = {}, sine[kHarmonics] = {};
};

// side: 1 for the flanks that look along the teeth's numbering, -1 for those that look against it.
// Without the scatter.
FlankDeviations wave_deviations(int teeth, double pressure_angle_rad, const DeviationScales& scales,
                                const WaveNumbers& numbers, int side);

// What a measurement of both sides of a gear finds, m: index deviations along the line of action
// go in.
ToothTolerances measured_deviations(double pressure_angle_rad, const std::vector<double>& along,
                                    const std::vector<double>& against);

// Scales of gears of which nine in ten keep each of the tolerances f_pt, F_p, F_r, and of which
// nine in ten sides keep F_alpha (as slopes, without form deviations), each on its own. Where the
// scatter that f_pt asks for brings more runout than F_r, the gears have no eccentricity. Two
// thirds of a slope are common to a side: one tool cut it. The same at every call and on every
// machine.
inline constexpr double kShareWithin = 0.9;
DeviationScales scales_of(const ToothTolerances& tolerances, int teeth, double pressure_angle_rad);

}  // namespace gearpod::gears
