// Thinning of long curves for plots.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Returns ascending indices: all of them, or the smallest and the largest value of each of most / 2
// equal intervals, so that no peak is lost.
std::vector<std::size_t> extremes(std::span<const double> values, std::size_t most);

// Returns ascending indices: all of them, or the largest value of each of `most` equal intervals.
std::vector<std::size_t> maxima(std::span<const double> values, std::size_t most);

// Signals and spectra as JSON, thinned for plotting.

// Mesh phase and value of each sample; of many samples the extremes of each interval.
nlohmann::json time_json(std::span<const double> values, int samples_per_mesh);

// Spectra over the whole band and around the largest noise-free line, one-sided amplitudes over the
// whole span. `meshes`: lines per mesh frequency.
nlohmann::json spectrum_json(const std::vector<double>& clean, const std::vector<double>& noisy,
                             std::size_t meshes, double period_s);

// Spectrogram of a signal at uneven times: windows of eight mesh periods (Hann), one per mesh
// period, each with its mid time, its mean mesh frequency and levels in dB of the largest line.
// Frequencies up to `highest_Hz`.
nlohmann::json spectrogram_json(std::span<const double> time_s, const std::vector<double>& signal,
                                int samples_per_mesh, double highest_Hz);
inline constexpr int kSpectrogramWindow = 8;  // mesh periods
inline constexpr int kSpectrogramSlices = 150;

// Two example gearboxes of a results file, one healthy and one with the largest fault. They are
// computed again to show the signals from which features are computed, and the mesh stiffness.

// Returns {"examples": {"refusal", "noise_level", "gearboxes": [...]}, "stiffness": {"refusal",
// ...}} for the study stored in the file (docs/reference/report-json.md lists the keys). The
// gearboxes are the first rows with values of size 0 and of the largest size. `refusal` is the
// reason why there are none, or null.
nlohmann::json examples_json(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
