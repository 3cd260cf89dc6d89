#include "lockstep/sensor_filter.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace gearpod::lockstep {

void filter_step(double w, double h, double (&coefficients)[kFilterCoefficients]) {
    const double b1 = 2.0 * std::cos(std::numbers::pi / 8);
    const double b2 = 2.0 * std::cos(3 * std::numbers::pi / 8);
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1.0;
    a.row(1) << -w * w, -b1 * w, 0.0, 0.0;
    a(2, 3) = 1.0;
    a.row(3) << w * w, 0.0, -w * w, -b2 * w;
    Eigen::Vector4d input = Eigen::Vector4d::Zero();
    input(1) = w * w;

    // z' = A z + b u by classical Runge-Kutta with u at the start, middle and end of the step.
    const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d ha = h * a;
    const Eigen::Matrix4d ha2 = ha * ha;
    const Eigen::Matrix4d ha3 = ha2 * ha;
    const Eigen::Matrix4d transition = one + ha + ha2 / 2.0 + ha3 / 6.0 + ha3 * ha / 24.0;
    const Eigen::Vector4d start = h / 6.0 * (one + ha + ha2 / 2.0 + ha3 / 4.0) * input;
    const Eigen::Vector4d middle = h / 6.0 * (4.0 * one + 2.0 * ha + ha2 / 2.0) * input;
    const Eigen::Vector4d end = h / 6.0 * input;

    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            coefficients[kFilterXX + 2 * i + j] = transition(i, j);
            coefficients[kFilterYX + 2 * i + j] = transition(2 + i, j);
            coefficients[kFilterYY + 2 * i + j] = transition(2 + i, 2 + j);
        }
    }
    for (int i = 0; i < kFilterStates; ++i) {
        coefficients[kFilterInput + i] = start(i);
        coefficients[kFilterInput + 4 + i] = middle(i);
        coefficients[kFilterInput + 8 + i] = end(i);
    }
}

machine::AlignedVector filter_coefficients(double w, std::span<const double> lengths,
                                           std::span<const double> mesh_periods) {
    const std::size_t lanes = mesh_periods.size();
    machine::AlignedVector all(lengths.size() * kFilterCoefficients * lanes);
    for (std::size_t kind = 0; kind < lengths.size(); ++kind) {
        for (std::size_t l = 0; l < lanes; ++l) {
            double coefficients[kFilterCoefficients];
            filter_step(w, lengths[kind] * mesh_periods[l], coefficients);
            for (std::size_t i = 0; i < kFilterCoefficients; ++i) {
                all[(kind * kFilterCoefficients + i) * lanes + l] = coefficients[i];
            }
        }
    }
    return all;
}

}  // namespace gearpod::lockstep
