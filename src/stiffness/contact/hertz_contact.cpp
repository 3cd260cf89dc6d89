#include "stiffness/contact/hertz_contact.hpp"

#include <cmath>

namespace gearpod::stiffness {

HertzContact::HertzContact(const Material& material, Contact contact)
    : contact_(contact),
      unit_(load_dependent() ? 1.37 / (std::pow(material.youngs_modulus_Pa, 0.9) *
                                       std::pow(material.face_width_m, 0.8) *
                                       std::pow(material.contact_factor, 1.1))
                             : 1 / hertz_stiffness(material)) {}

double HertzContact::compliance(double force_N, double width) const {
    if (!load_dependent())
        return unit_ / width;
    const double by_width = width == 1 ? 1 : std::pow(width, 0.8);
    return unit_ / (by_width * std::pow(force_N, 0.1));
}

}  // namespace gearpod::stiffness
