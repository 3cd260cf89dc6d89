#include "mc/plan/gearbox_streams.hpp"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <string>

#include "signals/noise/normals.hpp"

namespace gearpod::mc {
namespace {

Philox plain_stream(const Study& study, Group group, std::uint64_t index, StreamPurpose purpose) {
    return {static_cast<std::uint64_t>(study.ensemble.seed), group, index, purpose};
}

std::span<const analysis::InputExchange> exchanges_of(const GearboxId& id) {
    return id.exchanged.value_or(std::span<const analysis::InputExchange>{});
}

// True if the exchange replaces all random numbers of this purpose by those of the other gearbox.
bool is_replaced(const Study& study, Group group, const analysis::InputExchange& exchange,
                 StreamPurpose purpose) {
    Philox engine = plain_stream(study, group, exchange.index, with_suffix(purpose, ".exchange"));
    return boost::random::uniform_01<double>()(engine) < exchange.share;
}

StreamPurpose record_purpose(const GearboxId& id, StreamPurpose purpose) {
    return id.record == Record::test ? purpose
           : id.baseline == 0        ? with_suffix(purpose, ".baseline")
                              : with_suffix(purpose, ".baseline." + std::to_string(id.baseline));
}

StreamPurpose noise_purpose(const GearboxId& id, StreamPurpose purpose) {
    const bool own = id.sensor > 0 && (purpose == StreamPurpose::sensor_noise ||
                                       purpose == StreamPurpose::sensor_noise_direction ||
                                       purpose == StreamPurpose::background_noise);
    if (own) {
        purpose = with_suffix(purpose, ".sensor." + std::to_string(id.sensor));
    }
    return record_purpose(id, id.repeat == 0
                                  ? purpose
                                  : with_suffix(purpose, ".repeat." + std::to_string(id.repeat)));
}

}  // namespace

long row_of_id(const Study& study, const GearboxId& id) {
    const long records = study.ensemble.threshold_records;
    return id.group == Group::threshold
               ? static_cast<long>(id.index) * records + static_cast<long>(id.repeat)
               : static_cast<long>(id.index) + study.ensemble.threshold_instances * records;
}

std::uint64_t source_index(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    // The last exchange that replaces them determines the gearbox.
    const std::span<const analysis::InputExchange> exchanges = exchanges_of(id);
    const auto last = std::find_if(exchanges.rbegin(), exchanges.rend(), [&](const auto& one) {
        return is_replaced(study, id.group, one, purpose);
    });
    return last == exchanges.rend() ? id.index : last->index;
}

Philox gearbox_stream(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    return plain_stream(study, id.group, source_index(study, id, purpose), purpose);
}

Philox record_stream(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    return gearbox_stream(study, id, record_purpose(id, purpose));
}

Philox noise_stream(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    return gearbox_stream(study, id, noise_purpose(id, purpose));
}

Normals::Normals(const Study& study, const GearboxId& id, StreamPurpose purpose)
    : engine_(plain_stream(study, id.group, id.index, purpose)) {
    for (const analysis::InputExchange& exchange : exchanges_of(id)) {
        const double own = 1.0 - exchange.share;
        exchanges_.push_back({own, std::sqrt(1.0 - own * own),
                              plain_stream(study, id.group, exchange.index, purpose)});
    }
}

Normals Normals::of_record(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    return {study, id, record_purpose(id, purpose)};
}

Normals Normals::of_noise(const Study& study, const GearboxId& id, StreamPurpose purpose) {
    return {study, id, noise_purpose(id, purpose)};
}

// Mixes variates so that the sum stays standard normal: own^2 + other^2 = 1.
double Normals::operator()() {
    double number = unit_(engine_);
    for (Exchange& exchange : exchanges_) {
        number = exchange.own * number + exchange.other * unit_(exchange.engine);
    }
    return number;
}

void Normals::normals(std::span<double> values) {
    signals::draw_normals(engine_, values);
    others_.resize(exchanges_.empty() ? 0 : values.size());
    for (Exchange& exchange : exchanges_) {
        signals::draw_normals(exchange.engine, others_);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = exchange.own * values[i] + exchange.other * others_[i];
        }
    }
}

}  // namespace gearpod::mc
