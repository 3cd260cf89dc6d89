#include "mc/report/example_gearboxes.hpp"

#include <algorithm>
#include <bit>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <complex>
#include <exception>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "analysis/report/json_values.hpp"
#include "machine/contracts.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/scene.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {
namespace {

std::vector<std::size_t> all_of(std::size_t count) {
    std::vector<std::size_t> indices(count);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
}

// Calls use(first, last) for `count` intervals of about equal length.
template <typename Use>
void for_each_stretch(std::span<const double> values, std::size_t count, Use use) {
    for (std::size_t s = 0; s < count; ++s) {
        use(values.begin() + static_cast<std::ptrdiff_t>(s * values.size() / count),
            values.begin() + static_cast<std::ptrdiff_t>((s + 1) * values.size() / count));
    }
}

}  // namespace

std::vector<std::size_t> extremes(std::span<const double> values, std::size_t most) {
    EXPECTS(most >= 2);
    if (values.size() <= most) {
        return all_of(values.size());
    }
    std::vector<std::size_t> kept;
    for_each_stretch(values, most / 2, [&](auto first, auto last) {
        const auto [low, high] = std::minmax_element(first, last);
        kept.push_back(static_cast<std::size_t>(std::min(low, high) - values.begin()));
        if (low != high) {
            kept.push_back(static_cast<std::size_t>(std::max(low, high) - values.begin()));
        }
    });
    return kept;
}

std::vector<std::size_t> maxima(std::span<const double> values, std::size_t most) {
    if (values.size() <= most) {
        return all_of(values.size());
    }
    std::vector<std::size_t> kept;
    for_each_stretch(values, most, [&](auto first, auto last) {
        kept.push_back(static_cast<std::size_t>(std::max_element(first, last) - values.begin()));
    });
    return kept;
}

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPlottedSamples = 2000;  // plotted samples of a time signal
constexpr std::size_t kMostLines = 500;            // plotted lines of a spectrum
constexpr double kZoomMeshes = 2.5;  // mesh frequencies to either side of the largest line

Json numbers_json(std::span<const double> values, std::span<const std::size_t> indices) {
    Json json = Json::array();
    for (const std::size_t i : indices) {
        json.push_back(values[i]);
    }
    return json;
}

// Spectral lines first to last - 1, `resolution_Hz` apart, thinned to the largest of each interval.
Json lines_json(std::span<const double> amplitude, std::size_t first, std::size_t last,
                double resolution_Hz) {
    const auto lines = amplitude.subspan(first, last - first);
    const auto kept = maxima(lines, kMostLines);
    Json json{{"frequency_Hz", Json::array()}, {"amplitude", numbers_json(lines, kept)}};
    for (const std::size_t i : kept) {
        json["frequency_Hz"].push_back(static_cast<double>(first + i) * resolution_Hz);
    }
    return json;
}

// One-sided amplitude spectrum over the whole span.
std::vector<double> amplitudes_of(const std::vector<double>& signal) {
    signals::OrderSpectrum spectrum(static_cast<int>(signal.size()));
    spectrum.load(signal);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    return amplitude;
}

// The signal at `count` evenly spaced times from the first to the last. The places between the
// samples follow linearly from the times, the values from a cubic spline.
std::vector<double> evenly_spaced(std::span<const double> time_s, const std::vector<double>& signal,
                                  std::size_t count) {
    const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
        signal.begin(), signal.end(), 0.0, 1.0);
    const double first = time_s.front(),
                 step = (time_s.back() - first) / static_cast<double>(count - 1);
    std::vector<double> even;
    std::size_t after = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = first + step * static_cast<double>(i);
        while (after + 1 < time_s.size() && time_s[after] < at) {
            ++after;
        }
        const double inside = (at - time_s[after - 1]) / (time_s[after] - time_s[after - 1]);
        even.push_back(spline(static_cast<double>(after - 1) + std::clamp(inside, 0.0, 1.0)));
    }
    return even;
}

}  // namespace

nlohmann::json spectrogram_json(std::span<const double> time_s, const std::vector<double>& signal,
                                int samples_per_mesh, double highest_Hz) {
    constexpr std::size_t kMostBins = 120;
    constexpr double kLowest_dB = -60.0;
    const std::size_t mesh = static_cast<std::size_t>(samples_per_mesh),
                      length = kSpectrogramWindow * mesh;
    Json json{{"time_s", Json::array()},
              {"mesh_Hz", Json::array()},
              {"frequency_Hz", Json::array()},
              {"level_dB", Json::array()}};
    if (signal.size() < length) {
        return json;
    }
    const std::vector<double> even = evenly_spaced(time_s, signal, signal.size());
    const double duration = time_s.back() - time_s.front(),
                 step_s = duration / (static_cast<double>(signal.size()) - 1.0),
                 line_Hz = 1.0 / (step_s * static_cast<double>(length));
    const auto lines = std::min(length / 2, static_cast<std::size_t>(highest_Hz / line_Hz));
    const std::size_t each = std::max<std::size_t>(1, (lines + kMostBins - 1) / kMostBins);
    signals::FourierTransform transform(static_cast<int>(length));
    std::vector<std::complex<double>> windowed(length), spectrum(length);
    std::vector<std::vector<double>> amplitudes;
    double largest = 0.0;
    for (std::size_t first = 0; first + length <= even.size(); first += mesh) {
        for (std::size_t i = 0; i < length; ++i) {
            const double turn = (static_cast<double>(i) + 0.5) / static_cast<double>(length);
            windowed[i] = even[first + i] * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn));
        }
        transform.transform(windowed, spectrum);
        std::vector<double>& bins = amplitudes.emplace_back();
        for (std::size_t line = 1; line + each <= lines + 1; line += each) {
            double peak = 0.0;
            for (std::size_t k = line; k < line + each; ++k) {
                peak = std::max(peak, std::abs(spectrum[k]));
            }
            bins.push_back(peak);
            largest = std::max(largest, peak);
        }
        const double middle_s = time_s.front() + step_s * (static_cast<double>(first) +
                                                           0.5 * static_cast<double>(length));
        json["time_s"].push_back(middle_s);
        // Mesh period around the middle: the time of as many samples.
        const auto at =
            static_cast<std::size_t>(std::ranges::lower_bound(time_s, middle_s) - time_s.begin());
        const std::size_t from = std::clamp(at, mesh / 2, time_s.size() - 1 - mesh / 2) - mesh / 2;
        json["mesh_Hz"].push_back(static_cast<double>(2 * (mesh / 2)) / static_cast<double>(mesh) /
                                  (time_s[from + 2 * (mesh / 2)] - time_s[from]));
    }
    for (std::size_t bin = 0; bin < amplitudes.front().size(); ++bin) {
        json["frequency_Hz"].push_back(line_Hz * (1.0 + static_cast<double>(each * bin) +
                                                  0.5 * (static_cast<double>(each) - 1.0)));
    }
    for (const std::vector<double>& bins : amplitudes) {
        Json levels = Json::array();
        for (const double amplitude : bins) {
            const double level = largest > 0.0 && amplitude > 0.0
                                     ? 20.0 * std::log10(amplitude / largest)
                                     : kLowest_dB;
            levels.push_back(0.1 * std::round(10.0 * std::max(kLowest_dB, level)));
        }
        json["level_dB"].push_back(std::move(levels));
    }
    return json;
}

nlohmann::json time_json(std::span<const double> values, int samples_per_mesh) {
    const auto kept = extremes(values, kMostPlottedSamples);
    Json json{{"mesh", Json::array()}, {"value", numbers_json(values, kept)}};
    for (const std::size_t i : kept) {
        json["mesh"].push_back(static_cast<double>(i) / samples_per_mesh);
    }
    return json;
}

nlohmann::json spectrum_json(const std::vector<double>& clean, const std::vector<double>& noisy,
                             std::size_t meshes, double period_s) {
    const double resolution_Hz = 1.0 / (static_cast<double>(meshes) * period_s);
    const std::vector<double> without = amplitudes_of(clean), with = amplitudes_of(noisy);
    const auto top = static_cast<std::size_t>(std::max_element(without.begin() + 1, without.end()) -
                                              without.begin());
    const auto reach = static_cast<std::size_t>(kZoomMeshes * static_cast<double>(meshes));
    const std::size_t first = top > reach ? top - reach : 1;
    const std::size_t last = std::min(without.size(), top + reach + 1);
    const auto both = [&](std::size_t from, std::size_t to) {
        return Json{{"clean", lines_json(without, from, to, resolution_Hz)},
                    {"noisy", lines_json(with, from, to, resolution_Hz)}};
    };
    return {{"whole", both(1, without.size())}, {"zoom", both(first, last)}};
}

namespace {

using Json = nlohmann::json;

constexpr int kStiffnessPoints = 160;  // in a mesh period

// Row of the results file.
struct ExampleRow {
    std::size_t row = 0;
    double size = 0.0;
    std::vector<double> values;  // as in RowShape
};

struct ExampleRows {
    std::optional<ExampleRow> healthy, faulty;
};

ExampleRows choose_rows(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const auto size_at = frame.parameter_index(frame.request.size.name);
    ExampleRows chosen;
    for_each_row(rows, [&](const ResultRow& row) {
        if (row.status != static_cast<int>(Status::ok)) {
            return;
        }
        const double size = size_at ? row.values[*size_at] : 0.0;
        auto& place = size > 0.0 ? chosen.faulty : chosen.healthy;
        if (!place || size > place->size) {
            place = {row.index, size, {row.values, row.values + shape.values()}};
        }
    });
    return chosen;
}

// True if all values are equal bit by bit, as they are for a gearbox computed again.
bool same_bits(std::span<const double> a, std::span<const double> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
}

// Intervals of a planet turn, in mesh periods, in which the faulty tooth is engaged.
Json engagements(const GearboxPlan& gearbox, double size) {
    Json json = Json::array();
    const lockstep::FaultPattern& pattern = gearbox.fault().pattern();
    const int turn = gearbox.drivetrain->span().planet_teeth;
    for (const lockstep::FaultPassage& passage : pattern.passages) {
        const auto mesh = gearbox.fault().mesh(passage.curve, size);
        if (!mesh) {
            continue;
        }
        for (double start = passage.start; start < turn; start += pattern.length) {
            json.push_back({{"pair", gearbox.drivetrain->pair_name(passage.pair)},
                            {"from", start},
                            {"to", start + mesh->duration()}});
        }
    }
    return json;
}

// Computes example gearboxes, one at a time.
class Examples {
  public:
    Examples(const TilePlan& tile, const EnsemblePlan& ensemble, const Results& frame)
        : plan_(tile),
          ensemble_(ensemble),
          frame_(frame),
          healthy_(healthy_reference(tile)),
          features_(tile, &healthy_, false),
          level_(reference_level(frame.noise_levels)) {}

    // Identity of the gearbox in a row. Rows of a part count from the first row of the part.
    GearboxId id_of(std::size_t row) const {
        const BatchPlan plan =
            ensemble_.batches(read_part(frame_.provenance_value("part")).value_or(Part{}));
        const Batch batch = plan.batch(plan.batch_of_row(row));
        const std::size_t within = row - batch.first_row;
        return {batch.group, batch.first_index + within / batch.records, Record::test,
                within % batch.records,
                batch.group == Group::threshold ? plan_.draw().rows.threshold_noise
                                                : NoiseSampling::plain};
    }

    Json run(const ExampleRow& row) {
        const GearboxId id = id_of(row.row);
        const GearboxTile tile = run_gearboxes(plan_, std::span(&id, 1), 1);
        if (tile.status[0] != Status::ok) {
            throw std::runtime_error("the gearbox in row " + std::to_string(row.row) +
                                     " failed when computed again");
        }
        std::vector<LevelSignals> levels;
        const LaneSignals gearbox_signals =
            lane_signals(plan_, tile, LaneId{0}, features_.meshes());
        auto values = features_.compute(gearbox_signals, tile.realizations[0], &levels);
        std::vector<double> te_turn = features_.record().te_turn;
        rotate_to_first_tooth(features_.record(), plan_.record.te_samples, te_turn);
        const RowShape shape = row_shape(frame_);
        const std::span<const double> stored(row.values.data() + shape.parameters,
                                             shape.features * shape.levels);
        // Features in Python keep their stored values.
        for (std::size_t f = 0; f < shape.features; ++f) {
            const bool external =
                std::ranges::any_of(plan_.features.used, [&](const features::Feature* feature) {
                    return feature->external && feature->name == frame_.features[f].name;
                });
            if (external) {
                std::copy_n(stored.begin() + static_cast<std::ptrdiff_t>(f * shape.levels),
                            shape.levels,
                            values.begin() + static_cast<std::ptrdiff_t>(f * shape.levels));
            }
        }
        const double period_s =
            dynamics::mesh_period_s(plan_.gearbox->inputs(tile.realizations[0].inputs));
        Json json{{"row", row.row},
                  {"size", row.size},
                  {"mesh_period_s", period_s},
                  {"same_bits", same_bits(values, stored)},
                  {"engagements", engagements(*plan_.gearbox, row.size)},
                  {"te",
                   {{"clean", time_json(te_turn, plan_.record.te_samples)},
                    {"noisy", time_json(levels[level_].te_turn, plan_.record.te_samples)}}},
                  {"sensor", nullptr},
                  {"spectrum", nullptr},
                  {"tooth_rms", nullptr}};
        for (std::size_t p = 0; p < shape.parameters; ++p) {
            json["inputs"].push_back({{"name", frame_.parameters[p].name},
                                      {"unit", frame_.parameters[p].unit},
                                      {"value", row.values[p]}});
        }
        for (std::size_t f = 0; f < shape.features; ++f) {
            const double value = values[f * shape.levels + level_];
            json["features"].push_back(
                {{"name", frame_.features[f].name}, {"value", analysis::number(value)}});
        }
        if (!gearbox_signals.folded.empty()) {
            const Signals signals = record_of(plan_.sensors->front(), tile.realizations[0],
                                              features_, whole_signals(tile));
            add_sensor(signals, json);
            json.update(sensor_json(plan_.sensors->front(), signals, features_,
                                    levels[level_].tooth_rms, period_s));
            json["additional_sensors"] = additional_sensors(tile, period_s);
            if (plan_.gearbox->excitation && plan_.gearbox->excitation->speed) {
                json["spectrogram"] = spectrogram(id);
            }
        }
        return json;
    }

    double noise_level() const { return frame_.noise_levels[level_]; }

  private:
    // Samples of a record, without and with noise at the page's level.
    struct Signals {
        LaneSignals record;
        std::vector<double> noisy;
        signals::SpanLayout layout;
    };

    // Signals of all sensors from which records are taken.
    LaneSignals whole_signals(const GearboxTile& tile) const {
        return lane_signals(
            plan_, tile, LaneId{0},
            plan_.record.length ? plan_.record.signal_meshes : plan_.record.span.meshes());
    }

    Signals record_of(const SensorPlan& sensor, const Realization& realization,
                      const RealizationFeatures& features, LaneSignals whole) const {
        Signals signals{
            drawn_record(plan_.record, std::move(whole), realization), {}, plan_.record.span};
        if (signals.record.turns > 0) {
            signals.layout.ring_teeth = signals.record.turns;
        }
        signals.noisy = signals.record.sensor;
        add_noise(sample_noise(plan_.record, sensor.noise(), realization, signals.record.sensor,
                               features.noise().sensor, signals.layout.ring_teeth),
                  noise_level() * realization.inputs.noise_m_s2, signals.noisy);
        if (const auto* range = sensor.find<RangeStage>()) {
            range->clip(signals.noisy);
            range->clip(signals.record.sensor);
            fold_again(plan_.record, signals.record);
        }
        return signals;
    }

    // A turn from tooth 0 on.
    void add_sensor(const Signals& signals, Json& json) const {
        const int samples = plan_.record.samples, teeth = signals.layout.planet_teeth;
        const int before = signals.record.first_mesh % teeth;
        const std::size_t first =
                              static_cast<std::size_t>(before > 0 ? (teeth - before) * samples : 0),
                          turn = static_cast<std::size_t>(teeth * samples);
        json["sensor"] = {
            {"clean", time_json({signals.record.sensor.data() + first, turn}, samples)},
            {"noisy", time_json({signals.noisy.data() + first, turn}, samples)}};
    }

    // Spectrum and RMS of each tooth of a sensor's record, whose features were computed last.
    Json sensor_json(const SensorPlan& sensor, const Signals& signals,
                     const RealizationFeatures& features, const std::vector<double>& noisy_rms,
                     double period_s) const {
        std::vector<double> clean_rms(noisy_rms.size());
        signals::Windowing windowing(signals.layout, plan_.record.samples,
                                     plan_.features.tukey_taper);
        windowing.load(sensor.find<RangeStage>() != nullptr ? signals.record.folded
                                                            : features.record().folded);
        windowing.search(0.0, clean_rms);
        rotate_to_first_tooth(features.record(), 1, clean_rms);
        return {{"spectrum",
                 spectrum_json(signals.record.sensor, signals.noisy,
                               static_cast<std::size_t>(signals.layout.meshes()), period_s)},
                {"tooth_rms", {{"clean", clean_rms}, {"noisy", noisy_rms}}}};
    }

    // Spectrogram of the sensor without noise, from the first mesh periods of the gearbox's record.
    Json spectrogram(const GearboxId& id) const {
        const long meshes =
            std::min(plan_.record.span.meshes(), kSpectrogramSlices + kSpectrogramWindow - 1);
        const Simulation simulated = simulate(plan_, id, meshes);
        const auto column = [&](const char* name) -> const std::vector<double>& {
            return std::ranges::find(simulated.columns, name, &SignalColumn::name)->values;
        };
        constexpr double kBeyondBand = 1.25;  // of the low-pass
        return spectrogram_json(column("time"), column("sensor"), plan_.record.samples,
                                kBeyondBand * plan_.features.low_pass_Hz);
    }

    Json additional_sensors(const GearboxTile& tile, double period_s) const {
        Json all = Json::array();
        for (const SensorPlan& sensor : std::span(*plan_.sensors).subspan(1)) {
            const HealthyReference healthy = healthy_reference(plan_, sensor.number);
            RealizationFeatures features(plan_, &healthy, false, sensor.number);
            const Realization here = sensor.realization(tile.realizations[0]);
            SensorSignals record =
                signals_of_sensor(sensor, lane_signals(plan_, tile, LaneId{0}, features.meshes()));
            std::vector<LevelSignals> levels;
            features.compute(record.linked(), here, &levels);
            const Signals signals = record_of(
                sensor, here, features, signals_of_sensor(sensor, whole_signals(tile)).record);
            Json json = sensor_json(sensor, signals, features, levels[level_].tooth_rms, period_s);
            json["name"] = sensor.name;
            all.push_back(std::move(json));
        }
        return all;
    }

    const TilePlan& plan_;
    const EnsemblePlan& ensemble_;
    const Results& frame_;
    const HealthyReference healthy_;
    RealizationFeatures features_;
    const std::size_t level_;
};

Json gearboxes_json(const TilePlan& tile, const EnsemblePlan& ensemble, const Results& frame,
                    const RowSource& rows) {
    Json json{{"refusal", nullptr}, {"gearboxes", Json::array()}};
    const ExampleRows chosen = choose_rows(frame, rows);
    if (!chosen.healthy && !chosen.faulty) {
        json["refusal"] = "all gearboxes failed";
        return json;
    }
    Examples examples(tile, ensemble, frame);
    json["noise_level"] = examples.noise_level();
    for (const auto& row : {chosen.healthy, chosen.faulty}) {
        if (row) {
            json["gearboxes"].push_back(examples.run(*row));
        }
    }
    return json;
}

Json healthy_curves(const GearboxPlan& gearbox) {
    Json pairs = Json::array();
    for (PairId pair{0}; pair < gearbox.pairs().pairs(); ++pair) {
        Json values = Json::array();
        for (int i = 0; i < kStiffnessPoints; ++i) {
            values.push_back(
                gearbox.pairs().total(pair, static_cast<double>(i) / kStiffnessPoints));
        }
        pairs.push_back({{"name", gearbox.drivetrain->pair_name(pair)}, {"stiffness", values}});
    }
    return pairs;
}

// Mesh stiffness from a quarter mesh period before the faulty tooth engages to a quarter after it
// disengages.
Json passage_json(const GearboxPlan& gearbox, int curve, PairId pair, std::vector<double> sizes) {
    Json json{{"pair", gearbox.drivetrain->pair_name(pair)},
              {"mesh", Json::array()},
              {"healthy", Json::array()},
              {"faulty", Json::array()}};
    double duration = 0.0;
    for (const double size : sizes) {
        duration = std::max(duration, gearbox.fault().mesh(curve, size)->duration());
    }
    const double start = gearbox.pairs().start[pair];
    const int last = static_cast<int>(std::ceil((duration + 0.25) * kStiffnessPoints));
    const auto since = [](int i) { return static_cast<double>(i) / kStiffnessPoints; };
    for (int i = -kStiffnessPoints / 4; i <= last; ++i) {
        json["mesh"].push_back(since(i));
        json["healthy"].push_back(gearbox.pairs().total(pair, start + since(i)));
    }
    for (const double size : sizes) {
        const auto mesh = gearbox.fault().mesh(curve, size);
        Json values = Json::array();
        for (int i = -kStiffnessPoints / 4; i <= last; ++i) {
            values.push_back(faulty_total(gearbox.pairs(), pair, *mesh, since(i)));
        }
        json["faulty"].push_back({{"size", size}, {"stiffness", values}});
    }
    return json;
}

Json stiffness_json(const GearboxPlan& gearbox) {
    Json json{{"refusal", nullptr}, {"mesh", Json::array()}, {"passages", Json::array()}};
    for (int i = 0; i < kStiffnessPoints; ++i) {
        json["mesh"].push_back(static_cast<double>(i) / kStiffnessPoints);
    }
    json["pairs"] = healthy_curves(gearbox);
    const std::vector<PairId> pairs = faulty_pairs(gearbox.fault());
    const std::vector<double> sizes = gearbox.fault().plan().sizes;
    for (int curve = 0; curve < gearbox.fault().curves() && !sizes.empty(); ++curve) {
        json["passages"].push_back(
            passage_json(gearbox, curve, pairs[static_cast<std::size_t>(curve)], sizes));
    }
    return json;
}

Json refusal_json(const std::string& why) {
    return {{"examples", {{"refusal", why}, {"gearboxes", Json::array()}}},
            {"stiffness", {{"refusal", why}}}};
}

// Returns the result of `make`, or the reason why it failed.
template <typename Make>
Json or_refusal(Make make) {
    try {
        return make();
    } catch (const std::exception& error) {
        return {{"refusal", error.what()}};
    }
}

}  // namespace

nlohmann::json examples_json(const Results& frame, const RowSource& rows) {
    const std::string text = frame.provenance_value("study");
    if (text.empty()) {
        return refusal_json("the file contains no study");
    }
    const std::string name = "study of the results";
    const StudyScene made = make_scene(name, read_study_text(text, name));
    if (!made) {
        return refusal_json("this version cannot build the study in the file: " +
                            format(made.problems));
    }
    return {{"examples", or_refusal([&] {
                 return gearboxes_json(made.scene->tile(), made.scene->ensemble(), frame, rows);
             })},
            {"stiffness", or_refusal([&] { return stiffness_json(made.scene->gearbox()); })}};
}

}  // namespace gearpod::mc
