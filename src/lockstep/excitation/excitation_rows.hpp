// Values of a time-varying excitation at the stage nodes of one mesh period, for all lanes of a
// tile.
#pragma once

#include <span>
#include <vector>

#include "lockstep/excitation/row_layout.hpp"
#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

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
