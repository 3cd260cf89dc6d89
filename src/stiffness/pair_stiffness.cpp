#include "stiffness/pair_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "stiffness/position_range.hpp"
#include "stiffness/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kNodes = 48;
constexpr double kSeriesTolerance = 1e-13;

// phase without its whole part, in [0, 1), and exactly 0 if it lies at a whole number.
double wrapped(double phase) {
    const double fraction = phase - std::floor(phase);
    return fraction > 1 - kPositionTolerance ? 0 : fraction;
}

}  // namespace

PairStiffness::PairStiffness(const gears::MeshGeometry& geometry, const Material& material,
                             Profile profile)
    : contact_ratio_(geometry.contact_ratio()), pitch_position_(geometry.pitch_position()) {
    const ToothProfile tooth_1(geometry.gear(1), profile), tooth_2(geometry.gear(2), profile);
    const double contact = 1 / hertz_stiffness(material);
    const auto stiffness = [&](double tau) {
        const auto first = tooth_compliance(tooth_1, material, geometry.contact_angle(1, tau));
        const auto second = tooth_compliance(tooth_2, material, geometry.contact_angle(2, tau));
        return 1 / (contact + first.total() + second.total());
    };
    series_ = ChebyshevSeries(stiffness, 0, contact_ratio_, kNodes, kSeriesTolerance);
    find_transitions();
}

PairStiffness PairStiffness::constant(double stiffness_N_m, double contact_ratio) {
    return constant(stiffness_N_m, contact_ratio, contact_ratio / 2);
}

PairStiffness PairStiffness::constant(double stiffness_N_m, double contact_ratio,
                                      double pitch_position) {
    PairStiffness pair;
    pair.contact_ratio_ = contact_ratio;
    pair.pitch_position_ = pitch_position;
    pair.series_ = ChebyshevSeries(stiffness_N_m, 0, contact_ratio);
    pair.find_transitions();
    return pair;
}

void PairStiffness::find_transitions() {
    const double leaving = wrapped(contact_ratio_);
    const bool together = leaving < kPositionTolerance;
    if (together && series_.coefficients().size() == 1)
        return;
    transitions_.push_back(0);
    if (!together)
        transitions_.push_back(leaving);
}

double PairStiffness::tooth_pair(double tau) const {
    double stiffness = 0;
    tooth_pair({&tau, 1}, {&stiffness, 1});
    return stiffness;
}

void PairStiffness::tooth_pair(std::span<const double> tau, std::span<double> stiffness) const {
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    const auto [first, count] = positions_within(tau, 0, contact_ratio_);
    series_(tau.subspan(first, count), stiffness.subspan(first, count));
}

double PairStiffness::mesh(double phase, Side side) const {
    double sum = 0;
    for (double tau = wrapped(phase); tau <= contact_ratio_ + kPositionTolerance; tau += 1) {
        const bool engaging = tau < kPositionTolerance;
        const bool leaving = tau > contact_ratio_ - kPositionTolerance;
        if ((side == Side::before && engaging) || (side == Side::after && leaving))
            continue;
        sum += tooth_pair(tau);
    }
    return sum;
}

double PairStiffness::mean() const {
    return series_.integral();
}

}  // namespace gearpod::stiffness
