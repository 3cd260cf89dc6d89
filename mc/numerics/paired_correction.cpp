#include "mc/numerics/paired_correction.hpp"

#include <algorithm>
#include <cmath>

#include "machine/no_value.hpp"
#include "machine/team.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

constexpr double kNormalQuantile = 1.959964;  // of 0.975

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

// Slope of y over x, and the residuals of y; 0 where x does not vary.
struct Regression {
    double slope = 0.0;
    std::vector<double> residuals;
};
Regression regress(const std::vector<double>& y, const std::vector<double>& x) {
    const double mean_x = mean(x), mean_y = mean(y);
    double xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    Regression found{xx > 0.0 ? xy / xx : 0.0, {}};
    for (std::size_t i = 0; i < x.size(); ++i) {
        found.residuals.push_back(y[i] - mean_y - found.slope * (x[i] - mean_x));
    }
    return found;
}

PairedCorrection no_correction() {
    return {kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan};
}

// Rows with corrected features. `deviations`: standard errors by which the part that grows with the
// fault is changed.
class CorrectedRows final : public RowSource {
  public:
    CorrectedRows(const RowSource& rows, const Results& frame, double deviations)
        : rows_(rows), frame_(frame), deviations_(deviations) {}

    std::size_t rows() const override { return rows_.rows(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override {
        const RowShape shape = row_shape(frame_);
        const std::vector<PairedCorrection>& all = frame_.numerical->corrections;
        rows_.visit([&](const RowBlock& block) {
            RowBlock corrected = block;
            for (std::size_t row = 0; row < block.count(); ++row) {
                double* const values = corrected.values.data() + row * shape.values();
                const bool test = block.group[row] == static_cast<int>(Group::test);
                const double size = test ? values[shape.fault_size()] : 0.0;
                for (std::size_t at = 0; at < all.size(); ++at) {
                    if (!std::isfinite(all[at].by_size)) {
                        continue;  // too few pairs
                    }
                    double& value = values[shape.parameters + at];
                    value += all[at].offset + all[at].by_value * value +
                             (all[at].by_size + deviations_ * all[at].by_size_error) * size;
                }
            }
            use(corrected);
        });
    }

  private:
    const RowSource& rows_;
    const Results& frame_;
    const double deviations_;
};

struct CorrectedResults {
    std::vector<analysis::FeatureDetection> rates;
    std::optional<analysis::Reliability> reliability;

    double a90(std::size_t feature, std::size_t level) const {
        using Where = analysis::SizeEstimate::Where;
        if (!reliability) {
            return kNan;
        }
        const analysis::HitMissPod& pod = reliability->features[feature].levels[level].hit_miss;
        return pod.refusal.empty() && pod.a90.estimate.where == Where::reached
                   ? pod.a90.estimate.size
                   : kNan;
    }
};

CorrectedResults results_with(const Results& frame, const RowSource& rows, double deviations) {
    const CorrectedRows corrected(rows, frame, deviations);
    Results own = frame;
    own.detection = detect_all(own, corrected);
    return {own.detection, reliability_of(own, corrected, "", machine::processors())};
}

}  // namespace

double standard_deviation(const std::vector<double>& values) {
    const double middle = mean(values);
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - middle) * (value - middle);
    }
    return values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : kNan;
}

PairedCorrection fit_correction(const PairedValues& pairs) {
    std::vector<double> own, size, difference, healthy_own, healthy_fine, healthy, test;
    for (std::size_t i = 0; i < pairs.own.size(); ++i) {
        const double change = pairs.fine[i] - pairs.own[i];
        if (!std::isfinite(change)) {
            continue;
        }
        own.push_back(pairs.own[i]);
        size.push_back(pairs.size[i]);
        difference.push_back(change);
        (pairs.size[i] > 0.0 ? test : healthy).push_back(-change);
        if (!(pairs.size[i] > 0.0)) {
            healthy_own.push_back(pairs.own[i]);
            healthy_fine.push_back(pairs.fine[i]);
        }
    }
    constexpr std::size_t kFewest = kFewestPairs;
    if (healthy.size() < kFewest || test.size() < kFewest) {
        return no_correction();
    }
    // The part that grows with the size, apart from what grows with the value.
    const std::vector<double> net_size = regress(size, own).residuals;
    const Regression by_size = regress(regress(difference, own).residuals, net_size);
    double squares = 0.0, weighted = 0.0;
    for (std::size_t i = 0; i < net_size.size(); ++i) {
        squares += net_size[i] * net_size[i];
        weighted += std::pow(net_size[i] * by_size.residuals[i], 2);
    }
    const double count = static_cast<double>(own.size());
    std::vector<double> rest = difference;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        rest[i] -= by_size.slope * size[i];
    }
    const double by_value = regress(rest, own).slope;
    const auto standard_error = [](const std::vector<double>& values) {
        return standard_deviation(values) / std::sqrt(static_cast<double>(values.size()));
    };
    return {mean(rest) - by_value * mean(own),
            by_value,
            by_size.slope,
            squares > 0.0 ? std::sqrt(weighted * count / (count - 3.0)) / squares : 0.0,
            mean(healthy),
            standard_error(healthy),
            mean(test),
            standard_error(test),
            standard_deviation(healthy_own) / standard_deviation(healthy_fine)};
}

std::vector<CorrectedDetection> corrected_detection(const Results& frame, const RowSource& rows) {
    if (!frame.numerical || frame.numerical->corrections.empty()) {
        return {};
    }
    const CorrectedResults middle = results_with(frame, rows, 0.0),
                           low = results_with(frame, rows, -kNormalQuantile),
                           high = results_with(frame, rows, kNormalQuantile);
    std::vector<CorrectedDetection> all;
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        for (std::size_t level = 0; level < frame.noise_levels.size(); ++level) {
            const auto& own = frame.detection[f].levels[level].cells;
            const auto& corrected = middle.rates[f].levels[level].cells;
            const std::size_t at = f * frame.noise_levels.size() + level;
            if (!std::isfinite(frame.numerical->corrections[at].by_size)) {
                all.push_back({kNan, kNan, kNan, kNan});
                continue;
            }
            CorrectedDetection one;
            one.pd_change = std::isfinite(frame.detection[f].levels[level].threshold) ? 0.0 : kNan;
            for (std::size_t c = 0; c < own.size(); ++c) {
                one.pd_change = std::max(one.pd_change, std::abs(corrected[c].pd - own[c].pd));
            }
            one.a90 = middle.a90(f, level);
            const double ends[] = {one.a90, low.a90(f, level), high.a90(f, level)};
            const bool reached =
                std::ranges::all_of(ends, [](double a) { return std::isfinite(a); });
            one.a90_lower = reached ? *std::ranges::min_element(ends) : kNan;
            one.a90_upper = reached ? *std::ranges::max_element(ends) : kNan;
            all.push_back(one);
        }
    }
    return all;
}

}  // namespace gearpod::mc
