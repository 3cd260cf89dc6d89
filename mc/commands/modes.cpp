#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/stiffness_modes.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

struct ModesOptions {
    StudyOptions study;
    std::string json;
    std::string html, figures;  // page and folder of its figures; "": none
    bool force = false;         // replaces outputs of another kind
};

// Relative difference below which frequencies are printed as one mode with a multiplicity.
constexpr double kSameMode = 1e-6;
// Campbell diagram: highest speed over the nominal one, number of speeds, mesh harmonics.
constexpr double kHighestSpeed = 1.5;
constexpr int kSpeeds = 61, kHarmonics = 5;

double rpm(double rad_s) {
    return rad_s * 30.0 / std::numbers::pi;
}

struct Modes {
    std::string_view speed_member;  // whose speed the study gives
    std::vector<double> frequencies_Hz;
    std::vector<SpeedFrequencies> speeds;
    std::vector<CriticalSpeed> critical;
    std::vector<double> train_Hz;  // with coupled stages; empty without

    double nominal_rpm() const { return rpm(speeds.back().speed_rad_s) / kHighestSpeed; }
};

nlohmann::json json_of(const std::string& title, const Modes& modes) {
    using Json = nlohmann::json;
    Json speeds = Json::array(), critical_speeds = Json::array();
    for (const SpeedFrequencies& speed : modes.speeds) {
        speeds.push_back({{"rpm", rpm(speed.speed_rad_s)},
                          {"mesh_Hz", speed.mesh_Hz},
                          {"frequencies_Hz", speed.frequencies_Hz}});
    }
    for (const CriticalSpeed& critical : modes.critical) {
        critical_speeds.push_back({{"rpm", rpm(critical.speed_rad_s)},
                                   {"harmonic", critical.harmonic},
                                   {"frequency_Hz", critical.frequency_Hz},
                                   {"modes", critical.modes}});
    }
    return {{"kind", "modes"},
            {"title", title},
            {"frequencies_Hz", modes.frequencies_Hz},
            {"train_frequencies_Hz", modes.train_Hz.empty() ? Json(nullptr) : Json(modes.train_Hz)},
            {"campbell", modes.speeds.empty() ? Json(nullptr)
                                              : Json{{"member", modes.speed_member},
                                                     {"nominal_rpm", modes.nominal_rpm()},
                                                     {"harmonics", kHarmonics},
                                                     {"speeds", speeds},
                                                     {"critical_speeds", critical_speeds}}}};
}

void print_frequencies(const std::string& of, const std::vector<double>& frequencies) {
    fmt::print("natural frequencies{} at mean mesh stiffness, {} degrees of freedom\n", of,
               frequencies.size());
    fmt::print("{:>12}  {}\n", "Hz", "multiplicity");
    for (std::size_t i = 0; i < frequencies.size();) {
        std::size_t end = i + 1;
        while (end < frequencies.size() &&
               std::abs(frequencies[end] - frequencies[i]) <= kSameMode * frequencies[end]) {
            ++end;
        }
        fmt::print("{:>12.1f}  {}\n", frequencies[i], end - i);
        i = end;
    }
}

void print_critical_speeds(const Modes& modes) {
    if (modes.speeds.empty()) {
        return;
    }
    const double nominal_rpm = modes.nominal_rpm();
    fmt::print(
        "\nspeeds of the {} at which mesh harmonics 1 to {} meet a natural frequency,\n"
        "up to {:g} times the nominal {:.5g} rpm{}\n",
        modes.speed_member, kHarmonics, kHighestSpeed, nominal_rpm,
        modes.critical.empty() ? ": none" : "");
    if (!modes.critical.empty()) {
        fmt::print("{:>12}  {:>10}  {:>8}  {:>10}  {}\n", "rpm", "of nominal", "harmonic", "Hz",
                   "multiplicity");
    }
    for (const CriticalSpeed& critical : modes.critical) {
        fmt::print("{:>12.5g}  {:>10.3f}  {:>8}  {:>10.1f}  {}\n", rpm(critical.speed_rad_s),
                   rpm(critical.speed_rad_s) / nominal_rpm, critical.harmonic,
                   critical.frequency_Hz, critical.modes);
    }
}

int modes_command(const ModesOptions& options) {
    const bool writable = can_write_json_and_page(
        options.json, options.html, {{"the study", options.study.path}}, options.force);
    const auto study = load_study(options.study);
    if (!study || !writable) {
        return kBadInput;
    }
    const ModalPlan plan = make_modal_plan(*study);
    Modes modes{member_name(plan.speed_member),
                natural_frequencies_Hz(plan),
                frequencies_over_speed(plan, kHighestSpeed, kSpeeds),
                {},
                {}};
    if (plan.coupled) {
        modes.train_Hz = train_frequencies_Hz(resolved_plan(*study).gearbox());
    }
    modes.critical = critical_speeds(modes.speeds, kHarmonics);
    if (!write_json_and_page(json_of(study->title, modes), options.json, options.html,
                             options.figures)) {
        return kBadInput;
    }
    if (options.json == "-") {
        return kDone;
    }
    print_frequencies(modes.train_Hz.empty() ? "" : " of the gearbox alone", modes.frequencies_Hz);
    if (!modes.train_Hz.empty()) {
        fmt::print("\n");
        print_frequencies(" of the train with its elastic shafts", modes.train_Hz);
    }
    print_critical_speeds(modes);
    print_written("page", options.html);
    return kDone;
}

}  // namespace

void add_modes(CLI::App& app, int& code) {
    const auto [command, options] = add_command<ModesOptions>(
        app, code, "modes", "print the natural frequencies at mean mesh stiffness",
        reporting<modes_command>);
    add_study(command, options.study);
    add_json(command, options.json);
    add_file(command, "--html", options.html, "write a page with the Campbell diagram");
    add_file(command, "--figures", options.figures,
             "write the figures of the page to a folder, as SVG, PNG and PDF");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
