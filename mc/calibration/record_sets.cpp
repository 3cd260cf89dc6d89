#include "mc/calibration/record_sets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearpod::mc {
namespace {

constexpr std::size_t kFewest = 3;

// Logarithm of the standard deviation, so that its order of magnitude does not depend on the unit.
// The small constant avoids the logarithm of zero.
double spread(double squares, double count) {
    constexpr double kLeast = 1e-30;
    return 0.5 * std::log(squares / count + kLeast);
}

}  // namespace

SetSummary::SetSummary(std::vector<const features::Feature*> features, const RecordValues& measured)
    : features_(std::move(features)),
      logarithmic_(features_.size(), 1),
      between_gearboxes_(measured.size() >= kFewest),
      between_records_(std::ranges::any_of(
          measured, [](const auto& gearbox) { return gearbox.size() >= kFewest; })) {
    for (const auto& gearbox : measured) {
        for (const auto& record : gearbox) {
            for (std::size_t f = 0; f < features_.size(); ++f) {
                logarithmic_[f] = logarithmic_[f] != 0 && record[f] > 0.0 ? 1 : 0;
            }
        }
    }
    const auto add = [&](const std::string& what) {
        for (const features::Feature* feature : features_) {
            names_.push_back(std::string(feature->name) + what);
        }
    };
    add("");
    if (between_gearboxes_) {
        add(" between gearboxes");
    }
    if (between_records_) {
        add(" between records");
    }
}

std::vector<double> SetSummary::of(const RecordValues& values) const {
    const auto gearboxes = static_cast<double>(values.size());
    std::vector<double> means, between, within;
    for (std::size_t f = 0; f < features_.size(); ++f) {
        double sum = 0.0, squares = 0.0, inside = 0.0, freedom = 0.0;
        for (const auto& gearbox : values) {
            double own = 0.0, own_squares = 0.0;
            for (const auto& record : gearbox) {
                const double value = logarithmic_[f] != 0 ? std::log(record[f]) : record[f];
                if (!std::isfinite(value)) {
                    return {};
                }
                own += value;
                own_squares += value * value;
            }
            const auto count = static_cast<double>(gearbox.size());
            inside += std::max(0.0, own_squares - own * own / count);
            freedom += count - 1.0;
            sum += own / count;
            squares += own / count * own / count;
        }
        means.push_back(sum / gearboxes);
        if (between_gearboxes_) {
            between.push_back(
                spread(std::max(0.0, squares - sum * sum / gearboxes), gearboxes - 1.0));
        }
        if (between_records_) {
            within.push_back(spread(inside, freedom));
        }
    }
    means.insert(means.end(), between.begin(), between.end());
    means.insert(means.end(), within.begin(), within.end());
    return means;
}

double SetSummary::in_unit(std::size_t i, double mean) const {
    return logarithmic_[i] != 0 ? std::exp(mean) : mean;
}

}  // namespace gearpod::mc
