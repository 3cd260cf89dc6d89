// Parts of reading a REXS model that planetary stages and gear pairs share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/new_study/datasheet_problems.hpp"
#include "mc/new_study/rexs_choices.hpp"
#include "mc/rexs/rexs_gear.hpp"
#include "mc/rexs/rexs_load.hpp"

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

}  // namespace gearpod::mc
