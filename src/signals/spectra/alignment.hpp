// Alignment of one periodic signal with another, for records of the same gearbox that began at
// different teeth or carrier positions.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Shift by whole samples and a fraction of -1 to 1. One number would lose digits of the fraction.
struct Shift {
    long samples = 0;
    double fraction = 0.0;

    double total() const { return static_cast<double>(samples) + fraction; }
};

struct Alignment {
    Shift shift;  // samples, from -1 to n: other(i + shift) is most similar to signal(i)
    double correlation = 0.0;  // at that shift, from -1 to 1; 0 if either is constant
};

// Maximum of the circular correlation of two signals of n samples, one period each, without their
// means. Shifts between samples are included (band-limited). Throws std::invalid_argument unless
// both have the same number of samples, at least one.
Alignment align(std::span<const double> signal, std::span<const double> other);

// Correlation without a shift.
double correlation(std::span<const double> signal, std::span<const double> other);

// Periodic signal shifted to periodic(i + shift) at every sample i, band-limited between samples.
std::vector<double> shifted(std::span<const double> periodic, const Shift& shift);

}  // namespace gearpod::signals
