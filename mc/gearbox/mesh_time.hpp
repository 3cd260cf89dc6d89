// How long a march is going to take and how large its records will be, before it is marched.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Mesh periods that the nominal gearboxes march until their orbit repeats; 0 if nothing is marched.
double approach_meshes(const Scene& scene);
// Mesh periods that a tile of gearboxes marches or solves: approach, run-in, and the passages of
// the fault or, where every mesh is marched, all that is recorded. From the nominal damping: most
// gearboxes march about as many.
double marched_meshes(const Scene& scene);

// Mesh periods that a fault of theirs changes: its passages, until the motion is back.
double passage_meshes(const Scene& scene);

// Likewise without the fault.
double healthy_meshes(const Scene& scene);

// Which gearboxes are superposed while they keep contact: where the study asks for it and it
// marches fewer meshes.
struct Superposition {
    bool healthy = false, faulty = false;
};
Superposition superposition(const Scene& scene);

// Whether the sensors hear the meshes of a tile as they are marched, which are not kept then: where
// every mesh is marched and no other tile can use them.
bool hears_march(const Scene& scene);

// Mesh periods of the sensor's samples that are looked at one by one: by features with these needs
// (features::Need), or by all of the study's.
int looked_at_meshes(const Scene& scene, unsigned needs);
int looked_at_meshes(const Scene& scene);

// Bytes of what a tile of a run keeps of its motion; and of the records of all its meshes.
double motion_bytes(const Scene& scene);
double record_bytes(const Scene& scene);

// Seconds of one thread for one healthy mesh period of as many gearboxes as there are lanes, driven
// as the study says: the least of some marches from rest.
double mesh_period_s(const Scene& scene);

// The same of a step of the classical Runge-Kutta method, also where nobody would march by it, and
// of one gearbox in a full tile; nothing drives it unevenly.
double explicit_step_s(const Scene& scene);

}  // namespace gearpod::mc
