#include "mc/ensemble/rare_event_rates.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "machine/no_value.hpp"
#include "mc/ensemble/messages.hpp"

namespace gearpod::mc {
namespace {

// MissRecords of several gearboxes, in the form that ImportanceSample takes.
struct MissRecords {
    std::vector<double> values, weights;
    std::vector<std::size_t> gearbox;
    long gearboxes = 0, failed = 0;

    void add(const BatchRows& rows, const RowShape& shape, std::size_t records) {
        for (std::size_t row = 0; row < rows.count(); ++row) {
            const double* values_of = rows.values.data() + row * shape.values();
            if (row % records == 0) {
                ++gearboxes;
                failed += rows.status[row] == static_cast<int>(Status::ok) ? 0 : 1;
            }
            values.push_back(values_of[shape.value_of(0, 0)]);
            weights.push_back(values_of[shape.noise_weight()]);
            gearbox.push_back(static_cast<std::size_t>(gearboxes));
        }
    }
};

// Reason why a run of batches has no result, or "".
std::string failure_reason(const EnsembleOutcome& outcome) {
    return outcome.failure.empty() && !outcome.interruption.empty()
               ? "stopped by " + outcome.interruption
               : outcome.failure;
}

// Sample size of plain counting that gives this relative variance of a rate; NaN for a rate of 1.
double equivalent_sample_size(double rate, double variance) {
    return rate < 1.0 ? (1.0 - rate) / (rate * variance) : kNan;
}

Group group_of(const RareRateRequest& request) {
    return request.rate ? Group::threshold : Group::test;
}

GearboxId id_of(const RareRateRequest& request, const analysis::SplitMember& member) {
    GearboxId id{group_of(request), member.index};
    id.exchanged = member.exchanged;
    return id;
}

// Computes the feature values of members on all ranks and returns them in every rank.
class SplitRun {
  public:
    SplitRun(const TilePlan& tile, const EnsemblePlan& ensemble, const RareRateRequest& request,
             const Ranks& ranks, Progress& progress, const Interruption* interruption)
        : tile_(tile),
          ensemble_(ensemble),
          request_(request),
          ranks_(ranks),
          progress_(progress),
          interruption_(interruption),
          shape_(ensemble.shape) {}

    std::vector<double> values(std::span<const analysis::SplitMember> members) {
        const BatchPlan plan(0, static_cast<std::int64_t>(members.size()));
        MemoryRows store(ranks_.leads() ? plan.batches() : 0);
        const EnsembleOutcome outcome = run_batches(
            ensemble_, plan,
            {.ranks = ranks_, .store = store, .progress = progress_, .interruption = interruption_},
            [&] { return computers(members); });
        std::vector<double> values(members.size());
        if (const std::string why = ranks_.from_leader(failure_reason(outcome)); !why.empty()) {
            throw std::runtime_error(why);
        }
        if (ranks_.leads()) {
            read(store, plan, values);
        }
        return value_of<std::vector<double>>(ranks_.from_leader(bytes_of(values)));
    }
    long failed() const { return failed_; }

  private:
    BatchComputers computers(std::span<const analysis::SplitMember> members) {
        if (!task_) {
            task_ = std::make_shared<const BatchTask>(tile_, ensemble_);
        }
        return [this, members]() -> BatchComputer {
            const auto worker = std::make_shared<BatchWorker>(*task_);
            return [this, members, worker](const Batch& batch, Seconds& seconds) {
                std::vector<GearboxId> ids;
                for (std::size_t i = 0; i < batch.gearboxes; ++i) {
                    ids.push_back(id_of(request_, members[batch.first_index + i]));
                }
                return worker->compute(ids, 1, seconds);
            };
        };
    }
    void read(const RowStore& store, const BatchPlan& plan, std::vector<double>& values) {
        std::size_t member = 0;
        for (std::size_t batch = 0; batch < plan.batches(); ++batch) {
            const BatchRows rows = store.read(batch);
            for (std::size_t row = 0; row < rows.count(); ++row) {
                values[member++] = rows.values[row * shape_.values() + shape_.value_of(0, 0)];
                failed_ += rows.status[row] == static_cast<int>(Status::ok) ? 0 : 1;
            }
        }
    }

    const TilePlan& tile_;
    const EnsemblePlan& ensemble_;
    const RareRateRequest& request_;
    const Ranks& ranks_;
    Progress& progress_;
    const Interruption* interruption_;
    const RowShape shape_;
    std::shared_ptr<const BatchTask> task_;  // created for the first batch
    long failed_ = 0;
};

// Sums and sums of squares of the random inputs of a set of gearboxes.
struct InputSums {
    std::vector<double> sum, squares;
    double count = 0.0;

    void add(const std::vector<double>& values) {
        sum.resize(values.size());
        squares.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum[i] += values[i];
            squares[i] += values[i] * values[i];
        }
        count += 1.0;
    }
    double mean(std::size_t input) const { return sum[input] / count; }
    double deviation(std::size_t input) const {
        return std::sqrt(std::max(0.0, squares[input] / count - mean(input) * mean(input)));
    }
};

// Random inputs whose mean in the last level differs from the mean of all gearboxes by more than
// chance. The chance deviation is that of as many independent gearboxes as there are families.
std::vector<ShiftedInput> shifted_inputs(const Sampler& sampler,
                                         std::span<const ParameterColumn> columns,
                                         const RareRateRequest& request,
                                         const analysis::SplitTail& tail) {
    constexpr double kBeyondChance = 3.0;
    const auto values_of = [&](const analysis::SplitMember& member) {
        return sampler.draw(id_of(request, member)).random_values;
    };
    InputSums all, last;
    for (long i = 0; i < request.gearboxes; ++i) {
        all.add(values_of({static_cast<std::uint64_t>(i), {}}));
    }
    for (const analysis::SplitMember& member : tail.last()) {
        last.add(values_of(member));
    }
    const double chance = kBeyondChance / std::sqrt(tail.last_families());
    std::vector<ShiftedInput> shifted;
    for (std::size_t i = 0; i < all.sum.size(); ++i) {
        if (std::abs(last.mean(i) - all.mean(i)) > chance * all.deviation(i)) {
            shifted.push_back({columns[i].name, columns[i].unit, all.mean(i), last.mean(i)});
        }
    }
    return shifted;
}

analysis::SplitTail::Settings settings_of(const RareRateRequest& request) {
    return {request.gearboxes, request.towards()};
}

}  // namespace

MissRateResult estimate_miss_rate(const TilePlan& tile, const EnsemblePlan& ensemble,
                                  const MissRateRequest& request, const Ranks& ranks,
                                  Progress& progress, const Interruption* interruption) {
    const auto records = static_cast<std::size_t>(request.records);
    const BatchPlan plan(0, request.gearboxes);
    MemoryRows store(ranks.leads() ? plan.batches() : 0);
    const EnsembleOutcome outcome = run_batches(
        ensemble, plan,
        {.ranks = ranks, .store = store, .progress = progress, .interruption = interruption},
        [&]() -> BatchComputers {
            const auto task = std::make_shared<BatchTask>(tile, ensemble);
            task->test_noise = NoiseSampling::towards_misses;
            return [task, records]() -> BatchComputer {
                const auto worker = std::make_shared<BatchWorker>(*task);
                return [task, worker, records](Batch batch, Seconds& seconds) {
                    batch.records = records;
                    return worker->compute(batch, seconds);
                };
            };
        });
    MissRateResult result;
    if (!ranks.leads()) {
        return result;
    }
    if (const std::string why = failure_reason(outcome); !why.empty()) {
        throw std::runtime_error(why);
    }
    const RowShape& shape = ensemble.shape;
    MissRecords all;
    for (std::size_t batch = 0; batch < plan.batches(); ++batch) {
        all.add(store.read(batch), shape, records);
    }
    const analysis::ImportanceSample sample(
        all.values, all.weights, all.gearbox,
        analysis::opposite(features::find_feature(request.feature)->alarm));
    result.misses = sample.at(request.threshold, ensemble.request.confidence);
    result.gearboxes = all.gearboxes;
    result.failed = all.failed;
    result.records = static_cast<long>(all.values.size());
    result.counted = result.misses
                         ? equivalent_sample_size(result.misses->expected, result.misses->variance)
                         : kNan;
    return result;
}

long largest_gearbox_count(const RareRateRequest& request) {
    return analysis::SplitTail::values_for(settings_of(request),
                                           request.rate.value_or(kSmallestMissRate));
}

RareRateResult estimate_rare_rate(const TilePlan& tile, const EnsemblePlan& ensemble,
                                  const RareRateRequest& request, const Ranks& ranks,
                                  Progress& progress, const Interruption* interruption) {
    SplitRun run(tile, ensemble, request, ranks, progress, interruption);
    const auto values = [&](std::span<const analysis::SplitMember> members) {
        return run.values(members);
    };
    const analysis::SplitTail tail =
        request.rate ? analysis::SplitTail::to_rate(settings_of(request), *request.rate, values)
                     : analysis::SplitTail::to_value(settings_of(request), request.threshold,
                                                     kSmallestMissRate, values);
    const double confidence = ensemble.request.confidence;
    RareRateResult result;
    result.estimate = request.rate ? tail.threshold(*request.rate, confidence)
                                   : tail.at(request.threshold, confidence);
    result.threshold = result.estimate && request.rate
                           ? tail.threshold_interval(*request.rate, *result.estimate)
                           : analysis::Interval{kNan, kNan};
    result.computed = tail.computed();
    result.failed = run.failed();
    result.levels = tail.levels();
    result.last_rate = tail.last_rate();
    result.least_kept = tail.least_kept();
    result.counted = result.estimate ? equivalent_sample_size(result.estimate->expected,
                                                              result.estimate->variance)
                                     : kNan;
    if (ranks.leads() && tail.levels() > 1) {
        result.shifted = shifted_inputs(*tile.sampler, ensemble.inputs, request, tail);
    }
    return result;
}

}  // namespace gearpod::mc
