// Measures how many ranks rank 0 can serve: batches whose realizations take no time, or a given
// time, on all ranks, through the code of `run` into a checkpoint on the disk.
// Usage: mpirun --oversubscribe -n 8 bench_ranks STUDY.toml OUT.h5 MILLISECONDS [SECTION.KEY=VALUE
// ...] OUT.h5.part is created and removed. The cost of rank 0 is the processor time of the thread
// that communicates and writes, which other programs on the machine do not increase. Batches per
// second are by wall time.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/results/checkpoint.hpp"

using namespace gearpod::mc;

namespace {

double own_processor_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Rows of the right shape; all their numbers differ.
BatchComputers rows_at_once(const RowShape& shape, std::chrono::microseconds each) {
    return [=]() -> BatchComputer {
        return [=](const Batch& batch, Seconds&) {
            if (each.count() > 0) {
                std::this_thread::sleep_for(each);
            }
            BatchRows rows;
            rows.status.assign(batch.rows(), 0);
            for (std::size_t i = 0; i < batch.rows() * shape.values(); ++i) {
                rows.values.push_back(static_cast<double>(batch.first_index + i));
            }
            return rows;
        };
    };
}

}  // namespace

int main(int count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.size() < 3) {
        fmt::print(stderr, "bench_ranks STUDY.toml OUT.h5 MILLISECONDS [SECTION.KEY=VALUE ...]\n");
        return 2;
    }
    const Ranks ranks;
    const StudyReading reading = read_study(words[0], {words.begin() + 3, words.end()});
    if (!reading.study) {
        fmt::print(stderr, "{}\n", format(reading.problems));
        ranks.abort(2);
    }
    const EnsemblePlan ensemble(*reading.study);
    const BatchPlan plan = ensemble.batches();
    const RowShape& shape = ensemble.shape;
    std::unique_ptr<Checkpoint> checkpoint;
    MemoryRows none(0);
    if (ranks.leads()) {
        checkpoint =
            open_checkpoint(ensemble, shape, plan, words[1], {.force = true, .quiet = true});
    }
    RowStore& store = checkpoint ? static_cast<RowStore&>(*checkpoint) : none;
    Progress progress(static_cast<long>(plan.rows()), true);
    const double before_s = own_processor_s();
    const std::chrono::microseconds each(std::lround(1e3 * std::atof(words[2].c_str())));
    const EnsembleOutcome outcome = run_batches(ensemble, plan,
                                                {.ranks = ranks,
                                                 .store = store,
                                                 .progress = progress,
                                                 .checkpoint_s = ensemble.checkpoint_s},
                                                [&] { return rows_at_once(shape, each); });
    if (!ranks.leads()) {
        return 0;
    }
    const double talked_s = own_processor_s() - before_s;
    const auto batches = static_cast<double>(plan.batches());
    const double bytes = 8.0 * (3.0 + kBatchRows * (1.0 + static_cast<double>(shape.values())));
    fmt::print(
        "{} ranks, {} threads: {} batches of {:.0f} bytes in {:.2f} s: {:.0f} a second, {:.1f} "
        "MB/s; "
        "rank 0 talks and writes {:.1f} us a batch, of which {:.1f} us by the wall clock for "
        "writing: {:.0f} batches and {:.0f} MB a second at most\n",
        ranks.size(), outcome.threads(), plan.batches(), bytes, outcome.wall_s,
        batches / outcome.wall_s, 1e-6 * bytes * batches / outcome.wall_s, 1e6 * talked_s / batches,
        1e6 * outcome.output_s / batches, batches / talked_s, 1e-6 * bytes * batches / talked_s);
    if (!outcome.failure.empty()) {
        fmt::print(stderr, "{}\n", outcome.failure);
        return 1;
    }
    checkpoint->remove();
    return 0;
}
