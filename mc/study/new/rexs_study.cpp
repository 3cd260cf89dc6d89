#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "mc/files/child_process.hpp"
#include "mc/study/new/datasheet.hpp"
#include "python_sources.hpp"

namespace gearpod::mc {
namespace {

// Problems as rexs.py lists them: line, key, what is wrong, remedy.
Problems problems_in(const nlohmann::json& list, const std::string& file) {
    Problems problems;
    for (const nlohmann::json& one : list) {
        problems.push_back({file, one.at(0), one.at(1), one.at(2), one.at(3)});
    }
    return problems;
}

// Sets a value if the model gives it.
template <class T>
void take(const nlohmann::json& values, const char* name, T& value) {
    if (values.contains(name)) {
        values.at(name).get_to(value);
    }
}
template <class T>
void take(const nlohmann::json& values, const char* name, std::optional<T>& value) {
    if (values.contains(name)) {
        value = values.at(name).get<T>();
    }
}

void take_stage(const nlohmann::json& reply, StageDatasheet& data) {
    const nlohmann::json& values = reply.at("values");
    take(values, "module_mm", data.module_mm);
    take(values, "helix_deg", data.helix_deg);
    take(values, "pressure_angle_deg", data.pressure_angle_deg);
    take(values, "face_width_mm", data.face_width_mm);
    take(values, "addendum", data.addendum);
    take(values, "centre_distance_mm", data.centre_distance_mm);
    take(values, "young_modulus_Pa", data.young_modulus_Pa);
    take(values, "poisson_ratio", data.poisson_ratio);
    take(values, "quality", data.quality);
    take(values, "torque_N_m", data.torque_N_m);
    take(values, "speed_rpm", data.speed_rpm);
    take(values, "power_kW", data.power_kW);
    data.origin = "REXS model";
    reply.at("notes").get_to(data.notes);
}

PairDatasheet pair_datasheet(const nlohmann::json& reply) {
    const nlohmann::json& values = reply.at("values");
    PairDatasheet data;
    take_stage(reply, data);
    take(values, "pinion", data.pinion);
    take(values, "gear", data.gear);
    take(values, "pinion_shift", data.pinion_shift);
    take(values, "gear_shift", data.gear_shift);
    take(values, "pinion_tip_mm", data.pinion_tip_mm);
    take(values, "gear_tip_mm", data.gear_tip_mm);
    take(values, "pinion_bearing_N_m", data.pinion_bearing_N_m);
    take(values, "gear_bearing_N_m", data.gear_bearing_N_m);
    return data;
}

PlanetaryDatasheet planetary_datasheet(const nlohmann::json& reply) {
    const nlohmann::json& values = reply.at("values");
    PlanetaryDatasheet data;
    take_stage(reply, data);
    take(values, "sun", data.sun);
    take(values, "planet", data.planet);
    take(values, "ring", data.ring);
    take(values, "planets", data.planets);
    take(values, "input", data.input);
    for (const auto& [member, shift, tip, bearing] :
         {std::tuple{"sun", &data.sun_shift, &data.sun_tip_mm, &data.sun_bearing_N_m},
          std::tuple{"planet", &data.planet_shift, &data.planet_tip_mm, &data.planet_bearing_N_m},
          std::tuple{"ring", &data.ring_shift, &data.ring_tip_mm, &data.ring_bearing_N_m}}) {
        const std::string name = member;
        take(values, (name + "_shift").c_str(), *shift);
        take(values, (name + "_tip_mm").c_str(), *tip);
        take(values, (name + "_bearing_N_m").c_str(), *bearing);
    }
    take(values, "carrier_bearing_N_m", data.carrier_bearing_N_m);
    return data;
}

// A stage of a model; `neighbours` as rexs.py lists them.
struct RexsStage {
    TrainStage stage;
    Problems problems, notices;
    nlohmann::json neighbours;
    std::string id;
};

RexsStage read_stage(const std::string& path, nlohmann::json options) {
    options["name"] = std::filesystem::path(path).filename().string();
    nlohmann::json reply;
    try {
        // -I: ignore the modules of the user and of the working directory; -B: write no files.
        const PythonOutput output =
            run_python({"-IB", "-c", kRexsSource, path},
                       options.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
        if (output.status != 0) {
            throw PythonError(fmt::format("cannot be read: {} {}", python_interpreter(),
                                          ended_text(output.status)));
        }
        reply = nlohmann::json::parse(output.text);
    } catch (const PythonError& error) {
        return {{}, {{path, 0, "", error.what(), ""}}, {}, {}, {}};
    }
    RexsStage read{{}, problems_in(reply.at("problems"), path), {}, {}, {}};
    if (!read.problems.empty()) {
        return read;
    }
    DatasheetSource& source = read.stage.source;
    source = planetary_options();
    source.file = path;
    for (const auto& [key, value] : reply.at("names").items()) {
        source.keys[key] = value;
    }
    source.meshing_remedy =
        "correct the model's tip diameters, shifts or centre distance, or give --addendum";
    if (reply.at("kind") == "planetary") {
        read.stage.gears = planetary_datasheet(reply);
    } else {
        read.stage.gears = pair_datasheet(reply);
    }
    read.notices = problems_in(reply.at("notices"), path);
    read.neighbours = reply.at("neighbours");
    read.id = reply.at("id");
    return read;
}

}  // namespace

NewStudy new_from_rexs(const std::string& path, const nlohmann::json& options,
                       const std::string& command) {
    RexsStage read = read_stage(path, options);
    NewStudy made{"", std::move(read.problems)};
    if (made.problems.empty()) {
        made = new_stage(read.stage, command);
        made.notices = made.problems.empty() ? std::move(read.notices) : Problems{};
    }
    sort_problems(made.problems);
    return made;
}

TrainDatasheet train_from_rexs(const std::string& path, nlohmann::json options, NewTrain& made) {
    TrainDatasheet train;
    std::map<std::string, std::size_t> numbers;
    const auto add = [&] {
        RexsStage read = read_stage(path, options);
        std::ranges::move(read.problems, std::back_inserter(made.problems));
        std::ranges::move(read.notices, std::back_inserter(made.notices));
        read.stage.name = "stage-" + read.id;
        read.stage.data().around.place =
            fmt::format("stage {} of {}", read.id, std::filesystem::path(path).filename().string());
        train.stages.push_back(std::move(read.stage));
        return read.neighbours;
    };
    options["train"] = true;
    const nlohmann::json neighbours = add();
    if (made.problems.empty() && neighbours.empty()) {
        made.problems.push_back({path, 0, "",
                                 "no shaft connects the stage with another that can be simulated",
                                 "leave out \"train\""});
    }
    options.erase("train");  // the neighbours of these are known
    for (const nlohmann::json& next : neighbours) {
        const auto [id, nearer, shaft, stage_shaft] =
            next.get<std::tuple<std::string, std::string, std::string, std::string>>();
        numbers[id] = train.stages.size();
        train.shafts.push_back({numbers[nearer], numbers[id], shaft, stage_shaft});
        options["stage"] = id;
        add();
    }
    sort_problems(made.problems);
    return train;
}

}  // namespace gearpod::mc
