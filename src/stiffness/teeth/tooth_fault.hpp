// Fault on one or several neighbouring teeth of one gear, described by the laws that it overrides.
// It may change the tooth's sections (crack, pitting), the contact (chip, pitting) or the whole
// tooth pair (broken tooth). Where no more is known, it changes the whole mesh (reduced stiffness).
//
// Positions tau count mesh periods since the start of the faulty tooth's engagement.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearpod::stiffness {

// Part of the face width, 0 to 1, from the end that engages first when the first gear is the
// driver.
struct FaceRange {
    double begin = 0, end = 1;
};

// Fault of one size. Immutable.
class ToothFault {
  public:
    virtual ~ToothFault() = default;
    // Number of neighbouring teeth with the fault.
    virtual int teeth() const { return 1; }
    // Gear of the pair with the fault, 1 or 2. Relevant only where the sections change.
    virtual int gear() const { return 1; }
    // True if beam_compliance() replaces the healthy tooth's.
    virtual bool changes_sections() const { return false; }
    // Compliance of the faulty tooth as a beam (bending, shear, axial), m/N, at ascending tau.
    // Infinite where the tooth carries no load. Throws std::logic_error unless the sections change.
    virtual void beam_compliance(std::span<const double> /*tau*/,
                                 std::span<double> /*compliance*/) const {
        throw std::logic_error("this fault leaves the tooth's sections as they are");
    }
    // True if contact_width() differs from 1 anywhere.
    virtual bool changes_contact() const { return false; }
    // Fraction of the face width, 0 to 1, on which the tooth is in contact at tau.
    virtual double contact_width(double /*tau*/) const { return 1.0; }
    // Part of the face width that the fault weakens. Relevant only to helical teeth, which touch
    // one end first.
    virtual FaceRange face() const { return {}; }
    // Factor on the stiffness of the faulty tooth's pair, 0 to 1.
    virtual double pair_factor() const { return 1.0; }
    // Factor on the stiffness of the whole mesh, 0 to 1, while a faulty tooth is engaged.
    virtual double mesh_factor() const { return 1.0; }
    // Ascending positions at which a law has a jump or a kink.
    virtual std::vector<double> breaks() const { return {}; }
    // Ascending positions at which a law has a jump, a subset of breaks().
    virtual std::vector<double> jumps() const { return {}; }
};

// Fault as a function of its size. Immutable; shared by threads.
class ToothFaultFamily {
  public:
    virtual ~ToothFaultFamily() = default;
    // Fault of the given size. Never called with size 0, which is the healthy tooth. The family
    // must outlive the fault.
    virtual std::unique_ptr<const ToothFault> at(double size) const = 0;
    // Size at which the tooth carries no more load, or beyond which the fault's shape has no
    // meaning. Larger sizes are treated as this size.
    virtual double largest_size() const = 0;
    // Errors of a fault of this size, one sentence each; empty if there are none.
    virtual std::vector<std::string> problems(double /*size*/) const { return {}; }
    // Ascending positions at which the stiffness jumps for every size. Time steps should end there.
    virtual std::vector<double> jumps() const { return {}; }
};

}  // namespace gearpod::stiffness
