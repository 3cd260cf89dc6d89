// A fault on one or several neighbouring teeth of one gear, as the laws by which it acts: on the
// tooth's sections (crack, pitting), on the contact (chip, pitting), on the whole tooth pair
// (broken tooth) or, where only that is known, on the whole mesh (reduced stiffness). A fault
// overrides the laws that it changes.
//
// Positions tau count mesh periods since the faulty tooth's own engagement began.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gearpod::stiffness {

// A part of the face width, 0 to 1, from the end that engages first where the first gear drives.
struct FaceRange {
    double begin = 0, end = 1;
};

// Of one size. Immutable.
class ToothFault {
  public:
    virtual ~ToothFault() = default;
    // Neighbouring teeth that have it.
    virtual int teeth() const { return 1; }
    // The gear of the pair, 1 or 2, that has it. Matters only where the sections change.
    virtual int gear() const { return 1; }
    // Whether beam_compliance() replaces the healthy tooth's.
    virtual bool changes_sections() const { return false; }
    // Compliance of the faulty tooth as a beam (bending, shear, axial), m/N, at ascending tau;
    // infinite where the tooth carries nothing. Throws std::logic_error unless the sections change.
    virtual void beam_compliance(std::span<const double> tau, std::span<double> compliance) const;
    // Whether contact_width() differs from 1 anywhere.
    virtual bool changes_contact() const { return false; }
    // The part of the face width, 0 to 1, on which the tooth is touched at tau.
    virtual double contact_width(double /*tau*/) const { return 1.0; }
    // Where along the face width it takes what it takes. Matters only to helical teeth, which touch
    // one end first.
    virtual FaceRange face() const { return {}; }
    // Factor on the stiffness of the faulty tooth's pair, 0 to 1.
    virtual double pair_factor() const { return 1.0; }
    // Factor on the stiffness of the whole mesh, 0 to 1, while a faulty tooth is engaged.
    virtual double mesh_factor() const { return 1.0; }
    // Positions, ascending, at which a law jumps or kinks.
    virtual std::vector<double> breaks() const { return {}; }
    // Those of them at which it jumps.
    virtual std::vector<double> jumps() const { return {}; }
};

// All sizes of one fault. Immutable; shared by threads.
class ToothFaultFamily {
  public:
    virtual ~ToothFaultFamily() = default;
    // Never called with size 0, which is the healthy tooth. The family must outlive the fault.
    virtual std::unique_ptr<const ToothFault> at(double size) const = 0;
    // The size at which the tooth carries nothing any more, or beyond which the fault's shape has
    // no meaning; larger ones count as it.
    virtual double largest_size() const = 0;
    // What is wrong with a tooth that has this size, one sentence each; empty if nothing is.
    virtual std::vector<std::string> problems(double /*size*/) const { return {}; }
    // Positions, ascending, at which the stiffness jumps whatever the size: an integrator's steps
    // should end there.
    virtual std::vector<double> jumps() const { return {}; }
};

}  // namespace gearpod::stiffness
