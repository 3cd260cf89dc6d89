#include "lockstep/integrators/filter_coefficients.hpp"

#include <cmath>
#include <numbers>

#include "lockstep/integrators/facts.hpp"

namespace gearpod::lockstep {

void filter_step(Integrator integrator, double w, double h,
                 double (&coefficients)[kFilterCoefficients]) {
    const double b1 = 2.0 * std::cos(std::numbers::pi / 8);
    const double b2 = 2.0 * std::cos(3 * std::numbers::pi / 8);
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1.0;
    a.row(1) << -w * w, -b1 * w, 0.0, 0.0;
    a(2, 3) = 1.0;
    a.row(3) << w * w, 0.0, -w * w, -b2 * w;
    Eigen::Vector4d input = Eigen::Vector4d::Zero();
    input(1) = w * w;

    const FilterMap map = facts(integrator).filter({h * a, h, input});
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            coefficients[kFilterXX + 2 * i + j] = map.transition(i, j);
            coefficients[kFilterYX + 2 * i + j] = map.transition(2 + i, j);
            coefficients[kFilterYY + 2 * i + j] = map.transition(2 + i, 2 + j);
        }
    }
    for (int stage = 0; stage < kFilterInputs; ++stage) {
        for (int i = 0; i < kFilterStates; ++i) {
            coefficients[kFilterInput + kFilterStates * stage + i] = map.inputs(i, stage);
        }
    }
}

machine::AlignedVector filter_coefficients(Integrator integrator, double w,
                                           std::span<const double> lengths,
                                           std::span<const double> mesh_periods) {
    const std::size_t lanes = mesh_periods.size();
    machine::AlignedVector all(lengths.size() * kFilterCoefficients * lanes);
    for (std::size_t kind = 0; kind < lengths.size(); ++kind) {
        for (std::size_t l = 0; l < lanes; ++l) {
            double coefficients[kFilterCoefficients];
            filter_step(integrator, w, lengths[kind] * mesh_periods[l], coefficients);
            for (std::size_t i = 0; i < kFilterCoefficients; ++i) {
                all[(kind * kFilterCoefficients + i) * lanes + l] = coefficients[i];
            }
        }
    }
    return all;
}

}  // namespace gearpod::lockstep
