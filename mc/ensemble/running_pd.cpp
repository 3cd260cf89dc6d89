#include "mc/ensemble/running_pd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/detection/detection.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::mc {
namespace {

std::size_t level_next_to(const std::vector<double>& levels, double requested) {
    const auto nearer = [&](double a, double b) {
        return std::abs(a - requested) < std::abs(b - requested);
    };
    return static_cast<std::size_t>(std::min_element(levels.begin(), levels.end(), nearer) -
                                    levels.begin());
}

}  // namespace

RunningPd::RunningPd(const EnsemblePlan& plan, const BatchPlan& batches, const std::string& feature)
    : request_(plan.request), batches_(batches), shape_(plan.shape) {
    std::size_t index = 0;
    while (!feature.empty() && plan.features.at(index)->name != feature) {
        ++index;
    }
    group_ = request_.groups.size() - 1;
    level_ = level_next_to(request_.noise_levels, 1.0);
    feature_name_ = plan.features.at(index)->name;
    alarm_ = plan.features[index]->alarm;
    size_name_ = plan.group_names[group_];
    column_ = shape_.value_of(index, level_);
}

void RunningPd::advance(const RowStore& store) {
    while (next_ < batches_.batches() && store.has(next_)) {
        if (next_ == batches_.threshold_batches()) {
            set_threshold(store);
        }
        if (next_ >= batches_.threshold_batches()) {
            count(store.read(next_));
        }
        ++next_;
    }
}

void RunningPd::set_threshold(const RowStore& store) {
    std::vector<double> healthy;
    for (std::size_t batch = 0; batch < batches_.threshold_batches(); ++batch) {
        const BatchRows rows = store.read(batch);
        for (std::size_t row = 0; row < rows.count(); ++row) {
            healthy.push_back(rows.values[row * shape_.values() + column_]);
        }
    }
    threshold_ =
        analysis::alarm_threshold(std::move(healthy), alarm_, request_.false_alarm_rate).value;
}

void RunningPd::count(const BatchRows& rows) {
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const double* values = rows.values.data() + row * shape_.values();
        const double value = values[column_];
        if (std::isfinite(value) && !std::isnan(threshold_) &&
            analysis::group_of(values[shape_.fault_size()], request_.groups) == group_) {
            ++tested_;
            detected_ += analysis::is_alarm(value, threshold_, alarm_) ? 1 : 0;
        }
    }
}

std::string RunningPd::text() const {
    if (tested_ == 0) {
        return "";
    }
    const auto interval = analysis::wilson_interval(detected_, tested_, request_.confidence);
    return fmt::format("Pd({}, {}, noise x {:g}) = {:.3g} [{:.3g}, {:.3g}]", feature_name_,
                       size_name_, request_.noise_levels[level_],
                       static_cast<double>(detected_) / static_cast<double>(tested_),
                       interval.lower, interval.upper);
}

}  // namespace gearpod::mc
