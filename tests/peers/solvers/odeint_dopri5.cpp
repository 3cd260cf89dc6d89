#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "machine/clocks.hpp"
#include "peer_runs.hpp"

namespace gearpod::peers {
namespace {

namespace odeint = boost::numeric::odeint;

using Sensing = std::array<double, static_cast<std::size_t>(kSensing)>;

// Largest error over the states, each relative to its scale.
class ErrorAgainstSize {
  public:
    ErrorAgainstSize(const Task& task, double tolerance) {
        for (std::size_t i = 0; i < kSensing; ++i) {
            inverse_[i] = 1.0 / (tolerance * task.scale[i]);
        }
    }
    template <class Algebra, class State, class Rate, class Error, class Time>
    double error(Algebra&, const State&, const Rate&, Error& error, Time) const {
        double largest = 0.0;
        for (std::size_t i = 0; i < kSensing; ++i) {
            largest = std::max(largest, std::abs(error[i]) * inverse_[i]);
        }
        return largest;
    }

  private:
    double inverse_[kSensing];
};

// Integrates one realization by Dormand and Prince's pair.
class Dopri5 {
  public:
    Dopri5(const Task& task, double tolerance, int gearbox)
        : task_(task),
          gearbox_(gearbox),
          parameters_(gearbox_of(task, gearbox)),
          stepper_(Controlled(ErrorAgainstSize(task, tolerance))) {}

    double steps() const { return steps_; }

    // Returns true if it reached the end in time.
    bool integrate(const Extent& extent, bool stops, std::vector<lockstep::MeshRecord>& records) {
        const double give_up_at_s = mc::thread_processor_s() + extent.most_s;
        Sensing y;
        copy_start(task_, gearbox_, y.data());
        const std::vector<int>& all = task_.fine.stretches();
        const std::vector<int> whole{all.front(), all.back()};
        begin(y, -extent.run_in);
        for (int k = -extent.run_in; k < extent.recorded; ++k) {
            lockstep::MeshRecord* record = k < 0 ? nullptr : &records[static_cast<std::size_t>(k)];
            const std::vector<int>& stretches = stops ? all : whole;
            for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
                stretch(k, stretches[i], stretches[i + 1], stops, record);
            }
            if (mc::thread_processor_s() > give_up_at_s) {
                return false;
            }
        }
        return true;
    }

  private:
    using Pair =
        odeint::runge_kutta_dopri5<Sensing, double, Sensing, double, odeint::array_algebra>;
    using Controlled = odeint::controlled_runge_kutta<Pair, ErrorAgainstSize>;

    double phase_of(int step) const {
        const auto& steps = task_.fine.grid().steps;
        return step < static_cast<int>(steps.size()) ? steps[static_cast<std::size_t>(step)].phase
                                                     : 1.0;
    }
    void begin(const Sensing& y, double phase) {
        stepper_.initialize(y, phase * task_.mesh_period_s, step_s_);
    }

    // Integrates steps first to last - 1 of the fine grid; times are mesh periods times the period.
    void stretch(int k, int first, int last, bool stops, lockstep::MeshRecord* record) {
        const double period = task_.mesh_period_s;
        const double from = k + phase_of(first), to = k + phase_of(last);
        const auto rates_of = [&](const Sensing& y, Sensing& dy, double t) {
            const double phase = t / period;
            Meshes<double> m;
            if (stops) {
                task_.fine.at_phase(pattern_mesh(task_, k), phase - k, first, last, gearbox_, m);
            } else {
                const double mesh = std::floor(phase);
                task_.fine.at_phase(pattern_mesh(task_, static_cast<int>(mesh)), phase - mesh,
                                    first, last, gearbox_, m);
            }
            rates<kSensing>(parameters_, m, y.data(), dy.data());
        };
        const int samples = task_.scene.record().samples;
        int sample = static_cast<int>(std::ceil((from - k) * samples - 1e-9));
        Sensing y;
        while (true) {
            for (; sample < samples && k + double(sample) / samples < to - 1e-12 &&
                   (k + double(sample) / samples) * period <= stepper_.current_time();
                 ++sample) {
                if (record != nullptr) {
                    stepper_.calc_state((k + double(sample) / samples) * period, y);
                    record_sample(task_, y.data(), true, gearbox_, sample, *record);
                }
            }
            if (stepper_.current_time() >= to * period) {
                break;
            }
            stepper_.do_step(rates_of);
            ++steps_;
        }
        if (stops) {
            stepper_.calc_state(to * period, y);
            step_s_ = stepper_.current_time_step();
            begin(y, to);
        }
    }

    const Task& task_;
    const int gearbox_;
    const Gearbox<double> parameters_;
    odeint::dense_output_runge_kutta<Controlled> stepper_;
    double step_s_ = 1e-6;
    double steps_ = 0.0;
};

}  // namespace

PeerRun odeint_dopri5(const Task& task, const Extent& extent, int first, int last, double tolerance,
                      bool stops) {
    PeerRun run{empty_records(task, extent.recorded)};
    for (int g = first; g < last; ++g) {
        Dopri5 solver(task, tolerance, g);
        const double began = mc::thread_processor_s();
        run.late |= !solver.integrate(extent, stops, run.records);
        run.integration_s += mc::thread_processor_s() - began;
        run.steps += solver.steps() / (extent.run_in + extent.recorded) / (last - first);
    }
    return run;
}

}  // namespace gearpod::peers
