#include "mc/plan/gearbox_streams.hpp"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <string>

#include "signals/noise/normals.hpp"

namespace gearpod::mc {
namespace {

std::span<const analysis::InputExchange> exchanges_of(const GearboxId& id) {
    return id.exchanged.value_or(std::span<const analysis::InputExchange>{});
}

// True if the exchange replaces all random numbers of this purpose by those of the other gearbox.
bool is_replaced(std::uint64_t seed, Group group, const analysis::InputExchange& exchange,
                 StreamPurpose purpose) {
    Philox engine(seed, group, exchange.index, with_suffix(purpose, ".exchange"));
    return boost::random::uniform_01<double>()(engine) < exchange.share;
}

StreamPurpose record_purpose(const GearboxId& id, StreamPurpose purpose) {
    return id.record == Record::test ? purpose
           : id.baseline == 0        ? with_suffix(purpose, ".baseline")
                              : with_suffix(purpose, ".baseline." + std::to_string(id.baseline));
}

StreamPurpose noise_purpose(const GearboxId& id, StreamPurpose purpose) {
    const bool at_additional_sensor =
        id.sensor > 0 && (purpose == StreamPurpose::sensor_noise ||
                          purpose == StreamPurpose::sensor_noise_direction ||
                          purpose == StreamPurpose::background_noise);
    if (at_additional_sensor) {
        purpose = with_suffix(purpose, ".sensor." + std::to_string(id.sensor));
    }
    return record_purpose(id, id.repeat == 0
                                  ? purpose
                                  : with_suffix(purpose, ".repeat." + std::to_string(id.repeat)));
}

}  // namespace

RowOrder::RowOrder(const Ensemble& ensemble)
    : threshold_gearboxes(static_cast<long>(ensemble.threshold_instances)),
      records(ensemble.threshold_records),
      threshold_noise(ensemble.uses_importance_sampling() ? NoiseSampling::towards_alarms
                                                          : NoiseSampling::plain) {}

long RowOrder::row_of(const GearboxId& id) const {
    return id.group == Group::threshold
               ? static_cast<long>(id.index) * records + static_cast<long>(id.repeat)
               : static_cast<long>(id.index) + threshold_gearboxes * records;
}

GearboxId RowOrder::id_of(long row) const {
    const long threshold_rows = threshold_gearboxes * records;
    return row < threshold_rows
               ? GearboxId{Group::threshold, static_cast<std::uint64_t>(row / records),
                           Record::test, static_cast<std::uint64_t>(row % records), threshold_noise}
               : GearboxId{Group::test, static_cast<std::uint64_t>(row - threshold_rows)};
}

std::uint64_t source_index(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    // The last exchange that replaces them determines the gearbox.
    const std::span<const analysis::InputExchange> exchanges = exchanges_of(id);
    const auto last = std::find_if(exchanges.rbegin(), exchanges.rend(), [&](const auto& exchange) {
        return is_replaced(seed, id.group, exchange, purpose);
    });
    return last == exchanges.rend() ? id.index : last->index;
}

Philox gearbox_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    return {seed, id.group, source_index(seed, id, purpose), purpose};
}

Philox record_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    return gearbox_stream(seed, id, record_purpose(id, purpose));
}

Philox noise_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    return gearbox_stream(seed, id, noise_purpose(id, purpose));
}

Normals::Normals(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose)
    : engine_(seed, id.group, id.index, purpose) {
    for (const analysis::InputExchange& exchange : exchanges_of(id)) {
        const double factor = 1.0 - exchange.share;
        exchanges_.push_back({factor, std::sqrt(1.0 - factor * factor),
                              Philox(seed, id.group, exchange.index, purpose)});
    }
}

Normals Normals::of_record(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    return {seed, id, record_purpose(id, purpose)};
}

Normals Normals::of_noise(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose) {
    return {seed, id, noise_purpose(id, purpose)};
}

// Mixes variates so that the sum stays standard normal: the squares of both factors add up to 1.
double Normals::operator()() {
    double number = unit_(engine_);
    for (Exchange& exchange : exchanges_) {
        number = exchange.factor * number + exchange.other_factor * unit_(exchange.engine);
    }
    return number;
}

void Normals::normals(std::span<double> values) {
    signals::draw_normals(engine_, values);
    others_.resize(exchanges_.empty() ? 0 : values.size());
    for (Exchange& exchange : exchanges_) {
        signals::draw_normals(exchange.engine, others_);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = exchange.factor * values[i] + exchange.other_factor * others_[i];
        }
    }
}

}  // namespace gearpod::mc
