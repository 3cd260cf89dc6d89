// A fault on one or several neighbouring teeth of one gear, as the three laws by which it acts:
// on the tooth's sections (crack), on the contact (chip, pitting) or on the whole tooth pair
// (broken tooth, reduced stiffness). A fault overrides the laws that it changes.
//
// Positions tau count mesh periods since the faulty tooth's own engagement began.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace gearpod::stiffness {

// Of one size. Immutable.
class ToothFault {
  public:
    virtual ~ToothFault() = default;
    // Neighbouring teeth that have it.
    virtual int teeth() const { return 1; }
    // Whether beam_compliance() replaces the healthy tooth's.
    virtual bool changes_sections() const { return false; }
    // Compliance of the faulty tooth as a beam (bending, shear, axial), m/N, at ascending tau;
    // infinite where the tooth carries nothing.
    virtual void beam_compliance(std::span<const double> tau, std::span<double> compliance) const;
    // The part of the face width, 0 to 1, on which the tooth is touched at tau.
    virtual double contact_width(double /*tau*/) const { return 1.0; }
    // Factor on the stiffness of the faulty tooth's pair, 0 to 1.
    virtual double pair_factor() const { return 1.0; }
    // Positions, ascending, at which a law jumps or kinks.
    virtual std::vector<double> breaks() const { return {}; }
};

// All sizes of one fault. Immutable; shared by threads.
class ToothFaultFamily {
  public:
    virtual ~ToothFaultFamily() = default;
    // Never called with size 0, which is the healthy tooth.
    virtual std::unique_ptr<const ToothFault> at(double size) const = 0;
    // The size at which the tooth carries nothing any more; larger ones count as it.
    virtual double largest_size() const = 0;
};

}  // namespace gearpod::stiffness
