// Meshes in which no tooth pair leaves contact: there the motion is linear in the load and in the
// errors of the teeth, and what one gear's errors do comes again whenever the gear has turned. So
// the motion of all Z_p Z_r meshes is that of a few dozen: with S kinds of gears by their number of
// teeth,
//   x_k = sum over s of x^s_(k mod Z_s) - (S - 1) x^0,
// x^s the motion under the load where only the gears of Z_s teeth have errors, x^0 the orbit of a
// mesh period without any.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/tooth_errors.hpp"

namespace gearpod::lockstep {

// The parts' periods: gears' numbers of teeth, each once, ascending.
std::vector<int> part_periods(std::vector<int> teeth);
std::vector<int> part_periods(const ToothErrors& errors);
// The errors of the gears with so many teeth; the others have none.
ToothErrors errors_of_part(ToothErrors errors, int teeth);
// Mesh periods that the parts march, each behind a run-in, and one of the orbit.
int part_meshes(std::span<const int> periods, int run_in_meshes);

// Of a mesh period, how far each tooth pair is pressed together, the least over stretches of the
// period: [stretch][pair][tooth pair][lane], m; infinite where the two teeth are not in contact.
// Needs the record's motion.
class Pressing {
  public:
    explicit Pressing(const MarchPlan& plan);
    // `gaps` of the mesh (tooth_gaps), `orbit` the record of a mesh period without errors or null.
    // With it, what it lacks of the orbit.
    machine::AlignedVector least(const MeshRecord& record, std::span<const PairGaps> gaps,
                                 const MeshRecord* orbit) const;

  private:
    // The tooth pairs of a pair that are in contact at a sample: slots are a range.
    struct Touching {
        int sample = 0, pair = 0, step = 0;
        int first_slot = 0, last_slot = 0;  // one past the last
    };
    // Of a pair's deflection.
    struct Entry {
        std::size_t degree = 0;
        double weight = 0.0;
    };
    const MarchPlan& plan_;
    std::vector<Touching> touching_;
    std::vector<std::vector<Entry>> row_;
};

// One part, [mesh of its period].
struct ComposedPart {
    std::vector<MeshRecord> records;
    std::vector<TileState> states;                 // at the beginning of each
    std::vector<machine::AlignedVector> pressing;  // Pressing::least, less the orbit
};

struct Composition {
    MeshRecord orbit;
    TileState orbit_state;
    machine::AlignedVector orbit_pressing;
    std::vector<ComposedPart> parts;

    // Makes all parts but the first what they lack of the orbit, so that parts add up to the mesh.
    void take_orbit_once();
    // k counts from any integer. `record` and `state` have their sizes.
    void record(int k, MeshRecord& record) const;
    void state(int k, TileState& state) const;
    // [lane]: whether at all samples of the meshes from `from` until before `to`, of each part and
    // of the orbit tooth pairs are pressed together: true is sure, by the least over stretches.
    std::vector<char> keeps_contact(int from, int to, std::size_t lanes) const;
};

}  // namespace gearpod::lockstep
