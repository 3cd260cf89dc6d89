// Where one periodic signal lies in another: records of the same gearbox that began at different
// teeth or carrier positions.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

struct Alignment {
    double shift = 0.0;        // samples, in [0, n): other(i + shift) is most like signal(i)
    double correlation = 0.0;  // there, from -1 to 1; 0 if either is constant
};

// Of two signals of n samples, one period each, their means left aside: the largest value of their
// circular correlation, between samples too (band-limited). Throws std::invalid_argument unless
// both have the same number of samples, and some.
Alignment align(std::span<const double> signal, std::span<const double> other);

// The correlation as they stand, at no shift.
double correlation(std::span<const double> signal, std::span<const double> other);

// periodic(i + shift) for every sample i, band-limited between samples.
std::vector<double> shifted(std::span<const double> periodic, double shift);

}  // namespace gearpod::signals
