// Speed and torque of a stage's shafts in a REXS model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/rexs/rexs_stages.hpp"

namespace gearpod::mc {

// Load at the driving member of a stage.
struct RexsLoad {
    bool second_drives = false;  // planetary: the carrier drives, not the sun; else gear_2
    std::optional<double> speed_rpm, torque_N_m;
    std::vector<std::string> notes;
};

// Follows speeds and torques from the shafts that state them through gear pairs, planetary stages
// with a fixed ring, and couplings to the stage. Losses are neglected. Torque and speed of the same
// sense drive. Without a torque, a stage's driving gear (is_driving_gear), else its sun or gear_1,
// drives. Speeds that contradict each other are problems.
RexsLoad rexs_load(RexsValues& values, const std::vector<RexsStage>& stages,
                   const RexsStage& stage);

// Reason why the ring of a planetary stage turns; empty if nothing in the model says so.
std::string why_ring_turns(RexsValues& values, const RexsStage& stage);

// Shafts of the carrier of a planetary stage.
std::vector<const RexsComponent*> rexs_carrier_shafts(const RexsModel& model,
                                                      const RexsStage& stage);

}  // namespace gearpod::mc
