#include "step_table.hpp"

#include <fmt/format.h>

#include "peer_operations.hpp"
#include "tests/bench/operations.hpp"

namespace gearpod::peers {
namespace {

using bench::Width;

constexpr int kGearbox = kLargestCrack;
constexpr std::size_t kScalarRow = 2;  // one gearbox in scalar code, with the sensor

}  // namespace

StepTable::StepTable(GearpodSolver& own, const mc::Reference& reference)
    : own_(own), reference_(reference) {
    rows_.push_back({"gearpod, 8 in lockstep", {}, 0.0, {}});
    work_.push_back(
        {static_cast<double>(bench::rk4_operations(own.scene().solve().integration()).flop())});
    for (const bool motion_only : {false, true}) {
        const std::string what = motion_only ? ", no sensor" : "";
        const double flop = rk4_flop(motion_only);
        add("odeint rk4, one gearbox" + what, {flop, Width::bits_512, motion_only},
            [=](const Task& task, const Extent& extent) {
                return vectorized::odeint_rk4(task, extent, kGearbox, kGearbox + 1, motion_only);
            });
        add("odeint rk4, one gearbox, scalar code" + what, {flop, Width::scalar, motion_only},
            [=](const Task& task, const Extent& extent) {
                return scalar::odeint_rk4(task, extent, kGearbox, kGearbox + 1, motion_only);
            });
        add("odeint rk4, 8-wide value type" + what, {flop, Width::bits_512, motion_only},
            [=](const Task& task, const Extent& extent) {
                PeerRun run = vectorized::odeint_wide_rk4(task, extent, motion_only);
                run.integration_s /= kGearboxes;
                return run;
            });
    }
}

void StepTable::add(const std::string& name, Work work, Way way) {
    rows_.push_back({name, {}, 0.0, {}});
    work_.push_back(work);
    ways_.push_back(std::move(way));
}

void StepTable::measure_errors() {
    const Extent pattern{2, own_.task().steps.meshes()};
    for (std::size_t i = 0; i < ways_.size() && !work_[i + 1].no_sensor; ++i) {
        const PeerRun run = ways_[i](own_.task(), pattern);
        rows_[i + 1].error =
            error_of(own_.study(), run.records, kGearbox, kGearbox + 1, reference_.record);
    }
}

void StepTable::round() {
    const double steps = static_cast<double>(own_.task().steps.grid().steps.size());
    std::vector<std::vector<double>> all(rows_.size());
    for (int repeat = 0; repeat < 5; ++repeat) {
        all[0].push_back(own_.tile_mesh_s() / steps / kGearboxes);
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            all[i + 1].push_back(ways_[i](own_.task(), {1, 0}).integration_s / steps);
        }
        for (const Width width : {Width::scalar, Width::bits_256, Width::bits_512}) {
            peaks_[width].push_back(bench::fma_rate_double(width));
        }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        rows_[i].times.push_back(median(all[i]));
    }
}

double StepTable::peak(Width width) const {
    const double widest = median(peaks_.at(Width::bits_512));
    return width == Width::bits_512 && widest == 0.0 ? median(peaks_.at(Width::bits_256))
                                                     : median(peaks_.at(width));
}

double StepTable::share(std::size_t row) const {
    return work_[row].flop / median(rows_[row].times) / (2.0 * peak(work_[row].width));
}

void StepTable::add_to(nlohmann::ordered_json& part) const {
    nlohmann::ordered_json rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        const auto ratio = ratio_json(row, rows_[0]);
        rows.push_back({row.name, 1e9 * median(row.times), i == 0 ? one() : ratio,
                        row.error ? fmt::format("{:.1e}", row.error->largest_feature()) : "",
                        fmt::format("{:.0f}", work_[i].flop),
                        fmt::format("{:.0f} %", 100.0 * share(i))});
        if (i > 0) {
            part["ratios"]["step: " + row.name] = ratio;
        }
    }
    part["tables"].push_back(
        {{"title", "One step of one gearbox by the classical Runge-Kutta method, in doubles:"},
         {"columns",
          {"solver", "ns", "over gearpod", "worst feature", "operations", "share of its peak"}},
         {"rows", rows}});
}

void StepTable::print_limit() const {
    const double scalar = peak(Width::scalar), widest = peak(Width::bits_512);
    fmt::print(
        "fused multiply-adds of doubles a second: {:.3g} in scalar registers, {:.3g} in 256 bits "
        "({:.2f} times), {:.3g} in 512 ({:.2f})\n",
        scalar, peak(Width::bits_256), peak(Width::bits_256) / scalar, widest, widest / scalar);
    const double least_s = work_[0].flop / (2.0 * widest);
    fmt::print(
        "with nothing but fused multiply-adds at the peak a step of gearpod would take {:.1f} ns: "
        "scalar code at its own {:.0f} % is {:.2f} times that, and {:.2f} times at 100 %\n",
        1e9 * least_s, 100.0 * share(kScalarRow), median(rows_[kScalarRow].times) / least_s,
        work_[kScalarRow].flop / (2.0 * scalar) / least_s);
}

}  // namespace gearpod::peers
