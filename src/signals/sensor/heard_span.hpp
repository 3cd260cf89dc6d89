// What the sensor and the encoders of a tile's gearboxes take from a march whose meshes come one
// after the other and are not kept: the sensor's signal, its folded squares and the averaged
// transmission error. Of a mesh period of W gearboxes that is 1/2N of what the march records.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

class HeardSpan {
  public:
    struct Tile {
        int lanes = 0;                      // 16, 8, 4 or 1
        std::span<const double> exponents;  // of the path, 1/rad^2, one a lane
        const Tones* tones = nullptr;       // with their lanes
        int te_phases = 0;                  // P_te, divides P
        int heard_meshes = 0;               // of the signal
        int kept_meshes = 0;                // of them, the first: those whose samples are kept
    };

    // `path` must outlive the march that is heard. Throws std::invalid_argument if the shapes
    // disagree.
    HeardSpan(const PathGrid& path, const SpanLayout& layout, const Tile& tile);

    // Mesh k of the signal, each once and in order: accel[p][channel][lane] and te[p][lane] as in
    // TileSignals.
    void hear(int k, const double* accel, const double* te);

    // As fold_squares of the span, summed in the order of the meshes.
    const machine::AlignedVector& folded() const { return folded_; }
    // The bits of average_te.
    machine::AlignedVector averaged_te() const;
    // The bits of synthesize for the first meshes, at most `kept_meshes`; of the first so many
    // lanes, or of one.
    std::vector<std::vector<double>> signals(std::size_t lanes, int meshes) const;
    std::vector<double> signal(int lane, int meshes) const;

  private:
    std::size_t samples(int meshes) const;

    const PathGrid* const path_;
    const int phases_;
    const SpanLayout layout_;
    const std::size_t lanes_;
    const int te_phases_, kept_meshes_, heard_meshes_;
    machine::AlignedVector weight_, folded_, te_, signal_, unkept_;
    std::optional<ToneTable> tones_;
};

}  // namespace gearpod::signals
