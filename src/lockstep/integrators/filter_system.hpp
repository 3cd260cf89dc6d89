// The sensor's low-pass z' = A z + b u (sensor_filter.hpp) along one step of h seconds, as the
// methods' filter() sees it: what z becomes is linear in z and in the input u at the stage nodes.
#pragma once

#include <Eigen/Dense>

namespace gearpod::lockstep {

// next = transition * z + inputs * (u at up to three stage nodes).
struct FilterMap {
    Eigen::Matrix4d transition;
    Eigen::Matrix<double, 4, 3> inputs;
};

struct FilterSystem {
    using Matrix = Eigen::Matrix4d;
    using Map = FilterMap;
    // A vector as the sum of z (columns 0-3) and u at three nodes (4-6).
    using Parts = Eigen::Matrix<double, 4, 7>;

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
    Parts slope(const Parts& from, int node) const {
        Parts k = a * from;
        k.col(4 + node) += h * b;
        return k;
    }
    static Map map(const Parts& end) { return {end.leftCols<4>(), end.rightCols<3>()}; }

    // With the input at the step's ends, nodes 0 and 2.
    Map trapezoidal() const {
        const Matrix solve = (one() - a / 2.0).inverse();
        Map result;
        result.transition = solve * (one() + a / 2.0);
        result.inputs.col(0) = result.inputs.col(2) = solve * (h * b) / 2.0;
        result.inputs.col(1).setZero();
        return result;
    }
};

}  // namespace gearpod::lockstep
