// Checks the speed of a signal by the mesh lines of its spectrum.
//
// In steady running all lines of a gearbox are multiples of the turn frequency of the carrier (of
// the wheel, for a fixed-shaft pair). The lines of a mesh cluster around the multiples k of the
// mesh frequency. A comb of these lines, stretched by `ratio`, is compared with the strong lines of
// the spectrum. The ratio of the best fit is the signal's speed over the assumed one.
//
// A stretch by one comb tooth maps the lines of k = 1 to their neighbours, but the lines of the
// k-th harmonic k teeth away, where lines are weaker. With few harmonics such a ratio may fit
// nearly as well; it is then reported as `other`.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace gearpod::signals {

struct MeshSpeed {
    double ratio = 1.0;   // best-fitting speed over the assumed one
    double fit = 0.0;     // fraction of the lines' amplitudes that the comb covers at `ratio`
    double stated = 0.0;  // the same at a ratio of 1
    double other = 0.0;   // another ratio with nearly the same fit; 0: none
    int harmonics = 0;    // number of mesh harmonics with lines
};

// The first samples, at most 2^20, of the largest even number with no prime factors other than 2, 3
// and 5: the Fourier transform of so many is fast.
std::span<const double> fast_part(std::span<const double> samples);

// Amplitudes by order of samples less their `mean` in a Hann window; an even number of samples.
std::vector<double> hann_amplitudes(std::span<const double> samples, double mean);

// `samples` are evenly spaced in mesh phase, `per_mesh` per mesh period; `turn_meshes` is the
// number of mesh periods of a turn. Searches ratios from 0.94 to 1.06. Empty if the data do not
// suffice: fewer than four turns, fewer than three harmonics with lines, or no ratio with an
// acceptable fit.
std::optional<MeshSpeed> mesh_speed(std::span<const double> samples, int per_mesh, int turn_meshes);

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
