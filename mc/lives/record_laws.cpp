#include "mc/lives/record_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

double nominal_of(const Study& study, const RandomInput& input) {
    const std::size_t dot = input.key.find('.');
    const Key& key = *find_key(input.key.substr(0, dot), input.key.substr(dot + 1));
    return std::get<NumberAccess>(key.access).get(study).value() / input.to_si;
}

}  // namespace

RecordLaw::RecordLaw(const Study& study, RecordQuantity quantity, double scatter)
    : scatter_(scatter) {
    for (const RandomInput& input : study.random) {
        if (input.distribution.per_record() && record_quantity(input.key) == quantity) {
            input_ = input;
            nominal_ = nominal_of(study, input);
        }
    }
}

double RecordLaw::factor(double unit) const {
    if (!input_) {
        return std::exp(scatter_ * unit);
    }
    const double share = boost::math::cdf(boost::math::normal_distribution<double>(), unit);
    return input_->distribution.quantile(share) / nominal_;
}

double RecordLaw::rms() const {
    if (!input_) {
        return std::exp(scatter_ * scatter_);
    }
    constexpr int kShares = 999;
    double sum = 0.0;
    for (int i = 0; i < kShares; ++i) {
        const double value = input_->distribution.quantile((i + 0.5) / kShares) / nominal_;
        sum += value * value / kShares;
    }
    return std::sqrt(sum);
}

std::vector<double> RecordLaw::marched() const {
    if (!varies()) {
        return {1.0};
    }
    constexpr double kReach = 1.5;
    const double low = factor(-kReach), high = factor(kReach);
    if (low < high) {
        return {low, high};
    }
    // A law of few values that are seldom others.
    const Support support = input_ ? input_->distribution.support() : Support{1.0, 1.0};
    return support.low < support.high
               ? std::vector<double>{support.low / nominal_, support.high / nominal_}
               : std::vector<double>{low};
}

std::string RecordLaw::text() const {
    if (input_) {
        return fmt::format("{} = {}", input_->key, input_->distribution.toml());
    }
    return scatter_ > 0.0
               ? fmt::format("scatters by {:g} % (rms) about the gearbox's", 100.0 * scatter_)
               : "the gearbox's";
}

RecordLaws::RecordLaws(const Study& study)
    : torque(study, RecordQuantity::torque, study.life.torque_scatter),
      speed(study, RecordQuantity::speed, study.life.speed_scatter),
      gain(study, RecordQuantity::gain, study.life.gain_scatter),
      noise(study, RecordQuantity::noise, study.life.noise_scatter),
      noise_of_sensor_alone(std::ranges::any_of(study.random, [](const RandomInput& input) {
          return input.distribution.per_record() &&
                 record_quantity(input.key) == RecordQuantity::noise;
      })) {}

std::vector<double> shares_of(const std::vector<double>& marched, double factor) {
    if (marched.size() == 1) {
        return {1.0};
    }
    const double high = (factor - marched[0]) / (marched[1] - marched[0]);
    return {1.0 - high, high};
}

Study study_of_gearboxes(const Study& study) {
    Study all = study;
    std::erase_if(all.random,
                  [](const RandomInput& input) { return input.distribution.per_record(); });
    return all;
}

}  // namespace gearpod::mc
