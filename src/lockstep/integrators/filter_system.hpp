// Sensor's low-pass filter z' = A z + b u (sensor_filter.hpp) over one step of h seconds, as the
// argument of the methods' filter(). The result is linear in z and in the input u at the stages.
#pragma once

#include <Eigen/Dense>

#include "lockstep/integrators/sensor_filter.hpp"

namespace gearpod::lockstep {

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
