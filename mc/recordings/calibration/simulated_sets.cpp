#include "mc/recordings/calibration/simulated_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_signals.hpp"
#include "mc/recordings/measured_features.hpp"
#include "mc/study/keys/key.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/normals.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

double uniform(Philox& engine) {
    constexpr double kUnit = 0x1p-53;
    return (static_cast<double>(engine() >> 11) + 0.5) * kUnit;
}

// One gearbox of a set: integrated once, and combined with several backgrounds.
struct Item {
    std::size_t set = 0, gearbox = 0;
    std::vector<std::vector<GivenInput>> given;  // for each background
};

class Simulator {
  public:
    Simulator(const TilePlan& tile, const RecordLengths& lengths, const UsedFeatures& features)
        : tile_(tile),
          plan_{tile.record, tile.features, tile.gearbox->nominal},
          lengths_(lengths),
          features_(features) {}

    int lanes() const { return tile_.solve->settings.numerics.lanes; }

    // Values [item][background][record][feature]; empty for a gearbox that failed.
    std::vector<RecordValues> run(std::span<const Item> items) const {
        std::vector<Realization> realizations;
        for (const Item& item : items) {
            realizations.push_back(tile_.sampler->draw(id_of(item), item.given.front()));
            // gain and tone level are applied for each background
            InstanceInputs& inputs = realizations.back().inputs;
            inputs.gain = inputs.tone_level = 1.0;
        }
        const GearboxTile tile = run_realizations(tile_, std::move(realizations), lanes(),
                                                  {.records = lockstep::RecordOptions{}});
        std::vector<RecordValues> values(items.size());
        for (LaneId lane{0}; lane < items.size(); ++lane) {
            if (tile.status[lane] == Status::ok) {
                values[lane] = records_of(tile, lane, items[lane]);
            }
        }
        return values;
    }

  private:
    GearboxId id_of(const Item& item) const {
        return {Group::threshold, item.set * lengths_.size() + item.gearbox};
    }

    std::vector<double> synthesize(const GearboxTile& tile, LaneId lane, double exponent,
                                   const signals::Tones& tones) const {
        return signals::synthesize(tile.views, lane, tile.integration.content, plan_.record.span,
                                   tile_.sensors->front().paths.front(), exponent, 0,
                                   plan_.record.signal_meshes, tones);
    }

    // Records of a gearbox with each background.
    RecordValues records_of(const GearboxTile& tile, LaneId lane, const Item& item) const {
        const GearboxId id = id_of(item);
        RecordValues values;
        std::vector<double> bare, tones;
        std::optional<double> exponent;
        for (std::size_t k = 0; k < item.given.size(); ++k) {
            const InstanceInputs inputs = tile_.sampler->draw(id, item.given[k]).inputs;
            if (exponent != inputs.path_exponent) {
                exponent = inputs.path_exponent;
                bare = synthesize(tile, lane, *exponent, {});
                if (!tile.tones.empty()) {
                    tones = synthesize(tile, lane, *exponent, tile.tones);
                    for (std::size_t i = 0; i < tones.size(); ++i) {
                        tones[i] -= bare[i];
                    }
                }
            }
            values.emplace_back();
            const std::vector<int>& lengths = lengths_[item.gearbox];
            for (std::size_t record = 0; record < lengths.size(); ++record) {
                Philox engine = gearbox_stream(tile_.draw().seed, id,
                                               with_suffix(StreamPurpose::calibration_record,
                                                           fmt::format("{}.{}", k, record)));
                values.back().push_back(measured_values(
                    plan_, record_with_background(bare, tones, inputs, lengths[record], engine),
                    features_));
            }
        }
        return values;
    }

    // Record with the given background; its first mesh period and its noise are random.
    MeasuredSignal record_with_background(const std::vector<double>& bare,
                                          const std::vector<double>& tones,
                                          const InstanceInputs& inputs, int meshes,
                                          Philox& engine) const {
        const auto samples = static_cast<std::size_t>(plan_.record.samples);
        const int unused = std::max(0, plan_.record.signal_meshes - meshes);
        const auto first =
            samples * static_cast<std::size_t>(uniform(engine) * static_cast<double>(unused + 1));
        const std::size_t count = std::min(samples * static_cast<std::size_t>(meshes), bare.size());
        MeasuredSignal signal;
        signal.has_sensor = true;
        signal.sensor.resize(count);
        if (const NoiseStage& noise = tile_.sensors->front().noise(); noise.by_density()) {
            draw_unit_noise(noise, noise_of(inputs), tile_.record.sample_s(inputs),
                            NoiseEngines<Philox>{engine, engine, engine}, std::span(signal.sensor));
        } else {
            signals::draw_normals(engine, std::span(signal.sensor));
        }
        for (std::size_t i = 0; i < count; ++i) {
            signal.sensor[i] = inputs.gain * bare[first + i] + inputs.noise_m_s2 * signal.sensor[i];
            if (!tones.empty()) {
                signal.sensor[i] += inputs.tone_level * tones[first + i];
            }
        }
        signal.sensor_meshes = static_cast<int>(count / samples);
        return signal;
    }

    const TilePlan& tile_;
    const MeasurementPlan plan_;
    const RecordLengths& lengths_;
    const UsedFeatures& features_;
};

// Quantiles of the inputs in the priors, for each background of one integrated set. Inputs of the
// time integration have the same value in all of them.
std::vector<std::vector<double>> prior_quantiles(std::uint64_t seed,
                                                 std::span<const CalibratedInput> inputs,
                                                 const PriorRegion& region, std::size_t number,
                                                 std::size_t backgrounds) {
    std::vector<std::vector<double>> all(backgrounds, std::vector<double>(inputs.size()));
    for (std::size_t p = 0; p < inputs.size(); ++p) {
        Philox engine =
            gearbox_stream(seed, {Group::threshold, number},
                           with_suffix(StreamPurpose::calibration_prior, flat_path(inputs[p].key)));
        for (std::size_t k = 0; k < backgrounds; ++k) {
            all[k][p] = k > 0 && !inputs[p].independent_of_motion()
                            ? all[0][p]
                            : region.low[p] + (region.high[p] - region.low[p]) * uniform(engine);
        }
    }
    return all;
}

}  // namespace

std::vector<SimulatedSet> simulate_sets(const TilePlan& tile,
                                        std::span<const CalibratedInput> inputs,
                                        const PriorRegion& region, const SetPlan& plan,
                                        const RecordLengths& lengths, const UsedFeatures& features,
                                        int threads,
                                        const std::function<void(double)>& report_time) {
    const std::size_t gearboxes = lengths.size();
    std::vector<SimulatedSet> sets;
    std::vector<Item> items;
    for (std::size_t d = 0; d < plan.integrated; ++d) {
        const std::size_t number = plan.first + d;
        const auto units =
            prior_quantiles(tile.draw().seed, inputs, region, number, plan.backgrounds);
        std::vector<std::vector<GivenInput>> given;
        for (const auto& unit : units) {
            sets.push_back({unit, number, {}});
            given.push_back(given_at(inputs, unit));
        }
        for (std::size_t g = 0; g < gearboxes; ++g) {
            items.push_back({number, g, given});
        }
    }
    const Simulator simulator(tile, lengths, features);
    std::vector<RecordValues> set_records(items.size());
    const auto lanes = static_cast<std::size_t>(simulator.lanes());
    const std::size_t tiles = (items.size() + lanes - 1) / lanes;
    const auto run = [&](std::size_t number) {
        const std::size_t first = number * lanes;
        auto of_tile =
            simulator.run(std::span(items).subspan(first, std::min(lanes, items.size() - first)));
        std::move(of_tile.begin(), of_tile.end(),
                  set_records.begin() + static_cast<std::ptrdiff_t>(first));
    };
    const double start = thread_processor_s();
    run(0);
    report_time((thread_processor_s() - start) * static_cast<double>(tiles));
    machine::for_each_index(tiles - 1, threads, [&](std::size_t number) { run(number + 1); });
    for (std::size_t d = 0; d < plan.integrated; ++d) {
        const std::span<const RecordValues> of_set =
            std::span(set_records).subspan(d * gearboxes, gearboxes);
        if (std::ranges::any_of(of_set,
                                [](const RecordValues& gearbox) { return gearbox.empty(); })) {
            continue;
        }
        for (std::size_t k = 0; k < plan.backgrounds; ++k) {
            std::vector<double>& values = sets[d * plan.backgrounds + k].values;
            for (const RecordValues& gearbox : of_set) {
                for (const std::vector<double>& record : gearbox[k]) {
                    values.insert(values.end(), record.begin(), record.end());
                }
            }
        }
    }
    return sets;
}

}  // namespace gearpod::mc
