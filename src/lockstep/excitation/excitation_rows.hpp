// Values of a time-varying excitation at the stage nodes of a mesh period, one row for each node.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Values after a row's columns if the speed fluctuates: seconds per mesh period, speed relative to
// its mean, and the rate of change of that, 1/s.
enum SpeedValue { mesh_period_value, relative_speed_value, speed_rate_value, speed_value_count };

// Number of force patterns of an excitation (ExcitationForces), and number of values in a row:
// these plus the speed values.
int columns_in(const Excitation& excitation);
int values_in_row(const Excitation& excitation);

// Distinct stage nodes per step: a node at the end of a step counts as the first one of the next
// step if both exist.
int distinct_nodes_per_step(const PhaseGrid& grid);

// SIMD kernels that evaluate fluctuations at the stage nodes of W gearboxes.

// Arguments of add_sines. At nodes n with phase phase[n] and time time[n][lane], it adds
//   amplitude sin(2 pi z),  z = turns_per_mesh phase + turns_per_s time + turns,
// to sum[n][lane]. Unless slope is null, it adds the derivative by the phase at fixed time to
// slope[n][lane]. The other arrays are [lane].
struct SineRows {
    int nodes = 0;
    const double* phase = nullptr;
    const double* time = nullptr;
    const double* amplitude = nullptr;
    const double* turns_per_mesh = nullptr;
    const double* turns_per_s = nullptr;
    const double* turns = nullptr;
    double* sum = nullptr;
    double* slope = nullptr;
};
void add_sines(int lanes, const SineRows& rows);

// Arguments of add_splines. At the same nodes, it adds the cubic B-spline with knots [knot][lane]
// at
//   time knots_per_s + first_knot
// to sum. Unless slope is null, it adds the derivative by the phase, with `period` seconds per mesh
// period, to slope. The spline is 0 outside its `count` knots. These must include kSplineMargin
// zeros at each end.
inline constexpr int kSplineMargin = 4;
struct SplineRows {
    int nodes = 0, count = 0;
    const double* time = nullptr;
    const double* knots_per_s = nullptr;
    const double* first_knot = nullptr;
    const double* period = nullptr;
    const double* knot = nullptr;
    double* sum = nullptr;
    double* slope = nullptr;
};
void add_splines(int lanes, const SplineRows& rows);

// Arguments of write_speed_values. Inputs are the variation x of a speed and its derivative by the
// phase at every node. It writes the acceleration of the train's rotation and then the three
// SpeedValue values. Rows have `values` values; these start at index `first_value`.
struct SpeedRows {
    int nodes = 0, values = 0, first_value = 0;
    const double* variation = nullptr;
    const double* slope = nullptr;
    const double* period = nullptr;        // [lane], mean, s
    const double* rotation_m_s = nullptr;  // [lane]
    double* rows = nullptr;
};
void write_speed_values(int lanes, const SpeedRows& rows);

// Values of a time-varying excitation at the stage nodes of one mesh period, for all lanes of a
// tile.
class ExcitationRows {
  public:
    // `inputs` has one gearbox per lane (8, 4 or 1). The excitation must outlive the rows.
    // `with_time` computes the time even if no torque depends on it.
    ExcitationRows(const IntegrationPlan& plan, const Excitation& excitation,
                   std::span<const dynamics::GearboxInputs> inputs, bool with_time = false);

    // Computes the rows of a mesh period. Time continues from the end of the previous mesh period
    // if that was the last one filled. Otherwise the mesh period starts at its index times its mean
    // length.
    void fill(int mesh);

    // [distinct stage node][value][lane], values_in_row() values: relative torque minus 1, gravity
    // along the model's x and y (m/s^2), acceleration of the train's rotation (m/s^2), speed
    // (SpeedValue). The address never changes.
    const machine::AlignedVector& rows() const { return rows_; }
    const double* row(int step, int node) const {
        return rows_.data() + (step * nodes_per_step_ + node) * values_ * lanes_;
    }
    // Seconds since the start of the first recorded mesh period, [lane]; valid only if time is
    // computed.
    const double* time(int step) const { return time_.data() + step * nodes_per_step_ * lanes_; }

  private:
    double* value(std::size_t node, int which) {
        return rows_.data() +
               (node * static_cast<std::size_t>(values_) + static_cast<std::size_t>(which)) *
                   static_cast<std::size_t>(lanes_);
    }
    void fill_speed_values(int mesh);
    void fill_torque(int mesh);
    void fill_gravity(int mesh, int column);
    // Computes a fluctuation at `time_` into `sum_`, and its derivative per mesh period into
    // `slope_`. `knots` includes the margins.
    void evaluate_fluctuation(const Fluctuation& fluctuation, const machine::AlignedVector& knots,
                              int mesh, bool with_slope);
    void set_uniform_time(int mesh);
    void integrate_time(int mesh);

    const Excitation& excitation_;
    const int lanes_, nodes_per_step_, values_;
    const bool with_time_;
    std::vector<double> position_;         // of the distinct stage nodes, mesh periods
    std::vector<double> turn_x_, turn_y_;  // cosine and sine of the carrier angle there
    machine::AlignedVector torque_knots_, speed_knots_;
    machine::AlignedVector period_;              // [lane], mean, s
    machine::AlignedVector time_, sum_, slope_;  // [distinct stage node][lane]
    machine::AlignedVector end_time_;            // [lane], of the last mesh period
    int last_mesh_ = 0;
    bool any_before_ = false;
    machine::AlignedVector rows_;
};

}  // namespace gearpod::lockstep
