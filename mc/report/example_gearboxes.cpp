#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "analysis/report/json_values.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/scene.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPlottedSamples = 2000;  // plotted samples of a time signal
constexpr std::size_t kMostLines = 500;            // plotted lines of a spectrum
constexpr double kZoomMeshes = 2.5;  // mesh frequencies to either side of the largest line
// Mesh periods of the signal for a spectrogram, of which the page shows windows of eight.
constexpr int kSpectrogramMeshes = 157;

// Ascending indices: all of them, or the largest value of each of `count` intervals of about equal
// length, with `both` also the smallest one, so that no peak is lost.
std::vector<std::size_t> thinned(std::span<const double> values, std::size_t count, bool both) {
    std::vector<std::size_t> kept;
    if (values.size() <= count * (both ? 2 : 1)) {
        kept.resize(values.size());
        std::iota(kept.begin(), kept.end(), std::size_t{0});
        return kept;
    }
    for (std::size_t s = 0; s < count; ++s) {
        const auto interval = values.subspan(
            s * values.size() / count, (s + 1) * values.size() / count - s * values.size() / count);
        auto [low, high] = std::minmax_element(interval.begin(), interval.end());
        if (!both) {
            low = high = std::max_element(interval.begin(), interval.end());
        }
        kept.push_back(static_cast<std::size_t>(&*std::min(low, high) - values.data()));
        if (low != high) {
            kept.push_back(static_cast<std::size_t>(&*std::max(low, high) - values.data()));
        }
    }
    return kept;
}

// Values at the indices, as `y`, and place(index) of each, as `x`.
template <typename Place>
Json curve_json(std::span<const double> values, const std::vector<std::size_t>& indices,
                const char* x, const char* y, Place place) {
    Json json{{x, Json::array()}, {y, Json::array()}};
    for (const std::size_t i : indices) {
        json[x].push_back(place(i));
        json[y].push_back(values[i]);
    }
    return json;
}

// Mesh phase and value of each sample; of many samples the extremes of each interval.
Json time_json(std::span<const double> values, int samples_per_mesh) {
    return curve_json(values, thinned(values, kMostPlottedSamples / 2, true), "mesh", "value",
                      [&](std::size_t i) { return static_cast<double>(i) / samples_per_mesh; });
}

// One-sided amplitude spectrum over the whole span.
std::vector<double> amplitudes_of(signals::OrderSpectrum& spectrum,
                                  const std::vector<double>& signal) {
    spectrum.load(signal);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    return amplitude;
}

// Spectra over the whole band and around the largest noise-free line, one-sided amplitudes over the
// whole span, thinned to the largest line of each interval. `meshes`: lines per mesh frequency.
Json spectrum_json(signals::OrderSpectrum& spectrum, const std::vector<double>& clean,
                   const std::vector<double>& noisy, std::size_t meshes, double period_s) {
    const double resolution_Hz = 1.0 / (static_cast<double>(meshes) * period_s);
    const std::vector<double> without = amplitudes_of(spectrum, clean),
                              with = amplitudes_of(spectrum, noisy);
    const auto top = static_cast<std::size_t>(std::max_element(without.begin() + 1, without.end()) -
                                              without.begin());
    const auto reach = static_cast<std::size_t>(kZoomMeshes * static_cast<double>(meshes));
    const std::size_t first = top > reach ? top - reach : 1;
    const std::size_t last = std::min(without.size(), top + reach + 1);
    const auto both = [&](std::size_t from, std::size_t to) {
        const auto lines = [&](std::span<const double> all) {
            const auto shown = all.subspan(from, to - from);
            return curve_json(
                shown, thinned(shown, kMostLines, false), "frequency_Hz", "amplitude",
                [&](std::size_t i) { return static_cast<double>(from + i) * resolution_Hz; });
        };
        return Json{{"clean", lines(without)}, {"noisy", lines(with)}};
    };
    return {{"whole", both(1, without.size())}, {"zoom", both(first, last)}};
}

constexpr int kStiffnessPoints = 160;  // in a mesh period

// Row of the results file.
struct ExampleRow {
    std::size_t row = 0;
    double size = 0.0;
    std::vector<double> values;  // as in RowShape
};

// The first healthy row, and the first with the largest fault.
std::vector<ExampleRow> choose_rows(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const auto size_at = frame.parameter_index(frame.request.size.name);
    std::optional<ExampleRow> chosen[2];
    for_each_row(rows, [&](const ResultRow& row) {
        if (row.status != static_cast<int>(Status::ok)) {
            return;
        }
        const double size = size_at ? row.values[*size_at] : 0.0;
        auto& place = chosen[size > 0.0 ? 1 : 0];
        if (!place || size > place->size) {
            place = {row.index, size, {row.values, row.values + shape.values()}};
        }
    });
    std::vector<ExampleRow> found;
    for (const auto& row : chosen) {
        if (row) {
            found.push_back(*row);
        }
    }
    return found;
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

// Computes example gearboxes.
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

    // Results of the gearboxes, which are integrated together where their records allow it.
    Json run(const std::vector<ExampleRow>& rows) {
        std::vector<GearboxId> ids;
        for (const ExampleRow& row : rows) {
            ids.push_back(id_of(row.row));
        }
        Json all = Json::array();
        for (std::size_t first = 0; first < ids.size();) {
            const auto left = std::span(ids).subspan(first);
            const auto together = left.first(shared_records(plan_.record, left, left.size()));
            const GearboxTile tile =
                run_gearboxes(plan_, together, static_cast<int>(together.size()));
            for (LaneId lane{0}; lane < together.size(); ++lane) {
                all.push_back(gearbox(rows[first + lane], together[lane], tile, lane));
            }
            first += together.size();
        }
        return all;
    }

    double noise_level() const { return frame_.noise_levels[level_]; }

  private:
    Json gearbox(const ExampleRow& row, const GearboxId& id, const GearboxTile& tile, LaneId lane) {
        if (tile.status[lane] != Status::ok) {
            throw std::runtime_error("the gearbox in row " + std::to_string(row.row) +
                                     " failed when computed again");
        }
        std::vector<LevelSignals> levels;
        const Realization& realization = tile.realizations[lane];
        const LaneSignals gearbox_signals = lane_signals(plan_, tile, lane, features_.meshes());
        auto values = features_.compute(gearbox_signals, realization, &levels);
        std::vector<double> te_turn = features_.record().te_turn;
        rotate_to_first_tooth(features_.record(), plan_.record.te_samples, te_turn);
        const RowShape shape = row_shape(frame_);
        const std::span<const double> stored(row.values.data() + shape.parameters,
                                             shape.features * shape.levels);
        // Features in Python keep their stored values.
        for (std::size_t v = 0; v < stored.size(); ++v) {
            const std::string& name = frame_.features[v / shape.levels].name;
            const auto external = [&](const features::Feature* feature) {
                return feature->external && feature->name == name;
            };
            if (std::ranges::any_of(plan_.features.used, external)) {
                values[v] = stored[v];
            }
        }
        const double period_s = dynamics::mesh_period_s(plan_.gearbox->inputs(realization.inputs));
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
            const Signals signals = record_of(plan_.sensors->front(), realization, features_,
                                              whole_signals(tile, lane));
            add_sensor(signals, json);
            json.update(sensor_json(plan_.sensors->front(), signals, features_,
                                    levels[level_].tooth_rms, period_s));
            json["additional_sensors"] = additional_sensors(tile, lane, period_s);
            if (plan_.gearbox->excitation && plan_.gearbox->excitation->speed) {
                json["spectrogram"] = spectrogram(id);
            }
        }
        return json;
    }

    // Samples of a record, without and with noise at the page's level.
    struct Signals {
        LaneSignals record;
        std::vector<double> noisy;
        signals::SpanLayout layout;
    };

    // Signals of all sensors from which records are taken.
    LaneSignals whole_signals(const GearboxTile& tile, LaneId lane) const {
        return lane_signals(
            plan_, tile, lane,
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
                     double period_s) {
        std::vector<double> clean_rms(noisy_rms.size());
        signals::Windowing windowing(signals.layout, plan_.record.samples,
                                     plan_.features.tukey_taper);
        windowing.load(sensor.find<RangeStage>() != nullptr ? signals.record.folded
                                                            : features.record().folded);
        windowing.search(0.0, clean_rms);
        rotate_to_first_tooth(features.record(), 1, clean_rms);
        const auto points = static_cast<int>(signals.noisy.size());
        signals::OrderSpectrum& spectrum = spectra_.try_emplace(points, points).first->second;
        return {{"spectrum",
                 spectrum_json(spectrum, signals.record.sensor, signals.noisy,
                               static_cast<std::size_t>(signals.layout.meshes()), period_s)},
                {"tooth_rms", {{"clean", clean_rms}, {"noisy", noisy_rms}}}};
    }

    // Sensor without noise over the first mesh periods of the gearbox's record, for a spectrogram.
    Json spectrogram(const GearboxId& id) const {
        const Simulation simulated =
            simulate(plan_, id, std::min(plan_.record.span.meshes(), kSpectrogramMeshes));
        const auto column = [&](const char* name) -> const std::vector<double>& {
            return std::ranges::find(simulated.columns, name, &SignalColumn::name)->values;
        };
        constexpr double kBeyondBand = 1.25;  // of the low-pass
        return {{"time_s", column("time")},
                {"sensor", column("sensor")},
                {"samples_per_mesh", plan_.record.samples},
                {"highest_Hz", kBeyondBand * plan_.features.low_pass_Hz}};
    }

    Json additional_sensors(const GearboxTile& tile, LaneId lane, double period_s) {
        Json all = Json::array();
        for (const SensorPlan& sensor : std::span(*plan_.sensors).subspan(1)) {
            const HealthyReference healthy = healthy_reference(plan_, sensor.number);
            RealizationFeatures features(plan_, &healthy, false, sensor.number);
            const Realization here = sensor.realization(tile.realizations[lane]);
            SensorSignals record =
                signals_of_sensor(sensor, lane_signals(plan_, tile, lane, features.meshes()));
            std::vector<LevelSignals> levels;
            features.compute(record.linked(), here, &levels);
            const Signals signals =
                record_of(sensor, here, features,
                          signals_of_sensor(sensor, whole_signals(tile, lane)).record);
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
    // By number of samples: their tables cost more than a transform.
    std::map<int, signals::OrderSpectrum> spectra_;
};

Json gearboxes_json(const TilePlan& tile, const EnsemblePlan& ensemble, const Results& frame,
                    const RowSource& rows) {
    Json json{{"refusal", nullptr}, {"gearboxes", Json::array()}};
    const std::vector<ExampleRow> chosen = choose_rows(frame, rows);
    if (chosen.empty()) {
        json["refusal"] = "all gearboxes failed";
        return json;
    }
    Examples examples(tile, ensemble, frame);
    json["noise_level"] = examples.noise_level();
    json["gearboxes"] = examples.run(chosen);
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
    const std::string text = frame.provenance_value("study"), name = "study of the results";
    const StudyScene made = text.empty()
                                ? StudyScene()
                                : make_scene(name, read_study_text(text, name), Choosing::nothing);
    if (!made) {
        const std::string why = text.empty() ? "the file contains no study"
                                             : "this version cannot build the study in the file: " +
                                                   format(made.problems);
        return {{"examples", {{"refusal", why}, {"gearboxes", Json::array()}}},
                {"stiffness", {{"refusal", why}}}};
    }
    return {{"examples", or_refusal([&] {
                 return gearboxes_json(made.scene->tile(), made.scene->ensemble(), frame, rows);
             })},
            {"stiffness", or_refusal([&] { return stiffness_json(made.scene->gearbox()); })}};
}

}  // namespace gearpod::mc
