#include "mc/ensemble/rows_of_gearboxes.hpp"

#include <algorithm>
#include <vector>

#include "machine/team.hpp"
#include "mc/ensemble/batch_worker.hpp"
#include "mc/ensemble/thread_count.hpp"

namespace gearpod::mc {

BatchRows rows_of_gearboxes(const Scene& scene, std::span<const GearboxId> gearboxes) {
    const BatchTask task(scene);
    const std::size_t size = kBatchRows, batches = (gearboxes.size() + size - 1) / size;
    std::vector<BatchRows> parts(batches);
    machine::for_each_index(batches, thread_count(scene.study()), [&](std::size_t batch) {
        Seconds seconds;
        const std::size_t first = batch * size;
        parts[batch] = BatchWorker(task).compute(
            gearboxes.subspan(first, std::min(size, gearboxes.size() - first)), 1, seconds);
    });
    BatchRows all;
    for (const BatchRows& part : parts) {
        all.status.insert(all.status.end(), part.status.begin(), part.status.end());
        all.values.insert(all.values.end(), part.values.begin(), part.values.end());
    }
    return all;
}

}  // namespace gearpod::mc
