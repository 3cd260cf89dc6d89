#include "signals/prediction/toeplitz.hpp"

namespace gearpod::signals {

std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b) {
    // `predictor`: 1, a_1, ..., a_m of the prediction error filter of order m.
    std::vector<double> predictor{1.0}, solution{b[0] / r[0]};
    double error = r[0];
    for (std::size_t m = 1; m < r.size(); ++m) {
        double mismatch = 0.0;
        for (std::size_t j = 0; j < m; ++j) {
            mismatch += predictor[j] * r[m - j];
        }
        const double reflection = -mismatch / error;
        std::vector<double> next(m + 1, 0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            next[j] = (j < m ? predictor[j] : 0.0) + (j > 0 ? reflection * predictor[m - j] : 0.0);
        }
        predictor = std::move(next);
        error *= 1.0 - reflection * reflection;
        double remainder = b[m];
        for (std::size_t j = 0; j < m; ++j) {
            remainder -= r[m - j] * solution[j];
        }
        const double step = remainder / error;
        solution.push_back(0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            solution[j] += step * predictor[m - j];
        }
    }
    return solution;
}

}  // namespace gearpod::signals
