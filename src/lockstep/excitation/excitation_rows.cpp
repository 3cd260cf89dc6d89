#include "lockstep/excitation/excitation_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "machine/contracts.hpp"

namespace gearpod::lockstep {

int columns_in(const Excitation& e) {
    return (e.torque ? 1 : 0) + (e.gravity ? 2 : 0) + (e.speed ? 1 : 0) +
           static_cast<int>(e.shafts.size());
}

int values_in_row(const Excitation& e) {
    return columns_in(e) + (e.speed ? static_cast<int>(speed_value_count) : 0);
}

int distinct_nodes_per_step(const PhaseGrid& grid) {
    const auto nodes = static_cast<int>(grid.stage_nodes.size());
    return grid.stage_nodes.front() == 0.0 && grid.stage_nodes.back() == 1.0 ? nodes - 1 : nodes;
}

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Pads the knots with zeros at both ends.
machine::AlignedVector padded_knots(const Fluctuation& f, std::size_t lanes) {
    machine::AlignedVector knots(f.knot.size() + 2 * kSplineMargin * lanes);
    std::copy(f.knot.begin(), f.knot.end(),
              knots.begin() + static_cast<std::ptrdiff_t>(kSplineMargin * lanes));
    return knots;
}

}  // namespace

ExcitationRows::ExcitationRows(const IntegrationPlan& plan, const Excitation& excitation,
                               std::span<const dynamics::GearboxInputs> inputs, bool with_time)
    : excitation_(excitation),
      lanes_(static_cast<int>(inputs.size())),
      nodes_per_step_(distinct_nodes_per_step(plan.grid)),
      values_(values_in_row(excitation)),
      with_time_(with_time || excitation.torque) {
    for (const Step& step : plan.grid.steps) {
        for (int node = 0; node < nodes_per_step_; ++node) {
            const auto part = plan.grid.stage_nodes[static_cast<std::size_t>(node)];
            position_.push_back(std::fma(part, step.length, step.phase));
        }
    }
    if (nodes_per_step_ < static_cast<int>(plan.grid.stage_nodes.size())) {
        position_.push_back(1.0);
    }
    for (const auto& in : inputs) {
        period_.push_back(dynamics::mesh_period_s(in));
    }
    if (excitation.torque) {
        torque_knots_ = padded_knots(*excitation.torque, inputs.size());
    }
    if (excitation.speed) {
        speed_knots_ = padded_knots(*excitation.speed, inputs.size());
    }
    if (excitation.gravity) {
        for (const double position : position_) {
            const double angle = kTurn * excitation.gravity->carrier_turns_per_mesh * position;
            turn_x_.push_back(std::cos(angle));
            turn_y_.push_back(std::sin(angle));
        }
    }
    const std::size_t nodes = position_.size() * inputs.size();
    time_.resize(nodes);
    sum_.resize(nodes);
    slope_.resize(nodes);
    end_time_.resize(inputs.size());
    rows_.resize(nodes * static_cast<std::size_t>(values_));
}

void ExcitationRows::fill(int mesh) {
    set_uniform_time(mesh);
    if (excitation_.speed) {
        fill_speed_values(mesh);
        if (with_time_) {
            integrate_time(mesh);
        }
    }
    int column = 0;
    if (excitation_.torque) {
        fill_torque(mesh);
        ++column;
    }
    if (excitation_.gravity) {
        fill_gravity(mesh, column);
    }
    last_mesh_ = mesh;
    any_before_ = true;
}

void ExcitationRows::set_uniform_time(int mesh) {
    const auto lanes = static_cast<std::size_t>(lanes_);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        for (std::size_t l = 0; l < lanes; ++l) {
            time_[n * lanes + l] = (mesh + position_[n]) * period_[l];
        }
    }
}

void ExcitationRows::evaluate_fluctuation(const Fluctuation& f, const machine::AlignedVector& knots,
                                          int mesh, bool with_slope) {
    std::fill(sum_.begin(), sum_.end(), 0.0);
    std::fill(slope_.begin(), slope_.end(), 0.0);
    const auto nodes = static_cast<int>(position_.size());
    double* const slope = with_slope ? slope_.data() : nullptr;
    if (!f.amplitude.empty()) {
        std::vector<double> phase = position_;
        for (double& p : phase) {
            p += mesh;
        }
        add_sines(lanes_,
                  {nodes, phase.data(), time_.data(), f.amplitude.data(), f.turns_per_mesh.data(),
                   f.turns_per_s.data(), f.turns.data(), sum_.data(), slope});
    }
    if (!f.knot.empty()) {
        machine::AlignedVector first = f.first_knot;
        for (double& knot : first) {
            knot += kSplineMargin;
        }
        add_splines(lanes_, {nodes, static_cast<int>(knots.size()) / lanes_, time_.data(),
                             f.knots_per_s.data(), first.data(), period_.data(), knots.data(),
                             sum_.data(), slope});
    }
}

void ExcitationRows::fill_torque(int mesh) {
    evaluate_fluctuation(*excitation_.torque, torque_knots_, mesh, false);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        std::copy_n(sum_.data() + n * static_cast<std::size_t>(lanes_), lanes_, value(n, 0));
    }
}

// In a frame that rotates forwards, the weight rotates backwards.
void ExcitationRows::fill_gravity(int mesh, int column) {
    const Gravity& g = *excitation_.gravity;
    const double start =
        g.direction_rad - kTurn * std::remainder(g.carrier_turns_per_mesh * mesh, 1.0);
    const double x = g.acceleration_m_s2 * std::cos(start);
    const double y = g.acceleration_m_s2 * std::sin(start);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        std::fill_n(value(n, column), lanes_, std::fma(x, turn_x_[n], y * turn_y_[n]));
        std::fill_n(value(n, column + 1), lanes_, std::fma(y, turn_x_[n], -x * turn_y_[n]));
    }
}

void ExcitationRows::fill_speed_values(int mesh) {
    evaluate_fluctuation(*excitation_.speed, speed_knots_, mesh, true);
    write_speed_values(lanes_, {static_cast<int>(position_.size()), values_,
                                columns_in(excitation_) - 1, sum_.data(), slope_.data(),
                                period_.data(), excitation_.rotation_m_s.data(), rows_.data()});
}

// The classical Runge-Kutta method has nodes at the start, middle and end of a step. The time at
// the end follows from Simpson's rule, the time at the middle from the parabola through the three.
void ExcitationRows::integrate_time(int mesh) {
    EXPECTS(nodes_per_step_ == 2 && position_.size() % 2 == 1);
    const auto lanes = static_cast<std::size_t>(lanes_);
    const int column = columns_in(excitation_) + mesh_period_value;
    for (std::size_t l = 0; l < lanes; ++l) {
        double time = any_before_ && mesh == last_mesh_ + 1 ? end_time_[l] : mesh * period_[l];
        time_[l] = time;
        for (std::size_t n = 2; n < position_.size(); n += 2) {
            const double h = position_[n] - position_[n - 2];
            const double a = value(n - 2, column)[l], b = value(n - 1, column)[l],
                         c = value(n, column)[l];
            time_[(n - 1) * lanes + l] = std::fma(h / 24.0, 5.0 * a + 8.0 * b - c, time);
            time = std::fma(h / 6.0, a + 4.0 * b + c, time);
            time_[n * lanes + l] = time;
        }
        end_time_[l] = time;
    }
}

}  // namespace gearpod::lockstep
