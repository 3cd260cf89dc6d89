// numerics.tolerance: the cheapest rung of the ladder that keeps every feature of a pilot within
// it.
#pragma once

#include <optional>
#include <string>

#include "mc/numerics/rung.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct NumericsChoice {
    Numerics numerics;  // the study's, with the rung's keys
    Rung rung;
    double error = 0.0;             // of the pilot's worst feature, relative
    std::string worst_feature;      // which that is
    double cost = 0.0;              // of the pilot's march by the cost model, rk4 steps a gearbox
    std::string reference;          // what the pilot was compared with
    double reference_change = 0.0;  // of its worst feature when its steps were halved last
    int gearboxes = 0;              // of the pilot
    int marches = 0;                // of them, to find the rung

    std::string text() const;
};

// A study with the numerics that it runs by, and how they were chosen: not at all without a
// tolerance.
struct ResolvedStudy {
    Study study;
    std::optional<NumericsChoice> choice;
};
// Depends on the study alone: neither on clocks nor on lanes, threads or instruction set. Throws
// SceneError where no rung keeps the tolerance.
ResolvedStudy resolve_numerics(Study study);

}  // namespace gearpod::mc
