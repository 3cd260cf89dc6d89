// Stiffness of the one tooth pair whose tooth is cracked, for every crack depth, N/m.
// Section law: stiffness/faults/crack.hpp. Sources: Tian (2004), section 3.3; Liang (2016),
// section 3.5.
//
// At a given depth the cracked tooth's compliance is a polynomial in the cosine of the contact
// angle whose coefficients are cumulative integrals from the root to the contact. They are summed
// panel by panel between the Chebyshev nodes of a smooth piece, so a curve costs one sweep over the
// tooth, for any depth alike.
#pragma once

#include <array>
#include <span>

#include "gears/mesh_geometry.hpp"
#include "stiffness/chebyshev.hpp"
#include "stiffness/material.hpp"
#include "stiffness/tooth_profile.hpp"

namespace gearpod::stiffness {

// The cracked pair at one depth, in smooth pieces ascending in tau; zero where the tooth section is
// gone. A value without heap memory; const members may be shared by threads.
class CrackedToothCurve {
  public:
    static constexpr int kMaxTerms = 40;
    static constexpr int kMaxPieces = 8;
    struct Piece {
        double begin = 0, end = 0;  // mesh periods since the engagement began
        int terms = 0;              // Chebyshev terms
        std::array<double, kMaxTerms> coefficients{};
    };

    // The cracked tooth pair tau mesh periods after its engagement began; 0 outside [0, contact
    // ratio] (to 1e-10).
    double tooth_pair(double tau) const;
    // The same for many positions in ascending order; same bits as one by one.
    void tooth_pair(std::span<const double> tau, std::span<double> stiffness) const;

    std::span<const Piece> pieces() const {
        return {pieces_.data(), static_cast<std::size_t>(count_)};
    }

  private:
    friend class CrackedPairFamily;
    std::array<Piece, kMaxPieces> pieces_;
    int count_ = 0;
};

class SectionSweep;

class CrackedPairFamily {
  public:
    // which: the gear whose tooth is cracked (1 or 2 of the geometry); crack_angle_rad: between
    // crack and centre line. Throws std::invalid_argument unless which is 1 or 2 and 0 <
    // crack_angle_rad < pi/2.
    CrackedPairFamily(const gears::MeshGeometry& geometry, const Material& material,
                      Profile profile, int which, double crack_angle_rad);

    // Depth at which the tooth breaks: twice the half root chord / sin(angle).
    double max_depth() const;
    // Depths outside [0, max_depth] count as the nearer end: 0 is the healthy pair, max_depth
    // carries nothing.
    CrackedToothCurve at(double depth_m) const;

  private:
    // Adds the piece whose contacts lie between the involute angles low (towards the root) and tip.
    void add_piece(CrackedToothCurve& curve, SectionSweep& sweep, double low, double tip,
                   bool cracked) const;

    double tau_at(double u) const { return (u - contact_start_) / contact_rate_; }

    ToothProfile profile_;
    Material material_;
    double crack_angle_rad_;
    double contact_ratio_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
    ChebyshevSeries partner_;  // compliance of the healthy tooth and of the contact, m/N, over tau
    double tolerance_;         // N/m, of a curve
    ChebyshevTransform transform_;
};

}  // namespace gearpod::stiffness
