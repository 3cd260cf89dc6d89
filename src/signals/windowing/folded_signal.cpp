#include "signals/windowing/folded_signal.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "signals/windowing/fold_squares.hpp"

namespace gearpod::signals {
namespace {

void check_shapes(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::size_t exponents) {
    check_tile(tile, {0, plan.largest_mesh()});
    if (path.planets() != tile.sources() || path.phases() != tile.phases ||
        path.positions() != plan.layout().carrier_meshes ||
        exponents != static_cast<std::size_t>(tile.lanes)) {
        throw std::invalid_argument(
            fmt::format("fold: tile of {} planets, {} phases, {} lanes against a path of {} "
                        "planets, {} phases, "
                        "{} exponents; {} carrier positions against {}",
                        tile.planets, tile.phases, tile.lanes, path.planets(), path.phases(),
                        exponents, path.positions(), plan.layout().carrier_meshes));
    }
}

}  // namespace

void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, machine::AlignedVector& folded) {
    fold_squares(tile, plan, path, path_exponent, {}, folded);
}

void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, const Tones& tones,
                  machine::AlignedVector& folded) {
    check_shapes(tile, plan, path, path_exponent.size());
    const std::size_t lanes = tile.lanes;
    const std::size_t positions = path.positions();
    const machine::AlignedVector exponent(path_exponent.begin(), path_exponent.end());
    machine::AlignedVector whole_steps((positions / 2 + 1) * lanes);
    machine::AlignedVector weight(positions * tile.planets * lanes);
    machine::AlignedVector pairs(plan.pairs().carrier.size() * lanes *
                                 (tones.empty() ? 1 : kTonePhases));
    machine::AlignedVector totals(plan.sums().first.size() * lanes);
    folded.resize(static_cast<std::size_t>(plan.layout().planet_teeth) * tile.phases * lanes);

    FoldArguments a;
    a.path = &path;
    a.plan = &plan;
    a.accel = tile.accel.data();
    a.exponent = exponent.data();
    std::optional<ToneTable> table;
    if (!tones.empty()) {
        table.emplace(tones, tile.lanes, 0, plan.layout().meshes(), tile.phases);
        a.tones = &*table;
    }
    a.whole_steps = whole_steps.data();
    a.weight = weight.data();
    a.pairs = pairs.data();
    a.totals = totals.data();
    a.folded = folded.data();
    (a.tones != nullptr ? fold_tones : fold_squares_without_tones)(static_cast<int>(lanes), a);
}

}  // namespace gearpod::signals
