#include "signals/windowing/folded_signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

namespace gearpod::signals {
namespace {

// Encodes (distinct mesh, carrier index) as one number, ordered by mesh.
struct PairCode {
    int positions;
    int operator()(int mesh, int carrier) const { return mesh * positions + carrier; }
};

// One sum: pair codes with their numbers of occurrences, in the order of addition.
using Occurrences = std::vector<std::pair<int, int>>;

// Pairs of tooth j with their counts. Order and counts follow the carrier index and the place in
// the timeline, never the number of the mesh. Which places share a recorded mesh differs with the
// tile's other lanes, and a lane's sum must not depend on them.
Occurrences occurrences_of_tooth(int j, const Timeline& timeline, const SpanLayout& layout,
                                 PairCode code) {
    const long length = static_cast<long>(timeline.size());
    std::vector<std::pair<int, int>> met;  // carrier index, place
    for (int i = 0; i < layout.ring_teeth; ++i) {
        const long k = j + static_cast<long>(i) * layout.planet_teeth;
        met.emplace_back(static_cast<int>(k % layout.carrier_meshes), static_cast<int>(k % length));
    }
    std::sort(met.begin(), met.end());
    Occurrences occurrences;
    for (std::size_t i = 0; i < met.size(); ++i) {
        const auto [carrier, index] = met[i];
        if (i == 0 || met[i] != met[i - 1]) {
            occurrences.emplace_back(code(timeline[static_cast<std::size_t>(index)], carrier), 0);
        }
        ++occurrences.back().second;
    }
    return occurrences;
}

// Numbers the occurring codes in ascending order. Returns the number of each code, -1 for codes
// that do not occur.
std::vector<int> number_pairs(const std::vector<Occurrences>& sums, int meshes, PairCode code,
                              FoldPlan::Pairs& pairs) {
    std::vector<int> number(static_cast<std::size_t>(meshes) * code.positions, -1);
    for (const Occurrences& sum : sums) {
        for (const auto& [c, count] : sum) {
            number[c] = 0;
        }
    }
    pairs.first.push_back(0);
    for (std::size_t c = 0; c < number.size(); ++c) {
        if (number[c] == 0) {
            number[c] = static_cast<int>(pairs.carrier.size());
            pairs.carrier.push_back(static_cast<int>(c) % code.positions);
        }
        if ((c + 1) % code.positions == 0) {
            pairs.first.push_back(static_cast<int>(pairs.carrier.size()));
        }
    }
    return number;
}

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

FoldPlan::FoldPlan(const Timeline& timeline, const SpanLayout& layout) : layout_(layout) {
    if (layout.planet_teeth < 1 || layout.ring_teeth < 1 || layout.carrier_meshes < 1) {
        throw std::invalid_argument("fold plan: the span has no meshes");
    }
    if (timeline.empty() || *std::min_element(timeline.begin(), timeline.end()) < 0) {
        throw std::invalid_argument("fold plan: the timeline is empty or names negative meshes");
    }
    largest_mesh_ = *std::max_element(timeline.begin(), timeline.end());
    const PairCode code{layout.carrier_meshes};

    std::map<Occurrences, int> known;
    std::vector<Occurrences> distinct;
    for (int j = 0; j < layout.planet_teeth; ++j) {
        Occurrences sum = occurrences_of_tooth(j, timeline, layout, code);
        const auto [entry, is_new] = known.try_emplace(sum, static_cast<int>(distinct.size()));
        sum_of_tooth_.push_back(entry->second);
        if (is_new) {
            distinct.push_back(std::move(sum));
        }
    }

    const std::vector<int> number = number_pairs(distinct, largest_mesh_ + 1, code, pairs_);
    sums_.first.push_back(0);
    for (const Occurrences& sum : distinct) {
        for (const auto& [c, count] : sum) {
            sums_.pair.push_back(number[c]);
            sums_.count.push_back(count);
        }
        sums_.first.push_back(static_cast<int>(sums_.pair.size()));
    }
    for (long k = 0; k < layout.meshes(); ++k) {
        const int mesh = timeline[k % static_cast<long>(timeline.size())];
        pair_of_mesh_.push_back(number[code(mesh, static_cast<int>(k % layout.carrier_meshes))]);
    }
}

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
