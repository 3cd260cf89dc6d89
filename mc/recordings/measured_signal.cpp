#include "mc/recordings/measured_signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>

#include "features/feature.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"
#include "mc/recordings/quantisation.hpp"
#include "mc/recordings/recording_columns.hpp"
#include "mc/recordings/sample_faults.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/member.hpp"
#include "signals/path/frequency_response.hpp"
#include "signals/rotation/shaft_motion.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "signals/spectra/recording_checks.hpp"
#include "signals/spectra/resampling.hpp"
#include "signals/spectra/speed_variation.hpp"
#include "signals/spectra/wide_speed.hpp"

namespace gearpod::mc {

namespace {

constexpr const char* kSensor = "sensor";
constexpr const char* kPhase = "mesh_phase";
constexpr const char* kSpeed = "speed_rpm";

// Samples after a low-pass of `cutoff` cycles per sample (signals/path/frequency_response.hpp).
// They repeat for ever, or there is no vibration before them.
std::vector<double> low_passed(std::vector<double> samples, double cutoff, bool repeat) {
    constexpr double kDecay = 8.0;  // cycles after which the filter is at rest
    const std::size_t count = samples.size();
    if (!repeat) {
        const double half = 0.5 * static_cast<double>(count) + kDecay / cutoff;
        samples.resize(2 *
                       static_cast<std::size_t>(signals::smooth_length(static_cast<int>(half))));
    }
    signals::HousingResponse sensor;
    sensor.chain.emplace().low_pass = {cutoff, INFINITY};
    signals::PeriodicResponse response(static_cast<int>(samples.size()));
    response.add(samples, 1.0, sensor);
    samples = response.take();
    samples.resize(count);
    return samples;
}

// Reads the signals. Throws SignalError if the file cannot be read or lacks a column.
class SignalsReader : protected RecordingColumns {
  public:
    using RecordingColumns::RecordingColumns;

    void read_signals() {
        file_ = source_.open(columns_.row);
        sensor_ = chosen(columns_.sensor, kSensor, Quantity::acceleration);
        te_ = chosen(columns_.te, "te", Quantity::angle);
        if (sensor_.empty() && te_.empty() && problems_.empty()) {
            reject(
                fmt::format("it has neither a column sensor nor a column te; its columns are {}; "
                            "choose with --sensor or --te",
                            file_->contents()));
        }
        for (const std::string& name : {columns_.tachometer, columns_.encoder}) {
            if (columns_.samples_per_mesh == 0.0 && !name.empty() && found(name, true).empty()) {
                reject_missing(name);
            }
        }
        stop_at_problems();
    }

  protected:
    std::vector<double> sensor_, te_;
};

class SignalReader : SignalsReader {
  public:
    SignalReader(const SignalSource& source, const SignalColumns& columns,
                 const MeasurementPlan& plan)
        : SignalsReader(source, columns), plan_(plan), record_(plan.record) {}

    // Reads the columns and the mesh phase of every sample.
    void read_file() {
        struct Closed {
            std::unique_ptr<SignalFile>& file;
            ~Closed() { file.reset(); }
        } closed{file_};
        read_signals();
        phase_ = phases(std::max(sensor_.size(), te_.size()), tracking_);
        if (phase_.size() > 1 && problems_.empty() && columns_.samples_per_mesh == 0.0 &&
            (!counted_ || speed_column_)) {
            mean_mesh_Hz_ = (phase_.back() - phase_.front()) /
                            static_cast<double>(phase_.size() - 1) * rate_Hz();
        }
        for (const std::string& text : file_->notes()) {
            notes_.push_back(printable(text));
        }
        stop_at_problems();
    }

    // Signals on the study's grid.
    MeasuredSignal resampled() {
        std::vector<double>&sensor = sensor_, &te = te_, &phase = phase_;
        MeasuredSignal measured;
        measured.has_sensor = !sensor.empty();
        measured.has_te = !te.empty();
        measured.tracking = std::move(tracking_);
        measured.notes = std::move(notes_);
        check_samples(measured);
        measured.sensor_rounding = rounding_rms(sensor);
        keep(sensor, phase.size());
        keep(te, phase.size());
        stop_at_problems();
        check_speed(measured);
        check_rate(measured);
        if (columns_.samples_per_mesh > 0.0) {
            extend_periodically({&sensor, &te}, phase,
                                columns_.samples_per_mesh * record_.span.planet_teeth);
        }
        resample(sensor, te, phase, measured);
        check_losses(measured);
        stop_at_problems();
        check_variation(measured);
        return measured;
    }

  private:
    // Removes the mean of the sensor signal and reports samples that are no vibration.
    void check_samples(MeasuredSignal& measured) {
        if (sensor_.empty()) {
            return;
        }
        constexpr double kStatedMean = 0.1;  // of the rms about the mean
        const std::string name = columns_.sensor.empty() ? kSensor : columns_.sensor;
        reject_column(name, stretches_text(sensor_));
        const double mean = subtract_mean(sensor_), rms = rms_of(sensor_);
        if (std::abs(mean) > kStatedMean * rms) {
            measured.notes.push_back(fmt::format(
                "column {}: its mean, {:.4g} m/s^2, is removed: gravity or a bias", name, mean));
        }
        for (const std::string& text : {spikes_text(sensor_), level_step_text(sensor_)}) {
            if (!text.empty()) {
                measured.notes.push_back(fmt::format("column {}: {}", name, text));
            }
        }
    }
    // Rejects a recording with too few samples per mesh period to resolve the mesh frequency or the
    // sensor's frequency range. One with more than the study's grid passes the study's low-pass
    // first, as the vibration does before the study's sensor is sampled.
    void check_rate(MeasuredSignal& measured) {
        constexpr double kFewestPerMesh = 2.0;  // samples
        constexpr double kRateTolerance = 1.02;
        const double per_mesh =
            static_cast<double>(phase_.size() - 1) / (phase_.back() - phase_.front());
        // Sampling rate of a recording with these samples per mesh period at the study's speed.
        const double study_Hz = per_mesh * record_.mesh_frequency_Hz;
        const double low_pass = plan_.features.low_pass_Hz;
        const std::string samples = fmt::format("{:.6g} samples per mesh period", per_mesh);
        if (!te_.empty() && per_mesh < kFewestPerMesh) {
            reject(samples +
                   " do not resolve the mesh frequency of the transmission error; check "
                   "the speed and the sampling rate");
        }
        // Without a low-pass the study is quasi-static.
        if (low_pass > 0.0 && !sensor_.empty() && per_mesh > kRateTolerance * record_.samples) {
            const double cutoff = low_pass / study_Hz;
            sensor_ = low_passed(std::move(sensor_), cutoff, columns_.samples_per_mesh > 0.0);
            measured.sensor_rounding *= std::sqrt(2.0 * cutoff);
            measured.notes.push_back(
                fmt::format("finer than the study's grid: the sensor signal passes the study's "
                            "low-pass first, {:.6g} Hz at the study's speed",
                            low_pass));
        }
        if (!sensor_.empty() && study_Hz < 2.0 * low_pass) {
            reject(
                fmt::format("{} are too few for signals up to {:.6g} Hz at the study's speed; "
                            "check the speed, or set sensor.low_pass_Hz to at most {:.6g}",
                            samples, low_pass, 0.5 * study_Hz));
        }
        stop_at_problems();
    }
    void resample(const std::vector<double>& sensor, const std::vector<double>& te,
                  const std::vector<double>& phase, MeasuredSignal& measured) const {
        const signals::OrderTracking tracking(phase);
        if (!sensor.empty()) {
            const int grid = record_.samples;
            measured.sensor_meshes = tracking.meshes(grid);
            measured.sensor =
                tracking.resample(sensor, grid, std::min(measured.sensor_meshes, most_meshes()));
        }
        if (!te.empty()) {
            const int grid = record_.te_samples;
            measured.te_meshes = tracking.meshes(grid);
            measured.te = tracking.resample(te, grid, std::min(measured.te_meshes, most_meshes()));
        }
    }
    // Mesh phase of every sample.
    std::vector<double> phases(std::size_t samples, std::string& how) {
        if (columns_.samples_per_mesh > 0.0) {
            how = fmt::format("{:.6g} samples per mesh period", columns_.samples_per_mesh);
            return evenly_spaced(samples, columns_.samples_per_mesh);
        }
        if (!columns_.tachometer.empty()) {
            return phases_of_pulses(how);
        }
        if (!columns_.encoder.empty()) {
            return phases_of_angle(how);
        }
        const std::string phase_name = columns_.sampling_Hz > 0.0 ? "" : found(kPhase, false);
        if (!phase_name.empty()) {
            how = "column mesh_phase";
            return rising(column(phase_name, Quantity::phase), true);
        }
        std::vector<double> phase = times(samples);
        if (!problems_.empty()) {
            return {};
        }
        counted_ = true;
        const std::string speed_name = found(kSpeed, false);
        if (speed_name.empty()) {
            how = fmt::format("constant speed, {:.6g} Hz at the mesh{}", record_.mesh_frequency_Hz,
                              unused_text());
            return scaled(std::move(phase), record_.mesh_frequency_Hz);
        }
        speed_column_ = true;
        const std::vector<double> speed_rpm = column(speed_name, Quantity::speed);
        how = speed_rpm.empty() || speed_rpm.front() >= 0.0
                  ? "column speed_rpm"
                  : "column speed_rpm, which is negative: backward rotation";
        return integrated(phase, speed_rpm);
    }

    // Mesh phase from a tachometer. Keeps the samples between its first and last pulse.
    std::vector<double> phases_of_pulses(std::string& how) {
        const std::vector<double> heights = present(columns_.tachometer, Quantity::any);
        const double meshes = meshes_per_turn() / columns_.pulses_per_turn;
        const signals::Pulses pulses =
            problems_.empty() ? signals::tachometer_pulses(heights, kSmallestJump / meshes)
                              : signals::Pulses();
        reject_column(columns_.tachometer, pulses.problem + moment(pulses.problem_sample));
        if (!problems_.empty()) {
            return {};
        }
        how = fmt::format("{} pulses of column {}, {:g} per turn", pulses.sample.size(),
                          columns_.tachometer, columns_.pulses_per_turn);
        signals::PulseCount counted = signals::count_pulses(pulses.sample);
        first_sample_ = counted.first;
        return scaled(std::move(counted.count), meshes);
    }

    // Mesh phase from an encoder. Removes samples before its first and after its last count.
    std::vector<double> phases_of_angle(std::string& how) {
        std::vector<double> written = present(columns_.encoder, Quantity::angle);
        if (!problems_.empty()) {
            return {};
        }
        const auto [low, high] = std::ranges::minmax(written);
        constexpr double kFewestCounts = 100.0;
        if (file_->unit(columns_.encoder).empty() && high - low >= kFewestCounts &&
            std::ranges::all_of(written, [](double v) { return v == std::round(v); })) {
            reject_column(columns_.encoder,
                          fmt::format("runs from {:g} to {:g}: counts? divide by the counts per "
                                      "turn and name it \"{} [turns]\"; without a unit the angle "
                                      "is in rad",
                                      low, high, columns_.encoder));
            return {};
        }
        const double meshes_per_rad = meshes_per_turn() / (2.0 * std::numbers::pi);
        signals::ShaftAngle angle =
            signals::shaft_angle(std::move(written), kSmallestJump / meshes_per_rad);
        reject_column(columns_.encoder, angle.problem + moment(angle.problem_sample));
        how = fmt::format("angles of column {}", columns_.encoder);
        first_sample_ = angle.first;
        return scaled(std::move(angle.rad), meshes_per_rad);
    }

    // Mesh periods per turn of the member whose speed the study gives.
    double meshes_per_turn() const {
        // The argument 2 pi rad/s is one turn per second.
        return std::abs(record_.drivetrain->mesh_frequency_rad_s(2.0 * std::numbers::pi)) /
               (2.0 * std::numbers::pi);
    }

    void keep(std::vector<double>& signal, std::size_t count) const {
        if (!signal.empty() && signal.size() != count) {
            signal = {signal.begin() + static_cast<std::ptrdiff_t>(first_sample_),
                      signal.begin() + static_cast<std::ptrdiff_t>(first_sample_ + count)};
        }
    }

    // Samples evenly spaced in mesh phase, and their number per mesh period.
    std::vector<double> evenly_tracked(double& per_mesh) const {
        const auto last = static_cast<double>(phase_.size() - 1);
        per_mesh = last / (phase_.back() - phase_.front());
        // Samples by which pulses and counts are off, as they are seen at the next sample. At a
        // constant speed the phase is then less accurate than the samples' numbers.
        constexpr double kTiming = 1.0;
        bool even = true;
        for (std::size_t i = 0; i < phase_.size() && even; ++i) {
            even = std::abs((phase_[i] - phase_.front()) * per_mesh - static_cast<double>(i)) <
                   kTiming;
        }
        const int grid = static_cast<int>(std::ceil(std::min(per_mesh, 1e4)));
        const signals::OrderTracking tracking(phase_);
        if (even || tracking.meshes(grid) < 1) {
            return sensor_;
        }
        per_mesh = grid;
        return tracking.resample(sensor_, grid, tracking.meshes(grid));
    }

    // Compares the mesh lines with the stated speed: rejects another one, or takes it if requested.
    // Adds a note if there are no lines, or if they are too weak to refuse the recording.
    void check_speed(MeasuredSignal& measured) {
        const bool sampled_in_phase = columns_.samples_per_mesh > 0.0;
        constexpr double kFewestTurns = 4.0;  // of a recording that was sampled in phase
        if (columns_.speed == SpeedCheck::ignore || !measured.has_sensor ||
            (sampled_in_phase &&
             phase_.back() - phase_.front() < kFewestTurns * record_.path_meshes())) {
            return;
        }
        double per_mesh = 0.0;
        const std::vector<double> samples = evenly_tracked(per_mesh);
        auto found = signals::wide_speed(samples, per_mesh, record_.path_meshes());
        if (found && !found->fits() && !found->contradicts()) {
            // A phase of pulses that are too coarse for their shaft smears the lines.
            const double mean =
                static_cast<double>(phase_.size() - 1) / (phase_.back() - phase_.front());
            const auto untracked = signals::wide_speed(sensor_, mean, record_.path_meshes());
            found = untracked && untracked->contradicts() ? untracked : found;
        }
        if (!found || found->fits()) {
            return;
        }
        constexpr double kNear = 0.06, kNoFit = 0.1;
        const bool near = std::abs(found->ratio - 1.0) <= kNear;
        const bool another =
            near ? found->fit > kNoFit && found->harmonics > 2 : found->contradicts();
        if (sampled_in_phase && !(near && another)) {
            return;
        }
        if (!another) {
            if (!near || found->fit <= kNoFit) {
                measured.notes.push_back(
                    fmt::format("no mesh harmonic of this gearbox stands out of the noise at the "
                                "stated speed ({}{}; {} lines of any origin stand out): another "
                                "channel, a machine at rest, or a speed that is wrong or varies",
                                measured.tracking, measured_speed_text(), found->lines));
            }
            return;
        }
        constexpr int kEnough = 4;  // harmonics; with fewer, a neighbour of the mesh line fits, too
        const double clear_fit = near ? kNoFit : 0.5;
        const double clearly_less = near && found->fit > 0.3 ? 0.5 : 0.25;
        const bool clear = found->other == 0.0 && found->harmonics >= kEnough;
        const std::string lines = fmt::format(
            "the mesh lines fit {:.4f}{} times the stated speed ({}{}): they hold {:.0f} % of the "
            "lines at that speed, {:.0f} % at the stated one; {}",
            found->ratio, found->other > 0.0 ? fmt::format(" or {:.4f}", found->other) : "",
            measured.tracking, measured_speed_text(), 100.0 * found->fit, 100.0 * found->stated,
            clear ? speed_remedy(found->ratio)
                  : "they are too few to determine the speed; correct it");
        if (columns_.speed == SpeedCheck::refuse &&
            (found->fit < clear_fit || found->stated > clearly_less * found->fit)) {
            measured.notes.push_back(lines);
            return;
        }
        if (columns_.speed == SpeedCheck::refuse || !clear) {
            reject(lines);
        }
        stop_at_problems();
        phase_ = scaled(std::move(phase_), found->ratio);
        measured.tracking +=
            fmt::format(", multiplied by {:.5f} to fit the mesh lines", found->ratio);
    }

    // Speed, rpm, of the member whose speed the study gives, at a mesh frequency.
    double speed_rpm(double mesh_Hz) const { return 60.0 * std::abs(mesh_Hz) / meshes_per_turn(); }

    // Measured mean speed next to that of the study; "" if it is not measured.
    std::string measured_speed_text() const {
        return mean_mesh_Hz_ > 0.0
                   ? fmt::format("; it is {:.5g} rpm in the mean, the study states {:.5g} rpm",
                                 speed_rpm(mean_mesh_Hz_), speed_rpm(record_.mesh_frequency_Hz))
                   : "";
    }

    // Remedy for a speed that must be multiplied by `ratio`.
    std::string speed_remedy(double ratio) const {
        constexpr double kAgreement = 0.01;
        std::string shaft;
        const double given = 1.0 / meshes_per_turn();
        for (const Member member : {Member::sun, Member::planet, Member::ring, Member::carrier,
                                    Member::pinion, Member::gear}) {
            const double turns = turns_per_mesh(member);
            if (turns > 0.0 && std::abs(ratio * turns / given - 1.0) < kAgreement &&
                std::abs(turns / given - 1.0) > kAgreement) {
                shaft = fmt::format(
                    "is that the speed of the {}, {:.5g} times that of the study's "
                    "member? ",
                    member_name(member), turns / given);
                ratio = given / turns;
            }
        }
        const double pulses = columns_.pulses_per_turn / ratio, whole = std::round(pulses);
        const bool counted = whole >= 1.0 && std::abs(pulses / whole - 1.0) < kAgreement;
        if (!columns_.tachometer.empty()) {
            return fmt::format("{}give --pulses-per-turn {:.5g}", shaft, counted ? whole : pulses);
        }
        return shaft +
               (counted_ && !speed_column_
                    ? fmt::format("correct the study's {:.6g} rpm to {:.6g} rpm",
                                  speed_rpm(record_.mesh_frequency_Hz),
                                  ratio * speed_rpm(record_.mesh_frequency_Hz))
                    : "correct the speed") +
               ", or use the fitted one with --speed found";
    }

    // Turns of a member per mesh period; 0 if it stands still or the gearbox has none.
    double turns_per_mesh(Member member) const {
        const bool pair = record_.path_meshes() <= 1 && record_.planet_sources == 0;
        const bool of_pair = member == Member::pinion || member == Member::gear;
        return pair == of_pair ? record_.drivetrain->shaft_turns_per_mesh(member) : 0.0;
    }

    // Notes a speed that varies where a constant one is taken. Averaged over a phase that deviates
    // by this much, the k-th mesh harmonic keeps sinc(k/4) of its amplitude: 90, 64, 30 and 0 %.
    void check_variation(MeasuredSignal& measured) const {
        constexpr double kLargestDeviation = 0.25;  // mesh periods
        if (columns_.speed == SpeedCheck::ignore || !measured.has_sensor || !counted_ ||
            speed_column_) {
            return;
        }
        const auto found = signals::speed_variation(measured.sensor, record_.samples);
        if (found && found->meshes >= kLargestDeviation) {
            measured.notes.push_back(fmt::format(
                "the speed varies by {:.2g} %, but is taken as constant: the mesh phase deviates "
                "by {:.2g} mesh periods, which smears what is averaged from {:g} on; give the "
                "speed with --tachometer, --encoder or a column speed_rpm",
                100.0 * found->speed, found->meshes, kLargestDeviation));
        }
    }

    // Checks for lost samples if the phase comes only from sample numbers, times and speed. Lost
    // samples then leave a jump in the phase.
    void check_losses(MeasuredSignal& measured) {
        if (columns_.speed == SpeedCheck::ignore || !measured.has_sensor || !counted_) {
            return;
        }
        const auto lost =
            signals::lost_samples(measured.sensor, record_.samples, record_.path_meshes());
        measured.losses_detectable = lost.has_value();
        if (lost && lost->found) {
            reject_column(
                columns_.sensor.empty() ? kSensor : columns_.sensor,
                fmt::format("the meshes are {:.2f} periods too {} (plus any number of whole "
                            "periods) after mesh period {} to {}: samples were lost or repeated, "
                            "which the times do not show; cut the recording there",
                            std::abs(lost->meshes), lost->meshes > 0.0 ? "early" : "late",
                            lost->first_mesh, lost->last_mesh));
        }
    }

    // Mesh phase from the absolute speed; the direction of rotation does not matter. A gearbox that
    // reverses passes its meshes again and loads the other flanks.
    std::vector<double> integrated(const std::vector<double>& time,
                                   const std::vector<double>& speed_rpm) {
        std::vector<double> phase(problems_.empty() ? speed_rpm.size() : 0, 0.0);
        for (std::size_t i = 1; i < phase.size(); ++i) {
            if (speed_rpm[i] * speed_rpm.front() < 0.0) {
                reject_column(
                    kSpeed,
                    fmt::format("changes its sign at sample {}; cut the recording there", i + 1));
                return {};
            }
            const double rpm = 0.5 * std::abs(speed_rpm[i - 1] + speed_rpm[i]);
            phase[i] = phase[i - 1] + (time[i] - time[i - 1]) * rpm / 60.0 * meshes_per_turn();
        }
        return rising(std::move(phase));
    }

    std::vector<double> rising(std::vector<double> phase, bool measured = false) {
        for (std::size_t i = 1; i < phase.size() && problems_.empty(); ++i) {
            if (!(phase[i] > phase[i - 1])) {
                reject(
                    fmt::format("the mesh phase does not increase from sample {} to the next", i));
            }
        }
        const bool check = measured && problems_.empty();
        reject_column(kPhase, check ? signals::phase_jump_text(phase, kSmallestJump) : "");
        return phase;
    }

    // Largest number of mesh periods that any feature uses.
    int most_meshes() const {
        return plan_.features.meshes_needed(plan_.features.sun ? features::kCentralGears
                                                               : features::SignalSet());
    }

    // Smallest jump of a measured motion that is reported, in mesh periods.
    static constexpr double kSmallestJump = 0.05;

    const MeasurementPlan& plan_;
    const RecordPlan& record_;
    std::vector<double> phase_;
    std::string tracking_;  // source of the phase
    std::size_t first_sample_ = 0;
    double mean_mesh_Hz_ = 0.0;  // measured; 0: not known
    bool speed_column_ = false;  // true if the column of speeds is used
    bool counted_ = false;  // true if the phase comes only from sample numbers, times and speed
};

// Calls `read`, which reads the recording with a reader of its own, by one thread at a time: the
// libraries that read files are not thread-safe. They may crash on a damaged HDF5 file, so that it
// is read in a child process first.
void read_alone(const SignalSource& source, const std::function<void(bool trial)>& read) {
    static std::mutex reading;
    const std::lock_guard lock(reading);
    constexpr std::uintmax_t kMemoryPerByte = 1000;  // compressed values
    if (!source.columns && file_kind(source.name) == FileKind::hdf5 &&
        why_not_readable(source.name).empty() &&
        !survives_reading(
            source.name, [&] { read(true); }, kMemoryPerByte)) {
        throw SignalError(source.name +
                          ": is damaged: reading it crashes, does not finish, or needs more memory "
                          "than reading a file may use");
    }
    read(false);
}

}  // namespace

void check_columns(const SignalSource& source, const SignalColumns& columns) {
    read_alone(source, [&](bool) { SignalsReader(source, columns).read_signals(); });
}

MeasuredSignal read_measured_signal(const SignalSource& source, const SignalColumns& columns,
                                    const MeasurementPlan& plan) {
    SignalReader reader(source, columns, plan);
    read_alone(source, [&](bool trial) {
        if (trial) {
            SignalReader(source, columns, plan).read_file();
        } else {
            reader.read_file();
        }
    });
    return reader.resampled();
}

namespace {

// Lines of the gears in mesh: orders that are whole multiples of a turn of the planet or of its
// partner. Lines of other stages, also of those that turn with a fixed ratio, hardly are.
std::vector<double> lines_of_gears(std::span<const double> periodic,
                                   const signals::SpanLayout& span) {
    auto spectrum = signals::spectrum_of(periodic);
    const auto planet = static_cast<std::size_t>(span.ring_teeth),
               partner = static_cast<std::size_t>(span.planet_teeth);
    for (std::size_t k = 1; k < spectrum.size(); ++k) {
        const std::size_t order = std::min(k, spectrum.size() - k);
        if (order % planet != 0 && order % partner != 0) {
            spectrum[k] = 0.0;
        }
    }
    return signals::signal_of(spectrum);
}

}  // namespace

AlignedSensor aligned_with(std::span<const double> other, std::span<const double> signal, int turns,
                           const signals::SpanLayout& span) {
    constexpr double kBetter = 0.05, kClear = 0.5;  // correlations; few lines may agree by chance
    AlignedSensor aligned{{signal.begin(), signal.end()}, 0.0, {}};
    if (turns == 1 || turns == span.ring_teeth) {
        aligned.shift = signals::align(other, signal).shift;
        aligned.sensor = signals::shifted(signal, aligned.shift);
    }
    aligned.correlation = signals::correlation(other, aligned.sensor);
    if (turns > 1 && turns == span.ring_teeth) {
        const auto before = lines_of_gears(other, span), now = lines_of_gears(signal, span);
        const signals::Alignment gears = signals::align(before, now);
        const double with_all = signals::correlation(before, signals::shifted(now, aligned.shift));
        if (gears.correlation > std::max(kClear, with_all + kBetter)) {
            return {signals::shifted(signal, gears.shift), gears.correlation, gears.shift};
        }
        if (aligned.correlation < kClear && with_all > kClear) {
            aligned.correlation = with_all;
        }
    }
    return aligned;
}

namespace {

// Factor on `before` that leaves the least squares of now - factor before.
double best_scale(std::span<const double> now, std::span<const double> before) {
    return std::inner_product(now.begin(), now.end(), before.begin(), 0.0) /
           std::inner_product(before.begin(), before.end(), before.begin(), 0.0);
}

}  // namespace

MeasuredChange measured_change(const RecordPlan& plan, const MeasuredSignal& record,
                               const MeasuredBaseline& from) {
    const MeasuredSignal& baseline = from.signal;
    const std::string& baseline_file = from.file;
    const int teeth = plan.span.planet_teeth;
    const int turns = std::min(record.planet_turns(plan.span), baseline.planet_turns(plan.span));
    if (turns < 1) {
        throw SignalError(
            fmt::format("{}: the baseline and the recording must both have at least {} mesh "
                        "periods of sensor signal",
                        baseline_file, teeth));
    }
    const auto samples = static_cast<std::size_t>(turns) * plan.turn_samples();
    const auto now = std::span(record.sensor).first(samples);
    auto [before, correlation, shift] =
        aligned_with(now, std::span(baseline.sensor).first(samples), turns, plan.span);
    MeasuredChange change;
    const double turned = shift.total() / static_cast<double>(plan.samples);
    change.meshes = turned < 0.0 ? turned + static_cast<double>(turns * teeth) : turned;
    change.correlation = correlation;
    if (!(change.correlation >= kLeastCorrelation)) {
        throw SignalError(fmt::format(
            "{}: the recording does not resemble this baseline (correlation {:.2f}): another "
            "gearbox or speed{}",
            baseline_file, change.correlation,
            turns == plan.span.ring_teeth || turns == 1
                ? ""
                : fmt::format(", or another start position, which is allowed only for recordings "
                              "of {} mesh periods or of one averaged planet turn",
                              plan.span.meshes())));
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
    change.signal.sensor_meshes = turns * teeth;
    return change;
}

}  // namespace gearpod::mc
