// Low-pass filter of the sensor, integrated together with the motion: 4th-order Butterworth, two
// sections in series,
//   x'' + b1 w x' + w^2 x = w^2 input,   y'' + b2 w y' + w^2 y = w^2 x,   w = 2 pi f_cutoff,
// with b1 = 2 cos(pi/8) and b2 = 2 cos(3 pi/8). One step of the integrator is linear in the state
// (x, x', y, y') and in the input at up to six stages. Its coefficients are computed once per step
// length and gearbox.
#pragma once

#include <Eigen/Dense>

namespace gearpod::lockstep {

inline constexpr int kFilterStates = 4;  // x, x', y, y'; y is the output
inline constexpr int kFilterOutput = 2;
inline constexpr double kFilterDamping[] = {1.8477590650225735, 0.7653668647301797};  // b1, b2

// Offsets in the coefficients of one step: the transition matrix without its zero block, then the
// columns of the input at the stages, 0 where a method has none. newmark has start, none, end;
// central_difference only the midpoint.
inline constexpr int kFilterXX = 0;      // 2 x 2: x, x' from x, x'
inline constexpr int kFilterYX = 4;      // 2 x 2: y, y' from x, x'
inline constexpr int kFilterYY = 8;      // 2 x 2: y, y' from y, y'
inline constexpr int kFilterInput = 12;  // kFilterInputs x 4
inline constexpr int kFilterInputs = 6;
inline constexpr int kFilterCoefficients = kFilterInput + kFilterInputs * kFilterStates;

// Sensor's low-pass filter z' = A z + b u over one step of h seconds, as the
// argument of the methods' filter(). The result is linear in z and in the input u at the stages.

// next = transition * z + inputs * (u at the stages).
struct FilterMap {
    Eigen::Matrix4d transition = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, kFilterInputs> inputs =
        Eigen::Matrix<double, 4, kFilterInputs>::Zero();
};

struct FilterSystem {
    using Matrix = Eigen::Matrix4d;
    using Map = FilterMap;
    // A vector as a linear combination of z (columns 0-3) and of u at the stages (other columns).
    using Parts = Eigen::Matrix<double, 4, 4 + kFilterInputs>;

    Matrix a;  // h A
    double h = 0.0;
    Eigen::Vector4d b;

    static Matrix one() { return Matrix::Identity(); }
    // z itself.
    static Parts start() {
        Parts parts = Parts::Zero();
        parts.leftCols<4>().setIdentity();
        return parts;
    }
    // h times the slope of a stage at z = `from`.
    Parts slope(const Parts& from, int stage) const {
        Parts k = a * from;
        k.col(4 + stage) += h * b;
        return k;
    }
    static Map map(const Parts& end) { return {end.leftCols<4>(), end.rightCols<kFilterInputs>()}; }

    // Trapezoidal rule with the input at the step's ends, nodes 0 and 2.
    Map trapezoidal() const {
        const Matrix solve = (one() - a / 2.0).inverse();
        Map result;
        result.transition = solve * (one() + a / 2.0);
        result.inputs.col(0) = result.inputs.col(2) = solve * (h * b) / 2.0;
        return result;
    }
};

}  // namespace gearpod::lockstep
