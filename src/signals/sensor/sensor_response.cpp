#include "signals/sensor/sensor_response.hpp"

#include <stdexcept>

#include "signals/sensor/sensor_response_kernel.hpp"
#include "signals/spectra/averaged_te.hpp"

namespace gearpod::signals {
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

std::vector<double> SensorResponse::signal(int lane, int meshes) const {
    if (meshes > kept_meshes_) {
        throw std::invalid_argument("sensor response: more meshes requested than were kept");
    }
    std::vector<double> own(samples(meshes) / lanes_);
    copy_lane(std::span(signal_).first(samples(meshes)), static_cast<int>(lanes_), lane, own);
    return own;
}

std::vector<double> SensorResponse::te_signal(int lane, int meshes) const {
    if (te_samples(meshes) > te_signal_.size()) {
        throw std::invalid_argument("sensor response: more meshes requested than were kept");
    }
    std::vector<double> own(te_samples(meshes) / lanes_);
    copy_lane(std::span(te_signal_).first(te_samples(meshes)), static_cast<int>(lanes_), lane, own);
    return own;
}

}  // namespace gearpod::signals
