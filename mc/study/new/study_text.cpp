#include "mc/study/new/study_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "analysis/detection/detection.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/numerics/numerics_choice.hpp"

namespace gearpod::mc {

std::string rounded_text(double value) {
    const double rounded = std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr);
    return std::abs(rounded) < 1e6 ? fmt::format("{:.9g}", rounded)
                                   : fmt::format("{:.4g}", rounded);
}

std::string line(const std::string& key, const std::string& value, const std::string& comment) {
    return comment.empty() ? fmt::format("{} = {}\n", key, value)
                           : fmt::format("{:<43} # {}\n", key + " = " + value, comment);
}
std::string line(const std::string& key, double value, const std::string& comment) {
    return line(key, rounded_text(value), comment);
}

std::string given_line(const std::string& key, double value, const std::string& comment) {
    return line(key, fmt::format("{:.9g}", value), comment);
}

MemberTables::MemberTables(std::initializer_list<const char*> members) {
    for (const char* member : members) {
        tables_.emplace_back(member, "");
    }
}

std::string& MemberTables::operator[](const std::string& member) {
    return std::ranges::find(tables_, member, [](const auto& table) { return table.first; })
        ->second;
}

std::string MemberTables::text() const {
    std::string text;
    for (const auto& [member, lines] : tables_) {
        text += lines.empty() ? "" : fmt::format("\n[gearbox.{}]\n{}", member, lines);
    }
    return text;
}

std::string study_header(const StageDatasheet& data, const std::string& gearbox,
                         const std::string& command, const std::string& name,
                         const std::string& fault) {
    std::string text = fmt::format("# {}, from its {} by\n#   gearpod {}\n", gearbox, data.origin,
                                   printable(command));
    for (const std::string& note : data.notes) {
        std::string lines = wrapped_text("- " + printable(note), 4);
        for (std::size_t at = 0; (at = lines.find("\n  ", at)) != std::string::npos; ++at) {
            lines.replace(at, 3, "\n# ");
        }
        text += "# " + lines + "\n";
    }
    return text + fmt::format(
                      "# Values that the {} does not give follow from rules of thumb with "
                      "their\n# sources, or are chosen. Replace the values that you know.\n"
                      "# Shigley: Mechanical Engineering Design. Kraemer: Dynamics of Rotors "
                      "and\n# Foundations (1993), section 3.4.\n"
                      "# `gearpod describe` prints the resulting gearbox. `gearpod calibrate` "
                      "fits tooth\n# errors, path and background noise to recordings of "
                      "healthy gearboxes.\n"
                      "title = \"{}{}: {}\"\n\n",
                      data.origin, name,
                      data.around.place.empty() ? " alone" : ", " + data.around.place, fault);
}

std::string teeth_lines(const StageDatasheet& data, double face_width_mm) {
    constexpr double kSteel_Pa = 2.06e11, kSteelPoisson = 0.3;
    std::string text = data.helix_deg != 0.0 ? given_line("normal_module_mm", data.module_mm) +
                                                   given_line("helix_angle_deg", data.helix_deg)
                                             : given_line("module_mm", data.module_mm);
    text += given_line("pressure_angle_deg", data.pressure_angle_deg);
    for (const auto& [key, value] : {std::pair{"addendum_coefficient", data.addendum},
                                     std::pair{"centre_distance_mm", data.centre_distance_mm}}) {
        text += value ? fmt::format("{} = {}\n", key, *value) : "";
    }
    return text +
           (data.face_width_mm ? given_line("face_width_mm", face_width_mm)
                               : line("face_width_mm", face_width_mm,
                                      "four circular pitches (Shigley: three to five)")) +
           line("young_modulus_Pa", data.young_modulus_Pa.value_or(kSteel_Pa),
                data.young_modulus_Pa ? "given" : "steel") +
           line("poisson_ratio", data.poisson_ratio.value_or(kSteelPoisson)) +
           "tooth_profile = \"fillet\"\n";
}

std::string gear_lines(int teeth, const std::optional<double>& shift,
                       const std::optional<double>& tip_mm) {
    return fmt::format("teeth = {}\n", teeth) + (shift ? fmt::format("shift = {}\n", *shift) : "") +
           (tip_mm ? fmt::format("tip_mm = {}\n", *tip_mm) : "");
}

NewSensor new_sensor(const StageDatasheet& data, double mesh_frequency_Hz) {
    // A filter of fourth order damps lines that fold back to below its corner by (6 - 1)^4 = 625.
    constexpr double kHarmonics = 20.0, kHighest_Hz = 10000.0, kPerLowPass = 6.0,
                     kFewestPerMesh = 12.0;
    // Noise of accelerometers, m/s^2/sqrt(Hz): 0.5 and 25 ug/sqrt(Hz).
    constexpr double kLowNoise = 5e-6, kMems = 2.5e-4, kMostPerLowPass = 50.0;
    const double low_pass =
        data.around.low_pass_Hz.value_or(std::min(kHarmonics * mesh_frequency_Hz, kHighest_Hz));
    const double sampling = std::max(kPerLowPass * low_pass, kFewestPerMesh * mesh_frequency_Hz);
    const double density = data.around.density.value_or(kChosenDensity);
    std::vector<double> levels{kLowNoise / density, kMems / density, 1.0};
    if (!data.around.measured) {
        levels.push_back(4.0);
    }
    return {mesh_frequency_Hz,
            {low_pass, sampling},
            sampling <= kMostPerLowPass * low_pass
                ? Background{"noise_density_m_s2_per_sqrt_Hz", density, levels}
                : Background{"noise_m_s2", density * std::sqrt(0.5 * sampling), levels}};
}

std::string load_lines(const StageDatasheet& data, const InputLoad& load,
                       const std::string& speed_key) {
    const auto shown = [](bool given, const std::string& key, double value) {
        return given ? given_line(key, value) : line(key, value);
    };
    return shown(data.torque_N_m.has_value(), "torque_N_m", load.torque_N_m) +
           shown(data.speed_rpm.has_value(), speed_key, load.speed_rpm);
}

std::string effects_section(const std::string& path) {
    return "\n[effects]\n" + line("motion", "\"translational-torsional\"", "") +
           line("foundation", "\"elastic-ring\"",
                "agrees with finite elements (docs/validation/mesh-stiffness-level.md)") +
           line("contact_onset", "\"extended\"", "tip corners touch before and after the path") +
           line("mesh_damping", "\"ratio\"", "") + line("path", "\"" + path + "\"", "");
}

std::string sensor_section(const StageDatasheet& data, const NewSensor& sensor,
                           const std::string& place) {
    const auto& [mesh_frequency_Hz, rates, noise] = sensor;
    std::vector<std::string> levels;
    std::ranges::transform(noise.levels, std::back_inserter(levels), rounded_text);
    return "\n[sensor]\n" +
           line("low_pass_Hz", rates.low_pass,
                data.around.low_pass_Hz
                    ? "upper end of the band"
                    : fmt::format("20 times the mesh frequency, {} Hz; 10 kHz at most",
                                  rounded_text(mesh_frequency_Hz))) +
           line("sampling_Hz", rates.sampling,
                "6 times the low-pass, at least 12 per mesh period") +
           place +
           line(noise.key, noise.value,
                data.around.measured ? "the rest of the measured level"
                                     : "background of the machine; measure or calibrate it") +
           line("encoder_sampling_Hz", rates.sampling, "same as the sensor") +
           line("encoder_noise_arcsec", 1.0, "a good encoder (chosen)") +
           line("noise_levels", fmt::format("[{}]", fmt::join(levels, ", ")),
                fmt::format("{}: a low-noise accelerometer alone, 0.5 ug/sqrt(Hz); {}: an "
                            "industrial MEMS one, 25 ug/sqrt(Hz)",
                            levels[0], levels[1])) +
           data.around.stages;
}

std::string varied(const std::string& key, const std::string& distribution) {
    return line(key, "{ distribution = " + distribution + " }", "");
}

std::string lognormal(double median, double cv) {
    return fmt::format("\"lognormal\", median = {}, cv = {}", rounded_text(median), cv);
}

std::string varied_torque(double torque_N_m) {
    return varied("operation.torque_N_m",
                  fmt::format("\"truncated-normal\", mean = {}, sd = {}, low = {}, high = {}",
                              rounded_text(torque_N_m), rounded_text(0.05 * torque_N_m),
                              rounded_text(0.85 * torque_N_m), rounded_text(1.15 * torque_N_m)));
}

std::string varied_depth(double deepest_m) {
    std::string depths;
    for (const double share : {0.0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8}) {
        depths += (depths.empty() ? "" : ", ") + fmt::format("{:.3g}", 1e3 * share * deepest_m);
    }
    return fmt::format("# 0 to 80 % of the way through the root, {} mm at 45 degrees\n",
                       rounded_text(1e3 * deepest_m)) +
           varied("fault.depth_mm", "\"levels\", values = [" + depths + "]");
}

std::string output_sections(const StageDatasheet& data, const Background& noise) {
    // Enough gearboxes to show 90 % at 95 % confidence at each of the depths, in whole batches.
    constexpr long kDepths = 7, kBatch = 16;
    std::vector<std::string> chosen{"\"features.baseline_torque_scatter\""};
    if (!data.quality) {
        chosen.push_back("\"gearbox.tooth_quality\"");
    }
    if (!data.around.measured) {
        chosen.push_back(fmt::format("\"sensor.{}\"", noise.key));
    }
    const long needed = kDepths * analysis::tests_to_show(analysis::kReliablePd, 0.95);
    return "\n[features]\n"
           "use = [\"te_kurtosis\", \"sensor_rms\", \"window_ratio\", \"window_z\", "
           "\"own_window_ratio\", \"change_window_ratio\"]\n"
           "baseline_torque_scatter = 0.02\n"
           "\n[detection]\nfalse_alarm_rate = 0.05\nconfidence = 0.95\n"
           "# neither measured nor from a source: the answer marks them\n"
           "chosen_values = [" +
           fmt::format("{}", fmt::join(chosen, ", ")) + "]\n\n[ensemble]\n" +
           line("instances", std::to_string((needed + kBatch - 1) / kBatch * kBatch),
                "enough to show 90 % detection at each depth; more narrow the intervals") +
           "threshold_instances = 96\nseed = 1\n";
}

NewStudy checked_study(
    const StageDatasheet& data, const DatasheetSource& source, const std::string& driver,
    const std::string& teeth,
    const std::function<std::string(const Study& teeth, const InputLoad& load)>& text_of) {
    Problems problems = load_problems(data, source, driver);
    const StudyReading reading = read_study_text(teeth, source.file);
    std::ranges::move(as_named_by(source, reading.problems), std::back_inserter(problems));
    if (!reading.study || !problems.empty()) {
        return {"", std::move(problems)};
    }
    const std::string text = text_of(*reading.study, load_of(data));
    // Reading finds values out of range; building the scene finds all other problems.
    problems =
        as_named_by(source, make_scene(source.file, read_study_text(text, source.file)).problems);
    return problems.empty() ? NewStudy{text, {}} : NewStudy{"", std::move(problems)};
}

}  // namespace gearpod::mc
