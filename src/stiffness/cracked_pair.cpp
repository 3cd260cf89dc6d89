#include "stiffness/cracked_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stiffness/faults/crack.hpp"
#include "stiffness/position_range.hpp"
#include "stiffness/section_moments.hpp"
#include "stiffness/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kNodes = CrackedToothCurve::kMaxTerms;
constexpr int kPartnerNodes = 48;
constexpr double kPartnerTolerance = 1e-13;
constexpr double kCurveTolerance = 4e-10;  // of the stiffness of contact and mate

// A series that needs more terms may hide an error in those it lacks: its piece is cut near the
// tip, where the stiffness of a tooth cracked past its centre line falls to zero within a short
// layer.
constexpr int kResolvedTerms = 32;
constexpr double kCut = 0.15;

// Shorter stretches of contact (rad) are left to the neighbouring piece.
constexpr double kShortestPiece_rad = 1e-9;

ChebyshevSeries partner_compliance(const gears::MeshGeometry& geometry, const Material& material,
                                   Profile profile, int which) {
    const ToothProfile tooth(geometry.gear(which), profile);
    const double contact = 1 / hertz_stiffness(material);
    return {
        [&](double tau) {
            return contact +
                   tooth_compliance(tooth, material, geometry.contact_angle(which, tau)).total();
        },
        0, geometry.contact_ratio(), kPartnerNodes, kPartnerTolerance};
}

// Where the section law changes within the contact's range [tip, low], or the nearer end of the
// range.
double piece_boundary(const CrackedSections& sections, double low, double tip) {
    if (!sections.cracked() || sections.boundary() > low - kShortestPiece_rad)
        return low;
    return sections.boundary() < tip + kShortestPiece_rad ? tip : sections.boundary();
}

}  // namespace

CrackedPairFamily::CrackedPairFamily(const gears::MeshGeometry& geometry, const Material& material,
                                     Profile profile, int which, double crack_angle_rad)
    : profile_(geometry.gear(which == 2 ? 2 : 1), profile),
      material_(material),
      crack_angle_rad_(crack_angle_rad),
      contact_ratio_(geometry.contact_ratio()),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which == 2 ? 2 : 1))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which == 2 ? 2 : 1))),
      partner_(partner_compliance(geometry, material, profile, which == 2 ? 1 : 2)),
      tolerance_(kCurveTolerance / partner_(contact_ratio_ / 2)),
      transform_(kNodes) {
    if (which != 1 && which != 2)
        throw std::invalid_argument("the cracked gear of a pair is gear 1 or gear 2");
    if (!(crack_angle_rad > 0 && crack_angle_rad < std::numbers::pi / 2))
        throw std::invalid_argument(
            "the crack's angle to the tooth's centre line must lie between 0 and 90 degrees");
}

double CrackedPairFamily::max_depth() const {
    return max_crack_depth(profile_, crack_angle_rad_);
}

CrackedToothCurve CrackedPairFamily::at(double depth_m) const {
    const CrackedSections sections(profile_, {depth_m, crack_angle_rad_});
    CrackedToothCurve curve;
    if (sections.broken())
        return curve;
    const double end = contact_start_ + contact_rate_ * contact_ratio_;
    const double low = std::max(contact_start_, end), tip = std::min(contact_start_, end);
    SectionSweep sweep(profile_, sections);
    const double boundary = piece_boundary(sections, low, tip);
    if (boundary < low)
        add_piece(curve, sweep, low, boundary, true);
    if (boundary > tip && !sections.past_centre()) {
        if (sections.cracked())
            sweep.advance_cracked(sections.boundary());
        add_piece(curve, sweep, boundary, tip, false);
    }
    // Pieces were added from the root to the tip.
    if (contact_rate_ > 0)
        std::reverse(curve.pieces_.begin(), curve.pieces_.begin() + curve.count_);
    return curve;
}

void CrackedPairFamily::add_piece(CrackedToothCurve& curve, SectionSweep& sweep, double low,
                                  double tip, bool cracked) const {
    const SectionSweep before = sweep;
    std::array<double, kNodes> tau, values;
    const auto& points = transform_.points();
    for (int i = 0; i < kNodes; ++i)
        tau[i] = tau_at(0.5 * (low + tip) + 0.5 * (low - tip) * points[i]);
    partner_(tau, values);
    for (int i = 0; i < kNodes; ++i) {
        const double u = contact_start_ + contact_rate_ * tau[i];
        cracked ? sweep.advance_cracked(u) : sweep.advance_healthy(u);
        values[i] = 1 / (values[i] + compliance(sweep.moments(), profile_, material_,
                                                profile_.involute_angle(u)));
    }
    CrackedToothCurve::Piece& piece = curve.pieces_[curve.count_];
    transform_.fit(values, piece.coefficients);
    piece.terms = chebyshev_terms(piece.coefficients, tolerance_);
    if (piece.terms > kResolvedTerms && curve.count_ + 2 <= CrackedToothCurve::kMaxPieces) {
        const double cut = tip + kCut * (low - tip);
        sweep = before;
        add_piece(curve, sweep, low, cut, cracked);
        add_piece(curve, sweep, cut, tip, cracked);
        return;
    }
    // Points run from the tooth's root to its tip; where the contact climbs, tau runs the same way
    // and x the other.
    if (contact_rate_ < 0)
        for (int j = 1; j < kNodes; j += 2)
            piece.coefficients[j] = -piece.coefficients[j];
    piece.begin = std::min(tau_at(low), tau_at(tip));
    piece.end = std::max(tau_at(low), tau_at(tip));
    ++curve.count_;
}

double CrackedToothCurve::tooth_pair(double tau) const {
    double stiffness = 0;
    tooth_pair({&tau, 1}, {&stiffness, 1});
    return stiffness;
}

void CrackedToothCurve::tooth_pair(std::span<const double> tau, std::span<double> stiffness) const {
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    for (const Piece& piece : pieces()) {
        const auto [first, count] = positions_within(tau, piece.begin, piece.end);
        evaluate_chebyshev({piece.coefficients.data(), static_cast<std::size_t>(piece.terms)},
                           piece.begin, piece.end, tau.subspan(first, count),
                           stiffness.subspan(first, count), 0.0);
    }
}

}  // namespace gearpod::stiffness
