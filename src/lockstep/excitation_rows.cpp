#include "lockstep/excitation_rows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "lockstep/driven_forces.hpp"
#include "lockstep/fluctuation_rows.hpp"

namespace gearpod::lockstep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct SplineValue {
    double value, slope;  // slope a knot spacing
};

// Cubic B-spline of lane l's knots at coordinate u (de Boor, A Practical Guide to Splines).
SplineValue spline(const machine::AlignedVector& knots, std::size_t lanes, std::size_t l,
                   double u) {
    const double left = std::floor(u);
    const double x = u - left, y = 1.0 - x;
    const double weight[] = {y * y * y / 6.0, 2.0 / 3.0 - x * x * (1.0 - 0.5 * x),
                             2.0 / 3.0 - y * y * (1.0 - 0.5 * y), x * x * x / 6.0};
    const double slope[] = {-0.5 * y * y, x * (1.5 * x - 2.0), y * (2.0 - 1.5 * y), 0.5 * x * x};
    const auto count = static_cast<long>(knots.size() / lanes);
    SplineValue sum{0.0, 0.0};
    for (int i = 0; i < 4; ++i) {
        const long knot = static_cast<long>(left) - 1 + i;
        if (knot >= 0 && knot < count) {
            const double k = knots[static_cast<std::size_t>(knot) * lanes + l];
            sum.value = std::fma(weight[i], k, sum.value);
            sum.slope = std::fma(slope[i], k, sum.slope);
        }
    }
    return sum;
}

void add_sines(std::size_t lanes, const SineRows& rows) {
    if (lanes == 8) {
        add_sines_8(rows);
    } else if (lanes == 4) {
        add_sines_4(rows);
    } else {
        assert(lanes == 1);
        add_sines_1(rows);
    }
}

}  // namespace

int columns_in(const Excitation& e) {
    return (e.torque ? 1 : 0) + (e.gravity ? 2 : 0) + (e.speed ? 1 : 0);
}

int values_in_row(const Excitation& e) {
    return columns_in(e) + (e.speed ? static_cast<int>(pace_values) : 0);
}

int distinct_nodes_per_step(const PhaseGrid& grid) {
    const auto nodes = static_cast<int>(grid.stage_nodes.size());
    return grid.stage_nodes.front() == 0.0 && grid.stage_nodes.back() == 1.0 ? nodes - 1 : nodes;
}

ExcitationRows::ExcitationRows(const MarchPlan& plan, const Excitation& excitation,
                               std::span<const dynamics::GearboxInputs> inputs)
    : plan_(plan),
      excitation_(excitation),
      lanes_(static_cast<int>(inputs.size())),
      nodes_per_step_(distinct_nodes_per_step(plan.grid)),
      values_(values_in_row(excitation)) {
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
    steady_time(mesh);
    if (excitation_.speed) {
        fill_pace(mesh);
        if (excitation_.torque) {
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

void ExcitationRows::steady_time(int mesh) {
    const auto lanes = static_cast<std::size_t>(lanes_);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        for (std::size_t l = 0; l < lanes; ++l) {
            time_[n * lanes + l] = (mesh + position_[n]) * period_[l];
        }
    }
}

void ExcitationRows::fluctuate(const Fluctuation& f, int mesh, bool with_slope) {
    const auto lanes = static_cast<std::size_t>(lanes_);
    std::fill(sum_.begin(), sum_.end(), 0.0);
    std::fill(slope_.begin(), slope_.end(), 0.0);
    if (!f.amplitude.empty()) {
        std::vector<double> phase = position_;
        for (double& p : phase) {
            p += mesh;
        }
        add_sines(lanes, {static_cast<int>(phase.size()), phase.data(), time_.data(),
                          f.amplitude.data(), f.turns_per_mesh.data(), f.turns_per_s.data(),
                          f.turns.data(), sum_.data(), with_slope ? slope_.data() : nullptr});
    }
    for (std::size_t i = 0; i < sum_.size() && !f.knot.empty(); ++i) {
        const std::size_t l = i % lanes;
        const SplineValue at =
            spline(f.knot, lanes, l, std::fma(time_[i], f.knots_per_s[l], f.first_knot[l]));
        sum_[i] += at.value;
        slope_[i] = std::fma(at.slope, f.knots_per_s[l] * period_[l], slope_[i]);
    }
}

void ExcitationRows::fill_torque(int mesh) {
    fluctuate(*excitation_.torque, mesh, false);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        std::copy_n(sum_.data() + n * static_cast<std::size_t>(lanes_), lanes_, value(n, 0));
    }
}

// The weight turns backwards in a frame that turns forwards.
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

// With dphase/dt = r / T: dr/dt = dr/dphase r / T.
void ExcitationRows::fill_pace(int mesh) {
    fluctuate(*excitation_.speed, mesh, true);
    const auto lanes = static_cast<std::size_t>(lanes_);
    const int columns = columns_in(excitation_);
    for (std::size_t n = 0; n < position_.size(); ++n) {
        for (std::size_t l = 0; l < lanes; ++l) {
            const double speed = 1.0 + sum_[n * lanes + l];
            const double change = slope_[n * lanes + l] * speed / period_[l];
            value(n, columns + pace_period)[l] = period_[l] / speed;
            value(n, columns + pace_speed)[l] = speed;
            value(n, columns + pace_change)[l] = change;
            value(n, columns - 1)[l] = excitation_.turning_m_s[l] * change;
        }
    }
}

// The classical Runge-Kutta method has nodes at the start, middle and end of a step: Simpson's rule
// to its end, the parabola through the three to its middle.
void ExcitationRows::integrate_time(int mesh) {
    assert(nodes_per_step_ == 2 && position_.size() % 2 == 1);
    const auto lanes = static_cast<std::size_t>(lanes_);
    const int at = columns_in(excitation_) + pace_period;
    for (std::size_t l = 0; l < lanes; ++l) {
        double time = any_before_ && mesh == last_mesh_ + 1 ? end_time_[l] : mesh * period_[l];
        time_[l] = time;
        for (std::size_t n = 2; n < position_.size(); n += 2) {
            const double h = position_[n] - position_[n - 2];
            const double a = value(n - 2, at)[l], b = value(n - 1, at)[l], c = value(n, at)[l];
            time_[(n - 1) * lanes + l] = std::fma(h / 24.0, 5.0 * a + 8.0 * b - c, time);
            time = std::fma(h / 6.0, a + 4.0 * b + c, time);
            time_[n * lanes + l] = time;
        }
        end_time_[l] = time;
    }
}

}  // namespace gearpod::lockstep
