// Gear stages of a REXS model: which gears mesh, on which shafts.
#pragma once

#include <string>
#include <vector>

#include "mc/rexs/rexs_values.hpp"

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

}  // namespace gearpod::mc
