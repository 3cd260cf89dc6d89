#include "mc/recordings/measured_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "mc/files/signal_file.hpp"
#include "signals/spectra/alignment.hpp"

namespace gearpod::mc {
namespace {

// Factor on `before` that leaves the least squares of now - factor before.
double best_scale(std::span<const double> now, std::span<const double> before) {
    double both = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        both += now[i] * before[i];
        squares += before[i] * before[i];
    }
    return both / squares;
}

}  // namespace

MeasuredChange measured_change(const Scene& scene, const MeasuredSignal& record,
                               const MeasuredBaseline& from) {
    const MeasuredSignal& baseline = from.signal;
    const std::string& baseline_file = from.file;
    const int teeth = scene.span().planet_teeth, of_span = scene.span().ring_teeth;
    const int turns =
        std::min({record.sensor_meshes / teeth, baseline.sensor_meshes / teeth, of_span});
    if (!record.has_sensor || !baseline.has_sensor || turns < 1) {
        throw SignalError(
            fmt::format("{}: the baseline and the recording must both have at least {} mesh "
                        "periods of sensor signal",
                        baseline_file, teeth));
    }
    const auto per_mesh = static_cast<std::size_t>(scene.samples_per_mesh());
    const auto meshes = static_cast<std::size_t>(turns) * static_cast<std::size_t>(teeth);
    const auto now = std::span(record.sensor).first(meshes * per_mesh);
    std::vector<double> before(baseline.sensor.begin(),
                               baseline.sensor.begin() + static_cast<std::ptrdiff_t>(now.size()));
    MeasuredChange change;
    if (turns == of_span || turns == 1) {
        const signals::Shift shift = signals::align(now, before).shift;
        before = signals::shifted(before, shift);
        const double turned = shift.total() / static_cast<double>(per_mesh);
        change.meshes = turned < 0.0 ? turned + static_cast<double>(meshes) : turned;
    }
    change.correlation = signals::correlation(now, before);
    if (!(change.correlation >= kLeastCorrelation)) {
        throw SignalError(fmt::format(
            "{}: the recording does not resemble this baseline (correlation {:.2f}): another "
            "gearbox or speed{}",
            baseline_file, change.correlation,
            turns == of_span || turns == 1
                ? ""
                : fmt::format(", or another start position, which is allowed only for recordings "
                              "of {} mesh periods or of one averaged planet turn",
                              scene.span_meshes())));
    }
    if (from.scaled) {
        change.scale = best_scale(now, before);
        for (double& value : before) {
            value *= change.scale;
        }
    }
    std::transform(now.begin(), now.end(), before.begin(), before.begin(), std::minus<>());
    change.signal.sensor_rounding =
        std::hypot(record.sensor_rounding, change.scale * baseline.sensor_rounding);
    change.signal.sensor = std::move(before);
    change.signal.has_sensor = true;
    change.signal.sensor_meshes = static_cast<int>(meshes);
    return change;
}

}  // namespace gearpod::mc
