#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "machine/clocks.hpp"
#include "peer_runs.hpp"

namespace gearpod::peers {
namespace {

void check(int code, const char* what) {
    if (code < 0) {
        throw std::runtime_error(std::string(what) + " failed with " + std::to_string(code));
    }
}

struct Late {};

class Cvode {
  public:
    Cvode(const Task& task, Multistep method, double tolerance, int gearbox)
        : task_(task), gearbox_(gearbox), parameters_(gearbox_of(task, gearbox)) {
        check(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
        y_ = N_VNew_Serial(kSensing, context_);
        absolute_ = N_VNew_Serial(kSensing, context_);
        for (int i = 0; i < kSensing; ++i) {
            NV_Ith_S(absolute_, i) = tolerance * task.scale[i];
        }
        copy_start(task, gearbox, NV_DATA_S(y_));
        memory_ = CVodeCreate(method == Multistep::adams ? CV_ADAMS : CV_BDF, context_);
        check(CVodeInit(memory_, rates_at, 0.0, y_), "CVodeInit");
        check(CVodeSetUserData(memory_, this), "CVodeSetUserData");
        check(CVodeSVtolerances(memory_, 0.0, absolute_), "CVodeSVtolerances");
        // Without this every interruption prints an error.
        check(CVodeSetErrFile(memory_, nullptr), "CVodeSetErrFile");
        check(CVodeSetMaxNumSteps(memory_, kStepsBetweenLooks), "CVodeSetMaxNumSteps");
        if (method == Multistep::bdf) {
            matrix_ = SUNDenseMatrix(kSensing, kSensing, context_);
            linear_ = SUNLinSol_Dense(y_, matrix_, context_);
            use_newton(dense_jacobian);
        } else if (method == Multistep::sparse_bdf) {
            find_pattern();
            matrix_ = SUNSparseMatrix(kSensing, kSensing, static_cast<sunindextype>(row_.size()),
                                      CSC_MAT, context_);
            linear_ = SUNLinSol_KLU(y_, matrix_, context_);
            use_newton(sparse_jacobian);
        } else {
            fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
            check(CVodeSetNonlinearSolver(memory_, fixed_point_), "CVodeSetNonlinearSolver");
        }
    }
    Cvode(const Cvode&) = delete;
    Cvode& operator=(const Cvode&) = delete;
    ~Cvode() {
        CVodeFree(&memory_);
        if (linear_ != nullptr) {
            SUNLinSolFree(linear_);
            SUNMatDestroy(matrix_);
        }
        if (fixed_point_ != nullptr) {
            SUNNonlinSolFree(fixed_point_);
        }
        N_VDestroy(y_);
        N_VDestroy(absolute_);
        SUNContext_Free(&context_);
    }

    double steps() const { return steps_; }

    void integrate(const Extent& extent, bool stops, std::vector<lockstep::MeshRecord>& records) {
        const std::vector<int>& all = task_.fine.stretches();
        const std::vector<int> whole{all.front(), all.back()};
        stops_ = stops;
        give_up_at_s_ = mc::thread_processor_s() + extent.most_s;
        restart(-extent.run_in);
        for (k_ = -extent.run_in; k_ < extent.recorded; ++k_) {
            lockstep::MeshRecord* record =
                k_ < 0 ? nullptr : &records[static_cast<std::size_t>(k_)];
            const std::vector<int>& stretches = stops ? all : whole;
            for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
                first_ = stretches[i];
                last_ = stretches[i + 1];
                stretch(record);
            }
        }
        count_steps();
    }

  private:
    static constexpr long kStepsBetweenLooks = 2000;  // between readings of the clock

    double phase_of(int step) const {
        const auto& steps = task_.fine.grid().steps;
        return step < static_cast<int>(steps.size()) ? steps[static_cast<std::size_t>(step)].phase
                                                     : 1.0;
    }
    void use_newton(CVLsJacFn jacobian) {
        compare_jacobian();
        check(CVodeSetLinearSolver(memory_, linear_, matrix_), "CVodeSetLinearSolver");
        check(CVodeSetJacFn(memory_, jacobian), "CVodeSetJacFn");
    }
    void count_steps() {
        long done = 0;
        CVodeGetNumSteps(memory_, &done);
        steps_ += static_cast<double>(done);
    }
    void restart(double phase) {
        count_steps();
        check(CVodeReInit(memory_, phase * task_.mesh_period_s, y_), "CVodeReInit");
    }
    void solve_to(double t) {
        double reached = 0.0;
        int code = CVode(memory_, t, y_, &reached, CV_NORMAL);
        while (code == CV_TOO_MUCH_WORK) {
            if (mc::thread_processor_s() > give_up_at_s_) {
                throw Late{};
            }
            code = CVode(memory_, t, y_, &reached, CV_NORMAL);
        }
        check(code, "CVode");
    }

    void stretch(lockstep::MeshRecord* record) {
        const double period = task_.mesh_period_s;
        const double from = phase_of(first_), to = phase_of(last_);
        if (stops_) {
            check(CVodeSetStopTime(memory_, (k_ + to) * period), "CVodeSetStopTime");
        }
        const int samples = task_.scene.record().samples;
        for (int sample = static_cast<int>(std::ceil(from * samples - 1e-9));
             record != nullptr && sample < samples && double(sample) / samples < to - 1e-12;
             ++sample) {
            const double phase = double(sample) / samples;
            if (phase > from + 1e-12) {
                solve_to((k_ + phase) * period);
            }
            record_sample(task_, NV_DATA_S(y_), true, gearbox_, sample, *record);
        }
        solve_to((k_ + to) * period);
        if (stops_) {
            restart(k_ + to);
        }
    }

    void meshes_at(double t, Meshes<double>& m) const {
        const double phase = t / task_.mesh_period_s;
        const double mesh = stops_ ? k_ : std::floor(phase);
        task_.fine.at_phase(pattern_mesh(task_, static_cast<int>(mesh)), phase - mesh, first_,
                            last_, gearbox_, m);
    }

    static int rates_at(double t, N_Vector y, N_Vector dy, void* self) {
        const auto& own = *static_cast<const Cvode*>(self);
        Meshes<double> m;
        own.meshes_at(t, m);
        rates<kSensing>(own.parameters_, m, NV_DATA_S(y), NV_DATA_S(dy));
        return 0;
    }

    using Column = std::array<double, kSensing>;

    // The equations are linear: a column of the Jacobian is y' of a unit state minus y' of the zero
    // state. Calls take(i, column).
    template <class Take>
    void each_column(const Meshes<double>& m, Take take) const {
        Gearbox<double> parameters = parameters_;
        parameters.pull = 0.0;
        for (double& force : parameters.force) {
            force = 0.0;
        }
        double unit[kSensing] = {};
        Column column;
        for (int i = 0; i < kSensing; ++i) {
            unit[i] = 1.0;
            rates<kSensing>(parameters, m, unit, column.data());
            unit[i] = 0.0;
            take(i, column);
        }
    }

    // Compares with the change of y' due to a step of every state, in the middle of mesh 0.
    void compare_jacobian() const {
        Meshes<double> m;
        task_.fine.at_phase(0, 0.5, 0, static_cast<int>(task_.fine.grid().steps.size()), gearbox_,
                            m);
        double y[kSensing], moved[kSensing];
        Column before, after, change{}, size{};
        copy_start(task_, gearbox_, y);
        for (int i = 0; i < kSensing; ++i) {
            moved[i] = y[i] + (i % 2 == 0 ? 1.0 : -0.5) * task_.scale[i];
        }
        rates<kSensing>(parameters_, m, y, before.data());
        rates<kSensing>(parameters_, m, moved, after.data());
        each_column(m, [&](int i, const Column& column) {
            for (std::size_t d = 0; d < kSensing; ++d) {
                change[d] += column[d] * (moved[i] - y[i]);
                size[d] += std::abs(column[d]) * (std::abs(moved[i]) + std::abs(y[i]));
            }
        });
        for (std::size_t d = 0; d < kSensing; ++d) {
            if (std::abs(after[d] - before[d] - change[d]) > 1e-12 * size[d]) {
                throw std::logic_error("the Jacobian is not that of the rates");
            }
        }
    }

    // Finds the nonzero entries of the Jacobian, and its diagonal, column by column.
    void find_pattern() {
        Meshes<double> all;
        std::fill_n(all.k, kPairs, 1.0);
        std::fill_n(all.c, kPairs, 1.0);
        begin_.push_back(0);
        each_column(all, [&](int i, const Column& column) {
            for (int d = 0; d < kSensing; ++d) {
                if (d == i || column[static_cast<std::size_t>(d)] != 0.0) {
                    row_.push_back(d);
                }
            }
            begin_.push_back(static_cast<sunindextype>(row_.size()));
        });
    }

    static int dense_jacobian(double t, N_Vector, N_Vector, SUNMatrix matrix, void* self, N_Vector,
                              N_Vector, N_Vector) {
        const auto& own = *static_cast<const Cvode*>(self);
        Meshes<double> m;
        own.meshes_at(t, m);
        own.each_column(m, [matrix](int i, const Column& column) {
            std::copy(column.begin(), column.end(), SM_COLUMN_D(matrix, i));
        });
        return 0;
    }

    static int sparse_jacobian(double t, N_Vector, N_Vector, SUNMatrix matrix, void* self, N_Vector,
                               N_Vector, N_Vector) {
        const auto& own = *static_cast<const Cvode*>(self);
        Meshes<double> m;
        own.meshes_at(t, m);
        std::copy(own.begin_.begin(), own.begin_.end(), SM_INDEXPTRS_S(matrix));
        std::copy(own.row_.begin(), own.row_.end(), SM_INDEXVALS_S(matrix));
        double* value = SM_DATA_S(matrix);
        own.each_column(m, [&](int i, const Column& column) {
            const auto at = static_cast<std::size_t>(i);
            for (auto n = own.begin_[at]; n < own.begin_[at + 1]; ++n) {
                value[n] = column[static_cast<std::size_t>(own.row_[static_cast<std::size_t>(n)])];
            }
        });
        return 0;
    }

    const Task& task_;
    const int gearbox_;
    const Gearbox<double> parameters_;
    bool stops_ = false;
    int k_ = 0, first_ = 0, last_ = 0;
    double steps_ = 0.0, give_up_at_s_ = 0.0;
    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr, absolute_ = nullptr;
    void* memory_ = nullptr;
    SUNMatrix matrix_ = nullptr;
    SUNLinearSolver linear_ = nullptr;
    SUNNonlinearSolver fixed_point_ = nullptr;
    std::vector<sunindextype> begin_, row_;  // columns of the sparse Jacobian
};

}  // namespace

PeerRun cvode(const Task& task, const Extent& extent, int first, int last, Multistep method,
              double tolerance, bool stops) {
    PeerRun run{empty_records(task, extent.recorded)};
    for (int g = first; g < last; ++g) {
        Cvode solver(task, method, tolerance, g);
        const double began = mc::thread_processor_s();
        try {
            solver.integrate(extent, stops, run.records);
        } catch (const Late&) {
            run.late = true;
        } catch (const std::runtime_error&) {
            run.failed = true;
        }
        run.integration_s += mc::thread_processor_s() - began;
        run.steps += solver.steps() / (extent.run_in + extent.recorded) / (last - first);
    }
    return run;
}

}  // namespace gearpod::peers
