#include "mc/gearbox/measured_signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "features/feature.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/printable.hpp"
#include "mc/scene/feature_needs.hpp"
#include "signals/spectra/order_tracking.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kPhase = "mesh_phase";
constexpr const char* kSpeed = "speed_rpm";
constexpr const char* kTime = "time";

class Reading {
  public:
    Reading(const std::string& path, const SignalColumns& columns, const Scene& scene)
        : path_(path), wanted_(columns), scene_(scene) {}

    MeasuredSignal read() {
        // The libraries that read files serve one thread at a time.
        static std::mutex reading;
        std::unique_lock lock(reading);
        struct Closed {
            std::unique_ptr<SignalFile>& file;
            ~Closed() { file.reset(); }
        } closed{file_};
        file_ = open_signal_file(path_, wanted_.row);
        std::vector<double> sensor = chosen(wanted_.sensor, "sensor");
        std::vector<double> te = chosen(wanted_.te, "te");
        if (sensor.empty() && te.empty() && problems_.empty()) {
            reject(
                fmt::format("no column sensor and none te; its columns are {}; choose with "
                            "--sensor or --te",
                            columns_text()));
        }
        stop_at_problems();
        const std::size_t samples = std::max(sensor.size(), te.size());
        MeasuredSignal measured;
        measured.has_sensor = !sensor.empty();
        measured.has_te = !te.empty();
        std::vector<double> phase = phases(samples, measured.tracking);
        stop_at_problems();
        file_.reset();
        lock.unlock();
        check_rate(phase, !sensor.empty(), !te.empty());
        stop_at_problems();
        close_turn(sensor, te, phase);
        const signals::OrderTracking tracking(std::move(phase));
        if (!sensor.empty()) {
            const int grid = scene_.samples_per_mesh();
            measured.sensor_meshes = tracking.meshes(grid);
            measured.sensor =
                tracking.resample(sensor, grid, std::min(measured.sensor_meshes, most_meshes()));
        }
        if (!te.empty()) {
            const int grid = scene_.te_samples_per_mesh();
            measured.te_meshes = tracking.meshes(grid);
            measured.te = tracking.resample(te, grid, std::min(measured.te_meshes, most_meshes()));
        }
        return measured;
    }

  private:
    void reject(const std::string& what) {
        problems_ += fmt::format("{}{}: {}", problems_.empty() ? "" : "\n", path_, printable(what));
    }
    void stop_at_problems() const {
        if (!problems_.empty()) {
            throw SignalError(problems_);
        }
    }
    std::string columns_text() const {
        const auto names = file_->names();
        constexpr std::size_t kShown = 20;
        const auto end =
            names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kShown));
        const std::string rest =
            names.size() > kShown ? fmt::format(" and {} more", names.size() - kShown) : "";
        return names.empty() ? "none"
                             : fmt::format("{}{}", fmt::join(names.begin(), end, ", "), rest);
    }

    // A column of finite numbers as long as the others.
    std::vector<double> column(const std::string& name) {
        std::vector<double> values = file_->read(name);
        const auto is_bad = [](double value) { return !std::isfinite(value); };
        const auto bad = std::find_if(values.begin(), values.end(), is_bad);
        if (bad != values.end()) {
            reject(
                fmt::format("column {}: {} of {} samples are no finite numbers, the first is "
                            "sample {}; cut them off or fill the gaps",
                            name, std::count_if(values.begin(), values.end(), is_bad),
                            values.size(), bad - values.begin() + 1));
        }
        const auto huge = std::find_if(values.begin(), values.end(),
                                       [](double value) { return std::abs(value) > kLargest; });
        if (huge != values.end() && bad == values.end()) {
            reject(
                fmt::format("column {}: sample {} is {:g}; numbers above {:g} cannot be computed "
                            "with",
                            name, huge - values.begin() + 1, *huge, kLargest));
        }
        if (values.size() < 2) {
            reject(fmt::format("column {} has {} sample(s)", name, values.size()));
        } else if (samples_ != 0 && values.size() != samples_) {
            reject(fmt::format("column {} has {} samples, but {} has {}", name, values.size(),
                               first_, samples_));
        } else if (samples_ == 0) {
            samples_ = values.size();
            first_ = name;
        }
        return values;
    }

    std::vector<double> chosen(const std::string& name, const std::string& usual) {
        const std::string& taken = name.empty() ? usual : name;
        if (file_->has(taken)) {
            return column(taken);
        }
        if (!name.empty()) {
            reject(fmt::format("no column {}; its columns are {}", name, columns_text()));
        }
        return {};
    }

    // Seconds of every sample.
    std::vector<double> times(std::size_t samples) {
        if (wanted_.sampling_Hz <= 0.0 && file_->has(kTime)) {
            const std::vector<double> time = column(kTime);
            const double step = (time.back() - time.front()) / static_cast<double>(samples - 1);
            for (std::size_t i = 1; i < time.size() && problems_.empty(); ++i) {
                if (!(std::abs(time[i] - time[i - 1] - step) <= kEven * step)) {
                    reject(
                        fmt::format("column {}: {:.6g} s from sample {} to the next, but {:.6g} "
                                    "s on average; the samples must be evenly spaced",
                                    kTime, time[i] - time[i - 1], i, step));
                }
            }
            return time;
        }
        const double rate =
            wanted_.sampling_Hz > 0.0 ? wanted_.sampling_Hz : file_->sampling_Hz().value_or(0.0);
        if (!(rate > 0.0 && std::isfinite(rate))) {
            reject(
                fmt::format("no sampling rate: neither a column {} or {} nor sampling_Hz in the "
                            "file; its columns are {}; give --sampling-Hz",
                            kTime, kPhase, columns_text()));
            return {};
        }
        std::vector<double> time(samples);
        for (std::size_t i = 0; i < samples; ++i) {
            time[i] = static_cast<double>(i) / rate;
        }
        return time;
    }

    // Mesh phase of every sample.
    std::vector<double> phases(std::size_t samples, std::string& how) {
        if (wanted_.samples_per_mesh > 0.0) {
            how = fmt::format("{:.6g} samples a mesh period", wanted_.samples_per_mesh);
            std::vector<double> phase(samples);
            for (std::size_t i = 0; i < samples; ++i) {
                phase[i] = static_cast<double>(i) / wanted_.samples_per_mesh;
            }
            return phase;
        }
        if (file_->has(kPhase) && wanted_.sampling_Hz <= 0.0) {
            how = "column mesh_phase";
            std::vector<double> phase = column(kPhase);
            check_rises(phase);
            return phase;
        }
        std::vector<double> phase = times(samples);
        if (!problems_.empty()) {
            return {};
        }
        if (!file_->has(kSpeed)) {
            how = fmt::format("constant speed, {:.6g} Hz at the mesh",
                              scene_.nominal_mesh_frequency_Hz());
            for (double& value : phase) {
                value *= scene_.nominal_mesh_frequency_Hz();
            }
            return phase;
        }
        const std::vector<double> speed_rpm = column(kSpeed);
        check_direction(speed_rpm);
        how = speed_rpm.empty() || speed_rpm.front() >= 0.0
                  ? "column speed_rpm"
                  : "column speed_rpm, which is negative: turning backwards";
        return integrated(phase, speed_rpm);
    }

    // Whole planet turns in mesh phase, as averages are kept, go on from their beginning: without
    // that, the grid's points behind the last sample would be lost, and the last mesh with them.
    void close_turn(std::vector<double>& sensor, std::vector<double>& te,
                    std::vector<double>& phase) const {
        constexpr std::size_t kMore = 8;
        const double turns = static_cast<double>(phase.size()) /
                             (wanted_.samples_per_mesh * scene_.span().planet_teeth);
        if (!(wanted_.samples_per_mesh > 0.0) || std::abs(turns - std::round(turns)) > 1e-9) {
            return;
        }
        for (std::size_t i = 0; i < kMore; ++i) {
            phase.push_back(static_cast<double>(phase.size()) / wanted_.samples_per_mesh);
            for (std::vector<double>* signal : {&sensor, &te}) {
                if (!signal->empty()) {
                    signal->push_back((*signal)[i]);
                }
            }
        }
    }

    // A gearbox that turns about passes its meshes again, and loads its other flanks.
    void check_direction(const std::vector<double>& speed_rpm) {
        const auto other = std::find_if(speed_rpm.begin(), speed_rpm.end(),
                                        [&](double rpm) { return rpm * speed_rpm.front() < 0.0; });
        if (other != speed_rpm.end()) {
            reject(fmt::format("column {} changes its sign at sample {}; cut the recording there",
                               kSpeed, other - speed_rpm.begin() + 1));
        }
    }

    // Trapezoidal rule. Backwards is as good as forwards.
    std::vector<double> integrated(const std::vector<double>& time,
                                   const std::vector<double>& speed_rpm) {
        if (!problems_.empty()) {
            return {};
        }
        constexpr double kRadPerSInRpm = 2.0 * std::numbers::pi / 60.0;
        const auto frequency_Hz = [&](double rpm) {
            return std::abs(scene_.drive().mesh_frequency_rad_s(std::abs(rpm) * kRadPerSInRpm)) /
                   (2.0 * std::numbers::pi);
        };
        std::vector<double> phase(time.size(), 0.0);
        for (std::size_t i = 1; i < time.size(); ++i) {
            phase[i] =
                phase[i - 1] + 0.5 * (time[i] - time[i - 1]) *
                                   (frequency_Hz(speed_rpm[i - 1]) + frequency_Hz(speed_rpm[i]));
        }
        check_rises(phase);
        return phase;
    }

    void check_rises(const std::vector<double>& phase) {
        for (std::size_t i = 1; i < phase.size() && problems_.empty(); ++i) {
            if (!(phase[i] > phase[i - 1])) {
                reject(fmt::format("the mesh phase does not rise from sample {} to the next", i));
            }
        }
    }

    // A grid coarser than the samples would fold high frequencies down.
    void check_rate(const std::vector<double>& phase, bool sensor, bool te) {
        const double per_mesh =
            static_cast<double>(phase.size() - 1) / (phase.back() - phase.front());
        const double mesh_Hz = scene_.nominal_mesh_frequency_Hz();
        if (te && per_mesh < kFewestSamples) {
            reject(
                fmt::format("{:.6g} samples a mesh period do not show the mesh frequency of the "
                            "transmission error; is the speed or the sampling rate right?",
                            per_mesh));
        }
        const double low_pass = scene_.study().sensor.low_pass_Hz;
        if (sensor && per_mesh > kSpareRate * scene_.samples_per_mesh()) {
            reject(
                fmt::format("{:.6g} samples a mesh period, but the study's grid has {}; set "
                            "sensor.sampling_Hz to the recording's, about {:.6g} Hz",
                            per_mesh, scene_.samples_per_mesh(), per_mesh * mesh_Hz));
        }
        if (sensor && per_mesh * mesh_Hz < 2.0 * low_pass) {
            reject(
                fmt::format("{:.6g} samples a mesh period, {:.6g} Hz, hold nothing of the "
                            "study's band up to {:.6g} Hz; lower sensor.low_pass_Hz",
                            per_mesh, per_mesh * mesh_Hz, low_pass));
        }
    }

    // All that any feature looks at.
    int most_meshes() const {
        const bool planetary = scene_.study().gearbox.kind == GearboxKind::planetary;
        return meshes_needed(scene_.study(), scene_.span(),
                             planetary ? features::kSun | features::kRing : 0U);
    }

    static constexpr double kEven = 1e-3;
    static constexpr double kFewestSamples = 2.0;  // a mesh period
    static constexpr double kLargest = 1e18;
    static constexpr double kSpareRate = 1.02;

    const std::string& path_;
    const SignalColumns& wanted_;
    const Scene& scene_;
    std::unique_ptr<SignalFile> file_;
    std::string problems_, first_;
    std::size_t samples_ = 0;
};

}  // namespace

MeasuredSignal read_measured_signal(const std::string& path, const SignalColumns& columns,
                                    const Scene& scene) {
    return Reading(path, columns, scene).read();
}

}  // namespace gearpod::mc
