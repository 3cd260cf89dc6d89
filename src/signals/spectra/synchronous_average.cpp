#include "signals/spectra/synchronous_average.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace gearpod::signals {
namespace {

std::size_t whole_turns(std::span<const double> samples, std::size_t bins) {
    if (bins == 0 || samples.size() < bins) {
        throw std::invalid_argument("synchronous average: the signal is shorter than a turn");
    }
    return samples.size() / bins;
}

// Place of the timeline that tooth j meets, with the fraction of its Z_r turns at which it does.
// Places are used rather than distinct meshes: which places share a distinct mesh differs with the
// tile's other lanes, and a lane's sum must not depend on them.
struct TimelineEntry {
    std::size_t index = 0;
    double share = 0.0;
};

std::vector<TimelineEntry> entries_of_tooth(int j, const Timeline& timeline,
                                            const SpanLayout& layout) {
    std::vector<double> turns(timeline.size(), 0.0);
    for (long i = 0; i < layout.ring_teeth; ++i) {
        const long k = j + i * layout.planet_teeth;
        turns[static_cast<std::size_t>(k) % timeline.size()] += 1.0;
    }
    std::vector<TimelineEntry> entries;
    for (std::size_t index = 0; index < turns.size(); ++index) {
        if (turns[index] > 0.0) {
            entries.push_back({index, turns[index] / layout.ring_teeth});
        }
    }
    return entries;
}

}  // namespace

std::vector<double> synchronous_average(std::span<const double> samples, std::size_t bins) {
    const std::size_t turns = whole_turns(samples, bins);
    std::vector<double> mean(bins, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        const double* turn = samples.data() + i * bins;
        for (std::size_t b = 0; b < bins; ++b) {
            mean[b] += turn[b];
        }
    }
    for (double& value : mean) {
        value /= static_cast<double>(turns);
    }
    return mean;
}

std::vector<double> fold_of_products(std::span<const double> a, std::span<const double> b,
                                     std::size_t bins) {
    const std::size_t turns = whole_turns(a, bins);
    if (b.size() != a.size()) {
        throw std::invalid_argument("fold of products: the signals differ in length");
    }
    std::vector<double> sum(bins, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        for (std::size_t k = 0; k < bins; ++k) {
            sum[k] += a[i * bins + k] * b[i * bins + k];
        }
    }
    return sum;
}

std::vector<double> fold_of_squares(std::span<const double> samples, std::size_t bins) {
    return fold_of_products(samples, samples, bins);
}

double rms_without_average(std::span<const double> samples, std::size_t bins) {
    const std::size_t turns = whole_turns(samples, bins);
    const std::vector<double> mean = synchronous_average(samples, bins);
    double sum = 0.0;
    for (std::size_t i = 0; i < turns; ++i) {
        const double* turn = samples.data() + i * bins;
        double of_turn = 0.0;
        for (std::size_t b = 0; b < bins; ++b) {
            of_turn += (turn[b] - mean[b]) * (turn[b] - mean[b]);
        }
        sum += of_turn;
    }
    return std::sqrt(sum / static_cast<double>(turns * bins));
}

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
        for (const auto& [index, share] : entries_of_tooth(j, timeline, layout)) {
            const double* te = tile.te[static_cast<std::size_t>(timeline[index])];
            add_te_mesh({te, mesh}, share, te_phases, {out, per_mesh});
        }
    }
    remove_lane_means(te_turn, lanes);
}

}  // namespace gearpod::signals
