#include "mc/library/run/reliability_on_machines.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>

#include "machine/team.hpp"
#include "mc/ensemble/ensemble.hpp"

namespace gearpod::mc {
namespace {

using Levels = std::vector<analysis::LevelReliability>;

const std::string kAssess = "assess";

// Share that the first rank of a machine sends to rank 0.
struct Evaluated {
    std::size_t machine = 0;
    Levels levels;
    bool failed = false;
};
using gearpod::serialize;
GEARPOD_FIELDS(Evaluated, machine, levels, failed)

// Evaluates the pairs of rank 0, and receives those of the other machines.
class AllMachines {
  public:
    AllMachines(const Results& frame, const analysis::ReliabilityData& data, const Ranks& ranks,
                int threads)
        : frame_(frame),
          data_(data),
          ranks_(ranks),
          machines_(static_cast<std::size_t>(ranks.machines())),
          threads_(threads),
          pairs_(frame.features.size() * frame.request.noise_levels.size()) {}

    Levels run() {
        std::exception_ptr failure;
        try {
            put(0, evaluate(0));
        } catch (...) {
            failure = std::current_exception();
        }
        // Also after a failure, because the other ranks wait until their messages are received.
        std::vector<std::size_t> missing;
        for (std::size_t others = 1; others < machines_; ++others) {
            Evaluated from = receive();
            if (from.failed) {
                missing.push_back(from.machine);
            } else {
                put(from.machine, std::move(from.levels));
            }
        }
        if (failure) {
            std::rethrow_exception(failure);
        }
        for (const std::size_t machine : missing) {
            put(machine, evaluate(machine));
        }
        return std::move(pairs_);
    }

  private:
    Levels evaluate(std::size_t machine) const {
        return analysis::assess_pairs(data_, frame_.detection, frame_.request, {machine, machines_},
                                      threads_);
    }
    void put(std::size_t machine, Levels levels) {
        for (std::size_t i = 0; i < levels.size(); ++i) {
            pairs_[machine + i * machines_] = std::move(levels[i]);
        }
    }
    Evaluated receive() const {
        for (;;) {
            if (auto message = ranks_.receive();
                message && message->kind == static_cast<int>(MessageKind::assessed)) {
                return value_of<Evaluated>(std::move(message->bytes));
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    const Results& frame_;
    const analysis::ReliabilityData& data_;
    const Ranks& ranks_;
    const std::size_t machines_;
    const int threads_;
    Levels pairs_;
};

void evaluate_share(const EnsemblePlan& plan, const Ranks& ranks) {
    Results frame = results_frame(plan);
    Evaluated evaluated{static_cast<std::size_t>(ranks.machine()), {}, false};
    std::string bytes = ranks.from_leader_to_machines({});
    try {
        AssessedColumns columns;
        read_bytes(std::move(bytes), columns, frame.detection);
        const AssessedData data(frame, columns, "");
        evaluated.levels =
            analysis::assess_pairs(*data, frame.detection, frame.request,
                                   {evaluated.machine, static_cast<std::size_t>(ranks.machines())},
                                   threads_of_machine(plan, ranks));
    } catch (...) {  // rank 0 reports the problem when it meets it, or is cancelled too
        evaluated = {evaluated.machine, {}, true};
    }
    send(ranks, 0, MessageKind::assessed, bytes_of(evaluated));
}

}  // namespace

std::optional<analysis::Reliability> reliability_on_machines(const Results& frame,
                                                             const RowSource& rows,
                                                             const Ranks& ranks, int threads) {
    if (ranks.machines() == 1) {
        return reliability_of(frame, rows, "", threads);
    }
    const auto columns = assessed_columns(frame, rows);
    if (!columns) {
        return std::nullopt;
    }
    const AssessedData data(frame, *columns, "");
    std::string bytes = bytes_of(*columns, frame.detection);
    ranks.from_leader(kAssess);
    ranks.from_leader_to_machines(std::move(bytes));
    Levels pairs = AllMachines(frame, *data, ranks, threads).run();
    return analysis::assess_reliability(*data, frame.request, std::move(pairs));
}

std::string assess_for_leader(const EnsemblePlan& plan, const Ranks& ranks) {
    for (;;) {
        std::string order = ranks.from_leader("");
        if (order != kAssess) {
            return order;
        }
        if (ranks.first_on_machine()) {
            evaluate_share(plan, ranks);
        }
    }
}

int threads_of_machine(const EnsemblePlan& plan, const Ranks& ranks) {
    const int count = ranks.on_this_machine();
    return std::min(machine::processors(), count * thread_count(plan, count));
}

}  // namespace gearpod::mc
