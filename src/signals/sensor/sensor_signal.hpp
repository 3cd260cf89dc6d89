// Sensor signal of a gearbox in time, sample by sample, for display and export.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "machine/ids.hpp"
#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Noise-free sensor signal of one gearbox, m/s^2, [k * P + p] for meshes first..first + count - 1
// of the span (k counted from `first`), with the tones of its lane. The arithmetic is that of
// fold_squares, so that folding this signal gives the same values. Throws std::invalid_argument if
// the shapes disagree.
std::vector<double> synthesize(const TileSignals& tile, LaneId lane, const Timeline& timeline,
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

// Records the sensor and encoder signals of a tile while it is integrated mesh by mesh. It keeps
// the sensor signal, its folded squares and the averaged transmission error, not the motions. For a
// mesh period of W gearboxes that is 1/2N of the data that the integration records.
class SensorResponse {
  public:
    struct Tile {
        int lanes = 0;                      // 16, 8, 4 or 1
        std::span<const double> exponents;  // path exponents, 1/rad^2, one per lane
        const Tones* tones = nullptr;       // tones of the same lanes
        int te_phases = 0;                  // P_te, encoder samples per mesh period, divides P
        int signal_meshes = 0;              // number of meshes of the signal
        int kept_meshes = 0;                // number of first meshes whose samples are kept
        bool keeps_te = false;              // true if those of the transmission error are kept, too
        int sources = 0;  // recorded sources (TileSignals); 0: the planets of the path
    };

    // `path` must outlive the object. Throws std::invalid_argument if the shapes disagree.
    SensorResponse(const PathGrid& path, const SpanLayout& layout, const Tile& tile);

    // Records mesh k of the signal. Each mesh is recorded once, in order. accel[p][channel][lane]
    // and te[p][lane] are as in TileSignals.
    void record_mesh(int k, const double* accel, const double* te);

    // Folded squares of the span as from fold_squares, summed in the order of the meshes.
    const machine::AlignedVector& folded() const { return folded_; }
    // Averaged transmission error, with the same bits as average_te.
    machine::AlignedVector averaged_te() const;
    // Sensor signals of the first meshes, at most `kept_meshes`, for the first `lanes` lanes or for
    // one lane. The bits are those of synthesize.
    std::vector<std::vector<double>> signals(std::size_t lanes, int meshes) const;
    std::vector<double> signal(LaneId lane, int meshes) const;
    // Transmission error of one lane in the first meshes, rad, [k * P_te + p]; needs keeps_te.
    std::vector<double> te_signal(LaneId lane, int meshes) const;

  private:
    std::size_t samples(int meshes) const;
    std::size_t te_samples(int meshes) const;

    const PathGrid* const path_;
    const int phases_;
    const SpanLayout layout_;
    const std::size_t lanes_;
    const int te_phases_, kept_meshes_, signal_meshes_, sources_;
    machine::AlignedVector weight_, folded_, te_, signal_, te_signal_, discarded_;
    std::optional<ToneTable> tones_;
};

}  // namespace gearpod::signals
