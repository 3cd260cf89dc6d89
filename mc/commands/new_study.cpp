#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/report/page.hpp"
#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {
namespace {

struct NewOptions {
    std::string kind;     // gearbox kind; empty for a stage of a REXS model
    std::string command;  // command line, quoted in the study's first comment
    PlanetaryDatasheet planetary;
    std::string rexs;              // model file; empty: the datasheet's values are options
    std::string stage, load_case;  // of the model
    std::string out = "-";         // "-": standard output
    bool force = false;            // overwrite a file
};

// Comment from which editors take the JSON schema of the study.
std::string schema_line() {
    const std::string schema = schema_path().string();
    return schema.empty() ? "" : "#:schema " + schema + "\n";
}

// Prints warnings of a torque that cannot be meant.
void warn_of_load(const NewStudy& made, const std::string& path) {
    const StudyReading reading = read_study_text(made.text, path);
    if (reading.study) {
        print_problems(load_warnings(*reading.study, path == "-" ? "the study" : path));
    }
}

// Options that a REXS model leaves open. It states all others.
const std::set<std::string> kWithModel{
    "--rexs",  "--stage",   "--load-case", "--planets",    "--input", "--torque", "--speed",
    "--power", "--quality", "--addendum",  "--face-width", "--out",   "--force"};

// Rejects missing options of a datasheet, and options whose values a model states.
void check_new_options(const CLI::App& command, const NewOptions& options) {
    if (options.rexs.empty()) {
        if (options.kind.empty()) {
            throw CLI::ValidationError(
                "new: the kind of gearbox (planetary) or --rexs FILE is missing");
        }
        std::string missing;
        for (const char* name : {"--sun", "--planet", "--module"}) {
            if (command.count(name) == 0) {
                missing += (missing.empty() ? "" : ", ") + std::string(name);
            }
        }
        if (!missing.empty()) {
            throw CLI::ValidationError("new " + options.kind + ": missing: " + missing);
        }
        for (const char* name : {"--stage", "--load-case"}) {
            if (command.count(name) > 0) {
                throw CLI::ValidationError(name, "chooses a part of a model; give --rexs");
            }
        }
        return;
    }
    if (!options.kind.empty()) {
        throw CLI::ValidationError("kind", "the model's stage states the kind; leave out \"" +
                                               options.kind + "\" or --rexs");
    }
    for (const CLI::Option* option : command.parse_order()) {
        if (!kWithModel.contains(option->get_name())) {
            throw CLI::ValidationError(option->get_name(),
                                       "the model states this; leave it out, and change the model "
                                       "or the written study");
        }
    }
}

// Options that are given in addition to a model, as new_from_rexs() takes them.
nlohmann::json model_options(const CLI::App& command, const NewOptions& options) {
    const PlanetaryDatasheet& data = options.planetary;
    nlohmann::json given;
    for (const auto& [name, key, value] :
         {std::tuple{"--stage", "stage", nlohmann::json(options.stage)},
          std::tuple{"--load-case", "load_case", nlohmann::json(options.load_case)},
          std::tuple{"--input", "input", nlohmann::json(data.input)},
          std::tuple{"--planets", "planets", nlohmann::json(data.planets)},
          std::tuple{"--quality", "quality", nlohmann::json(data.quality.value_or(0))},
          std::tuple{"--addendum", "addendum", nlohmann::json(data.addendum.value_or(0))},
          std::tuple{"--face-width", "face_width_mm",
                     nlohmann::json(data.face_width_mm.value_or(0))},
          std::tuple{"--torque", "torque_N_m", nlohmann::json(data.torque_N_m.value_or(0))},
          std::tuple{"--speed", "speed_rpm", nlohmann::json(data.speed_rpm.value_or(0))},
          std::tuple{"--power", "power_kW", nlohmann::json(data.power_kW.value_or(0))}}) {
        if (command.count(name) > 0) {
            given[key] = value;
        }
    }
    return given;
}

int new_command(const CLI::App& command, const NewOptions& options) {
    const bool exists = options.out != "-" && std::filesystem::exists(options.out);
    if (exists && !options.force) {
        fmt::print(stderr, "--out {}: exists already; choose another file, or give --force\n",
                   options.out);
    }
    const bool writable = can_write({"--out", options.out}, {{"the model", options.rexs}}) &&
                          (!exists || options.force);
    const NewStudy made =
        options.rexs.empty()
            ? new_planetary(options.planetary, options.command)
            : new_from_rexs(options.rexs, model_options(command, options), options.command);
    print_problems(made.problems);
    if (!made.problems.empty() || !writable ||
        !write_text_to(options.out, schema_line() + made.text)) {
        return kBadInput;
    }
    print_problems(made.notices);
    warn_of_load(made, options.out);
    if (options.out != "-") {
        fmt::print(
            "{0}: check its values and replace those that you know, then\n"
            "  gearpod describe {0}\n  gearpod run {0}\n",
            options.out);
    }
    return kDone;
}

}  // namespace

void add_new(CLI::App& app, int& code) {
    const auto options = std::make_shared<NewOptions>();
    auto* command = app.add_subcommand("new",
                                       "write a commented study from a gearbox datasheet or from a "
                                       "stage of a REXS model (--rexs); missing values follow from "
                                       "rules of thumb with sources");
    PlanetaryDatasheet& data = options->planetary;
    command->add_option("kind", options->kind, "kind of gearbox; not with --rexs")
        ->check([](const std::string& kind) {
            return kind == "planetary" ? ""
                                       : "unknown kind of gearbox \"" + kind +
                                             "\"; write planetary, or give a model (--rexs)";
        })
        ->type_name("planetary");
    add_number(*command, "--sun", data.sun, "number of teeth of the sun");
    add_number(*command, "--planet", data.planet, "number of teeth of a planet");
    add_number(*command, "--ring", data.ring,
               "number of teeth of the ring (default: sun + 2 planet)");
    add_number(*command, "--planets", data.planets, "number of planets (default: 3)");
    add_number(*command, "--module", data.module_mm, "normal module, mm");
    add_number(*command, "--helix", data.helix_deg, "helix angle, degrees (default: 0)");
    add_number(*command, "--pressure-angle", data.pressure_angle_deg,
               "normal pressure angle, degrees (default: 20)");
    add_number(*command, "--face-width", data.face_width_mm,
               "face width, mm (default: four circular pitches)");
    add_number(*command, "--addendum", data.addendum,
               "addendum divided by the module (default: 1)");
    add_number(*command, "--sun-shift", data.sun_shift, "profile shift coefficient of the sun");
    add_number(*command, "--planet-shift", data.planet_shift,
               "profile shift coefficient of the planets");
    add_number(*command, "--ring-shift", data.ring_shift,
               "profile shift coefficient of the ring; positive: thicker teeth (ISO "
               "21771)");
    add_number(*command, "--centre-distance", data.centre_distance_mm,
               "centre distance of sun and planets, mm (default: from the shifts)");
    const std::string tip = "tip circle diameter, mm (default: from addendum and shift)";
    add_number(*command, "--sun-tip", data.sun_tip_mm, tip);
    add_number(*command, "--planet-tip", data.planet_tip_mm, tip);
    add_number(*command, "--ring-tip", data.ring_tip_mm, tip);
    add_number(*command, "--quality", data.quality, "ISO 1328 grade of the teeth (default: 6)");
    command->add_option("--input", data.input, "driving member (default: sun); the ring is fixed")
        ->check(CLI::IsMember({"sun", "carrier"}));
    add_number(*command, "--torque", data.torque_N_m, "input torque, N m");
    add_number(*command, "--speed", data.speed_rpm, "input speed, rpm");
    add_number(*command, "--power", data.power_kW, "power, kW, instead of torque or speed");
    add_file(*command, "--rexs", options->rexs,
             "gear-unit model to read instead (REXS 1.0 to 1.6, XML): "
             "a planetary or cylindrical stage");
    command->add_option("--stage", options->stage,
                        "id of the model's stage; needed if it has several");
    command->add_option("--load-case", options->load_case,
                        "id of the model's load case; needed if it has several");
    add_file(*command, "--out", options->out,
             "study file to write (default: - for standard output)");
    command->add_flag("--force", options->force, "overwrite an existing file");
    command->callback([command, options, &code] {
        check_new_options(*command, *options);
        options->command = options->kind.empty() ? "new" : "new " + options->kind;
        for (const CLI::Option* option : command->parse_order()) {
            if (option->nonpositional() && !option->check_lname("out") &&
                !option->check_lname("force")) {
                options->command += " " + option->get_name() + " " + option->results().front();
            }
        }
        code = new_command(*command, *options);
    });
}

}  // namespace gearpod::mc
