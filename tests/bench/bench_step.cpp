// Measures time steps of realizations integrated in lockstep: steps per second, and their share of
// the core's peak of fused multiply-adds.
// Usage: bench_step [--benchmark_filter=REGEX] [--benchmark_repetitions=N] ...
// A round integrates one mesh period and then measures the peak. Times are this thread's processor
// time; the result is their median over the rounds.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bench_scene.hpp"
#include "peaks.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "machine/clocks.hpp"
#include "machine/instruction_sets.hpp"
#include "median.hpp"
#include "operations.hpp"

namespace gearpod::bench {
namespace {

using machine::InstructionSet;

struct Setting {
    int planets = 4;
    bool torsional = false;
    std::string integrator = "rk4", precision = "double";
    int lanes = 8;
    InstructionSet set = InstructionSet::baseline;

    bool single() const { return precision == "single"; }
    std::string text() const {
        return fmt::format("{}/N={}/{}/{}/{}/lanes={}", integrator, planets,
                           torsional ? "torsional" : "full", precision, machine::name(set), lanes);
    }
    std::vector<std::string> overrides() const {
        return {
            "numerics.integrator=" + integrator, "numerics.precision=" + precision,
            fmt::format("numerics.lanes={}", lanes),
            fmt::format("effects.motion={}", torsional ? "torsional" : "translational-torsional")};
    }
};

// A tile that is integrated one mesh period after the other.
template <int W>
class Tile {
  public:
    explicit Tile(const mc::Scene& scene)
        : inputs_(W, scene.gearbox().inputs(scene.gearbox().nominal)),
          mesh_integrator_(lockstep::make_mesh_integrator<W>(scene.solve().integration(), inputs_)),
          rotation_(scene.solve().integration().layout, inputs_),
          state_(lockstep::equilibrium_state(scene.solve().integration(), inputs_)),
          record_(lockstep::make_record(scene.solve().integration(), W, false)) {}

    // Time of one mesh period in seconds of processor time.
    double mesh_s() {
        const double start = mc::thread_processor_s();
        (*mesh_integrator_)({}, state_, record_);
        const double seconds = mc::thread_processor_s() - start;
        rotation_.remove(state_);  // otherwise it grows from mesh period to mesh period
        return seconds;
    }

  private:
    std::vector<dynamics::GearboxInputs> inputs_;
    std::unique_ptr<const lockstep::MeshIntegrator<W>> mesh_integrator_;
    lockstep::RigidRotation rotation_;
    lockstep::TileState state_;
    lockstep::MeshRecord record_;
};

std::function<double()> mesh_of(const mc::Scene& scene, int lanes) {
    const auto mesh = [&]<int W>() {
        auto tile = std::make_shared<Tile<W>>(scene);
        return [tile] { return tile->mesh_s(); };
    };
    return lanes == 16  ? std::function<double()>(mesh.operator()<16>())
           : lanes == 8 ? std::function<double()>(mesh.operator()<8>())
           : lanes == 4 ? std::function<double()>(mesh.operator()<4>())
                        : std::function<double()>(mesh.operator()<1>());
}

// Operations of one step, or nothing for a method whose operations are not counted.
std::optional<Operations> operations(const mc::Scene& scene, const Setting& setting) {
    if (setting.integrator == "rk4") {
        return rk4_operations(scene.solve().integration());
    }
    if (setting.integrator == "central-difference") {
        return central_difference_operations(scene.solve().integration());
    }
    return {};
}

void count_operations(const Operations& done, double step_s, double peak,
                      benchmark::UserCounters& counters) {
    const auto flop = static_cast<double>(done.flop());
    counters["fma"] = static_cast<double>(done.fma);
    counters["mul"] = static_cast<double>(done.multiply);
    counters["add"] = static_cast<double>(done.add + done.divide);
    counters["flop/s"] = flop / step_s;
    if (peak > 0.0) {
        counters["peak%"] = 100.0 * flop / step_s / (2.0 * peak);
    }
}

void measure_steps(benchmark::State& state, const Setting& setting) {
    machine::use_instruction_set(setting.set);
    const auto scene = reference_scene(setting.planets, setting.overrides());
    const lockstep::IntegrationPlan& plan = scene->solve().integration();
    const auto mesh_s = mesh_of(*scene, setting.lanes);
    for (int i = 0; i < 3; ++i) {
        mesh_s();
    }
    std::vector<double> times, peaks;
    for (auto _ : state) {
        times.push_back(mesh_s());
        peaks.push_back(setting.single() ? fma_rate_float() : fma_rate_double());
        state.SetIterationTime(times.back());
    }
    const double step_s =
        median(times) / static_cast<double>(plan.grid.steps.size()) / setting.lanes;
    auto& counters = state.counters;
    counters["steps"] = static_cast<double>(plan.grid.steps.size());
    counters["steps/s"] = 1.0 / step_s;
    counters["ns/step"] = 1e9 * step_s;
    if (const std::optional<Operations> done = operations(*scene, setting)) {
        count_operations(*done, step_s, median(peaks), counters);
    }
    counters["stream_B"] = bytes_streamed(plan, setting.lanes) / setting.lanes;
    counters["tile_B"] = bytes_of_tile(plan, setting.lanes, setting.single() ? 4 : 8);
}

void add(const Setting& setting) {
    benchmark::RegisterBenchmark(setting.text().c_str(),
                                 [setting](benchmark::State& state) {
                                     try {
                                         measure_steps(state, setting);
                                     } catch (const lockstep::MissingKernel& error) {
                                         state.SkipWithError(error.what());
                                     }
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

std::vector<InstructionSet> instruction_sets() {
    std::vector<InstructionSet> sets;
    for (const auto set :
         {InstructionSet::x86_64_v4, InstructionSet::x86_64_v3, InstructionSet::baseline}) {
        if (set <= machine::best_instruction_set()) {
            sets.push_back(set);
        }
    }
    return sets;
}

void add_all() {
    for (const InstructionSet set : instruction_sets()) {
        for (const int planets : {3, 4, 6}) {
            for (const bool torsional : {false, true}) {
                for (const char* method : {"rk4", "central-difference"}) {
                    add({planets, torsional, method, "double", 8, set});
                    add({planets, torsional, method, "single", 16, set});
                }
                add({planets, torsional, "sdirk3", "double", 8, set});
            }
        }
        for (const int lanes : {1, 4}) {
            add({4, false, "rk4", "double", lanes, set});
        }
        for (const int lanes : {1, 4, 8}) {
            add({4, false, "rk4", "single", lanes, set});
        }
    }
}

}  // namespace
}  // namespace gearpod::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    gearpod::bench::add_all();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
