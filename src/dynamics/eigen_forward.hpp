// Eigen's vectors and matrices by name alone, for headers that only declare functions of them:
// reading Eigen takes the compiler a second, and most who ask about a gearbox need none of it.
#pragma once

namespace Eigen {

template <typename Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
class Matrix;

using VectorXd = Matrix<double, -1, 1, 0, -1, 1>;
using MatrixXd = Matrix<double, -1, -1, 0, -1, -1>;
using MatrixX2d = Matrix<double, -1, 2, 0, -1, 2>;

}  // namespace Eigen
