#include "step_table.hpp"

#include <fmt/format.h>

#include "comparison.hpp"

namespace gearpod::peers {
namespace {

constexpr int kBox = kLargestCrack;

}  // namespace

StepTable::StepTable(OwnMarch& own, const mc::Reference& reference)
    : own_(own), reference_(reference) {
    rows_.push_back({"gearpod, 8 in lockstep", {}, 0.0, {}});
    for (const bool motion_only : {false, true}) {
        const std::string what = motion_only ? ", motion without sensor" : "";
        add("odeint rk4, one gearbox" + what, [=](const Task& task, const Extent& extent) {
            return vectorized::odeint_rk4(task, extent, kBox, kBox + 1, motion_only);
        });
        add("odeint rk4, one gearbox, scalar code" + what,
            [=](const Task& task, const Extent& extent) {
                return scalar::odeint_rk4(task, extent, kBox, kBox + 1, motion_only);
            });
        add("odeint rk4, 8-wide value type" + what, [=](const Task& task, const Extent& extent) {
            PeerRun run = vectorized::odeint_wide_rk4(task, extent, motion_only);
            run.march_s /= kGearboxes;
            return run;
        });
    }
}

void StepTable::add(const std::string& name, Way way) {
    rows_.push_back({name, {}, 0.0, {}});
    ways_.push_back(std::move(way));
}

void StepTable::measure_errors() {
    const Extent pattern{2, own_.task().steps.meshes()};
    for (std::size_t i = 0; i < ways_.size(); ++i) {
        const PeerRun run = ways_[i](own_.task(), pattern);
        rows_[i + 1].error = error_of(own_.scene(), run.records, kBox, kBox + 1, reference_.record);
    }
}

void StepTable::round() {
    const double steps = static_cast<double>(own_.task().steps.grid().steps.size());
    std::vector<std::vector<double>> all(rows_.size());
    for (int repeat = 0; repeat < 5; ++repeat) {
        all[0].push_back(own_.tile_mesh_s() / steps / kGearboxes);
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            all[i + 1].push_back(ways_[i](own_.task(), {1, 0}).march_s / steps);
        }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        rows_[i].times.push_back(median(all[i]));
    }
}

void StepTable::print() const {
    fmt::print(
        "\na step of a gearbox, classical Runge-Kutta, {} steps a mesh period, doubles\n"
        "{:<54} {:>8} {:>24} {:>14}\n",
        own_.task().steps.grid().steps.size(), "", "ns", "over gearpod", "worst feature");
    for (const Row& row : rows_) {
        fmt::print("{:<54} {:>8.1f} {:>24} {:>14}\n", row.name, 1e9 * median(row.times),
                   ratio_text(row, rows_[0]),
                   row.error ? fmt::format("{:.1e}", row.error->largest_feature()) : "");
    }
}

}  // namespace gearpod::peers
