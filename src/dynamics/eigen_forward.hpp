// Forward declarations of Eigen's vectors and matrices, for headers that only declare functions of
// them. Including Eigen takes the compiler a second, and most users of a gearbox do not need it.
#pragma once

namespace Eigen {

template <typename Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
class Matrix;

using VectorXd = Matrix<double, -1, 1, 0, -1, 1>;
using MatrixXd = Matrix<double, -1, -1, 0, -1, -1>;
using MatrixX2d = Matrix<double, -1, 2, 0, -1, 2>;

}  // namespace Eigen
