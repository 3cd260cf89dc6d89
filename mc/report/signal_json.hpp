// Signals and spectra as JSON, thinned for plotting.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace gearpod::mc {

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

}  // namespace gearpod::mc
