// Gear stages of a REXS model: which gears mesh, on which shafts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/rexs/rexs_values.hpp"

namespace gearpod::mc {

enum class RexsStageKind { planetary, cylindrical, other };

struct RexsStage {
    RexsStageKind kind = RexsStageKind::other;
    const RexsComponent* component = nullptr;
    // Gears: sun and ring of a planetary stage, gear_1 and gear_2 of a cylindrical one.
    const RexsComponent *first = nullptr, *second = nullptr;
    std::vector<const RexsComponent*> planets;
    // Gear pairs of a planetary stage (components cylindrical_stage), by mesh. A cylindrical stage
    // is its own pair.
    std::vector<const RexsComponent*> first_pairs, second_pairs;
    // Reason why no study can be written; empty if one can.
    std::string obstacle;
    std::string teeth;  // "17/22/61 teeth, 3 planets"; empty if unknown

    // "9 (Planetenstufe [9], planetary, 17/22/61 teeth, 3 planets)".
    std::string description() const;
};

// All stages, those within a planetary stage excepted.
std::vector<RexsStage> rexs_stages(RexsValues& values);

// Shaft that carries a gear, load or other part; null if there is none.
const RexsComponent* rexs_shaft_of(const RexsModel& model, const RexsComponent& part);

// Speed and torque of a stage's shafts in a REXS model.

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
