// Superposition of mesh periods in which no tooth pair loses contact. There the motion is linear in
// the load and in the tooth errors, and the effect of one gear's errors repeats with the gear's
// revolution. The motion of all Z_p Z_r mesh periods then follows from a few dozen: with S kinds of
// gears by their number of teeth,
//   x_k = sum over s of x^s_(k mod Z_s) - (S - 1) x^0,
// where x^s is the motion under the load if only the gears of Z_s teeth have errors, and x^0 the
// periodic orbit without any.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/tooth_errors.hpp"

namespace gearpod::lockstep {

// The parts' periods: gears' numbers of teeth, each once, ascending.
std::vector<int> part_periods(std::vector<int> teeth);
std::vector<int> part_periods(const ToothErrors& errors);
// Errors of the gears with so many teeth; the other gears have none.
ToothErrors errors_of_part(ToothErrors errors, int teeth);
// Number of mesh periods integrated for the parts, each after a run-in, and for the orbit.
int part_meshes(std::span<const int> periods, int run_in_meshes);

// One part, [mesh of its period].
struct ComposedPart {
    std::vector<MeshRecord> records;
    std::vector<TileState> states;  // at the beginning of each
    // ToothContact::least_pressing of its difference from the orbit.
    std::vector<machine::AlignedVector> pressing;
};

struct Composition {
    MeshRecord orbit;
    TileState orbit_state;
    machine::AlignedVector orbit_pressing;
    std::vector<ComposedPart> parts;

    // Subtracts the orbit from all parts but the first, so that the parts add up to the motion.
    void take_orbit_once();
    // k counts from any integer. `record` and `state` have their sizes.
    void record(int k, MeshRecord& record) const;
    void state(int k, TileState& state) const;
    // [lane]: true if all tooth pairs stay in contact during the meshes from `from` until before
    // `to`, in every part and in the orbit, at all positions at which the integrator evaluates
    // forces. Lower bounds over stretches of the mesh period decide, so that true is certain.
    std::vector<char> keeps_contact(int from, int to, std::size_t lanes) const;
};

}  // namespace gearpod::lockstep
