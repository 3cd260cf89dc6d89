#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/library/open_study.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/report/page.hpp"
#include "mc/study/new/datasheet.hpp"

namespace gearpod::mc {
namespace {

struct NewOptions {
    std::string kind;     // "planetary" or "train"; empty for a stage of a REXS model
    std::string command;  // command line, quoted in the study's first comment
    PlanetaryDatasheet planetary;
    std::string rexs;                 // model file; empty: the datasheet's values are options
    std::vector<std::string> stages;  // of a train; one: id of the model's
    std::string load_case;            // of the model
    int monitored = 1;                // stage of a train, from 1
    std::optional<double> level_m_s2, band_Hz;
    std::string out = "-";  // "-": standard output
    bool force = false;     // overwrite a file
};

// Comment from which editors take the JSON schema of the study.
std::string schema_line() {
    const std::string schema = schema_path().string();
    return schema.empty() ? "" : "#:schema " + schema + "\n";
}

// Prints warnings of a torque that cannot be meant.
void warn_of_load(const std::string& text, const std::string& path) {
    const StudyReading reading = read_study_text(text, path);
    if (reading.study) {
        print_problems(load_warnings(*reading.study, path == "-" ? "the study" : path));
    }
}

// Options that a REXS model leaves open. It states all others.
const std::set<std::string> kWithModel{
    "--rexs",  "--stage",   "--load-case", "--planets",    "--input", "--torque", "--speed",
    "--power", "--quality", "--addendum",  "--face-width", "--out",   "--force"};
// Options of a train. Other values belong to a --stage or to a written study.
const std::set<std::string> kOfTrain{"--stage", "--monitor", "--torque",  "--speed", "--power",
                                     "--level", "--band",    "--quality", "--out",   "--force"};
// Options of a train of a model, whose loads are the model's.
const std::set<std::string> kOfModelTrain{"--rexs", "--stage",   "--load-case", "--level",
                                          "--band", "--quality", "--out",       "--force"};
// Options that a single planetary gearbox does not have.
const std::set<std::string> kNotOfPlanetary{"--stage", "--load-case", "--monitor", "--level",
                                            "--band"};

// Rejects missing options of a datasheet, and options that do not belong to its kind.
void check_new_options(const CLI::App& command, const NewOptions& options) {
    const bool model = !options.rexs.empty(), train = options.kind == "train";
    if (model && !train && !options.kind.empty()) {
        throw CLI::ValidationError("kind", "the model's stage states the kind; leave out \"" +
                                               options.kind + "\" or --rexs");
    }
    if (!model && options.kind.empty()) {
        throw CLI::ValidationError(
            "new: the kind of gearbox (planetary, train) or --rexs FILE is missing");
    }
    for (const CLI::Option* option : command.parse_order()) {
        const std::string name = option->get_name();
        if (model && option->nonpositional() &&
            !(train ? kOfModelTrain : kWithModel).contains(name)) {
            throw CLI::ValidationError(
                name, train ? "new train takes this from the model for all stages; leave it out, "
                              "and change the model or the written studies"
                            : "the model states this; leave it out, and change the model or the "
                              "written study");
        }
        if (train && !model && option->nonpositional() && !kOfTrain.contains(name)) {
            throw CLI::ValidationError(
                name,
                "belongs to one stage; write it in its --stage, or change the "
                "stage's written study");
        }
        if (!model && !train && kNotOfPlanetary.contains(name)) {
            throw CLI::ValidationError(name, "belongs to `new train` or a model (--rexs)");
        }
    }
    if (model && options.stages.size() > 1) {
        throw CLI::ValidationError("--stage", "choose one stage of the model");
    }
    using Names = std::vector<const char*>;
    const Names needed = train   ? (model ? Names{"--out"} : Names{"--stage", "--out"})
                         : model ? Names{}
                                 : Names{"--sun", "--planet", "--module"};
    std::string missing;
    for (const char* name : needed) {
        if (command.count(name) == 0) {
            missing += (missing.empty() ? "" : ", ") + std::string(name);
        }
    }
    if (!missing.empty()) {
        throw CLI::ValidationError("new " + options.kind + ": missing: " + missing);
    }
    if (train && options.out == "-") {
        throw CLI::ValidationError("--out",
                                   "name a file; the other stages' studies lie next to it");
    }
    if (train && options.level_m_s2 && !options.band_Hz) {
        throw CLI::ValidationError("--level", "needs --band, the upper end of its band");
    }
}

// Options that are given in addition to a model, as new_from_rexs() takes them.
nlohmann::json model_options(const CLI::App& command, const NewOptions& options) {
    const PlanetaryDatasheet& data = options.planetary;
    nlohmann::json given;
    for (const auto& [name, key, value] :
         {std::tuple{"--stage", "stage",
                     nlohmann::json(options.stages.empty() ? "" : options.stages.front())},
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

// Rms of a healthy gearbox of a study without noise over one turn of its planet or pinion: the root
// of the mean square of the first three that set thresholds.
double healthy_level(const std::string& text, const std::string& record) {
    constexpr long kGearboxes = 3;
    std::vector<std::string> overrides{"features.use=[\"change_sensor_rms\"]",
                                       "ensemble.instances=1",
                                       fmt::format("ensemble.threshold_instances={}", kGearboxes)};
    if (!record.empty()) {
        overrides.push_back(record);
    }
    OpenStudy study("new train", text, overrides);
    double squares = 0.0, samples = 0.0;
    for (long row = 1; row <= kGearboxes; ++row) {
        const Simulation simulation = simulate_row(study.plans().tile, study.plans().ensemble, row);
        const std::vector<double>& sensor =
            std::ranges::find(simulation.columns, "sensor", &SignalColumn::name)->values;
        squares = std::inner_product(sensor.begin(), sensor.end(), sensor.begin(), squares);
        samples += static_cast<double>(sensor.size());
    }
    return std::sqrt(squares / samples);
}

NewTrain made_train(const CLI::App& command, const NewOptions& options) {
    NewTrain made;
    TrainDatasheet train =
        options.rexs.empty() ? TrainDatasheet{}
                             : train_from_rexs(options.rexs, model_options(command, options), made);
    for (std::size_t i = 0; options.rexs.empty() && i < options.stages.size(); ++i) {
        train.stages.push_back(read_train_stage(options.stages[i], i + 1, made.problems));
    }
    if (train.stages.size() < 2 && made.problems.empty()) {
        made.problems.push_back({"new train", 0, "--stage", "a train has at least two stages",
                                 "give each in an option of its own, or use new planetary"});
    }
    if (options.monitored < 1 || options.monitored > std::ssize(train.stages)) {
        made.problems.push_back({"new train", 0, "--monitor",
                                 fmt::format("there is no stage {}", options.monitored),
                                 "give the number of a stage, from 1"});
    }
    if (!made.problems.empty()) {
        return made;
    }
    train.load = options.planetary;
    train.monitored = static_cast<std::size_t>(options.monitored - 1);
    train.low_pass_Hz = options.band_Hz;
    train.level_m_s2 = options.level_m_s2;
    train.file = options.out;
    for (const std::string& file : train_files(train)) {
        if (!options.force && std::filesystem::exists(file)) {
            made.problems.push_back(
                {file, 0, "--out", "exists already", "choose another file, or give --force"});
        }
    }
    if (!made.problems.empty()) {
        return made;
    }
    NewTrain written = new_train(std::move(train), options.command, healthy_level);
    written.notices = std::move(made.notices);
    return written;
}

// Studies with their files.
NewTrain made_studies(const CLI::App& command, const NewOptions& options) {
    if (options.kind == "train") {
        return made_train(command, options);
    }
    NewStudy made =
        options.rexs.empty()
            ? new_planetary(options.planetary, options.command)
            : new_from_rexs(options.rexs, model_options(command, options), options.command);
    return {
        {{options.out, std::move(made.text)}}, std::move(made.problems), std::move(made.notices)};
}

int new_command(const CLI::App& command, const NewOptions& options) {
    const NewTrain made = made_studies(command, options);
    print_problems(made.problems);
    bool good = made.problems.empty();
    for (const auto& [path, text] : made.studies) {
        const bool exists = path != "-" && std::filesystem::exists(path);
        if (exists && !options.force) {
            fmt::print(stderr, "--out {}: exists already; choose another file, or give --force\n",
                       path);
        }
        good = can_write({"--out", path}, {{"the model", options.rexs}}) &&
               (!exists || options.force) && good;
    }
    for (const auto& [path, text] : made.studies) {
        good = good && write_text_to(path, schema_line() + text);
    }
    if (!good) {
        return kBadInput;
    }
    print_problems(made.notices);
    for (const auto& [path, text] : made.studies) {
        warn_of_load(text, path);
    }
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
    auto* command =
        app.add_subcommand("new",
                           "write a commented study from a gearbox datasheet, from those "
                           "of a train's stages, or from a stage of a REXS model "
                           "(--rexs); missing values follow from rules of thumb with "
                           "sources");
    PlanetaryDatasheet& data = options->planetary;
    command->add_option("kind", options->kind, "kind of gearbox; not with --rexs")
        ->check([](const std::string& kind) {
            return kind == "planetary" || kind == "train"
                       ? ""
                       : "unknown kind of gearbox \"" + kind +
                             "\"; write planetary or train, or give a model (--rexs)";
        })
        ->type_name("planetary|train");
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
    command
        ->add_option("--stage", options->stages,
                     "stage of a train in the order of the power flow, \"SUN/PLANET/RING "
                     "module=MM\" or \"DRIVING/DRIVEN module=MM\", also with helix=, face-width=, "
                     "pressure-angle=, addendum=, quality=, planets=, input=sun; or id of the "
                     "model's stage, needed if it has several")
        ->type_name("TEXT")
        ->allow_extra_args(false);
    add_number(*command, "--monitor", options->monitored,
               "number of the train's stage with the fault and the sensor (default: 1)");
    add_number(*command, "--level", options->level_m_s2,
               "measured vibration of the whole train, m/s^2 rms below --band; scales the other "
               "stages and the background",
               above(0.0, "m/s^2"));
    add_number(*command, "--band", options->band_Hz,
               "upper end of the sensor's band, Hz (default: 20 times the monitored stage's mesh "
               "frequency, 10 kHz at most)",
               above(0.0, "Hz"));
    command->add_option("--load-case", options->load_case,
                        "id of the model's load case; needed if it has several");
    add_file(*command, "--out", options->out,
             "study file to write (default: - for standard output)");
    command->add_flag("--force", options->force, "overwrite an existing file");
    command->callback([command, options, &code] {
        check_new_options(*command, *options);
        options->command = options->kind.empty() ? "new" : "new " + options->kind;
        std::map<const CLI::Option*, std::size_t> seen;
        for (const CLI::Option* option : command->parse_order()) {
            if (option->nonpositional() && !option->check_lname("out") &&
                !option->check_lname("force")) {
                const std::string& value = option->results().at(seen[option]++);
                const char* const quote =
                    value.find_first_of(" \t\n") == std::string::npos ? "" : "\"";
                options->command +=
                    fmt::format(" {} {}{}{}", option->get_name(), quote, value, quote);
            }
        }
        code = new_command(*command, *options);
    });
}

}  // namespace gearpod::mc
