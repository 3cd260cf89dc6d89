// Gap of a spur tooth pair along its engagement: relief, crowning, corner contact and wear.
#pragma once

#include <algorithm>
#include <optional>

#include "gears/flank_relief.hpp"
#include "gears/flank_wear.hpp"
#include "stiffness/path_extension.hpp"

namespace gearpod::stiffness {

// Flanks of a gear pair, with their relief and the extent of their contact.
struct FlankGaps {
    gears::MeshGeometry geometry;
    gears::FlankRelief relief_1 = {}, relief_2 = {};
    // Corner gap, m, up to which contact outside the nominal path is followed. 0: contact starts
    // and ends with the nominal path.
    double reach_m = 0;
    std::optional<gears::FlankWear> wear = {};  // empty unless the flanks of a gear wear
    // Sum of the crowning of both flanks, m.
    double crowning_m() const { return relief_1.crowning_m + relief_2.crowning_m; }
    // Gap by crowning, averaged over a slice, m.
    double crown_m(int slice, int slices) const {
        const double middle = (2 * slice + 1.0) / slices - 1, half = 1.0 / slices;  // face: -1 to 1
        return crowning_m() * (middle * middle + half * half / 3);
    }
};

// Outside the path of contact, the stiffness k of the pair's curve differs from `own`, the
// stiffness of the pair among all engaged pairs. The gap is scaled by own / k there, so that the
// product of stiffness and gap is correct.
struct PairGap {
    FlankGaps flanks;
    PathExtension extension;
    ExtendedPairs::Change joins = {}, leaves = {};

    // Position on the flank: -1/2 up to the start of the nominal path, 1/2 from its end on. `at`:
    // mesh periods from the start of the path.
    double flank_position(double at) const {
        return std::clamp(at / extension.contact_ratio(), 0.0, 1.0) - 0.5;
    }
    // Gap, m, at a position from the start of the nominal path, mesh periods; `crown`: gap by
    // crowning, m.
    double operator()(double at, double crown) const {
        const double flank = gears::relief_gap(flanks.geometry, flanks.relief_1, flanks.relief_2,
                                               std::clamp(at, 0.0, extension.contact_ratio())) +
                             crown;
        return on_path(at) ? flank : (flank + gears::corner_gap(flanks.geometry, at)) * scale(at);
    }
    // Gap by wear of unit depth at that position; 0 unless the flanks wear.
    double wear(double at) const {
        return !flanks.wear  ? 0
               : on_path(at) ? flanks.wear->shape(at)
                             : flanks.wear->shape(at) * scale(at);
    }

  private:
    bool on_path(double at) const { return at >= 0 && at <= extension.contact_ratio(); }
    // Factor of gaps at a position outside of the path.
    double scale(double at) const {
        const ExtendedPairs::Change& end = at < 0 ? joins : leaves;
        const double k = end.stiffness(extension.weight(at));
        return k > 0 ? end.own / k : 1;
    }
};

}  // namespace gearpod::stiffness
