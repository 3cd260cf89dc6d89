#include "signals/spectra/periodic_interpolation.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr std::size_t kDenser = 4;
// Dense samples repeated before and after the period, within which the ends of the spline lose
// their influence: it decays by a factor of 3.7 per sample.
constexpr std::size_t kMargin = 32;

// The period, sampled kDenser times as densely.
std::vector<double> dense(std::span<const double> period) {
    const std::size_t n = period.size();
    if (n < 4) {
        throw std::invalid_argument("periodic interpolation: needs at least 4 samples");
    }
    std::vector<std::complex<double>> values(period.begin(), period.end()), spectrum(n),
        wide(kDenser * n), all(kDenser * n);
    FourierTransform(static_cast<int>(n)).transform(values, spectrum);
    for (std::size_t k = 0; 2 * k <= n; ++k) {
        const double share = (2 * k == n ? 0.5 : 1.0) / static_cast<double>(n);
        wide[k] = share * spectrum[k];
        if (k > 0) {
            wide[wide.size() - k] = share * spectrum[n - k];
        }
    }
    FourierTransform(static_cast<int>(wide.size()), FourierTransform::Direction::back)
        .transform(wide, all);
    std::vector<double> repeated(all.size() + 2 * kMargin + 1);
    for (std::size_t i = 0; i < repeated.size(); ++i) {
        repeated[i] = all[(i + all.size() * kMargin - kMargin) % all.size()].real();
    }
    return repeated;
}

}  // namespace

PeriodicInterpolation::PeriodicInterpolation(std::span<const double> period)
    : samples_(static_cast<double>(period.size())), spline_([&] {
          const std::vector<double> samples = dense(period);
          return boost::math::interpolators::cardinal_cubic_b_spline<double>(
              samples.begin(), samples.end(), -static_cast<double>(kMargin) / kDenser,
              1.0 / kDenser);
      }()) {}

double PeriodicInterpolation::operator()(double position) const {
    return spline_(position - samples_ * std::floor(position / samples_));
}

}  // namespace gearpod::signals
