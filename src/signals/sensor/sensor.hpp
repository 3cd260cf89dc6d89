// Sensor signal of a gearbox in time, sample by sample, for display and export.
#pragma once

#include <span>
#include <vector>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Noise-free sensor signal of one gearbox, m/s^2, [k * P + p] for meshes first..first + count - 1
// of the span (k counted from `first`), with the tones of its lane. The arithmetic is that of
// fold_squares, so that folding this signal gives the same values. Throws std::invalid_argument if
// the shapes disagree.
std::vector<double> synthesize(const TileSignals& tile, int lane, const Timeline& timeline,
                               const SpanLayout& layout, const PathGrid& path, double path_exponent,
                               int first_mesh, int mesh_count, const Tones& tones = {});

// Sensor signals of the first lanes of a tile, one per exponent, with the same bits. The recorded
// motions are read once for several lanes.
std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent, int first_mesh,
                                            int mesh_count, const Tones& tones = {});

// Sensor signals of selected meshes k of the span, concatenated, without tones.
std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes);

}  // namespace gearpod::signals
