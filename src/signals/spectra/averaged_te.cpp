#include "signals/spectra/averaged_te.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace gearpod::signals {
namespace {

// Place of the timeline that tooth j meets, with the fraction of its Z_r turns at which it does.
// Places are used rather than distinct meshes: which places share a distinct mesh differs with the
// tile's other lanes, and a lane's sum must not depend on them.
struct Place {
    std::size_t place = 0;
    double share = 0.0;
};

std::vector<Place> places_of_tooth(int j, const Timeline& timeline, const SpanLayout& layout) {
    std::vector<double> turns(timeline.size(), 0.0);
    for (long i = 0; i < layout.ring_teeth; ++i) {
        const long k = j + i * layout.planet_teeth;
        turns[static_cast<std::size_t>(k) % timeline.size()] += 1.0;
    }
    std::vector<Place> places;
    for (std::size_t place = 0; place < turns.size(); ++place) {
        if (turns[place] > 0.0) {
            places.push_back({place, turns[place] / layout.ring_teeth});
        }
    }
    return places;
}

}  // namespace

void remove_lane_means(machine::AlignedVector& values, int lanes) {
    std::vector<double> mean(lanes, 0.0);
    const std::size_t points = values.size() / lanes;
    for (std::size_t i = 0; i < points; ++i) {
        for (int l = 0; l < lanes; ++l) {
            mean[l] += values[i * lanes + l];
        }
    }
    for (std::size_t i = 0; i < points; ++i) {
        for (int l = 0; l < lanes; ++l) {
            values[i * lanes + l] -= mean[l] / static_cast<double>(points);
        }
    }
}

void add_te_mesh(std::span<const double> te, double share, int te_phases, std::span<double> sum) {
    const std::size_t phases = static_cast<std::size_t>(te_phases);
    const std::size_t lanes = sum.size() / phases, stride = te.size() / phases;
    for (std::size_t p = 0; p < phases; ++p) {
        for (std::size_t l = 0; l < lanes; ++l) {
            sum[p * lanes + l] += share * te[p * stride + l];
        }
    }
}

void average_te(const TileSignals& tile, const Timeline& timeline, const SpanLayout& layout,
                int te_phases, machine::AlignedVector& te_turn) {
    check_tile(tile, timeline);
    if (te_phases < 1 || tile.phases % te_phases != 0 || layout.meshes() < 1) {
        throw std::invalid_argument(
            fmt::format("averaged transmission error: {} encoder samples per mesh of {} samples, "
                        "{} meshes",
                        te_phases, tile.phases, layout.meshes()));
    }
    const int lanes = tile.lanes;
    const std::size_t per_mesh = static_cast<std::size_t>(te_phases) * lanes;
    const std::size_t mesh = static_cast<std::size_t>(tile.phases) * lanes;
    te_turn.assign(static_cast<std::size_t>(layout.planet_teeth) * per_mesh, 0.0);
    for (int j = 0; j < layout.planet_teeth; ++j) {
        double* out = te_turn.data() + static_cast<std::size_t>(j) * per_mesh;
        for (const auto& [place, share] : places_of_tooth(j, timeline, layout)) {
            const double* te = tile.te[static_cast<std::size_t>(timeline[place])];
            add_te_mesh({te, mesh}, share, te_phases, {out, per_mesh});
        }
    }
    remove_lane_means(te_turn, lanes);
}

}  // namespace gearpod::signals
