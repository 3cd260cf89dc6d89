#include "features/statistics/standardised_moment.hpp"

#include <numeric>

namespace gearpod::features {

double standardised_moment(std::span<const double> values, int power) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double second = 0.0;
    double high = 0.0;
    for (const double value : values) {
        const double square = (value - mean) * (value - mean);
        double product = square;
        for (int p = 2; p < power; p += 2) {
            product *= square;
        }
        second += square;
        high += product;
    }
    second /= count;
    double scale = second;
    for (int p = 2; p < power; p += 2) {
        scale *= second;
    }
    return high / count / scale;
}

}  // namespace gearpod::features
