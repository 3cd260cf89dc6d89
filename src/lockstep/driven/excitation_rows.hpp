// The values of an excitation at the stage nodes of one mesh period, for all lanes of a tile.
#pragma once

#include <span>
#include <vector>

#include "lockstep/driven/row_layout.hpp"
#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

class ExcitationRows {
  public:
    // `inputs`: one gearbox a lane (8, 4 or 1). The excitation must outlive the rows.
    // `with_time`: time is kept even where no torque depends on it.
    ExcitationRows(const MarchPlan& plan, const Excitation& excitation,
                   std::span<const dynamics::GearboxInputs> inputs, bool with_time = false);

    // Computes the rows of a mesh period. Time runs on from the mesh period before if that was the
    // last one asked for; else the mesh period begins at its number times its mean length.
    void fill(int mesh);

    // [distinct stage node][value][lane], values_in_row() values: relative torque less 1, gravity
    // along the model's x and y (m/s^2), acceleration of the train's turning (m/s^2), pace
    // (PaceValue). Stays where it is.
    const machine::AlignedVector& rows() const { return rows_; }
    const double* row(int step, int node) const {
        return rows_.data() + (step * nodes_per_step_ + node) * values_ * lanes_;
    }
    // Seconds since the first recorded mesh period began, [lane]; only where time is kept.
    const double* time(int step) const { return time_.data() + step * nodes_per_step_ * lanes_; }

  private:
    double* value(std::size_t node, int which) {
        return rows_.data() +
               (node * static_cast<std::size_t>(values_) + static_cast<std::size_t>(which)) *
                   static_cast<std::size_t>(lanes_);
    }
    void fill_pace(int mesh);
    void fill_torque(int mesh);
    void fill_gravity(int mesh, int column);
    // A fluctuation at `time_` in `sum_`, and its change in `slope_` (a mesh period). `knots`: with
    // their margins.
    void fluctuate(const Fluctuation& fluctuation, const machine::AlignedVector& knots, int mesh,
                   bool with_slope);
    void steady_time(int mesh);
    void integrate_time(int mesh);

    const Excitation& excitation_;
    const int lanes_, nodes_per_step_, values_;
    const bool with_time_;
    std::vector<double> position_;         // of the distinct stage nodes, mesh periods
    std::vector<double> turn_x_, turn_y_;  // cosine and sine of the carrier's angle there
    machine::AlignedVector torque_knots_, speed_knots_;
    machine::AlignedVector period_;              // [lane], mean, s
    machine::AlignedVector time_, sum_, slope_;  // [distinct stage node][lane]
    machine::AlignedVector end_time_;            // [lane], of the last mesh period
    int last_mesh_ = 0;
    bool any_before_ = false;
    machine::AlignedVector rows_;
};

}  // namespace gearpod::lockstep
