#include "mc/new_study/planetary_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gearpod::mc {
namespace {

// Formats a number to four significant rounded_text, with an exponent from a million on.
std::string rounded_text(double value) {
    const double rounded = std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr);
    return std::abs(rounded) < 1e6 ? fmt::format("{:.9g}", rounded)
                                   : fmt::format("{:.4g}", rounded);
}

// Formats a key with its value and the source of the value.
std::string line(const std::string& key, const std::string& value, const std::string& comment) {
    return comment.empty() ? fmt::format("{} = {}\n", key, value)
                           : fmt::format("{:<43} # {}\n", key + " = " + value, comment);
}
std::string line(const std::string& key, double value, const std::string& comment = "") {
    return line(key, rounded_text(value), comment);
}

std::string header(const NominalGears& g, const std::string& command) {
    return fmt::format(
        "# A planetary gearbox of {}/{}/{} teeth and {} planets, from its datasheet by\n"
        "#   gearpod {}\n"
        "# Values that the datasheet does not give follow from rules of thumb with their\n"
        "# sources, or are chosen. Replace the values that you know.\n"
        "# Shigley: Mechanical Engineering Design. Kraemer: Dynamics of Rotors and\n"
        "# Foundations (1993), section 3.4.\n"
        "# `gearpod describe` prints the resulting gearbox. `gearpod calibrate` fits tooth\n"
        "# errors, path and background noise to recordings of healthy gearboxes.\n"
        "title = \"Planetary gearbox {}/{}/{}: crack of a planet tooth on the ring side\"\n\n",
        g.data.sun, g.data.planet, g.ring_teeth, g.data.planets, command, g.data.sun, g.data.planet,
        g.ring_teeth);
}

std::string masses(const DerivedGearbox& d) {
    std::string text;
    const auto body = [&](const char* name, const Annulus& annulus, const char* comment) {
        text += line(fmt::format("{}_mass_kg", name), annulus.mass_kg(), comment);
        text += line(fmt::format("{}_inertia_kg_m2", name), annulus.inertia_kg_m2());
    };
    body("sun", d.sun_body, "steel rings between bore and reference circle (7850 kg/m^3)");
    body("planet", d.planet_body, "");
    body("ring", d.ring_body, "between reference circle and outside");
    text += line("carrier_mass_kg", d.carrier_mass_kg,
                 "two plates of a quarter of the face width, one pin diameter beyond the pins");
    text += line("carrier_inertia_kg_m2", d.carrier_inertia_kg_m2,
                 "and pins of 1.5 face widths, chosen");
    return text;
}

std::string bodies(const DerivedGearbox& d) {
    return line("sun_bore_mm", 2e3 * d.sun_body.inner_m,
                "rims of 1.2 tooth heights: thinner ones weaken the root (AGMA 2001-D04, backup "
                "ratio)") +
           line("planet_bore_mm", 2e3 * d.planet_body.inner_m, "holds the bearing") +
           line("ring_outer_mm", 2e3 * d.ring_body.outer_m,
                "rim of three tooth heights, with room for bolts (chosen)");
}

std::string bearings(const DerivedGearbox& d) {
    const double planet = d.bearing.stiffness_N_m(d.pin_load_N);
    const RollerBearing& b = d.bearing;
    std::string text = fmt::format(
        "# Planet bearings: 2 rows of {} rollers, {} mm long, loaded with {} kN:\n"
        "# 1e9 Z^0.9 l^0.8 F^0.1 (Kraemer, after Palmgren). Chosen: carrier bearings of the\n"
        "# same stiffness, a bolted ring of twice the stiffness, and a floating sun of a\n"
        "# fiftieth, so that the planets share the load. Damping: 1e-5 s times the\n"
        "# stiffness (Kraemer: 0.25e-5 to 2.5e-5 s).\n",
        b.rollers, rounded_text(1e3 * b.roller_length_m), rounded_text(1e-3 * d.pin_load_N));
    std::string damping;
    for (const auto& [name, factor] : {std::pair{"sun_bearing", 0.02},
                                       {"planet_bearing", 1.0},
                                       {"ring_bearing", 2.0},
                                       {"carrier_bearing", 1.0},
                                       {"support", 2.0}}) {
        const double stiffness = factor * planet;
        const std::string prefix(name);
        text += line(prefix + "_stiffness_N_m", stiffness,
                     prefix == "support" ? "holds the ring's rotation" : "");
        damping += line(prefix + "_damping_N_s_m", bearing_damping_N_s_m(stiffness));
    }
    return text + damping;
}

// Standard deviation of the pin positions: a normal distribution with 95 % within the tolerance.
double pin_rms_um(const DerivedGearbox& d) {
    return 1e6 * grade_7_tolerance_m(d.centre_distance_m) / 4.0;
}

std::string accuracy(const NominalGears& g, const DerivedGearbox& d) {
    return line("tooth_quality", g.data.quality, "ISO 1328 grade of all gears") +
           line("pin_tangential_rms_um", pin_rms_um(d),
                "a quarter of ISO 286's tolerance of grade 7 on the centre distance") +
           line("pin_radial_rms_um", pin_rms_um(d)) +
           line("mesh_damping_ratio", 0.1, "0.03 to 0.17 of critical (Kasuba and Evans, 1981)");
}

std::string operation(const NominalGears& g, const InputLoad& load) {
    return "\n[operation]\nfixed = \"ring\"\n" + line("input", "\"" + g.data.input + "\"", "") +
           line("torque_on", "\"" + g.data.input + "\"", "") + line("torque_N_m", load.torque_N_m) +
           line(g.data.input + "_speed_rpm", load.speed_rpm);
}

std::string effects() {
    return "\n[effects]\n" + line("motion", "\"translational-torsional\"", "") +
           line("foundation", "\"elastic-ring\"",
                "agrees with finite elements (docs/validation/mesh-stiffness-level.md)") +
           line("contact_onset", "\"extended\"", "tip corners touch before and after the path") +
           line("mesh_damping", "\"ratio\"", "") + line("path", "\"hamming\"", "");
}

constexpr const char* kFault =
    "\n[fault]                                     # another gear, side or kind: gearpod describe "
    "--keys fault\n"
    "kind = \"crack\"\nmember = \"planet\"\nside = \"ring\"\nplanet = 1\ndepth_mm = 0\n"
    "angle_deg = 45\n";

// Sensor rates, Hz.
struct SensorRates {
    double low_pass = 0, sampling = 0;
};

// Rates for twenty mesh harmonics, limited to the range of a general-purpose accelerometer. At
// higher mesh frequencies a mesh period still has enough samples for the encoders and the windows.
SensorRates sensor_rates(double mesh_frequency_Hz) {
    constexpr double kHarmonics = 20.0, kHighest_Hz = 10000.0, kAnalyser = 2.56,
                     kFewestPerMesh = 12.0;
    const double low_pass = std::min(kHarmonics * mesh_frequency_Hz, kHighest_Hz);
    return {low_pass, std::max(kAnalyser * low_pass, kFewestPerMesh * mesh_frequency_Hz)};
}

// Background noise of the machine at the sensor: a one-sided density of 1e-3 m/s^2/sqrt(Hz), which
// is 0.1 m/s^2 up to 10 kHz (chosen). At sampling rates far above the low-pass the rms of white
// noise is used instead.
struct Background {
    const char* key;
    double value;
};

Background background(const SensorRates& rates) {
    constexpr double kDensity = 1e-3, kMostPerLowPass = 50.0;
    if (rates.sampling <= kMostPerLowPass * rates.low_pass) {
        return {"noise_density_m_s2_per_sqrt_Hz", kDensity};
    }
    return {"noise_m_s2", kDensity * std::sqrt(0.5 * rates.sampling)};
}

std::string sensor(const DerivedGearbox& d) {
    const SensorRates rates = sensor_rates(d.mesh_frequency_Hz);
    return "\n[sensor]\n" +
           line("low_pass_Hz", rates.low_pass,
                fmt::format("20 times the mesh frequency, {} Hz; 10 kHz at most",
                            rounded_text(d.mesh_frequency_Hz))) +
           line("sampling_Hz", rates.sampling,
                "2.56 times the low-pass, at least 12 per mesh period") +
           line("path_exponent", 0.1, "Liang (2016), section 5.1") +
           line(background(rates).key, background(rates).value,
                "background of the machine; measure or calibrate it") +
           line("encoder_sampling_Hz", rates.sampling, "same as the sensor") +
           line("encoder_noise_arcsec", 1.0, "a good encoder (chosen)") +
           line("noise_levels", "[0.005, 0.25, 1, 4]",
                "0.005: a low-noise accelerometer alone, 0.5 ug/sqrt(Hz); 0.25: an industrial "
                "MEMS one, 25 ug/sqrt(Hz)");
}

std::string varied(const char* key, const std::string& distribution, const char* comment = "") {
    return line(key, "{ distribution = " + distribution + " }", comment);
}

std::string random(const DerivedGearbox& d, const InputLoad& load) {
    const double bearing = d.bearing.stiffness_N_m(d.pin_load_N);
    const Background noise = background(sensor_rates(d.mesh_frequency_Hz));
    const auto lognormal = [](double median, double cv) {
        return fmt::format("\"lognormal\", median = {}, cv = {}", rounded_text(median), cv);
    };
    std::string depths;
    for (const double share : {0.0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8}) {
        depths +=
            (depths.empty() ? "" : ", ") + fmt::format("{:.3g}", 1e3 * share * d.deepest_crack_m);
    }
    return "\n[random]                                    # variation between gearboxes "
           "(chosen)\n" +
           varied("gearbox.planet_bearing_stiffness_N_m", lognormal(bearing, 0.3)) +
           varied("gearbox.sun_bearing_stiffness_N_m", lognormal(0.02 * bearing, 0.3)) +
           varied("gearbox.ring_bearing_stiffness_N_m", lognormal(2.0 * bearing, 0.3)) +
           varied("gearbox.carrier_bearing_stiffness_N_m", lognormal(bearing, 0.3)) +
           varied("gearbox.mesh_damping_ratio", "\"uniform\", low = 0.03, high = 0.17") +
           varied("operation.torque_N_m",
                  fmt::format("\"truncated-normal\", mean = {}, sd = {}, low = {}, high = {}",
                              rounded_text(load.torque_N_m), rounded_text(0.05 * load.torque_N_m),
                              rounded_text(0.85 * load.torque_N_m),
                              rounded_text(1.15 * load.torque_N_m))) +
           varied("sensor.path_exponent", "\"uniform\", low = -0.1, high = 0.1") +
           varied(("sensor." + std::string(noise.key)).c_str(), lognormal(noise.value, 0.2)) +
           fmt::format("# 0 to 80 % of the way through the root, {} mm at 45 degrees\n",
                       rounded_text(1e3 * d.deepest_crack_m)) +
           varied("fault.depth_mm", "\"levels\", values = [" + depths + "]");
}

constexpr const char* kOutputSections =
    "\n[features]\n"
    "use = [\"te_kurtosis\", \"sensor_rms\", \"window_ratio\", \"window_z\", "
    "\"own_window_ratio\", \"change_window_ratio\"]\n"
    "baseline_torque_scatter = 0.02\n"
    "\n[detection]\nfalse_alarm_rate = 0.05\nconfidence = 0.95\n"
    "\n[ensemble]                                  # more gearboxes narrow the intervals\n"
    "instances = 128\nthreshold_instances = 96\nseed = 1\n";

}  // namespace

std::string gearbox_teeth(const NominalGears& g) {
    const PlanetaryDatasheet& data = g.data;
    std::string text = fmt::format(
        "[gearbox]\nkind = \"planetary\"\nplanets = {}\nsun_teeth = {}\nplanet_teeth = {}\n"
        "ring_teeth = {}\n",
        data.planets, data.sun, data.planet, g.ring_teeth);
    if (data.helix_deg != 0.0) {
        text += line("normal_module_mm", data.module_mm) + line("helix_angle_deg", data.helix_deg);
    } else {
        text += line("module_mm", data.module_mm);
    }
    text += line("pressure_angle_deg", data.pressure_angle_deg);
    for (const auto& [key, value] :
         {std::pair{"addendum_coefficient", data.addendum}, std::pair{"sun_shift", data.sun_shift},
          std::pair{"planet_shift", data.planet_shift}, std::pair{"ring_shift", data.ring_shift},
          std::pair{"centre_distance_mm", data.centre_distance_mm},
          std::pair{"sun_tip_mm", data.sun_tip_mm}, std::pair{"planet_tip_mm", data.planet_tip_mm},
          std::pair{"ring_tip_mm", data.ring_tip_mm}}) {
        if (value) {
            text += fmt::format("{} = {}\n", key, *value);
        }
    }
    return text +
           line("face_width_mm", g.face_width_mm,
                data.face_width_mm ? "" : "four circular pitches (Shigley: three to five)") +
           line("young_modulus_Pa", 2.06e11, "steel") + line("poisson_ratio", 0.3);
}

std::string planetary_text(const NominalGears& g, const DerivedGearbox& d, const InputLoad& load,
                           const std::string& command) {
    return header(g, command) + gearbox_teeth(g) + "tooth_profile = \"fillet\"\n" + bodies(d) +
           accuracy(g, d) + masses(d) + bearings(d) + operation(g, load) + effects() + kFault +
           sensor(d) + random(d, load) + kOutputSections;
}

}  // namespace gearpod::mc
