// The classical Runge-Kutta method, built twice: with the options of a release build, and without
// automatic vectorization (GEARPOD_PEERS_BUILD, CMakeLists.txt).
#include <array>
#include <boost/numeric/odeint.hpp>

#include "eight.hpp"
#include "machine/clocks.hpp"
#include "peer_runs.hpp"

namespace gearpod::peers::GEARPOD_PEERS_BUILD {
namespace {

namespace odeint = boost::numeric::odeint;

template <int Size, class T>
using State = std::array<T, static_cast<std::size_t>(Size)>;

// Derivative y' for a step of the grid: the method evaluates it at the step's start, twice in its
// middle, and at its end.
template <int Size, class T, class MeshesAt>
class StepRates {
  public:
    StepRates(const Gearbox<T>& gearbox, MeshesAt meshes_at)
        : gearbox_(gearbox), meshes_at_(meshes_at) {}

    void begin(int mesh, int step) {
        mesh_ = mesh;
        step_ = step;
        stage_ = 0;
    }
    void operator()(const State<Size, T>& y, State<Size, T>& dy, double) {
        if (stage_ != 2) {
            meshes_at_(mesh_, step_, (stage_ + 1) / 2, meshes_);
        }
        ++stage_;
        rates<Size>(gearbox_, meshes_, y.data(), dy.data());
    }

  private:
    const Gearbox<T>& gearbox_;
    MeshesAt meshes_at_;
    Meshes<T> meshes_;
    int mesh_ = 0, step_ = 0, stage_ = 0;
};

template <int Size, class T, class MeshesAt, class Record>
void integrate_steps(const Task& task, const Extent& extent, const Gearbox<T>& gearbox,
                     MeshesAt meshes_at, State<Size, T>& y, Record record) {
    odeint::runge_kutta4<State<Size, T>, double, State<Size, T>, double, odeint::array_algebra>
        stepper;
    StepRates<Size, T, MeshesAt> rates_of(gearbox, meshes_at);
    const auto& steps = task.steps.grid().steps;
    for (int k = -extent.run_in; k < extent.recorded; ++k) {
        const int mesh = pattern_mesh(task, k);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (k >= 0 && steps[i].sample >= 0) {
                record(k, steps[i].sample, y);
            }
            rates_of.begin(mesh, static_cast<int>(i));
            stepper.do_step(std::ref(rates_of), y, 0.0, steps[i].length * task.mesh_period_s);
        }
    }
}

template <int Size>
PeerRun one_by_one(const Task& task, const Extent& extent, int first, int last) {
    PeerRun run{empty_records(task, extent.recorded), 0.0,
                static_cast<double>(task.steps.grid().steps.size())};
    for (int g = first; g < last; ++g) {
        const Gearbox<double> gearbox = gearbox_of(task, g);
        double start[kSensing];
        copy_start(task, g, start);
        State<Size, double> y;
        std::copy_n(start, Size, y.begin());
        const double began = mc::thread_processor_s();
        integrate_steps<Size>(
            task, extent, gearbox,
            [&](int mesh, int step, int node, Meshes<double>& m) {
                task.steps.at_node(mesh, step, node, g, m);
            },
            y,
            [&](int k, int sample, const State<Size, double>& state) {
                record_sample(task, state.data(), Size == kSensing, g, sample,
                              run.records[static_cast<std::size_t>(k)]);
            });
        run.integration_s += mc::thread_processor_s() - began;
    }
    return run;
}

template <int Size>
PeerRun wide(const Task& task, const Extent& extent) {
    PeerRun run{empty_records(task, extent.recorded), 0.0,
                static_cast<double>(task.steps.grid().steps.size())};
    const Gearbox<Eight> gearbox = all_gearboxes<Eight>(task);
    State<Size, Eight> y;
    for (int g = 0; g < kGearboxes; ++g) {
        double start[kSensing];
        copy_start(task, g, start);
        for (std::size_t i = 0; i < y.size(); ++i) {
            y[i].x[g] = start[i];
        }
    }
    const double began = mc::thread_processor_s();
    integrate_steps<Size>(
        task, extent, gearbox,
        [&](int mesh, int step, int node, Meshes<Eight>& m) {
            task.steps.at_node(mesh, step, node, m);
        },
        y,
        [&](int k, int sample, const State<Size, Eight>& state) {
            double one[Size];
            for (int g = 0; g < kGearboxes; ++g) {
                for (std::size_t i = 0; i < state.size(); ++i) {
                    one[i] = state[i].x[g];
                }
                record_sample(task, one, Size == kSensing, g, sample,
                              run.records[static_cast<std::size_t>(k)]);
            }
        });
    run.integration_s = mc::thread_processor_s() - began;
    return run;
}

}  // namespace

PeerRun odeint_rk4(const Task& task, const Extent& extent, int first, int last, bool motion_only) {
    return motion_only ? one_by_one<kMotionStates>(task, extent, first, last)
                       : one_by_one<kSensing>(task, extent, first, last);
}

PeerRun odeint_wide_rk4(const Task& task, const Extent& extent, bool motion_only) {
    return motion_only ? wide<kMotionStates>(task, extent) : wide<kSensing>(task, extent);
}

}  // namespace gearpod::peers::GEARPOD_PEERS_BUILD
