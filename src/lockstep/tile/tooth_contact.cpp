#include "lockstep/tile/tooth_contact.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "dynamics/gearbox.hpp"

namespace gearpod::lockstep {
namespace {

constexpr int kStretches = 24;  // per mesh period

// Static transmission error of a pair at a stage node, m.
double static_error(const IntegrationPlan& plan, int step, std::size_t node, PairId pair) {
    const StiffnessNodes& nodes = plan.nodes;
    const std::size_t index =
        (static_cast<std::size_t>(step) * plan.grid.stage_nodes.size() + node) *
            static_cast<std::size_t>(nodes.pairs) +
        pair;
    return nodes.error.empty() ? 0.0 : nodes.error[index];
}

}  // namespace

// Lane-dependent gaps of a pair, step by step.
class ToothContact::LaneGaps {
  public:
    // `size` is the number of tooth pairs times lanes. `wear` may be null.
    LaneGaps(std::span<const PairGaps> all, const machine::AlignedVector* wear, PairId pair,
             std::size_t size)
        : all_(all), wear_(wear), pair_(pair), none_(size, 0.0) {}

    // [tooth pair][lane], m.
    struct Rows {
        const double* gap;
        const double* growth;
    };
    Rows at(int step) {
        if (now_ == nullptr || step < now_->first_step || step >= now_->last_step) {
            now_ = gaps_of_pair(all_, pair_, step);
        }
        return now_ == nullptr ? Rows{none_.data(), none_.data()}
                               : Rows{now_->gap.data(), now_->growth.data()};
    }
    // Depth of the wear, [lane], m.
    const double* wear() const {
        return wear_ == nullptr || wear_->empty() ? none_.data() : wear_->data();
    }

  private:
    std::span<const PairGaps> all_;
    const machine::AlignedVector* wear_;
    PairId pair_;
    const machine::AlignedVector none_;
    const PairGaps* now_ = nullptr;
};

ToothContact::ToothContact(const IntegrationPlan& plan, std::vector<double> mesh_period_s)
    : plan_(plan),
      mesh_period_s_(std::move(mesh_period_s)),
      contacts_(static_cast<std::size_t>(std::max(1, plan.nodes.contacts()))),
      nodes_(static_cast<std::size_t>(plan.nodes.pairs)),
      engaged_(static_cast<std::size_t>(plan.nodes.pairs), 0.0) {
    const int steps = static_cast<int>(plan.grid.steps.size());
    for (PairId pair{0}; pair < plan.nodes.pairs; ++pair) {
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

void ToothContact::add_node(PairId pair, int step, std::size_t node) {
    const double length = plan_.grid.steps[static_cast<std::size_t>(step)].length;
    Node pair_node{step,
                   node == 0,
                   plan_.grid.stage_nodes[node],
                   length,
                   static_error(plan_, step, node, pair),
                   {}};
    if (plan_.nodes.tooth_pairs == 0) {  // one spring carries the whole load
        pair_node.teeth.push_back({0, 0, 0.0, 0.0, 0.0, 1.0});
    }
    const bool gaps = !plan_.nodes.tooth_gap.empty(), worn = !plan_.nodes.tooth_wear.empty();
    for (int contact = 0; contact < plan_.nodes.contacts(); ++contact) {
        const int n = static_cast<int>(node);
        const std::size_t index = tooth_pair_at(plan_, step, n, contact, pair);
        if (plan_.nodes.tooth_stiffness[index] > 0.0) {
            const double position = plan_.nodes.tooth_position[index];
            pair_node.teeth.push_back({static_cast<std::size_t>(contact),
                                       static_cast<std::size_t>(contact / plan_.nodes.slices),
                                       position,
                                       tooth_gap(plan_, {}, pair, step, n, contact, LaneId{0}),
                                       worn ? plan_.nodes.tooth_wear[index] : 0.0,
                                       gaps ? plan_.nodes.tooth_on_path[index] : 1.0});
        }
    }
    for (const Tooth& tooth : pair_node.teeth) {
        engaged_[pair] += pair_node.first ? tooth.on_path * length : 0.0;
    }
    nodes_[pair].push_back(std::move(pair_node));
}

// Adds sign times the pair's deflection, or its rate, at the step ends to d. `first_degree` is the
// index at which positions or velocities start in a row of step states.
void ToothContact::deflect(const MeshRecord& record, PairId pair, double sign,
                           std::size_t first_degree, machine::AlignedVector& d) const {
    const std::size_t lanes = mesh_period_s_.size(), rows = plan_.grid.steps.size() + 1;
    const std::size_t width = record.step_states.size() / rows;
    for (const Entry& entry : row_[pair]) {
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

// Lower bound of the deflection, m, at a stage node of a step. Positions at which integrators
// evaluate forces lie on the chord, or on the tangents at the step's ends.
void ToothContact::least_deflection(const Node& node, const double* __restrict deflection_start,
                                    const double* __restrict rate, double* __restrict least) const {
    const std::size_t width = mesh_period_s_.size();
    const double part = node.part, left = 1.0 - node.part, length = node.length;
    const double* __restrict period = mesh_period_s_.data();
    if (part == 0.0 || left == 0.0) {
        std::copy_n(deflection_start + (part == 0.0 ? 0 : width), width, least);
        return;
    }
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) {
        const double h = length * period[l];
        const double chord = left * deflection_start[l] + part * deflection_start[width + l];
        const double forward = deflection_start[l] + part * h * rate[l];
        const double backward = deflection_start[width + l] - left * h * rate[width + l];
        const double tangents = forward < backward ? forward : backward;
        least[l] = chord < tangents ? chord : tangents;
    }
}

machine::AlignedVector ToothContact::least_compression(const MeshRecord& record,
                                                       std::span<const PairGaps> gaps,
                                                       const MeshRecord* periodic_orbit) const {
    const std::size_t width = mesh_period_s_.size(), rows = plan_.grid.steps.size() + 1;
    const std::size_t degrees = record.step_states.size() / (2 * rows * width);
    const std::size_t pairs = nodes_.size();
    machine::AlignedVector least(kStretches * pairs * contacts_ * width, INFINITY);
    machine::AlignedVector d(width), at(rows * width), rate(rows * width);
    for (PairId pair{0}; pair < pairs; ++pair) {
        std::ranges::fill(at, 0.0);
        std::ranges::fill(rate, 0.0);
        deflect(record, pair, 1.0, 0, at);
        deflect(record, pair, 1.0, degrees, rate);
        if (periodic_orbit != nullptr) {
            deflect(*periodic_orbit, pair, -1.0, 0, at);
            deflect(*periodic_orbit, pair, -1.0, degrees, rate);
        }
        LaneGaps lane_gaps(gaps, nullptr, pair, contacts_ * width);
        for (const Node& node : nodes_[pair]) {
            const std::size_t before = static_cast<std::size_t>(node.step) * width;
            least_deflection(node, at.data() + before, rate.data() + before, d.data());
            const auto [gap, growth] = lane_gaps.at(node.step);
            const auto stretch = static_cast<std::size_t>(
                kStretches * plan_.grid.steps[static_cast<std::size_t>(node.step)].phase);
            for (const Tooth& tooth : node.teeth) {
                double* __restrict row =
                    least.data() + ((stretch * pairs + pair) * contacts_ + tooth.contact) * width;
                const double shared = periodic_orbit == nullptr ? tooth.shared + node.error : 0.0;
                const double position = tooth.position;
                const double* __restrict constant = gap + tooth.tooth * width;
                const double* __restrict slope = growth + tooth.tooth * width;
                const double* __restrict deflection = d.data();
#pragma omp simd
                for (std::size_t l = 0; l < width; ++l) {
                    const double compression =
                        deflection[l] - shared - (position * slope[l] + constant[l]);
                    row[l] = compression < row[l] ? compression : row[l];
                }
            }
        }
    }
    // A value that is not finite stays so until the end of the mesh period, so checking the end is
    // enough.
    for (std::size_t i = record.step_states.size() - 2 * degrees * width;
         i < record.step_states.size(); ++i) {
        if (!std::isfinite(record.step_states[i])) {
            for (std::size_t row = i % width; row < least.size(); row += width) {
                least[row] = -INFINITY;
            }
        }
    }
    return least;
}

// `d` holds the pair's deflection; `weight` is added in each lane without contact.
void ToothContact::add_separation(const Node& node, PairId pair, const double* __restrict d,
                                  LaneGaps& lane_gaps, const double* __restrict weight,
                                  machine::AlignedVector& apart) const {
    const std::size_t width = mesh_period_s_.size();
    const auto [gap, growth] = lane_gaps.at(node.step);
    const double* __restrict wear = lane_gaps.wear();
    double* __restrict sum = apart.data() + pair * width;
    for (const Tooth& tooth : node.teeth) {
        if (tooth.on_path == 0.0) {
            continue;
        }
        const double shared = tooth.shared + node.error, position = tooth.position;
        const double share = tooth.on_path, unit_gap = tooth.wear;
        const double* __restrict constant = gap + tooth.tooth * width;
        const double* __restrict slope = growth + tooth.tooth * width;
#pragma omp simd
        for (std::size_t l = 0; l < width; ++l) {
            const double compression =
                d[l] - shared - (position * slope[l] + constant[l]) - unit_gap * wear[l];
            sum[l] += compression > 0.0 ? 0.0 : share * weight[l];
        }
    }
}

void ToothContact::add_separation_time(const MeshRecord& record, const MeshOverrides& overrides,
                                       std::span<const bool> lanes,
                                       machine::AlignedVector& apart) const {
    const std::size_t width = mesh_period_s_.size();
    machine::AlignedVector at((plan_.grid.steps.size() + 1) * width), d(width), weight(width);
    for (PairId pair{0}; pair < nodes_.size(); ++pair) {
        std::ranges::fill(at, 0.0);
        deflect(record, pair, 1.0, 0, at);
        LaneGaps lane_gaps(overrides.gaps, &overrides.wear, pair, contacts_ * width);
        for (const Node& node : nodes_[pair]) {
            if (!node.first) {
                continue;
            }
            const double* __restrict before =
                at.data() + static_cast<std::size_t>(node.step) * width;
            const double part = node.part, left = 1.0 - node.part;
            for (std::size_t l = 0; l < width; ++l) {
                d[l] = left * before[l] + part * before[width + l];
                weight[l] = lanes[l] ? node.length : 0.0;
            }
            add_separation(node, pair, d.data(), lane_gaps, weight.data(), apart);
        }
    }
}

void ToothContact::add_position(int step, const machine::AlignedVector& q,
                                const MeshOverrides& overrides, double weight,
                                ContactTime& time) const {
    const std::size_t width = mesh_period_s_.size(), stages = plan_.grid.stage_nodes.size();
    const machine::AlignedVector weights(width, weight);
    machine::AlignedVector d(width);
    for (PairId pair{0}; pair < nodes_.size(); ++pair) {
        std::ranges::fill(d, 0.0);
        for (const Entry& entry : row_[pair]) {
            for (std::size_t l = 0; l < width; ++l) {
                d[l] += entry.weight * q[entry.degree * width + l];
            }
        }
        const Node& node = nodes_[pair][static_cast<std::size_t>(step) * stages];
        for (const Tooth& tooth : node.teeth) {
            time.engaged[pair] += tooth.on_path * weight;
        }
        LaneGaps lane_gaps(overrides.gaps, &overrides.wear, pair, contacts_ * width);
        add_separation(node, pair, d.data(), lane_gaps, weights.data(), time.apart);
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
