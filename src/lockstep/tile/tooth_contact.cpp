#include "lockstep/tile/tooth_contact.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "dynamics/gearbox.hpp"

namespace gearpod::lockstep {
namespace {

constexpr int kStretches = 24;  // of a mesh period
constexpr double kPlaceRounding = 1e-9;

// Static transmission error of a pair at a stage node, m.
double static_error(const MarchPlan& plan, int step, std::size_t node, int pair) {
    const StiffnessNodes& nodes = plan.nodes;
    const std::size_t at = (static_cast<std::size_t>(step) * plan.grid.stage_nodes.size() + node) *
                               static_cast<std::size_t>(nodes.pairs) +
                           static_cast<std::size_t>(pair);
    return nodes.error.empty() ? 0.0 : nodes.error[at];
}

}  // namespace

// The gaps of a pair that differ between lanes, step by step.
class ToothContact::OwnGaps {
  public:
    OwnGaps(std::span<const PairGaps> all, int pair) : all_(all), pair_(pair) {}

    const PairGaps* at(int step) {
        if (now_ == nullptr || step < now_->first_step || step >= now_->last_step) {
            now_ = gaps_of_pair(all_, pair_, step);
        }
        return now_;
    }

  private:
    std::span<const PairGaps> all_;
    int pair_;
    const PairGaps* now_ = nullptr;
};

ToothContact::ToothContact(const MarchPlan& plan, std::vector<double> mesh_period_s)
    : plan_(plan),
      mesh_period_s_(std::move(mesh_period_s)),
      slots_(static_cast<std::size_t>(std::max(1, plan.nodes.tooth_pairs))),
      nodes_(static_cast<std::size_t>(plan.nodes.pairs)),
      engaged_(static_cast<std::size_t>(plan.nodes.pairs), 0.0) {
    const int steps = static_cast<int>(plan.grid.steps.size());
    for (int pair = 0; pair < plan.nodes.pairs; ++pair) {
        for (int step = 0; step < steps; ++step) {
            for (std::size_t node = 0; node < plan.grid.stage_nodes.size(); ++node) {
                add_node(pair, step, node);
            }
        }
        const Eigen::VectorXd row = dynamics::mesh_row(plan.layout, pair);
        row_.emplace_back();
        for (Eigen::Index i = 0; i < row.size(); ++i) {
            if (row(i) != 0.0) {
                row_.back().push_back({static_cast<std::size_t>(i), row(i)});
            }
        }
    }
}

void ToothContact::add_node(int pair, int step, std::size_t node) {
    const auto p = static_cast<std::size_t>(pair);
    const double length = plan_.grid.steps[static_cast<std::size_t>(step)].length;
    Node own{step,
             node == 0,
             plan_.grid.stage_nodes[node],
             length,
             static_error(plan_, step, node, pair),
             {}};
    if (plan_.nodes.tooth_pairs == 0) {  // one carries all
        own.teeth.push_back({0, 0.0, 0.0, true});
    }
    for (int slot = 0; slot < plan_.nodes.tooth_pairs; ++slot) {
        const int n = static_cast<int>(node);
        const std::size_t at = tooth_pair_at(plan_, step, n, slot, pair);
        if (plan_.nodes.tooth_stiffness[at] > 0.0) {
            const double place = plan_.nodes.tooth_place[at];
            own.teeth.push_back({static_cast<std::size_t>(slot), place,
                                 tooth_gap(plan_, {}, pair, step, n, slot, 0),
                                 std::abs(place) <= 0.5 + kPlaceRounding});
        }
    }
    for (const Tooth& tooth : own.teeth) {
        engaged_[p] += own.first && tooth.nominal ? length : 0.0;
    }
    nodes_[p].push_back(std::move(own));
}

void ToothContact::ask_for_steps(MeshRecord& record) const {
    record.step_states.resize(2 * (plan_.grid.steps.size() + 1) *
                              static_cast<std::size_t>(dynamics::degrees_of_freedom(plan_.layout)) *
                              mesh_period_s_.size());
}

// d += sign times the pair's deflection or its rate at the steps' ends; `first_degree`: where the
// positions or the velocities begin in a row of step states.
void ToothContact::deflect(const MeshRecord& record, int pair, double sign,
                           std::size_t first_degree, machine::AlignedVector& d) const {
    const std::size_t lanes = mesh_period_s_.size(), rows = plan_.grid.steps.size() + 1;
    const std::size_t width = record.step_states.size() / rows;
    for (const Entry& entry : row_[static_cast<std::size_t>(pair)]) {
        const double weight = sign * entry.weight;
        const double* __restrict from =
            record.step_states.data() + (first_degree + entry.degree) * lanes;
        double* __restrict out = d.data();
        for (std::size_t row = 0; row < rows; ++row) {
#pragma omp simd
            for (std::size_t l = 0; l < lanes; ++l) {
                out[row * lanes + l] += weight * from[row * width + l];
            }
        }
    }
}

machine::AlignedVector ToothContact::least_pressing(const MeshRecord& record,
                                                    std::span<const PairGaps> gaps,
                                                    const MeshRecord* orbit) const {
    const std::size_t lanes = mesh_period_s_.size(), rows = plan_.grid.steps.size() + 1;
    const std::size_t degrees = record.step_states.size() / (2 * rows * lanes);
    const auto pairs = nodes_.size();
    machine::AlignedVector least(kStretches * pairs * slots_ * lanes, INFINITY);
    machine::AlignedVector d(lanes), at(rows * lanes), rate(rows * lanes);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const int p = static_cast<int>(pair);
        std::ranges::fill(at, 0.0);
        std::ranges::fill(rate, 0.0);
        deflect(record, p, 1.0, 0, at);
        deflect(record, p, 1.0, degrees, rate);
        if (orbit != nullptr) {
            deflect(*orbit, p, -1.0, 0, at);
            deflect(*orbit, p, -1.0, degrees, rate);
        }
        OwnGaps own(gaps, p);
        for (const Node& node : nodes_[pair]) {
            const std::size_t before = static_cast<std::size_t>(node.step) * lanes;
            const std::size_t after = before + lanes;
            const double left = 1.0 - node.part;
            for (std::size_t l = 0; l < lanes; ++l) {
                const double h = node.length * mesh_period_s_[l];
                const double chord = at[before + l] + node.part * (at[after + l] - at[before + l]);
                const double forward = at[before + l] + node.part * h * rate[before + l];
                const double backward = at[after + l] - left * h * rate[after + l];
                const bool inside = node.part > 0.0 && left > 0.0;
                const double lowest = inside ? std::min({chord, forward, backward}) : chord;
                d[l] = orbit == nullptr ? lowest - node.error : lowest;
            }
            const PairGaps* const lane_gaps = own.at(node.step);
            const auto stretch = static_cast<std::size_t>(
                kStretches * plan_.grid.steps[static_cast<std::size_t>(node.step)].phase);
            for (const Tooth& tooth : node.teeth) {
                double* const row =
                    least.data() + ((stretch * pairs + pair) * slots_ + tooth.slot) * lanes;
                for (std::size_t l = 0; l < lanes; ++l) {
                    const std::size_t i = tooth.slot * lanes + l;
                    double gap = orbit == nullptr ? tooth.shared : 0.0;
                    if (lane_gaps != nullptr) {
                        gap += std::fma(tooth.place, lane_gaps->growth[i], lane_gaps->gap[i]);
                    }
                    const double pressed = d[l] - gap;
                    // NaN is no contact.
                    row[l] = pressed > row[l]         ? row[l]
                             : std::isfinite(pressed) ? pressed
                                                      : -INFINITY;
                }
            }
        }
    }
    return least;
}

// `d` holds the pair's deflection in each lane; no mask stands for all lanes.
void ToothContact::add_apart(const Node& node, std::size_t pair, const double* d,
                             const PairGaps* own, double weight, std::span<const bool> lanes,
                             machine::AlignedVector& apart) const {
    const std::size_t width = mesh_period_s_.size();
    for (const Tooth& tooth : node.teeth) {
        if (!tooth.nominal) {
            continue;
        }
        for (std::size_t l = 0; l < width; ++l) {
            const std::size_t i = tooth.slot * width + l;
            const double gap =
                own != nullptr ? std::fma(tooth.place, own->growth[i], own->gap[i]) : 0.0;
            const bool pressed = d[l] - node.error > tooth.shared + gap;
            const bool counted = lanes.empty() || lanes[l];
            apart[pair * width + l] += counted && !pressed ? weight : 0.0;
        }
    }
}

void ToothContact::add_time_apart(const MeshRecord& record, std::span<const PairGaps> gaps,
                                  std::span<const bool> lanes,
                                  machine::AlignedVector& apart) const {
    const std::size_t width = mesh_period_s_.size();
    machine::AlignedVector at((plan_.grid.steps.size() + 1) * width), d(width);
    for (std::size_t pair = 0; pair < nodes_.size(); ++pair) {
        const int p = static_cast<int>(pair);
        std::ranges::fill(at, 0.0);
        deflect(record, p, 1.0, 0, at);
        OwnGaps own(gaps, p);
        for (const Node& node : nodes_[pair]) {
            if (!node.first) {
                continue;
            }
            const double* const before = at.data() + static_cast<std::size_t>(node.step) * width;
            for (std::size_t l = 0; l < width; ++l) {
                d[l] = before[l] + node.part * (before[width + l] - before[l]);
            }
            add_apart(node, pair, d.data(), own.at(node.step), node.length, lanes, apart);
        }
    }
}

void ToothContact::add_position(int step, const machine::AlignedVector& q,
                                std::span<const PairGaps> gaps, double weight,
                                ContactTime& time) const {
    const std::size_t width = mesh_period_s_.size(), stages = plan_.grid.stage_nodes.size();
    machine::AlignedVector d(width);
    for (std::size_t pair = 0; pair < nodes_.size(); ++pair) {
        std::ranges::fill(d, 0.0);
        for (const Entry& entry : row_[pair]) {
            for (std::size_t l = 0; l < width; ++l) {
                d[l] += entry.weight * q[entry.degree * width + l];
            }
        }
        const Node& node = nodes_[pair][static_cast<std::size_t>(step) * stages];
        for (const Tooth& tooth : node.teeth) {
            time.engaged[pair] += tooth.nominal ? weight : 0.0;
        }
        add_apart(node, pair, d.data(), gaps_of_pair(gaps, static_cast<int>(pair), step), weight,
                  {}, time.apart);
    }
}

machine::AlignedVector ContactTime::ratio() const {
    machine::AlignedVector all = apart;
    const std::size_t width = engaged.empty() ? 0 : apart.size() / engaged.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] /= engaged[i / width];
    }
    return all;
}

}  // namespace gearpod::lockstep
