// Units, ranges and reasons against randomness that several keys share.
#pragma once

#include <limits>

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

inline constexpr double kPi = 3.14159265358979323846;

inline constexpr Unit kNone{"", "1", "", "1", 1.0};
inline constexpr Unit kMm{"mm", "mm", "m", "m", 1e-3};
inline constexpr Unit kUm{"um", "um", "m", "m", 1e-6};
inline constexpr Unit kDeg{"deg", "deg", "rad", "rad", kPi / 180};
inline constexpr Unit kArcsec{"arcsec", "arcsec", "rad", "rad", kPi / 648000};
inline constexpr Unit kPa{"Pa", "Pa", "Pa", "Pa", 1.0};
inline constexpr Unit kKg{"kg", "kg", "kg", "kg", 1.0};
inline constexpr Unit kKgM2{"kg_m2", "kg m^2", "kg_m2", "kg m^2", 1.0};
inline constexpr Unit kNPerM{"N_m", "N/m", "N_m", "N/m", 1.0};
inline constexpr Unit kNSPerM{"N_s_m", "N s/m", "N_s_m", "N s/m", 1.0};
inline constexpr Unit kNm{"N_m", "N m", "N_m", "N m", 1.0};
inline constexpr Unit kNmPerRad{"N_m_rad", "N m/rad", "N_m_rad", "N m/rad", 1.0};
inline constexpr Unit kNmSPerRad{"N_m_s_rad", "N m s/rad", "N_m_s_rad", "N m s/rad", 1.0};
inline constexpr Unit kS{"s", "s", "s", "s", 1.0};
inline constexpr Unit kHours{"h", "h", "h", "h", 1.0};
inline constexpr Unit kMPaRootM{"MPa_m05", "MPa m^(1/2)", "Pa_m05", "Pa m^(1/2)", 1e6};
inline constexpr Unit kHz{"Hz", "Hz", "Hz", "Hz", 1.0};
inline constexpr Unit kRpm{"rpm", "rpm", "rad_s", "rad/s", kPi / 30};
inline constexpr Unit kMPerS2{"m_s2", "m/s^2", "m_s2", "m/s^2", 1.0};
inline constexpr Unit kMPerS2RootHz{"m_s2_per_sqrt_Hz", "m/s^2/sqrt(Hz)", "m_s2_per_sqrt_Hz",
                                    "m/s^2/sqrt(Hz)", 1.0};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{};
inline constexpr Range kPositive{0.0, kInfinity, true, false};
inline constexpr Range kNotNegative{0.0, kInfinity, false, false};
// ISO 1328-1:1995 grades.
inline constexpr Range kGrade{0.0, 12.0, false, false};
// Above the sampling rate of real converters; the limit also bounds the number of samples.
inline constexpr Range kFrequency{0.0, 1e7, true, false};
constexpr Range from_to(double low, double high) {
    return {low, high, false, false};
}
constexpr Range inside(double low, double high) {
    return {low, high, true, true};
}

inline constexpr std::string_view kRandom = "";  // may be random
inline constexpr std::string_view kGeometry =
    "it defines the teeth, which are the same in all gearboxes";
inline constexpr std::string_view kSampling = "sampling is the same for all gearboxes";
inline constexpr std::string_view kShared = "it is the same for all gearboxes";
inline constexpr std::string_view kFaultShape = "only the size of a fault may be random";

}  // namespace gearpod::mc
