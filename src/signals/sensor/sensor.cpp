#include "signals/sensor/sensor.hpp"

#include <stdexcept>

#include "signals/sensor/time_signal.hpp"

namespace gearpod::signals {
namespace {

machine::AlignedVector every(const machine::AlignedVector& values, std::size_t lanes, int lane) {
    machine::AlignedVector own;
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += lanes) {
        own.push_back(values[i]);
    }
    return own;
}

Tones of_lane(const Tones& tones, int lanes, int lane) {
    return {every(tones.mesh_period_s, lanes, lane), every(tones.frequency_Hz, lanes, lane),
            every(tones.amplitude_m_s2, lanes, lane), every(tones.phase_rad, lanes, lane)};
}

}  // namespace

std::vector<double> synthesize(const TileSignals& tile, int lane, const Timeline& timeline,
                               const SpanLayout& layout, const PathGrid& path, double path_exponent,
                               int first_mesh, int mesh_count, const Tones& tones) {
    check_tile(tile, timeline);
    if (lane < 0 || lane >= tile.lanes || first_mesh < 0 || mesh_count < 0 ||
        path.planets() != tile.planets || path.phases() != tile.phases ||
        path.positions() != layout.carrier_meshes) {
        throw std::invalid_argument("sensor signal: tile, path and layout disagree in shape");
    }
    const std::size_t places = static_cast<std::size_t>(path.positions()) * tile.phases;
    std::vector<double> whole_steps(path.positions() / 2 + 1);
    std::vector<double> weight(places * tile.planets);
    all_path_weights(path, path_exponent, whole_steps.data(), weight.data());

    const std::size_t values = static_cast<std::size_t>(tile.phases) * tile.channels();
    std::vector<double> accel(values);
    std::vector<double> signal(static_cast<std::size_t>(mesh_count) * tile.phases);
    const ToneTable table(of_lane(tones, tile.lanes, lane), 1, first_mesh, mesh_count, tile.phases);
    for (int i = 0; i < mesh_count; ++i) {
        const long k = static_cast<long>(first_mesh) + i;
        const double* mesh = tile.accel[timeline[k % static_cast<long>(timeline.size())]];
        copy_lane({mesh, values * tile.lanes}, tile.lanes, lane, accel);
        double* samples = signal.data() + static_cast<std::size_t>(i) * tile.phases;
        mesh_signal(path, weight.data(), static_cast<int>(k % path.positions()), accel.data(),
                    samples);
        if (table.tones() > 0) {
            add_tones(table, i, mesh_count, tile.phases, samples);
        }
    }
    return signal;
}

}  // namespace gearpod::signals
