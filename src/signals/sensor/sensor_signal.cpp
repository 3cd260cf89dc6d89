#include "signals/sensor/sensor_signal.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "machine/contracts.hpp"
#include "signals/sensor/sensor_response_kernel.hpp"
#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::signals {
namespace {

machine::AlignedVector lane_values(const machine::AlignedVector& values, std::size_t lanes,
                                   LaneId lane) {
    machine::AlignedVector of_lane;
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += lanes) {
        of_lane.push_back(values[i]);
    }
    return of_lane;
}

Tones tones_of_lane(const Tones& tones, int lanes, LaneId lane) {
    return {
        lane_values(tones.mesh_period_s, lanes, lane), lane_values(tones.frequency_Hz, lanes, lane),
        lane_values(tones.amplitude_m_s2, lanes, lane), lane_values(tones.phase_rad, lanes, lane)};
}

// Number of lanes that are read together: one cache line holds their values.
constexpr int kTogether = 8;

std::vector<int> consecutive(int first, int count) {
    std::vector<int> meshes(static_cast<std::size_t>(std::max(0, count)));
    std::iota(meshes.begin(), meshes.end(), first);
    return meshes;
}

std::vector<std::vector<double>> signals_of(const TileSignals& tile, int first,
                                            const Timeline& timeline, const SpanLayout& layout,
                                            const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes, const Tones& tones) {
    const int lanes = static_cast<int>(path_exponent.size());
    const int mesh_count = static_cast<int>(meshes.size());
    const int first_mesh = meshes.empty() ? 0 : meshes.front();
    EXPECTS(tones.empty() || meshes.empty() || meshes.back() - first_mesh == mesh_count - 1);
    check_tile(tile, timeline);
    if (first < 0 || lanes > tile.lanes - first || first_mesh < 0 ||
        path.first_source() + path.planets() > tile.sources() || path.phases() != tile.phases ||
        path.positions() != layout.carrier_meshes) {
        throw std::invalid_argument("sensor signal: tile, path and layout disagree in shape");
    }
    const std::size_t values = static_cast<std::size_t>(tile.phases) * tile.channels();
    const std::size_t turn = static_cast<std::size_t>(path.positions()) * path.planets();
    std::vector<double> whole_steps(path.positions() / 2 + 1), of_phase(turn);
    std::vector<double> accel(values * lanes);
    std::vector<std::vector<double>> weight, signal;
    std::vector<ToneTable> table;
    for (int n = 0; n < lanes; ++n) {
        weight.emplace_back(turn * tile.phases);
        path_weights_of_one_lane(
            {&path, &path_exponent[n], whole_steps.data(), of_phase.data(), weight.back().data()});
        signal.emplace_back(static_cast<std::size_t>(mesh_count) * tile.phases);
        table.emplace_back(tones_of_lane(tones, tile.lanes, LaneId{first + n}), 1, first_mesh,
                           mesh_count, tile.phases);
    }
    for (int i = 0; i < mesh_count; ++i) {
        const long k = meshes[static_cast<std::size_t>(i)];
        const double* mesh = tile.accel[timeline[k % static_cast<long>(timeline.size())]];
        copy_lanes({mesh, values * tile.lanes}, tile.lanes, first, accel);
        for (int n = 0; n < lanes; ++n) {
            SensorResponseArguments arguments;
            arguments.path = &path;
            arguments.carrier = static_cast<int>(k % path.positions());
            arguments.weight = weight[n].data() + static_cast<std::size_t>(arguments.carrier) *
                                                      tile.phases * path.planets();
            arguments.accel = accel.data() + n * values;
            arguments.sources = tile.sources();
            arguments.tones = table[n].tones() > 0 ? &table[n] : nullptr;
            arguments.mesh = i;
            arguments.meshes = mesh_count;
            arguments.signal = signal[n].data() + static_cast<std::size_t>(i) * tile.phases;
            sensor_response_of_one_lane(arguments);
        }
    }
    return signal;
}

// Signals of all lanes, computed kTogether lanes at a time.
std::vector<std::vector<double>> signals_of_all(const TileSignals& tile, const Timeline& timeline,
                                                const SpanLayout& layout, const PathGrid& path,
                                                std::span<const double> path_exponent,
                                                std::span<const int> meshes, const Tones& tones) {
    std::vector<std::vector<double>> signal;
    for (std::size_t n = 0; n < path_exponent.size(); n += kTogether) {
        auto some = signals_of(
            tile, static_cast<int>(n), timeline, layout, path,
            path_exponent.subspan(n, std::min<std::size_t>(kTogether, path_exponent.size() - n)),
            meshes, tones);
        std::move(some.begin(), some.end(), std::back_inserter(signal));
    }
    return signal;
}

}  // namespace

std::vector<double> synthesize(const TileSignals& tile, LaneId lane, const Timeline& timeline,
                               const SpanLayout& layout, const PathGrid& path, double path_exponent,
                               int first_mesh, int mesh_count, const Tones& tones) {
    return std::move(signals_of(tile, lane, timeline, layout, path, {&path_exponent, 1},
                                consecutive(first_mesh, mesh_count), tones)
                         .front());
}

std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent, int first_mesh,
                                            int mesh_count, const Tones& tones) {
    return signals_of_all(tile, timeline, layout, path, path_exponent,
                          consecutive(first_mesh, mesh_count), tones);
}

std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes) {
    return signals_of_all(tile, timeline, layout, path, path_exponent, meshes, {});
}

SensorResponse::SensorResponse(const PathGrid& path, const SpanLayout& layout, const Tile& tile)
    : path_(&path),
      phases_(path.phases()),
      layout_(layout),
      lanes_(static_cast<std::size_t>(tile.lanes)),
      te_phases_(tile.te_phases),
      kept_meshes_(tile.kept_meshes),
      signal_meshes_(tile.signal_meshes),
      sources_(tile.sources > 0 ? tile.sources : path.planets()) {
    if (!machine::is_lane_count(tile.lanes) || tile.exponents.size() != lanes_ || te_phases_ < 1 ||
        path.phases() % te_phases_ != 0 || path.positions() != layout.carrier_meshes ||
        kept_meshes_ > signal_meshes_ || signal_meshes_ < layout.meshes() ||
        path.first_source() + path.planets() > sources_) {
        throw std::invalid_argument("sensor response: tile, path and layout disagree in shape");
    }
    const auto positions = static_cast<std::size_t>(path.positions());
    const std::size_t turn = positions * static_cast<std::size_t>(path.planets()) * lanes_;
    const machine::AlignedVector exponent(tile.exponents.begin(), tile.exponents.end());
    machine::AlignedVector whole_steps((positions / 2 + 1) * lanes_), of_phase(turn);
    weight_.resize(turn * static_cast<std::size_t>(path.phases()));
    sensor_path_weights(
        tile.lanes, {&path, exponent.data(), whole_steps.data(), of_phase.data(), weight_.data()});
    if (tile.tones != nullptr && !tile.tones->empty()) {
        tones_.emplace(*tile.tones, tile.lanes, 0, signal_meshes_, path.phases());
    }
    folded_.assign(samples(layout.planet_teeth), 0.0);
    te_.assign(static_cast<std::size_t>(layout.planet_teeth * te_phases_) * lanes_, 0.0);
    signal_.resize(samples(kept_meshes_));
    discarded_.resize(samples(1));
    if (tile.keeps_te) {
        te_signal_.resize(te_samples(kept_meshes_));
    }
}

std::size_t SensorResponse::samples(int meshes) const {
    return static_cast<std::size_t>(meshes) * static_cast<std::size_t>(phases_) * lanes_;
}

std::size_t SensorResponse::te_samples(int meshes) const {
    return static_cast<std::size_t>(meshes) * static_cast<std::size_t>(te_phases_) * lanes_;
}

void SensorResponse::record_mesh(int k, const double* accel, const double* te) {
    SensorResponseArguments mesh;
    const int tooth = k % layout_.planet_teeth;
    const bool in_span = k < layout_.meshes();
    mesh.path = path_;
    mesh.carrier = k % path_->positions();
    mesh.weight = weight_.data() + static_cast<std::size_t>(mesh.carrier) * samples(1) *
                                       static_cast<std::size_t>(path_->planets());
    mesh.accel = accel;
    mesh.sources = sources_;
    mesh.tones = tones_ ? &*tones_ : nullptr;
    mesh.mesh = k;
    mesh.meshes = signal_meshes_;
    mesh.signal = k < kept_meshes_ ? signal_.data() + samples(k) : discarded_.data();
    mesh.folded = in_span ? folded_.data() + samples(tooth) : nullptr;
    sensor_response(static_cast<int>(lanes_), mesh);
    if (te_samples(k + 1) <= te_signal_.size()) {
        add_te_mesh({te, samples(1)}, 1.0, te_phases_,
                    std::span(te_signal_).subspan(te_samples(k), te_samples(1)));
    }
    if (in_span) {
        add_te_mesh({te, samples(1)}, 1.0 / layout_.ring_teeth, te_phases_,
                    std::span(te_).subspan(static_cast<std::size_t>(tooth * te_phases_) * lanes_,
                                           static_cast<std::size_t>(te_phases_) * lanes_));
    }
}

machine::AlignedVector SensorResponse::averaged_te() const {
    machine::AlignedVector averaged = te_;
    remove_lane_means(averaged, static_cast<int>(lanes_));
    return averaged;
}

std::vector<std::vector<double>> SensorResponse::signals(std::size_t lanes, int meshes) const {
    const std::size_t count = samples(meshes) / lanes_;
    if (meshes > kept_meshes_ || lanes > lanes_) {
        throw std::invalid_argument(
            "sensor response: more meshes or lanes requested than were kept");
    }
    std::vector<std::vector<double>> all(lanes, std::vector<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t l = 0; l < lanes; ++l) {
            all[l][i] = signal_[i * lanes_ + l];
        }
    }
    return all;
}

std::vector<double> SensorResponse::signal(LaneId lane, int meshes) const {
    if (meshes > kept_meshes_) {
        throw std::invalid_argument("sensor response: more meshes requested than were kept");
    }
    std::vector<double> lane_signal(samples(meshes) / lanes_);
    copy_lane(std::span(signal_).first(samples(meshes)), static_cast<int>(lanes_), lane,
              lane_signal);
    return lane_signal;
}

std::vector<double> SensorResponse::te_signal(LaneId lane, int meshes) const {
    if (te_samples(meshes) > te_signal_.size()) {
        throw std::invalid_argument("sensor response: more meshes requested than were kept");
    }
    std::vector<double> lane_signal(te_samples(meshes) / lanes_);
    copy_lane(std::span(te_signal_).first(te_samples(meshes)), static_cast<int>(lanes_), lane,
              lane_signal);
    return lane_signal;
}

}  // namespace gearpod::signals
