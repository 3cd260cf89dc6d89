// Fault of a study: its names, sizes and unit.
#pragma once

#include <string>
#include <vector>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/schema/schema.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

struct FaultPlan {
    std::string kind;               // in study files, "spatial-crack"; "" without a fault
    std::string words = "a fault";  // in messages, "a spatial crack"
    std::string title;              // in descriptions, "tooth crack"
    std::string location;           // "planet 1, sun side"
    // Location on the tooth, and the datum from which the sizes are measured.
    std::string origin;
    SizeShare share{};  // part of the tooth that a size takes
    // Gives the size; without a fault, the depth of a crack, which is then 0.
    const Key* size_key = nullptr;
    // Sizes at which stiffness curves are shown: the levels, or the edges of groups, without 0.
    // Ascending, SI.
    std::vector<double> sizes;
    bool groups = false;  // the sizes are edges of groups

    bool given() const { return !kind.empty(); }
    const Unit& unit() const { return size_key->unit; }
    // "a crack in planet 1, sun side"; "" without a fault.
    std::string phrase() const { return given() ? words + " in " + location : ""; }
    // "crack_3mm", or "chip_0.1" for a pure number.
    std::string name_at(double size) const;
};
FaultPlan make_fault_plan(const Study& study);

}  // namespace gearpod::mc
