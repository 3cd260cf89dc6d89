// The sensor's time signal, sample by sample, for looking at a gearbox and for exporting it.
#pragma once

#include <span>
#include <vector>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Noise-free sensor signal of one gearbox, m/s^2, [k * P + p] for meshes first..first + count - 1
// of the span (k counted from `first`), with the tones that its lane has. The arithmetic is that of
// fold_squares: folding this signal gives its values. Throws std::invalid_argument if the shapes
// disagree.
std::vector<double> synthesize(const TileSignals& tile, int lane, const Timeline& timeline,
                               const SpanLayout& layout, const PathGrid& path, double path_exponent,
                               int first_mesh, int mesh_count, const Tones& tones = {});

// The same bits for the first lanes of a tile, as many as there are exponents, which read what was
// recorded once for several of them.
std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent, int first_mesh,
                                            int mesh_count, const Tones& tones = {});

// Those of some meshes k of the span alone, one after the other, without tones.
std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes);

}  // namespace gearpod::signals
