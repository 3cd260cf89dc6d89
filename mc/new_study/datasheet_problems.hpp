// Problems of a datasheet, in the terms of its source: options of the command line, or attributes
// of a model.
#pragma once

#include <map>
#include <string>

#include "mc/input/problems.hpp"
#include "mc/new_study/stage_datasheet.hpp"

namespace gearpod::mc {

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

// Options of `new planetary`.
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

}  // namespace gearpod::mc
