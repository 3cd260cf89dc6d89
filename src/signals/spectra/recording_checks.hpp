// Spectra of recordings, and detection of lost samples.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace gearpod::signals {

// The first samples, at most 2^20, of the largest even number with no prime factors other than 2, 3
// and 5: the Fourier transform of so many is fast.
std::span<const double> fast_part(std::span<const double> samples);

// Amplitudes by order of samples less their mean in a Hann window, an even number, followed by
// zeros, which interpolate the spectrum.
std::vector<double> hann_amplitudes(std::span<const double> samples, int zeros = 0);

// Detection of unreported missing samples inside a recording, after which the signal comes too
// early. In steady running every turn (of the carrier or the wheel) resembles the one before it.
// Their cross-correlation peaks at a lag of zero, or at a constant small lag where the speed is
// slightly off. A turn that lost samples is early by their number.
struct LostSamples {
    double meshes = 0.0;                // missing mesh periods, modulo whole ones: -1/2 to 1/2
    int first_mesh = 0, last_mesh = 0;  // the loss lies between these
    bool found = false;
};

// `samples` are evenly spaced in mesh phase, `per_mesh` per mesh period; `turn_meshes` is the
// number of mesh periods of a turn. A loss is found if it exceeds the scatter of the lags, which is
// taken as at least a twentieth of a sample. Empty where no loss could be detected: fewer than six
// turns, or turns whose correlation is too low. A loss of whole mesh periods is never detected.
std::optional<LostSamples> lost_samples(std::span<const double> samples, int per_mesh,
                                        int turn_meshes);

}  // namespace gearpod::signals
