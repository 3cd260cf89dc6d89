#include "lockstep/integrators/sensor_filter.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace gearpod::lockstep {

namespace {

// One step as a linear map: next = transition * state + inputs * (u at the three nodes).
struct FilterMap {
    Eigen::Matrix4d transition;
    Eigen::Matrix<double, 4, 3> inputs;
};

// z' = A z + b u by classical Runge-Kutta with u at the start, middle and end of the step.
FilterMap runge_kutta(const Eigen::Matrix4d& ha, double h, const Eigen::Vector4d& b) {
    const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d ha2 = ha * ha;
    const Eigen::Matrix4d ha3 = ha2 * ha;
    FilterMap map;
    map.transition = one + ha + ha2 / 2.0 + ha3 / 6.0 + ha3 * ha / 24.0;
    map.inputs.col(0) = h / 6.0 * (one + ha + ha2 / 2.0 + ha3 / 4.0) * b;
    map.inputs.col(1) = h / 6.0 * (4.0 * one + 2.0 * ha + ha2 / 2.0) * b;
    map.inputs.col(2) = h / 6.0 * b;
    return map;
}

// z' = A z + b u by the three stages of Bogacki and Shampine, u at 0, 1/2 and 3/4 of the step.
FilterMap bogacki_shampine(const Eigen::Matrix4d& ha, const Eigen::Vector4d& hb) {
    using Slopes = Eigen::Matrix<double, 4, 7>;  // of the stages, times h, from state and inputs
    Slopes state = Slopes::Zero();
    state.leftCols<4>().setIdentity();
    const auto slopes = [&](const Slopes& from, int node) -> Slopes {
        Slopes k = ha * from;
        k.col(4 + node) += hb;
        return k;
    };
    const Slopes k1 = slopes(state, 0);
    const Slopes k2 = slopes(state + k1 / 2.0, 1);
    const Slopes k3 = slopes(state + 0.75 * k2, 2);
    const Slopes end = state + (2.0 * k1 + 3.0 * k2 + 4.0 * k3) / 9.0;
    return {end.leftCols<4>(), end.rightCols<3>()};
}

FilterMap trapezoidal(const Eigen::Matrix4d& ha, const Eigen::Vector4d& hb) {
    const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d solve = (one - ha / 2.0).inverse();
    FilterMap map;
    map.transition = solve * (one + ha / 2.0);
    map.inputs.col(0) = map.inputs.col(2) = solve * hb / 2.0;
    map.inputs.col(1).setZero();
    return map;
}

// The same with the input at the step's middle alone.
FilterMap midpoint(const Eigen::Matrix4d& ha, const Eigen::Vector4d& hb) {
    FilterMap map = trapezoidal(ha, hb);
    map.inputs.col(0) *= 2.0;
    map.inputs.col(2).setZero();
    return map;
}

// The trapezoidal rule on a straight line through the input at two times `lag` steps before the
// step's ends.
FilterMap lagging(const Eigen::Matrix4d& ha, const Eigen::Vector4d& hb, double lag) {
    const FilterMap ends = trapezoidal(ha, hb);
    FilterMap map = ends;
    map.inputs.col(0) = (1.0 - lag) * ends.inputs.col(0) - lag * ends.inputs.col(2);
    map.inputs.col(2) = lag * ends.inputs.col(0) + (1.0 + lag) * ends.inputs.col(2);
    return map;
}

FilterMap alexander(const Eigen::Matrix4d& ha, const Eigen::Vector4d& hb) {
    const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d solve = (one - Alexander::kDiagonal * ha).inverse();
    // Slopes of the stages, times h, from the state and the three inputs.
    using Slopes = Eigen::Matrix<double, 4, 7>;
    Slopes known = Slopes::Zero();
    known.leftCols<4>() = one;
    const auto slopes = [&](const Slopes& from, int node) -> Slopes {
        Slopes right = ha * from;
        right.col(4 + node) += hb;
        return solve * right;
    };
    const Slopes k1 = slopes(known, 0);
    const Slopes k2 = slopes(known + Alexander::k21 * k1, 1);
    const Slopes third = known + Alexander::k31 * k1 + Alexander::k32 * k2;
    const Slopes end = third + Alexander::kDiagonal * slopes(third, 2);
    return {end.leftCols<4>(), end.rightCols<3>()};
}

FilterMap filter_map(Integrator integrator, const Eigen::Matrix4d& ha, double h,
                     const Eigen::Vector4d& b) {
    switch (integrator) {
        case Integrator::newmark:
            return trapezoidal(ha, h * b);
        case Integrator::sdirk3:
            return alexander(ha, h * b);
        case Integrator::generalized_alpha:
            return lagging(ha, h * b, ChungHulbert::kLag);
        case Integrator::bs3:
            return bogacki_shampine(ha, h * b);
        case Integrator::central_difference:
            return midpoint(ha, h * b);
        case Integrator::rk4:
            break;
    }
    return runge_kutta(ha, h, b);
}

}  // namespace

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

    const FilterMap map = filter_map(integrator, h * a, h, input);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            coefficients[kFilterXX + 2 * i + j] = map.transition(i, j);
            coefficients[kFilterYX + 2 * i + j] = map.transition(2 + i, j);
            coefficients[kFilterYY + 2 * i + j] = map.transition(2 + i, 2 + j);
        }
    }
    for (int node = 0; node < 3; ++node) {
        for (int i = 0; i < kFilterStates; ++i) {
            coefficients[kFilterInput + 4 * node + i] = map.inputs(i, node);
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
