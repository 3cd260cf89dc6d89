#include "mc/new_study/rexs_reading.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <tuple>
#include <utility>

namespace gearpod::mc {

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

}  // namespace gearpod::mc
