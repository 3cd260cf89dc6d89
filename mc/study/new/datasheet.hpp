// Datasheets of planetary stages and gear pairs, and the studies that are made from them.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mc/files/input/problems.hpp"

namespace gearpod::mc {

// The machine around a stage, as the stage's study states it.
struct Surroundings {
    std::string place;                  // "stage 1 of 3"; empty: nothing is known of other stages
    std::string stages;                 // value of sensor.stages; may be empty
    std::optional<double> low_pass_Hz;  // of the sensor; follows from the mesh frequency if absent
    // One-sided density of the machine's noise, m/s^2/sqrt(Hz), beside a measured level.
    std::optional<double> density;
    bool measured = false;  // the density is the rest of the level, not chosen
};

// Values in the usual units. Missing ones follow from rules of thumb or the geometry.
struct StageDatasheet {
    double module_mm = 0;  // normal
    double helix_deg = 0, pressure_angle_deg = 20;
    std::optional<double> face_width_mm;
    std::optional<double> addendum;  // divided by the normal module
    std::optional<double> centre_distance_mm;
    std::optional<double> young_modulus_Pa, poisson_ratio;
    std::optional<double> quality;  // ISO 1328 grade; 6 if not given
    // Torque, speed and power of the driving member; exactly two of the three.
    std::optional<double> torque_N_m, speed_rpm, power_kW;
    std::string origin = "datasheet";  // kind of document, for the study's first comment
    std::vector<std::string> notes;    // further comments at the head of the study
    Surroundings around;
};

// Datasheet of a gear pair on fixed shafts. The pinion drives the gear and may be the larger of the
// two; the smaller one has the crack.
struct PairDatasheet : StageDatasheet {
    int pinion = 0, gear = 0;  // teeth
    std::optional<double> pinion_shift, gear_shift;
    std::optional<double> pinion_tip_mm, gear_tip_mm;            // diameters
    std::optional<double> pinion_bearing_N_m, gear_bearing_N_m;  // radial stiffness
};

// Datasheet of a planetary gearbox.
struct PlanetaryDatasheet : StageDatasheet {
    int sun = 0, planet = 0;
    std::optional<int> ring;  // teeth; default for standard gears: sun + 2 planet
    int planets = 3;
    std::optional<double> sun_shift, planet_shift, ring_shift;
    std::optional<double> sun_tip_mm, planet_tip_mm, ring_tip_mm;  // diameters
    // Radial stiffness of the bearings of each member.
    std::optional<double> sun_bearing_N_m, planet_bearing_N_m, ring_bearing_N_m,
        carrier_bearing_N_m;
    std::string input = "sun";  // or "carrier"
};

// Tooth number of the ring, given or that of standard gears. The numbers need not be possible.
int ring_teeth(const PlanetaryDatasheet& data);

// Problems of a datasheet, in the terms of its source: options of the command line, or attributes
// of a model.

struct NewStudy {
    std::string text;  // TOML with comments; empty if there are problems
    Problems problems;
    Problems notices = {};  // statements of a model that the study does not take
};

// Names of a datasheet's values for messages.
struct DatasheetSource {
    std::string file;                         // stands for the file in messages
    std::map<std::string, std::string> keys;  // by study key
    std::string meshing_remedy;               // for gears that do not mesh
};

DatasheetSource planetary_options();

// Replaces study keys in problems by the names of their values, because the study is not written
// yet.
Problems as_named_by(const DatasheetSource& source, Problems problems);

struct InputLoad {
    double torque_N_m = 0, speed_rpm = 0;
};

// Problems of torque, speed and power; `input` is the driving member.
Problems load_problems(const StageDatasheet& data, const DatasheetSource& source,
                       const std::string& input);
// Torque and speed from two of torque, speed and power.
InputLoad load_of(const StageDatasheet& data);

// Face width, rounded to whole millimetres from 10 mm if it follows by rule. Any number if the
// module is invalid.
double face_width_mm(const StageDatasheet& data);

// Makes the study of a datasheet by the rules of rules.hpp. It passes every check of `describe`;
// otherwise the result has one problem for each reason and no text. Problems name values as their
// source does. `command` goes into the study's first comment.
NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command,
                       const DatasheetSource& source = planetary_options());

// Makes the study of a datasheet by the rules of rules.hpp, as new_planetary() does.
NewStudy new_pair(const PairDatasheet& data, const std::string& command,
                  const DatasheetSource& source);

// Reads the model with analysis/python/gearpod/rexs.py and makes the study of a planetary stage, or
// of a cylindrical one as a gear pair. The study's first comment and the notices list what the
// model lacks and what the study does not take. Contradictions within the model are problems, with
// both values. `options`: stage, load_case, input, planets and values of StageDatasheet that are
// given in addition; loads replace the model's.
NewStudy new_from_rexs(const std::string& path, const nlohmann::json& options,
                       const std::string& command);

// Stage of a train of gears, with the names of its values for messages.
struct TrainStage {
    std::variant<PlanetaryDatasheet, PairDatasheet> gears;
    DatasheetSource source;
    std::string name;  // "stage-2"

    StageDatasheet& data();
};

// Makes the study of one stage.
NewStudy new_stage(const TrainStage& stage, const std::string& command);

// Reads a stage: "21/39/99 module=12 helix=8" (sun, planet and ring; the carrier drives unless
// input=sun follows) or "95/25 module=11" (driving and driven gear). `number`: its --stage, from 1.
TrainStage read_train_stage(const std::string& text, std::size_t number, Problems& problems);

// Shaft between two stages, with the members at its ends.
struct TrainShaft {
    std::size_t nearer = 0, stage = 0;  // `nearer` is or leads to the monitored stage
    std::string shaft, stage_shaft;
};

struct TrainDatasheet {
    std::vector<TrainStage> stages;
    // From the monitored stage outwards. Empty: the stages follow each other in the order of the
    // power flow, and `load` is that of the first.
    std::vector<TrainShaft> shafts;
    StageDatasheet load;                // torque, speed or power; tooth quality of all stages
    std::size_t monitored = 0;          // stage with the fault and the sensor
    std::optional<double> low_pass_Hz;  // default: as for a single stage
    std::optional<double> level_m_s2;   // measured rms below low_pass_Hz
    std::string file;                   // of the monitored stage's study
};

// Studies of a train with their files; none if there are problems.
struct NewTrain {
    std::vector<std::pair<std::string, std::string>> studies;
    Problems problems, notices = {};
};

// The stage of a model that `options` choose, as in new_from_rexs(), with all stages that shafts
// connect with it. Adds the problems and notices of all.
TrainDatasheet train_from_rexs(const std::string& path, nlohmann::json options, NewTrain& made);

// Files of the studies of a train, by stage.
std::vector<std::string> train_files(const TrainDatasheet& train);

// Rms of the vibration of healthy gearboxes of a study, without noise, m/s^2. `record`: override
// that shortens the record; may be empty.
using StageLevel = std::function<double(const std::string& study, const std::string& record)>;

// Makes a study of each stage by the rules of rules.hpp. That of the monitored stage lists the
// others in sensor.stages. A measured level is divided among the stages and the background, with
// the levels that `level_of` computes; without one, the gains are 1 and the background is chosen.
NewTrain new_train(TrainDatasheet train, const std::string& command, const StageLevel& level_of);

}  // namespace gearpod::mc
