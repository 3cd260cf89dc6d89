// Superposition of mesh periods in which no tooth pair loses contact. The motion is then linear in
// the load and in the tooth errors, and the effect of one gear's errors repeats with the gear's
// revolution. The motion of all Z_p Z_r mesh periods follows from a few dozen. With S distinct
// numbers of teeth Z_s among the gears,
//   x_k = sum over s of x^s_(k mod Z_s) - (S - 1) x^0,
// where x^s is the motion under load if only the gears with Z_s teeth have errors, and x^0 is the
// periodic orbit without errors.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/tooth_pairs.hpp"

namespace gearpod::lockstep {

// Periods of the parts, in mesh periods: the distinct numbers of teeth of the gears, ascending.
std::vector<int> part_periods(std::vector<int> teeth);
std::vector<int> part_periods(const ToothErrors& errors);
// Errors of the gears with this number of teeth; those of all other gears are zero.
ToothErrors errors_of_part(ToothErrors errors, int teeth);
// Number of mesh periods integrated for the parts, each after a run-in, and for the periodic orbit.
int part_meshes(std::span<const int> periods, int run_in_meshes);

// Motion due to the errors of the gears with one number of teeth; all arrays are [mesh of its
// period].
struct SuperpositionPart {
    std::vector<MeshRecord> records;
    std::vector<TileState> states;  // at the start of each mesh period
    // ToothContact::least_compression of the difference from the periodic orbit.
    std::vector<machine::AlignedVector> compression;
};

struct SuperposedMotion {
    MeshRecord periodic_orbit;
    TileState periodic_orbit_state;
    machine::AlignedVector periodic_orbit_compression;
    std::vector<SuperpositionPart> parts;

    // Subtracts the periodic orbit from all parts but the first, so that the sum of the parts is
    // the motion.
    void count_periodic_orbit_once();
    // Superpose mesh period k, which may be any integer, in a record or state of the parts' sizes.
    void record(int k, MeshRecord& record) const;
    void state(int k, TileState& state) const;
    // [lane]: true if all tooth pairs stay in contact in mesh periods [from, to). This includes
    // every part and the periodic orbit, at all positions at which the integrator evaluates forces.
    // The test uses lower bounds over stretches of the mesh period, so true is certain.
    std::vector<char> keeps_contact(int from, int to, std::size_t lanes) const;
};

}  // namespace gearpod::lockstep
