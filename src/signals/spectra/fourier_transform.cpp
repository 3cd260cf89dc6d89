#include "signals/spectra/fourier_transform.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "signals/spectra/prime_stage.hpp"

namespace gearpod::signals {
namespace {

using Complex = std::complex<double>;

// Largest factor for which kissfft has a specialised butterfly.
constexpr int kSmallFactor = 5;

// Transforms that a thread keeps: their number and their largest length limit the memory.
constexpr std::size_t kMostKnown = 16;
constexpr int kMostKnownPoints = 1 << 15;

int largest_prime_factor(int n) {
    int largest = 1;
    for (int p = 2; p * p <= n; ++p) {
        while (n % p == 0) {
            largest = p;
            n /= p;
        }
    }
    return n > 1 ? n : largest;
}

int prime_to_split_off(int points) {
    if (points < 1) {
        throw std::invalid_argument("Fourier transform: needs a point");
    }
    const int prime = largest_prime_factor(points);
    return prime > kSmallFactor && prime < points ? prime : 1;
}

// Angle 2 pi i / n, with i reduced modulo n first.
double angle(long i, long n) {
    return 2.0 * std::numbers::pi * static_cast<double>(i % n) / static_cast<double>(n);
}

}  // namespace

FourierTransform::FourierTransform(int points, Direction way)
    : FourierTransform(known(points, way)) {}

// The sines and cosines of a length cost more than a transform, and few lengths occur in a run.
FourierTransform FourierTransform::known(int points, Direction way) {
    thread_local std::map<std::pair<int, Direction>, FourierTransform> known;
    const auto found = known.find({points, way});
    if (found != known.end()) {
        return found->second;
    }
    FourierTransform transform(Computed{}, points, way);
    if (points <= kMostKnownPoints) {
        if (known.size() >= kMostKnown) {
            known.clear();
        }
        known.emplace(std::pair(points, way), transform);
    }
    return transform;
}

FourierTransform::FourierTransform(Computed, int points, Direction way)
    : prime_(prime_to_split_off(points)),
      part_(points / prime_),
      fft_(static_cast<std::size_t>(part_), way == Direction::back),
      row_((static_cast<std::size_t>(part_) + kColumns - 1) / kColumns * kColumns),
      part_spectrum_(part_) {
    if (prime_ == 1) {
        return;
    }
    const double sign = way == Direction::back ? 1.0 : -1.0;
    for (long r = 0; r < prime_; ++r) {
        for (long k = 0; k < part_; ++k) {
            twiddle_.emplace_back(std::cos(angle(r * k, points)),
                                  sign * std::sin(angle(r * k, points)));
        }
    }
    const int half = (prime_ - 1) / 2;
    for (long s = 1; s <= half; ++s) {
        for (long r = 1; r <= half; ++r) {
            cosine_.push_back(std::cos(angle(r * s, prime_)));
            sine_.push_back(sign * std::sin(angle(r * s, prime_)));
        }
    }
    for (machine::AlignedVector* values : {&real_, &imaginary_, &out_real_, &out_imaginary_}) {
        values->resize(static_cast<std::size_t>(prime_) * row_);
    }
}

// Transforms every part; part r consists of every q-th point from r on.
void FourierTransform::transform_parts(std::span<const Complex> in) {
    const Complex* twiddle = twiddle_.data();
    for (int r = 0; r < prime_; ++r) {
        fft_.transform(in.data() + r, part_spectrum_.data(), 0, 1,
                       static_cast<std::size_t>(prime_));
        double* real = real_.data() + static_cast<std::size_t>(r) * row_;
        double* imaginary = imaginary_.data() + static_cast<std::size_t>(r) * row_;
        for (int k = 0; k < part_; ++k) {
            const Complex z = part_spectrum_[k] * *twiddle++;
            real[k] = z.real();
            imaginary[k] = z.imag();
        }
    }
}

void FourierTransform::transform(std::span<const Complex> in, std::span<Complex> out) {
    if (in.size() != static_cast<std::size_t>(points()) || out.size() != in.size()) {
        throw std::invalid_argument("Fourier transform: signal and plan disagree in size");
    }
    if (prime_ == 1) {
        fft_.transform(in.data(), out.data());
        return;
    }
    transform_parts(in);
    PrimeStageArguments a;
    a.prime = prime_;
    a.row = static_cast<long>(row_);
    a.cosine = cosine_.data();
    a.sine = sine_.data();
    a.real = real_.data();
    a.imaginary = imaginary_.data();
    a.out_real = out_real_.data();
    a.out_imaginary = out_imaginary_.data();
    prime_stage(a);
    for (int s = 0; s < prime_; ++s) {
        for (int k = 0; k < part_; ++k) {
            const std::size_t index = static_cast<std::size_t>(s) * row_ + k;
            out[static_cast<std::size_t>(s) * part_ + k] = {out_real_[index],
                                                            out_imaginary_[index]};
        }
    }
}

std::vector<Complex> spectrum_of(std::span<const double> signal) {
    const std::vector<Complex> values(signal.begin(), signal.end());
    std::vector<Complex> spectrum(signal.size());
    FourierTransform(static_cast<int>(signal.size())).transform(values, spectrum);
    return spectrum;
}

std::vector<double> signal_of(std::span<const Complex> spectrum) {
    const std::size_t n = spectrum.size();
    std::vector<Complex> values(n);
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> signal(n);
    for (std::size_t i = 0; i < n; ++i) {
        signal[i] = values[i].real() / static_cast<double>(n);
    }
    return signal;
}

}  // namespace gearpod::signals
