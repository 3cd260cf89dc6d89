// Train of planetary stages and gear pairs: a study for each stage, and in that of the monitored
// stage the others with their shafts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <tuple>

#include "gears/planetary.hpp"
#include "mc/files/input/document.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/study_text.hpp"
#include "signals/noise/coloured_noise.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kCommand = "new train";

// Speeds and shafts of a stage. The ring of a planetary one is fixed.
struct StageFlow {
    std::string input, output;                      // members
    double output_turns_per_turn, meshes_per_turn;  // of the input
};
StageFlow flow_of(const TrainStage& stage) {
    if (const auto* pair = std::get_if<PairDatasheet>(&stage.gears)) {
        return {"pinion", "gear", 1.0 * pair->pinion / pair->gear, 1.0 * pair->pinion};
    }
    const auto& data = std::get<PlanetaryDatasheet>(stage.gears);
    const gears::PowerFlow flow{Member::ring,
                                data.input == "carrier" ? Member::carrier : Member::sun};
    const gears::PlanetaryTrain train{data.sun, data.planet, ring_teeth(data), data.planets};
    const gears::Speeds speeds = gears::train_speeds(train, flow.fixed, flow.input, 1.0);
    const Member output = gears::output_member(flow);
    return {data.input, std::string(member_name(output)), gears::speed_of(speeds, output),
            gears::mesh_frequency(train, speeds)};
}

// Names of the values of a --stage in problems.
DatasheetSource source_of(std::size_t number) {
    DatasheetSource source = planetary_options();
    source.file = kCommand;
    for (auto& [key, name] : source.keys) {
        if (name != "--quality" && name != "--torque") {
            name = fmt::format("{} in --stage {}", name.substr(2), number);
        }
    }
    for (const char* gear : {"sun", "planet", "ring", "pinion", "gear"}) {
        source.keys[fmt::format("gearbox.{}.teeth", gear)] =
            fmt::format("teeth in --stage {}", number);
    }
    source.meshing_remedy = "correct its teeth, or give addendum= in the stage";
    return source;
}

// Elements of sensor.stages, from the monitored stage outwards. `study`: key and value that name
// the study of a stage.
std::string stages_line(const TrainDatasheet& train, double gain,
                        const std::function<std::string(std::size_t)>& study) {
    std::string text = "stages = [\n";
    for (const auto& [nearer, stage, shaft, stage_shaft] : train.shafts) {
        text += fmt::format(
            "    {{ name = \"{}\", {}, {}shaft = \"{}\", stage_shaft = \"{}\", gain = {:.4g} "
            "}},\n",
            train.stages[stage].name, study(stage),
            nearer == train.monitored ? ""
                                      : fmt::format("of = \"{}\", ", train.stages[nearer].name),
            shaft, stage_shaft, gain);
    }
    return text + "]\n";
}

// Speeds, torques and shafts of stages that follow each other.
void follow_power(TrainDatasheet& train, InputLoad load) {
    const std::size_t count = train.stages.size();
    std::vector<StageFlow> flows;
    for (std::size_t i = 0; i < count; ++i) {
        StageDatasheet& data = train.stages[i].data();
        flows.push_back(flow_of(train.stages[i]));
        std::tie(data.torque_N_m, data.speed_rpm) = std::tuple{load.torque_N_m, load.speed_rpm};
        data.around.place = fmt::format("stage {} of {}", i + 1, count);
        load = {load.torque_N_m / flows[i].output_turns_per_turn,
                load.speed_rpm * flows[i].output_turns_per_turn};
    }
    for (std::size_t i = train.monitored; i + 1 < count; ++i) {
        train.shafts.push_back({i, i + 1, flows[i].output, flows[i + 1].input});
    }
    for (std::size_t i = train.monitored; i > 0; --i) {
        train.shafts.push_back({i, i - 1, flows[i].input, flows[i - 1].output});
    }
}

// The parts of a measured level beside the monitored stage: the other stages have one gain of at
// most 1, and the background is the rest. Where the others alone would exceed it, the
// background has the chosen density, or half of the mean square if that is less.
struct Rest {
    double gain = 1.0;
    double background_m_s2 = 0.0;
    bool measured = true;
};
Rest rest_of(double level, double monitored, double others, double bandwidth_Hz) {
    const double square = level * level - monitored * monitored,
                 chosen = std::min(kChosenDensity * kChosenDensity * bandwidth_Hz, 0.5 * square);
    if (square - others * others >= chosen) {
        return {1.0, std::sqrt(square - others * others), true};
    }
    return {std::sqrt(square - chosen) / others, std::sqrt(chosen), false};
}

// Divides a measured level among the monitored stage, the others and the background. Returns the
// gain of the other stages.
double divide_level(TrainDatasheet& train, const std::vector<NewStudy>& studies,
                    const StageLevel& level_of, Problems& problems) {
    StageDatasheet& monitored = train.stages[train.monitored].data();
    const double level = *train.level_m_s2, low_pass_Hz = *monitored.around.low_pass_Hz;
    double alone = 0.0, others = 0.0;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        double& part = i == train.monitored ? alone : others;
        // 1.5 turns of the carrier are at least three of a planet, the shortest record.
        const bool planetary = std::holds_alternative<PlanetaryDatasheet>(train.stages[i].gears);
        part =
            std::hypot(part, level_of(studies[i].text, planetary ? "sensor.record_turns=1.5" : ""));
    }
    if (!(alone < level)) {
        problems.push_back(
            {kCommand, 0, "--level",
             fmt::format("{:.3g} m/s^2 is less than the monitored stage alone has below {:g} Hz, "
                         "{:.3g} m/s^2",
                         level, low_pass_Hz, alone),
             "compare the band, the load and the tooth quality of the measurement, or set "
             "sensor.gain in a study without --level"});
        return 1.0;
    }
    const double bandwidth_Hz = signals::low_pass_noise_bandwidth_Hz(low_pass_Hz);
    const Rest rest = rest_of(level, alone, others, bandwidth_Hz);
    monitored.around.density = rest.background_m_s2 / std::sqrt(bandwidth_Hz);
    monitored.around.measured = rest.measured;
    monitored.notes.push_back(fmt::format(
        "Measured level: {:g} m/s^2 rms below {:g} Hz. Healthy gearboxes of this stage alone have "
        "{:.3g} m/s^2, the other stages together {:.3g} at their own sensors, here times the gain "
        "{:.3g}. The background has {:.3g} m/s^2.",
        level, low_pass_Hz, alone, others, rest.gain, rest.background_m_s2));
    return rest.gain;
}

}  // namespace

StageDatasheet& TrainStage::data() {
    return std::visit([](auto& data) -> StageDatasheet& { return data; }, gears);
}

NewStudy new_stage(const TrainStage& stage, const std::string& command) {
    if (const auto* pair = std::get_if<PairDatasheet>(&stage.gears)) {
        return new_pair(*pair, command, stage.source);
    }
    return new_planetary(std::get<PlanetaryDatasheet>(stage.gears), command, stage.source);
}

TrainStage read_train_stage(const std::string& text, std::size_t number, Problems& problems) {
    const auto reject = [&](const std::string& what, const std::string& remedy) {
        problems.push_back({kCommand, 0, fmt::format("--stage {}", number), what, remedy});
    };
    std::istringstream words(text);
    std::string word;
    std::vector<int> teeth;
    words >> word;
    std::istringstream numbers(word);
    for (std::string part; std::getline(numbers, part, '/');) {
        teeth.push_back(parsed_number<int>(part).value_or(0));
    }
    TrainStage stage{{}, source_of(number), fmt::format("stage-{}", number)};
    if ((teeth.size() != 2 && teeth.size() != 3) || std::ranges::min(teeth) < 1) {
        reject("\"" + word + "\" is not a list of tooth numbers",
               "write sun/planet/ring, or driving/driven gear of a pair");
        return stage;
    }
    PlanetaryDatasheet* planetary = nullptr;
    if (teeth.size() == 2) {
        PairDatasheet& pair = stage.gears.emplace<PairDatasheet>();
        std::tie(pair.pinion, pair.gear) = std::tuple{teeth[0], teeth[1]};
    } else {
        planetary = &stage.gears.emplace<PlanetaryDatasheet>();
        std::tie(planetary->sun, planetary->planet, planetary->ring) =
            std::tuple{teeth[0], teeth[1], teeth[2]};
        planetary->input = "carrier";
    }
    StageDatasheet& data = stage.data();
    const std::map<std::string, std::function<void(double)>> values{
        {"module", [&](double value) { data.module_mm = value; }},
        {"helix", [&](double value) { data.helix_deg = value; }},
        {"pressure-angle", [&](double value) { data.pressure_angle_deg = value; }},
        {"face-width", [&](double value) { data.face_width_mm = value; }},
        {"addendum", [&](double value) { data.addendum = value; }},
        {"quality", [&](double value) { data.quality = value; }}};
    while (words >> word) {
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals),
                          value = equals == std::string::npos ? "" : word.substr(equals + 1);
        const auto found = values.find(name);
        if (planetary != nullptr && name == "input" && (value == "sun" || value == "carrier")) {
            planetary->input = value;
        } else if (planetary != nullptr && name == "planets" &&
                   number_problem(value, NumberForm::whole, from_to(2, 8)).empty()) {
            planetary->planets = static_cast<int>(whole_number(value));
        } else if (found == values.end()) {
            reject("\"" + word + "\" is not understood",
                   std::string("write module=, helix=, pressure-angle=, face-width=, addendum=, "
                               "quality=") +
                       (planetary != nullptr ? ", planets=2 to 8, input=carrier or sun" : ""));
        } else if (const std::string problem = number_problem(value, NumberForm::real, {});
                   !problem.empty()) {
            reject(name + ": " + problem, "");
        } else {
            found->second(real_number(value));
        }
    }
    if (!(data.module_mm > 0.0)) {
        reject("module= is missing or not above 0", "add the normal module in mm");
    }
    return stage;
}

std::vector<std::string> train_files(const TrainDatasheet& train) {
    const std::filesystem::path path(train.file);
    std::vector<std::string> files;
    for (std::size_t i = 0; i < train.stages.size(); ++i) {
        const std::string name = fmt::format("{}-{}{}", path.stem().string(), train.stages[i].name,
                                             path.extension().string());
        files.push_back(i == train.monitored ? train.file : (path.parent_path() / name).string());
    }
    return files;
}

NewTrain new_train(TrainDatasheet train, const std::string& command, const StageLevel& level_of) {
    NewTrain made;
    Problems& problems = made.problems;
    if (train.shafts.empty()) {
        problems = load_problems(train.load, {kCommand, {}, ""}, "first stage's input");
        follow_power(train, problems.empty() ? load_of(train.load) : InputLoad{1.0, 1.0});
    }
    for (const TrainShaft& shaft : train.shafts) {
        const bool drives = flow_of(train.stages[shaft.nearer]).output == shaft.shaft;
        if (drives != (flow_of(train.stages[shaft.stage]).input == shaft.stage_shaft)) {
            problems.push_back({train.stages[shaft.stage].source.file, 0, "",
                                "the power flow branches or joins at a shaft between two stages, "
                                "and the torque of each branch is not known",
                                "write the stages' studies one by one, and list them in "
                                "sensor.stages"});
        }
    }
    TrainStage& stage = train.stages[train.monitored];
    const double meshes_Hz =
        flow_of(stage).meshes_per_turn * load_of(stage.data()).speed_rpm / 60.0;
    if (!train.low_pass_Hz) {
        train.low_pass_Hz = new_sensor(stage.data(), meshes_Hz).rates.low_pass;
    } else if (!(*train.low_pass_Hz > meshes_Hz) && problems.empty()) {
        problems.push_back(
            {kCommand, 0, "--band",
             fmt::format("{:g} Hz is below the monitored stage's mesh frequency, {:.4g} Hz",
                         *train.low_pass_Hz, meshes_Hz),
             "give the upper end of a wider band"});
    }
    std::vector<NewStudy> studies;
    for (TrainStage& next : train.stages) {
        next.data().quality = next.data().quality ? next.data().quality : train.load.quality;
        next.data().around.low_pass_Hz = train.low_pass_Hz;
        studies.push_back(new_stage(next, command));
        std::ranges::move(studies.back().problems, std::back_inserter(problems));
    }
    if (!problems.empty()) {
        return made;
    }
    const double gain = train.level_m_s2 ? divide_level(train, studies, level_of, problems) : 1.0;
    if (!problems.empty()) {
        return made;
    }
    const std::vector<std::string> files = train_files(train);
    // The study is checked with the texts of the other stages, and written with their files.
    const auto with_text = [&](std::size_t i) { return "text = " + quoted_text(studies[i].text); };
    const auto with_file = [&](std::size_t i) {
        return "study = " + quoted_text(std::filesystem::path(files[i]).filename().string());
    };
    std::string& stages = stage.data().around.stages;
    stages = stages_line(train, gain, with_text);
    NewStudy& monitored = studies[train.monitored];
    monitored = new_stage(stage, command);
    if (!monitored.problems.empty()) {
        problems = monitored.problems;
        return made;
    }
    monitored.text.replace(monitored.text.find(stages), stages.size(),
                           stages_line(train, gain, with_file));
    for (std::size_t i = 0; i < studies.size(); ++i) {
        made.studies.emplace_back(files[i], std::move(studies[i].text));
    }
    return made;
}

}  // namespace gearpod::mc
