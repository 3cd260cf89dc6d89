#include "mc/study/new/rexs_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/pair.hpp"
#include "mc/study/new/planetary.hpp"
#include "mc/study/rexs/rexs_gear.hpp"
#include "mc/study/rexs/rexs_stages.hpp"

namespace gearpod::mc {

// Collects problems, notes and the values that a model lacks.
struct RexsReading {
    const RexsModel& model;
    RexsValues& values;
    Problems& problems;
    std::vector<std::string> notes;    // how values of the model are used
    std::vector<std::string> lacking;  // values that follow by rule

    void reject(const std::string& key, const std::string& what, const std::string& remedy) {
        problems.push_back({model.file, 0, key, what, remedy});
    }
    template <class T>
    void lacks(const std::optional<T>& value, const std::string& name) {
        if (!value) {
            lacking.push_back(name);
        }
    }
};

// Items joined by a separator.
std::string list_of(const std::vector<std::string>& items, const char* separator = ", ");

// Sets torque, speed and power: given ones, completed by the model's.
void set_load(StageDatasheet& data, const RexsLoad& load, const RexsChoices& choices,
              RexsReading& reading);

// Sets the values that all gears share.
void set_teeth(StageDatasheet& data, const RexsTeeth& teeth, const RexsChoices& choices,
               RexsReading& reading);

// Names of values for messages: attributes of the model, else options. name_gear() adds those of
// one gear under the name that it has in a study.
DatasheetSource model_source(const RexsModel& model, const RexsStage& stage);
void name_gear(DatasheetSource& source, const std::string& member, const RexsGear& gear);

// Adds the notes to the datasheet. Returns them as notices for the user.
Problems finish(StageDatasheet& data, const RexsModel& model, const RexsStage& stage,
                RexsReading& reading);

std::string list_of(const std::vector<std::string>& items, const char* separator) {
    std::string list;
    for (const std::string& item : items) {
        list += (list.empty() ? "" : separator) + item;
    }
    return list;
}

void set_load(StageDatasheet& data, const RexsLoad& load, const RexsChoices& choices,
              RexsReading& reading) {
    data.torque_N_m = choices.torque_N_m;
    data.speed_rpm = choices.speed_rpm;
    data.power_kW = choices.power_kW;
    const auto given = [&] {
        return int{data.torque_N_m.has_value()} + int{data.speed_rpm.has_value()} +
               int{data.power_kW.has_value()};
    };
    if (given() < 2 && !data.speed_rpm && load.speed_rpm) {
        data.speed_rpm = load.speed_rpm;
    }
    if (given() < 2 && !data.torque_N_m && load.torque_N_m) {
        data.torque_N_m = load.torque_N_m;
    }
    if (given() < 2) {
        reading.reject("--torque, --speed, --power",
                       load.torque_N_m  ? "the model states a torque, but no speed of the stage"
                       : load.speed_rpm ? "the model states a speed, but no torque of the stage"
                                        : "the model states neither torque nor speed of the stage",
                       load.torque_N_m  ? "give --speed or --power"
                       : load.speed_rpm ? "give --torque or --power"
                                        : "give two of the three, for the driving member");
        return;
    }
    for (const auto& [name, used, stated] :
         {std::tuple{"torque of {:.6g} N m", data.torque_N_m, load.torque_N_m},
          std::tuple{"speed of {:.6g} rpm", data.speed_rpm, load.speed_rpm}}) {
        if (stated && used != stated) {
            reading.notes.push_back(fmt::format("an option replaces the model's {}",
                                                fmt::format(fmt::runtime(name), *stated)));
        }
    }
}

void name_gear(DatasheetSource& source, const std::string& member, const RexsGear& gear) {
    const std::string label = gear.component->label();
    source.keys["gearbox." + member + "_teeth"] = label + ": number_of_teeth";
    source.keys["gearbox." + member + "_shift"] = label + ": addendum_modification_coefficient";
    source.keys["gearbox." + member + "_tip_mm"] = label + ": tip_diameter";
}

DatasheetSource model_source(const RexsModel& model, const RexsStage& stage) {
    DatasheetSource source = planetary_options();
    source.file = model.file;
    const std::string label = stage.component->label();
    for (const auto& [key, attribute] :
         {std::pair{"normal_module_mm", "normal_module"}, std::pair{"module_mm", "normal_module"},
          std::pair{"helix_angle_deg", "helix_angle_reference_diameter"},
          std::pair{"pressure_angle_deg", "normal_pressure_angle"},
          std::pair{"face_width_mm", "face_width"},
          std::pair{"young_modulus_Pa", "elastic_modulus"},
          std::pair{"poisson_ratio", "poisson_ratio"},
          std::pair{"centre_distance_mm", "center_distance"}}) {
        source.keys[std::string("gearbox.") + key] = label + ": " + attribute;
    }
    source.keys["operation.pinion_speed_rpm"] = "--speed";
    source.meshing_remedy =
        "correct the model's tip diameters, shifts or centre distance, or give "
        "--addendum";
    return source;
}

void set_teeth(StageDatasheet& data, const RexsTeeth& teeth, const RexsChoices& choices,
               RexsReading& reading) {
    data.module_mm = teeth.module_mm.value_or(0.0);
    data.pressure_angle_deg = teeth.pressure_angle_deg.value_or(data.pressure_angle_deg);
    data.helix_deg = teeth.helix_deg.value_or(data.helix_deg);
    data.face_width_mm = choices.face_width_mm ? choices.face_width_mm : teeth.face_width_mm;
    data.centre_distance_mm = teeth.centre_distance_mm;
    data.young_modulus_Pa = teeth.young_modulus_Pa;
    data.poisson_ratio = teeth.poisson_ratio;
    data.addendum = choices.addendum;
    data.quality = choices.quality.value_or(data.quality);
    reading.lacks(teeth.pressure_angle_deg, "normal pressure angle (20 deg)");
    reading.lacks(teeth.helix_deg, "helix angle (0 deg)");
    reading.lacks(data.face_width_mm, "face width");
    reading.lacks(teeth.centre_distance_mm, "centre distance");
    reading.lacks(teeth.young_modulus_Pa, "Young's modulus");
    reading.lacks(teeth.poisson_ratio, "Poisson's ratio");
    reading.lacks(choices.quality, "tooth quality");
    reading.notes.insert(reading.notes.end(), teeth.notes.begin(), teeth.notes.end());
    if (choices.face_width_mm && teeth.face_width_mm) {
        reading.notes.push_back(fmt::format("an option replaces the model's face width of {:g} mm",
                                            *teeth.face_width_mm));
    }
}

Problems finish(StageDatasheet& data, const RexsModel& model, const RexsStage& stage,
                RexsReading& reading) {
    std::vector<std::string>& lacking = reading.lacking;
    for (const char* rule : {"gear bodies, masses and inertias", "damping", "sensor and noise"}) {
        lacking.emplace_back(rule);
    }
    data.origin = "REXS model";
    data.notes.push_back(fmt::format("Stage {} of {} (REXS {}).", stage.description(),
                                     std::filesystem::path(model.file).filename().string(),
                                     model.version));
    Problems notices = model.notices;
    for (const std::string& note : reading.notes) {
        data.notes.push_back(note);
        notices.push_back({model.file, 0, "", note, ""});
    }
    const std::string by_rule = "not in the model, by rule or chosen: " + list_of(lacking);
    data.notes.push_back("N" + by_rule.substr(1));
    notices.push_back({model.file, 0, "", by_rule, ""});
    for (const std::string& unused : reading.values.unused()) {
        data.notes.push_back("Not taken from the model: " + unused);
        notices.push_back({model.file, 0, "", "not taken from the model: " + unused, ""});
    }
    return notices;
}

namespace {

// Stage with that id, or the only one that is possible. Null after a problem that lists all.
const RexsStage* chosen_stage(const std::vector<RexsStage>& stages, const std::string& id,
                              RexsReading& reading) {
    std::vector<std::string> descriptions;
    const RexsStage* only = nullptr;
    int possible = 0;
    for (const RexsStage& stage : stages) {
        descriptions.push_back(stage.description());
        if (id.empty() ? stage.obstacle.empty() : stage.component->id == id) {
            only = &stage;
            ++possible;
        }
    }
    const std::string list = "the model has " + list_of(descriptions, "; ");
    if (stages.empty()) {
        reading.reject("", "has no gear stages",
                       "name a model with a planetary or cylindrical stage");
    } else if (possible == 0) {
        reading.reject("--stage",
                       id.empty() ? "no stage of the model can be simulated"
                                  : fmt::format("there is no stage {}", id),
                       list);
    } else if (possible > 1) {
        reading.reject("--stage", fmt::format("the model has {} stages", stages.size()),
                       "choose one: " + list_of(descriptions, "; "));
    } else if (!only->obstacle.empty()) {
        reading.reject("--stage", fmt::format("stage {} is not possible: {}", id, only->obstacle),
                       list);
    } else {
        return only;
    }
    return nullptr;
}

// Applies the chosen load case, or the only one.
void apply_load_case(RexsModel& model, const std::string& id, Problems& problems,
                     std::vector<std::string>& notes) {
    std::vector<std::string> ids;
    const RexsLoadCase* chosen = nullptr;
    for (const RexsLoadCase& load_case : model.load_cases) {
        ids.push_back(load_case.id);
        if (load_case.id == id || (id.empty() && model.load_cases.size() == 1)) {
            chosen = &load_case;
        }
    }
    if (chosen != nullptr) {
        notes.push_back("load case " + chosen->id);
        model.apply(*chosen);
    } else if (!id.empty()) {
        problems.push_back({model.file, 0, "--load-case",
                            fmt::format("the model has no load case {}", id),
                            ids.empty() ? "it has none" : "it has " + list_of(ids)});
    } else if (!ids.empty()) {
        problems.push_back({model.file, 0, "--load-case",
                            fmt::format("the model has {} load cases", ids.size()),
                            "choose one: " + list_of(ids)});
    }
}

struct NamedGear {
    const char* name;
    const RexsGear& gear;
};

// Sets the load and writes the study by `make`, or returns the problems.
template <class Datasheet, class Make>
NewStudy study_of(Datasheet& data, std::initializer_list<NamedGear> gears, const RexsLoad& load,
                  const RexsStage& stage, const RexsChoices& choices, RexsReading& reading,
                  Make make) {
    set_load(data, load, choices, reading);
    if (!reading.problems.empty()) {
        return {"", reading.problems};
    }
    DatasheetSource source = model_source(reading.model, stage);
    for (const NamedGear& named : gears) {
        name_gear(source, named.name, named.gear);
    }
    Problems notices = finish(data, reading.model, stage, reading);
    NewStudy made = make(source);
    made.notices = made.problems.empty() ? std::move(notices) : Problems{};
    return made;
}

// Number of planets: chosen, stated or modelled.
int planets_of(const RexsStage& stage, const RexsChoices& choices, RexsReading& reading) {
    const int modelled = static_cast<int>(stage.planets.size());
    const std::optional<int> stated = reading.values.count(*stage.component, "number_of_planets");
    if (stated && modelled > 1 && *stated != modelled) {
        reading.values.reject(
            *stage.component, "number_of_planets",
            fmt::format("is {}, but the model has {} planet gears", *stated, modelled),
            "correct one of them");
    }
    constexpr int kUsual = 3;
    if (modelled == 1 && !stated && !choices.planets) {
        reading.lacking.emplace_back("number of planets (3; the model has one planet gear)");
    }
    const int here = stated.value_or(modelled == 1 ? kUsual : modelled);
    if (choices.planets && *choices.planets != here && modelled > 1) {
        reading.notes.push_back(
            fmt::format("an option replaces the model's number of planets, {}", here));
    }
    return choices.planets.value_or(here);
}

// Notes planets that the model does not space equally.
void note_positions(const RexsStage& stage, RexsReading& reading) {
    constexpr double kSame_deg = 0.5, kTurn_deg = 360.0;
    std::vector<double> angles;
    for (const RexsComponent* pair : stage.first_pairs) {
        if (const auto angle = reading.values.number(*pair, "rotating_angle_around_neg_u_axis",
                                                     RexsQuantity::angle)) {
            angles.push_back(std::fmod(std::fmod(*angle, kTurn_deg) + kTurn_deg, kTurn_deg));
        }
    }
    std::ranges::sort(angles);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double equal =
            angles[0] + kTurn_deg * static_cast<double>(i) / static_cast<double>(angles.size());
        if (std::abs(angles[i] - equal) > kSame_deg) {
            std::vector<std::string> list;
            for (const double angle : angles) {
                list.push_back(fmt::format("{:.4g}", angle - angles[0]));
            }
            reading.notes.push_back(
                "planets at " + list_of(list) +
                " deg; the study spaces them equally or as nearly as the teeth allow "
                "(gearbox.planet_positions_deg)");
            return;
        }
    }
}

NewStudy planetary_study(const RexsStage& stage, const std::vector<RexsStage>& stages,
                         const RexsChoices& choices, const std::string& command,
                         RexsReading& reading) {
    RexsValues& values = reading.values;
    const RexsModel& model = reading.model;
    const RexsGear sun = rexs_gear(values, {stage.first}),
                   planet = rexs_gear(values, stage.planets),
                   ring = rexs_gear(values, {stage.second});
    const RexsTeeth teeth = rexs_teeth(values, stage, {sun, planet, ring});
    check_centre_distance(values, *stage.first_pairs.front(), teeth, sun, planet, false,
                          reading.notes);
    check_centre_distance(values, *stage.second_pairs.front(), teeth, planet, ring, true,
                          reading.notes);
    if (const std::string why = why_ring_turns(values, stage); !why.empty()) {
        reading.reject(stage.component->label(), "the ring is not the fixed member: " + why,
                       "new writes studies with a fixed ring; edit operation.fixed in one");
    }
    PlanetaryDatasheet data;
    set_teeth(data, teeth, choices, reading);
    data.sun = sun.teeth;
    data.planet = planet.teeth;
    data.ring = ring.teeth;
    data.planets = planets_of(stage, choices, reading);
    note_positions(stage, reading);
    std::tie(data.sun_shift, data.planet_shift, data.ring_shift) =
        std::tie(sun.shift, planet.shift, ring.shift);
    std::tie(data.sun_tip_mm, data.planet_tip_mm, data.ring_tip_mm) =
        std::tie(sun.tip_mm, planet.tip_mm, ring.tip_mm);
    reading.lacks(sun.shift, "sun's shift");
    reading.lacks(planet.shift, "planets' shift");
    reading.lacks(ring.shift, "ring's shift");
    reading.lacks(sun.tip_mm, "sun's tip circle");
    reading.lacks(planet.tip_mm, "planets' tip circle");
    reading.lacks(ring.tip_mm, "ring's tip circle");
    std::vector<const RexsComponent*> planet_shafts{rexs_shaft_of(model, *stage.planets.front())};
    for (const RexsComponent* other : stage.planets) {
        std::vector<std::string> same;  // as of the first planet
        rexs_bearings(values, {rexs_shaft_of(model, *other)}, "planets", same);
    }
    data.sun_bearing_N_m =
        rexs_bearings(values, {rexs_shaft_of(model, *stage.first)}, "sun", reading.notes);
    data.planet_bearing_N_m = rexs_bearings(values, planet_shafts, "planets", reading.notes);
    data.ring_bearing_N_m =
        rexs_bearings(values, {rexs_shaft_of(model, *stage.second)}, "ring", reading.notes);
    data.carrier_bearing_N_m =
        rexs_bearings(values, rexs_carrier_shafts(model, stage), "carrier", reading.notes);
    reading.lacks(data.sun_bearing_N_m, "sun's bearing stiffness");
    reading.lacks(data.planet_bearing_N_m, "planets' bearing stiffness");
    reading.lacks(data.ring_bearing_N_m, "ring's bearing stiffness");
    reading.lacks(data.carrier_bearing_N_m, "carrier's bearing stiffness");

    RexsLoad load = rexs_load(values, stages, stage);
    data.input = load.second_drives ? "carrier" : "sun";
    if (choices.input && *choices.input != data.input && data.sun > 0) {
        const double ratio = 1.0 + static_cast<double>(ring.teeth) / data.sun;
        const double faster = data.input == "sun" ? 1.0 / ratio : ratio;
        if (load.speed_rpm && load.torque_N_m) {
            reading.notes.push_back("an option replaces the model's input, the " + data.input);
        }
        load.speed_rpm = load.speed_rpm ? std::optional(*load.speed_rpm * faster) : std::nullopt;
        load.torque_N_m = load.torque_N_m ? std::optional(*load.torque_N_m / faster) : std::nullopt;
        data.input = *choices.input;
    }
    reading.notes.insert(reading.notes.end(), load.notes.begin(), load.notes.end());
    return study_of(
        data, {{"sun", sun}, {"planet", planet}, {"ring", ring}}, load, stage, choices, reading,
        [&](const DatasheetSource& source) { return new_planetary(data, command, source); });
}

NewStudy pair_study(const RexsStage& stage, const std::vector<RexsStage>& stages,
                    const RexsChoices& choices, const std::string& command, RexsReading& reading) {
    RexsValues& values = reading.values;
    const RexsModel& model = reading.model;
    const RexsLoad load = rexs_load(values, stages, stage);
    const RexsComponent *driving = load.second_drives ? stage.second : stage.first,
                        *driven = load.second_drives ? stage.first : stage.second;
    const RexsGear pinion = rexs_gear(values, {driving}), gear = rexs_gear(values, {driven});
    const RexsTeeth teeth = rexs_teeth(values, stage, {pinion, gear});
    check_centre_distance(values, *stage.component, teeth, pinion, gear, false, reading.notes);
    for (const auto& [option, given] : {std::pair{"--input", choices.input.has_value()},
                                        std::pair{"--planets", choices.planets.has_value()}}) {
        if (given) {
            reading.reject(option, "a gear pair has none", "leave it out for a cylindrical stage");
        }
    }
    PairDatasheet data;
    set_teeth(data, teeth, choices, reading);
    data.pinion = pinion.teeth;
    data.gear = gear.teeth;
    std::tie(data.pinion_shift, data.gear_shift) = std::tie(pinion.shift, gear.shift);
    std::tie(data.pinion_tip_mm, data.gear_tip_mm) = std::tie(pinion.tip_mm, gear.tip_mm);
    data.pinion_bearing_N_m =
        rexs_bearings(values, {rexs_shaft_of(model, *driving)}, "driving gear", reading.notes);
    data.gear_bearing_N_m =
        rexs_bearings(values, {rexs_shaft_of(model, *driven)}, "driven gear", reading.notes);
    reading.lacks(pinion.shift, "driving gear's shift");
    reading.lacks(gear.shift, "driven gear's shift");
    reading.lacks(pinion.tip_mm, "driving gear's tip circle");
    reading.lacks(gear.tip_mm, "driven gear's tip circle");
    reading.lacks(data.pinion_bearing_N_m, "driving gear's bearing stiffness");
    reading.lacks(data.gear_bearing_N_m, "driven gear's bearing stiffness");
    reading.lacking.emplace_back("shafts, motor and load");
    reading.notes.push_back(driving->label() + " drives (the study's pinion)");
    reading.notes.insert(reading.notes.end(), load.notes.begin(), load.notes.end());
    return study_of(data, {{"pinion", pinion}, {"gear", gear}}, load, stage, choices, reading,
                    [&](const DatasheetSource& source) { return new_pair(data, command, source); });
}

}  // namespace

NewStudy new_from_rexs(const std::string& path, const RexsChoices& choices,
                       const std::string& command) {
    Problems problems;
    RexsModel model = read_rexs(path, problems);
    if (!problems.empty()) {
        return {"", std::move(problems)};
    }
    std::vector<std::string> notes;
    apply_load_case(model, choices.load_case, problems, notes);
    RexsValues values(model, problems);
    RexsReading reading{model, values, problems, std::move(notes), {}};
    constexpr std::size_t kMostStages = 200;
    const std::vector<RexsStage> stages = rexs_stages(values);
    if (stages.size() > kMostStages) {
        reading.reject("", fmt::format("has {} gear stages", stages.size()),
                       fmt::format("models of up to {} are read", kMostStages));
        return {"", std::move(problems)};
    }
    const RexsStage* stage = chosen_stage(stages, choices.stage, reading);
    if (stage == nullptr) {
        return {"", std::move(problems)};
    }
    NewStudy made = stage->kind == RexsStageKind::planetary
                        ? planetary_study(*stage, stages, choices, command, reading)
                        : pair_study(*stage, stages, choices, command, reading);
    sort_problems(made.problems);
    return made;
}

}  // namespace gearpod::mc
