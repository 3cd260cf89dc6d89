#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/strategies/solution.hpp"
#include "lockstep/tile/mesh_forces.hpp"
#include "lockstep/tile/static_lanes.hpp"
#include "lockstep/tile/tooth_contact.hpp"
#include "machine/team.hpp"

namespace gearpod::lockstep {
namespace {

double largest_stiffness(const StiffnessNodes& nodes) {
    return *std::ranges::max_element(nodes.stiffness);
}

// Springs per pair under unilateral contact; a single one carries the whole load if tooth pairs are
// not resolved.
int contacts_of(const IntegrationPlan& plan) {
    return plan.mesh_law == dynamics::MeshLaw::unilateral ? std::max(1, plan.nodes.contacts()) : 0;
}

template <int W>
class QuasiStaticTile {
  public:
    // `tooth_errors` and `forces` may be null.
    QuasiStaticTile(const TileInputs& tile, const ToothErrors* tooth_errors,
                    const VaryingForces* forces)
        : plan_(tile.plan),
          faults_(tile.faults),
          schedule_(tile.plan, tile.faults, tooth_errors),
          lanes_(make_static_lanes<W>(plan_.layout, plan_.mesh_law, tile.gearboxes,
                                      largest_stiffness(plan_.nodes), contacts_of(plan_))),
          steady_force_(lanes_.force),
          state_(lanes_),
          mesh_forces_(plan_, tile.gearboxes) {
        if (dynamics::separates(plan_.mesh_law)) {
            contact_.emplace(plan_, dynamics::mesh_periods_s(tile.gearboxes));
            const auto pairs = static_cast<std::size_t>(plan_.nodes.pairs);
            contact_time_.engaged.assign(pairs, 0.0);
            contact_time_.apart.assign(pairs * W, 0.0);
        }
        result_.status.assign(W, LaneStatus::ok);
        if (forces != nullptr) {
            set_up_excitation(*forces, tile.gearboxes);
        }
        if (plan_.grid.stage_nodes.front() != 0.0) {
            throw std::invalid_argument(
                "a quasi-static tile needs the stiffness at the start of every step");
        }
    }

    TileResult solve_pattern(bool with_motion) {
        add_record(0, schedule_.periodic_overrides(), with_motion, true);
        for (int k = 0; k < faults_.pattern.length; ++k) {
            const MeshOverrides overrides = schedule_.pattern_overrides(k);
            result_.content.push_back(
                overrides.faults.empty() ? 0 : add_record(0, overrides, with_motion, false));
        }
        return finish();
    }

    TileResult solve_span(const StaticSpan& span) {
        add_record(0, schedule_.periodic_overrides(), span.motion_meshes > 0, false);
        for (int k = 0; k < span.meshes; ++k) {
            result_.content.push_back(add_record(k, schedule_.all_overrides(k),
                                                 k < span.motion_meshes,
                                                 counts_contact(k, span.motion_meshes)));
        }
        return finish();
    }

  private:
    TileResult finish() {
        result_.contact_loss = contact_time_.ratio();
        mark_unsupported_lanes();
        return std::move(result_);
    }

    void load_meshes(const MeshOverrides& overrides, int step) {
        const int pairs = plan_.nodes.pairs;
        const int nodes = static_cast<int>(plan_.grid.stage_nodes.size());
        const auto shared = static_cast<std::size_t>(step * nodes * pairs);
        for (std::size_t i = 0; i < state_.k.size(); ++i) {
            state_.k[i] = plan_.nodes.stiffness[shared + i / W];
            state_.e[i] = plan_.nodes.error.empty() ? 0.0 : plan_.nodes.error[shared + i / W];
        }
        for (const PairOverride& o : overrides.faults) {
            if (o.first_step <= step && step < o.last_step) {
                std::copy_n(o.stiffness.begin() + (step - o.first_step) * nodes * W, W,
                            state_.k.begin() + o.pair * W);
            }
        }
        if (lanes_.contacts > 0) {
            load_contacts(overrides, step);
        }
    }

    void load_contacts(const MeshOverrides& overrides, int step) {
        const int nodes = static_cast<int>(plan_.grid.stage_nodes.size());
        const auto known = static_cast<std::size_t>(plan_.nodes.contacts());
        const std::size_t pairs = static_cast<std::size_t>(plan_.nodes.pairs), rows = pairs * W;
        const std::size_t first = static_cast<std::size_t>(step * nodes) * known * pairs;
        for (std::size_t i = 0; i < known * rows; ++i) {
            state_.tooth_k[i] = plan_.nodes.tooth_stiffness[first + i / W];
            state_.tooth_e[i] =
                plan_.nodes.tooth_gap.empty() ? 0.0 : plan_.nodes.tooth_gap[first + i / W];
        }
        if (known == 0) {  // one spring carries the whole load
            std::copy(state_.k.begin(), state_.k.end(), state_.tooth_k.begin());
            std::ranges::fill(state_.tooth_e, 0.0);
        }
        for (const PairOverride& o : overrides.faults) {
            if (step < o.first_step || step >= o.last_step || o.tooth_stiffness.empty()) {
                continue;
            }
            const auto offset = static_cast<std::size_t>((step - o.first_step) * nodes) * known * W;
            for (std::size_t j = 0; j < known; ++j) {
                std::copy_n(o.tooth_stiffness.data() + offset + j * W, W,
                            tooth_row(state_.tooth_k, j, o.pair));
            }
        }
        const auto slices = static_cast<std::size_t>(plan_.nodes.slices);
        for (const PairGaps& g : overrides.gaps) {
            if (step < g.first_step || step >= g.last_step) {
                continue;
            }
            for (std::size_t j = 0; j < known; ++j) {
                const double position =
                    plan_.nodes
                        .tooth_position[first + j * pairs + static_cast<std::size_t>(g.pair)];
                double* const row = tooth_row(state_.tooth_e, j, g.pair);
                const std::size_t first_lane = j / slices * W;
                for (LaneId l{0}; l < W; ++l) {
                    row[l] = std::fma(position, g.growth[first_lane + l], g.gap[first_lane + l]) +
                             row[l];
                }
            }
        }
        for (std::size_t i = 0; i < known * rows && !overrides.wear.empty(); ++i) {
            double& gap = state_.tooth_e[i];
            gap = std::fma(plan_.nodes.tooth_wear[first + i / W], overrides.wear[i % W], gap);
        }
    }

    // Row of one spring in [contact][pair][lane].
    template <class Rows>
    double* tooth_row(Rows& rows, std::size_t slot, PairId pair) const {
        return rows.data() + (slot * static_cast<std::size_t>(plan_.nodes.pairs) + pair) * W;
    }

    void set_up_excitation(const VaryingForces& forces,
                           std::span<const dynamics::GearboxInputs> inputs) {
        static_cast<VaryingForces&>(excitation_) = forces;
        forces_ = make_excitation_forces<W>(plan_, excitation_, inputs, false);
        rows_ = std::make_unique<ExcitationRows>(plan_, excitation_, inputs);
        forces_.rows = rows_->rows().data();
        for (LaneId l{0}; l < W; ++l) {
            for (int e = 0; e < forces_.first[forces_.columns]; ++e) {
                lanes_.force_size[l] =
                    std::max(lanes_.force_size[l], std::abs(forces_.pattern[e][l]));
            }
        }
    }

    void load_forces(int step) {
        if (rows_ != nullptr) {
            lanes_.force = steady_force_;
            forces_.add(forces_.row(step, 0), lanes_.force.data());
        }
    }

    // Solves and records one mesh period, and returns the index of its record. `counted` adds it to
    // the contact loss.
    int add_record(int mesh, const MeshOverrides& overrides, bool with_motion, bool counted) {
        machine::throw_if_cancelled();
        if (rows_ != nullptr) {
            rows_->fill(mesh);
        }
        MeshRecord record = make_record(plan_, W, with_motion);
        record.acceleration.clear();
        const int steps = static_cast<int>(plan_.grid.steps.size());
        for (int i = 0; i < steps; ++i) {
            const int sample = plan_.grid.steps[static_cast<std::size_t>(i)].sample;
            if (sample >= 0) {
                load_meshes(overrides, i);
                load_forces(i);
                solve_static(lanes_, state_);
                write(static_cast<std::size_t>(sample), record);
                if (with_motion) {
                    mesh_forces_.at(i, overrides, state_.q, std::vector<double>(state_.q.size()),
                                    record.mesh_force.data() + sample * plan_.nodes.pairs * W);
                }
                note_status();
                if (counted && contact_) {
                    contact_->add_position(i, state_.q, overrides, 1.0 / plan_.grid.samples,
                                           contact_time_);
                }
            }
        }
        result_.records.push_back(std::move(record));
        ++result_.integrated_meshes;
        return static_cast<int>(result_.records.size()) - 1;
    }

    void write(std::size_t sample, MeshRecord& record) const {
        for (LaneId l{0}; l < W; ++l) {
            double te = 0.0;
            for (std::size_t d = plan_.te_weight.size(); d-- > 0;) {
                te = std::fma(plan_.te_weight[d], state_.q[d * W + l], te);
            }
            record.te[sample * W + l] = te;
        }
        if (!record.motion.empty()) {
            std::copy(
                state_.q.begin(), state_.q.end(),
                record.motion.begin() + static_cast<std::ptrdiff_t>(sample * state_.q.size()));
        }
    }

    void note_status() {
        for (LaneId l{0}; l < W; ++l) {
            LaneStatus& status = result_.status[l];
            if (state_.unsupported[l] != 0.0) {
                status = LaneStatus::diverged;
            } else if (state_.contacts_changed[l] != 0.0 && status == LaneStatus::ok) {
                status = LaneStatus::not_converged;
            }
        }
    }

    void mark_unsupported_lanes() {
        for (LaneId l{0}; l < W; ++l) {
            if (result_.status[l] != LaneStatus::diverged) {
                continue;
            }
            for (std::size_t i = l; i < result_.contact_loss.size(); i += W) {
                result_.contact_loss[i] = NAN;
            }
            for (MeshRecord& record : result_.records) {
                for (auto* values : {&record.te, &record.motion, &record.mesh_force}) {
                    for (std::size_t i = l; i < values->size(); i += W) {
                        (*values)[i] = NAN;
                    }
                }
            }
        }
    }

    const IntegrationPlan& plan_;
    const FaultCurves& faults_;
    FaultSchedule schedule_;
    StaticLanes<W> lanes_;
    const machine::AlignedVector steady_force_;
    Excitation excitation_;                 // the varying forces
    ExcitationForces<W> forces_;            // used only with
    std::unique_ptr<ExcitationRows> rows_;  // varying forces
    StaticState<W> state_;
    MeshForces<W> mesh_forces_;
    std::optional<ToothContact> contact_;  // present if teeth can separate
    ContactTime contact_time_;
    TileResult result_;
};

// Repeats the pattern of a result over the mesh periods of a span.
TileResult over_span(TileResult result, int meshes) {
    const std::vector<int> pattern = std::move(result.content);
    result.content.clear();
    for (int k = 0; k < meshes; ++k) {
        result.content.push_back(pattern[static_cast<std::size_t>(k) % pattern.size()]);
    }
    return result;
}

}  // namespace

template <int W>
TileResult QuasiStaticSolution::run(const TileInputs& tile) const {
    if constexpr (W > 8) {
        throw std::invalid_argument("quasi-static tiles have at most 8 lanes");
    } else if (const auto* const pattern = std::get_if<StaticPattern>(&meshes)) {
        VaryingForces weight;
        if (pattern->gravity) {
            weight.gravity = Gravity{*pattern->gravity};
        }
        return QuasiStaticTile<W>(tile, nullptr, pattern->gravity ? &weight : nullptr)
            .solve_pattern(pattern->with_motion);
    } else {
        const StaticSpan& span = std::get<StaticSpan>(meshes);
        QuasiStaticTile<W> static_tile(tile, span.tooth_errors, span.forces);
        return span.tooth_errors == nullptr && (span.forces == nullptr || span.forces->repeat())
                   ? over_span(static_tile.solve_pattern(span.motion_meshes > 0), span.meshes)
                   : static_tile.solve_span(span);
    }
}

template TileResult QuasiStaticSolution::run<1>(const TileInputs&) const;
template TileResult QuasiStaticSolution::run<4>(const TileInputs&) const;
template TileResult QuasiStaticSolution::run<8>(const TileInputs&) const;
template TileResult QuasiStaticSolution::run<16>(const TileInputs&) const;

}  // namespace gearpod::lockstep
