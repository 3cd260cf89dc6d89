#include "mc/analysis_trial.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <chrono>
#include <cmath>
#include <numeric>

#include "mc/ensemble.hpp"
#include "mc/reliability_of_results.hpp"
#include "mc/simulation.hpp"

namespace gearpod::mc {
namespace {

// Bytes that the assessment has of every value (gearbox, feature and noise level) at a time:
// columns, their parts by size, ranks. From the peaks of `report` on results of 48,000, 126,000 and
// 420,000 values.
constexpr double kBytesOfValue = 60.0;

// The computed gearboxes of one group, by fault size.
class Pool {
  public:
    Pool(const RunCalibration& calibration, const RowShape& shape, Group group)
        : rows_(calibration.rows), shape_(shape) {
        for (std::size_t row = 0; row < calibration.gearboxes.size(); ++row) {
            if (calibration.gearboxes[row].group == group) {
                order_.push_back(row);
            }
        }
        std::sort(order_.begin(), order_.end(),
                  [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
    }

    bool empty() const { return order_.empty(); }

    // A gearbox of that size or, with no such, one of the next to it.
    std::size_t draw(double wanted, Philox& engine) const {
        constexpr std::ptrdiff_t kNeighbours = 2;
        auto [low, high] =
            std::pair(std::partition_point(order_.begin(), order_.end(),
                                           [&](std::size_t row) { return size(row) < wanted; }),
                      std::partition_point(order_.begin(), order_.end(),
                                           [&](std::size_t row) { return size(row) <= wanted; }));
        if (low == high) {
            low -= std::min(kNeighbours, low - order_.begin());
            high += std::min(kNeighbours, order_.end() - high);
        }
        return *(low + boost::random::uniform_int_distribution<std::ptrdiff_t>(
                           0, high - low - 1)(engine));
    }

    double value(std::size_t row, std::size_t feature, std::size_t level) const {
        return rows_.values[row * shape_.values() + shape_.value_of(feature, level)];
    }

    // The smoothing's standard deviation: of the values, over the fifth root of their number.
    double smoothing(std::size_t feature, std::size_t level) const {
        double sum = 0.0, squares = 0.0, n = 0.0;
        for (const std::size_t row : order_) {
            if (const double one = value(row, feature, level); std::isfinite(one)) {
                sum += one;
                squares += one * one;
                n += 1.0;
            }
        }
        const double variance = n > 1.0 ? (squares - sum * sum / n) / (n - 1.0) : 0.0;
        return std::sqrt(std::max(0.0, variance)) * std::pow(std::max(1.0, n), -0.2);
    }

  private:
    // The last parameter.
    double size(std::size_t row) const {
        return rows_.values[row * shape_.values() + shape_.parameters - 1];
    }

    const TileRows& rows_;
    const RowShape shape_;
    std::vector<std::size_t> order_;
};

// Noise levels from the middle on.
std::vector<std::size_t> level_order(std::size_t levels) {
    std::vector<std::size_t> order(levels);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto middle = static_cast<double>(levels / 2);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(static_cast<double>(a) - middle) <
               std::abs(static_cast<double>(b) - middle);
    });
    return order;
}

double seconds_of_analysis(Results results, int threads, bool assessed) {
    const auto start = std::chrono::steady_clock::now();
    results.detection = detect_all(results);
    if (assessed) {
        reliability_of(results, ColumnRows(results), "", threads);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Results made_up_results(const Study& study, const RunCalibration& calibration, const TilePlan& plan,
                        std::size_t rows, const std::vector<std::size_t>& levels) {
    const Sampler sampler(study);
    const RowShape shape = row_shape(sampler, study);
    Results results = results_frame(study);
    results.noise_levels.clear();
    for (const std::size_t level : levels) {
        results.noise_levels.push_back(study.sensor.noise_levels[level]);
    }
    results.request.noise_levels = results.noise_levels;

    std::array<Pool, 2> pools{Pool(calibration, shape, Group::threshold),
                              Pool(calibration, shape, Group::graded)};
    // Healthy gearboxes scatter as those of the threshold sample do, or as all do if none is there.
    const Pool& scatter = pools[pools[0].empty() ? 1 : 0];
    std::vector<double> smoothing;
    for (std::size_t f = 0; f < shape.features; ++f) {
        for (const std::size_t level : levels) {
            smoothing.push_back(scatter.smoothing(f, level));
        }
    }
    for (std::size_t i = 0; i < rows; ++i) {
        const GearboxId id = id_of_row(study, static_cast<long>(i * plan.rows() / rows));
        const std::vector<double> parameters = sampler.row(id.group, id.index);
        Philox engine(static_cast<std::uint64_t>(study.ensemble.seed), id.group, id.index,
                      parameter_id("analysis.trial"));
        boost::random::normal_distribution<double> normal;
        const Pool& own = pools[static_cast<std::size_t>(id.group)];
        const Pool& pool = own.empty() ? scatter : own;
        const std::size_t like = pool.draw(parameters.back(), engine);
        results.group.push_back(static_cast<int>(id.group));
        results.status.push_back(calibration.rows.status[like]);
        for (std::size_t p = 0; p < shape.parameters; ++p) {
            results.parameters[p].values.push_back(parameters[p]);
        }
        for (std::size_t f = 0; f < shape.features; ++f) {
            for (std::size_t l = 0; l < levels.size(); ++l) {
                results.features[f].values.push_back(pool.value(like, f, levels[l]) +
                                                     smoothing[f * levels.size() + l] *
                                                         normal(engine));
            }
        }
    }
    return results;
}

AnalysisTrial try_analysis(const Study& study, const RunCalibration& calibration,
                           const TilePlan& plan, int threads, double budget_s) {
    AnalysisTrial trial;
    const std::size_t levels = study.sensor.noise_levels.size();
    const std::size_t values = plan.rows() * study.features.use.size() * levels;
    const bool assessed = values <= kMostAssessedValues;
    trial.bytes = kBytesOfValue * static_cast<double>(std::min(values, kMostAssessedValues));
    if (calibration.gearboxes.empty()) {
        return trial;
    }
    trial.rows = std::min(plan.rows(), kTrialRows);
    const std::vector<std::size_t> order = level_order(levels);
    const auto start = std::chrono::steady_clock::now();
    while (trial.levels < levels && (trial.levels == 0 || trial.trial_s < budget_s)) {
        const auto first = order.begin() + static_cast<std::ptrdiff_t>(trial.levels);
        const auto count =
            std::min(levels - trial.levels, static_cast<std::size_t>(std::max(1, threads)));
        std::vector<std::size_t> now(first, first + static_cast<std::ptrdiff_t>(count));
        std::sort(now.begin(), now.end());
        trial.total_s += seconds_of_analysis(
            made_up_results(study, calibration, plan, trial.rows, now), threads, assessed);
        trial.levels += count;
        trial.trial_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    trial.total_s *= static_cast<double>(levels) / static_cast<double>(trial.levels) *
                     static_cast<double>(plan.rows()) / static_cast<double>(trial.rows);
    return trial;
}

}  // namespace gearpod::mc
