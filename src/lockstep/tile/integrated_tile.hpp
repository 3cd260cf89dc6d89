// Tile during time integration: its state and records, the integration to the periodic orbit, and
// over a span.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/mesh_forces.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "lockstep/tile/tooth_contact.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

// Tile during time integration: its state and records, and the integration to the periodic orbit.
template <int W>
class IntegratedTile {
  public:
    // The object refers to everything that `tile` refers to, and to `tooth_errors` and
    // `excitation`; all must outlive it. The last two may be null.
    IntegratedTile(const TileInputs& tile, const Convergence& convergence,
                   const ToothErrors* tooth_errors, const Excitation* excitation)
        : tile_(tile),
          plan_(tile.plan),
          schedule_(tile.plan, tile.faults, tooth_errors),
          convergence_(convergence),
          mesh_integrator_(make_mesh_integrator<W>(plan_, tile.gearboxes)),
          excited_integrator_(make_excited(tile, excitation)),
          excitation_repeats_(excitation != nullptr && excitation->repeats()),
          rotation_(plan_.layout, tile.gearboxes),
          state_(equilibrium_state(plan_, tile.gearboxes)) {
        if (dynamics::separates(plan_.mesh_law)) {
            contact_.emplace(plan_, dynamics::mesh_periods_s(tile.gearboxes));
            separation_time_.assign(static_cast<std::size_t>(plan_.nodes.pairs) * W, 0.0);
        }
        result_.status.assign(W, LaneStatus::ok);
    }

  protected:
    // A larger motion counts as diverged.
    static constexpr double kDivergedMotion_m = 1.0;

    bool faulty(LaneId lane) const {
        return tile_.faults.faulty(lane) && result_.status[lane] == LaneStatus::ok;
    }

    static std::unique_ptr<ExcitedIntegrator<W>> make_excited(const TileInputs& tile,
                                                              const Excitation* excitation) {
        if (excitation == nullptr) {
            return nullptr;
        }
        if constexpr (W <= 8) {
            return make_excited_integrator<W>(tile.plan, *excitation, tile.gearboxes);
        } else {
            throw std::invalid_argument(
                "time-varying excitation needs double precision, at most 8 lanes");
        }
    }

    // Integrates mesh period `mesh` under its input excitation.
    void integrate_mesh(int mesh, const MeshOverrides& overrides, MeshRecord& record) {
        integrate(excited_integrator_ != nullptr, mesh, overrides, record);
    }

    // Sets TileResult::contact_loss from this many counted mesh periods; NaN in diverged lanes.
    void add_contact_loss(int meshes) {
        if (!contact_) {
            return;
        }
        result_.contact_loss = separation_time_;
        for (std::size_t i = 0; i < separation_time_.size(); ++i) {
            result_.contact_loss[i] /= contact_->time_engaged(PairId{i / W}) * meshes;
        }
        for (LaneId l{0}; l < W; ++l) {
            if (result_.status[l] == LaneStatus::diverged) {
                fill_lane<W>(result_.contact_loss, l, NAN);
            }
        }
    }

    // Integrates a mesh period without a faulty tooth under an excitation that repeats every mesh
    // period.
    void integrate_periodic(MeshRecord& record) {
        integrate(excitation_repeats_, 0, schedule_.periodic_overrides(), record);
    }

    // Integrates a mesh period, under the time-varying excitation if `excited`, and records the
    // mesh forces if the record holds the motion.
    void integrate(bool excited, int mesh, const MeshOverrides& overrides, MeshRecord& record) {
        const bool lends = lend_step_states(record);
        if (excited) {
            (*excited_integrator_)(mesh, overrides, state_, record);
        } else {
            (*mesh_integrator_)(overrides, state_, record);
        }
        finish_mesh(overrides, lends, record);
        rotation_.remove(state_);
    }

    // Lends a record the step states that its mesh forces need, if it has none of its own. Returns
    // true if it did.
    bool lend_step_states(MeshRecord& record) {
        const bool lends = !record.mesh_force.empty() && record.step_states.empty();
        if (lends) {
            record.step_states.swap(step_states_);
            size_step_states(plan_, W, record);
        }
        return lends;
    }

    // Records the mesh forces of an integrated mesh period, and counts it.
    void finish_mesh(const MeshOverrides& overrides, bool lent, MeshRecord& record) {
        if (!record.mesh_force.empty()) {
            if (!mesh_forces_) {
                mesh_forces_.emplace(plan_, tile_.gearboxes);
            }
            mesh_forces_->write(overrides, record);
            if (lent) {
                record.step_states.swap(step_states_);
            }
        }
        ++result_.integrated_meshes;
    }

    MeshRecord new_record(bool with_motion) const { return make_record(plan_, W, with_motion); }

    // Distance of two states relative to the motion. Velocities are weighted at the sensor's band
    // edge, and filtered accelerations by the largest recorded one.
    double distance(const TileState& a, const TileState& b, const MeshRecord& record,
                    LaneId lane) const {
        const double scale = largest<W>(b.q, lane);
        // Lower bound of the scale, so that rounding does not count as motion where the sensor
        // signal is nearly zero.
        const double acceleration =
            std::max(largest<W>(record.acceleration, lane),
                     0.01 * scale * plan_.low_pass_rad_s * plan_.low_pass_rad_s);
        const double dq = largest_difference<W>(a.q, b.q, lane);
        const double dv = largest_difference<W>(a.v, b.v, lane) / plan_.low_pass_rad_s;
        double df = 0.0;
        for (auto i = static_cast<std::size_t>(lane); i < a.filter.size();
             i += 2 * W) {  // outputs of the filter sections; their rates follow
            df = std::max(df, std::abs(a.filter[i] - b.filter[i]));
        }
        const double motion = scale > 0.0 ? std::max(dq, dv) / scale : 0.0;
        return std::max(motion, acceleration > 0.0 ? df / acceleration : 0.0);
    }

    bool diverged(LaneId lane) const {
        return !(largest<W>(state_.q, lane) < kDivergedMotion_m) ||
               !std::isfinite(largest<W>(state_.v, lane)) ||
               !std::isfinite(largest<W>(state_.filter, lane));
    }

    // Removes a diverged lane from the integration: sets its records to NaN and its periodic orbit
    // to zero.
    void mark_diverged(LaneId lane) {
        result_.status[lane] = LaneStatus::diverged;
        for (MeshRecord& record : result_.records) {
            fill_lane<W>(record.acceleration, lane, NAN);
            fill_lane<W>(record.te, lane, NAN);
            fill_lane<W>(record.motion, lane, NAN);
            fill_lane<W>(record.mesh_force, lane, NAN);
        }
        fill_lane<W>(periodic_orbit_.q, lane, 0.0);
        fill_lane<W>(periodic_orbit_.v, lane, 0.0);
        fill_lane<W>(periodic_orbit_.filter, lane, 0.0);
    }

    // Marks the faulty lanes of `lanes` as perturbed if a fault passes in mesh period k. Returns
    // the lanes that were unperturbed before; they start from their healthy state.
    LaneMask<W> start_perturbation(int k, const LaneMask<W>& lanes, LaneMask<W>& perturbed) const {
        const bool passes = schedule_.passes(k);
        LaneMask<W> unperturbed;
        for (LaneId l{0}; l < W; ++l) {
            unperturbed[l] = !perturbed[l];
            perturbed[l] = perturbed[l] || (passes && lanes[l] && faulty(l));
        }
        return unperturbed;
    }

    // Clears the mark of each lane whose motion has returned to `healthy`, the state after mesh
    // period k. A lane's end never depends on the other lanes. Marks diverged lanes.
    void end_perturbation(int k, const TileState& healthy, const MeshRecord& record,
                          LaneMask<W>& perturbed) {
        for (LaneId l{0}; l < W; ++l) {
            auto& is_perturbed = perturbed[l];
            if (is_perturbed && diverged(l)) {
                mark_diverged(l);
                is_perturbed = false;
            } else if (is_perturbed && !schedule_.continues_after(k)) {
                is_perturbed = distance(state_, healthy, record, l) > convergence_.tolerance;
            }
        }
    }

    // Sets the status of lanes that did not converge to their periodic orbit within max_meshes.
    void mark_not_converged(const LaneMask<W>& converged) {
        for (LaneId l{0}; l < W; ++l) {
            if (!converged[l]) {
                result_.status[l] = LaneStatus::not_converged;
            }
        }
    }

    // Integrates until the mesh period of every lane repeats the previous one, and keeps that one
    // as record 0. Returns the lanes that converged.
    LaneMask<W> converge_to_periodic_orbit(bool with_motion) {
        result_.records.push_back(new_record(with_motion));
        periodic_orbit_ = state_;
        MeshRecord record = new_record(with_motion);
        LaneMask<W> converged{};
        for (int mesh = 0; mesh < convergence_.max_meshes; ++mesh) {
            const TileState before = state_;
            integrate_periodic(record);
            LaneMask<W> unconverged;
            std::ranges::transform(converged, unconverged.begin(), std::logical_not());
            copy_lanes<W>(record, result_.records[0], unconverged);
            copy_lanes<W>(state_, periodic_orbit_, unconverged);
            bool any_pending = false;
            for (LaneId l{0}; l < W; ++l) {
                if (converged[l]) {
                    continue;
                }
                const bool lost = diverged(l);
                if (lost) {
                    mark_diverged(l);
                }
                const bool done =
                    lost || distance(state_, before, record, l) <= convergence_.tolerance;
                converged[l] = done;
                any_pending = any_pending || !done;
            }
            if (!any_pending) {
                break;
            }
        }
        state_ = periodic_orbit_;
        return converged;
    }

    const TileInputs tile_;
    const IntegrationPlan& plan_;
    FaultSchedule schedule_;
    const Convergence convergence_;
    const std::unique_ptr<const MeshIntegrator<W>> mesh_integrator_;
    const std::unique_ptr<ExcitedIntegrator<W>>
        excited_integrator_;  // null for a steady excitation
    const bool excitation_repeats_;
    const RigidRotation rotation_;
    std::optional<MeshForces<W>> mesh_forces_;  // present once a record holds motions
    std::optional<ToothContact> contact_;       // present if teeth can separate
    // sums of ToothContact::add_separation_time over the counted mesh periods
    machine::AlignedVector separation_time_;
    // MeshRecord::step_states of mesh periods whose contact loss or mesh forces are computed
    machine::AlignedVector step_states_;
    TileState state_;
    TileState periodic_orbit_;  // healthy periodic orbit at an integer phase
    TileResult result_;
};

// Tile during the time integration of every mesh period of a span.
template <int W>
class SpanTile : protected IntegratedTile<W> {
  protected:
    // Takes the arguments of IntegratedTile; `span` must outlive the object too.
    SpanTile(const TileInputs& tile, const Convergence& convergence, const RecordedSpan& span,
             const ToothErrors* tooth_errors, const Excitation* excitation)
        : Base(tile, convergence, tooth_errors, excitation), span_(span) {
        result_.content.assign(static_cast<std::size_t>(span.meshes), kUnchanged);
    }

    // Converges to the periodic orbit, from which the span and its run-in start. Returns the lanes
    // that converged.
    LaneMask<W> start() {
        const LaneMask<W> converged = converge_to_periodic_orbit(false);
        // Separating teeth need not have a periodic motion, and full integration does not require
        // one.
        if (!dynamics::separates(plan_.mesh_law)) {
            mark_not_converged(converged);
        }
        return converged;
    }

    bool is_recorded(int k) const {
        return k >= 0 &&
               (span_.parts.empty() || std::ranges::any_of(span_.parts, [&](const SpanPart& part) {
                    return k >= part.first && k < part.end;
                }));
    }

    bool counts_contact_in(int k) const {
        return contact_ && is_recorded(k) && counts_contact(k, span_.options.motion_meshes);
    }

    // Integrates mesh period k of the span, and adds the contact loss of the lanes in the mask.
    void integrate_counting_contact(int k, const MeshOverrides& overrides, MeshRecord& record,
                                    const LaneMask<W>& lanes) {
        if (!counts_contact_in(k)) {
            integrate_mesh(k, overrides, record);
            return;
        }
        record.step_states.swap(step_states_);
        size_step_states(plan_, W, record);
        integrate_mesh(k, overrides, record);
        contact_->add_separation_time(record, overrides, lanes, separation_time_);
        record.step_states.swap(step_states_);
    }

    // Clears the contact loss of superposed lanes, whose tooth pairs never separate.
    void clear_contact_loss(const LaneMask<W>& lanes) {
        for (LaneId l{0}; l < W; ++l) {
            if (lanes[l]) {
                fill_lane<W>(separation_time_, l, 0.0);
            }
        }
    }

    // Sets TileResult::contact_loss after the mesh periods of the span.
    void add_contact_loss_of_span() {
        int meshes = 0;
        for (int k = 0; k < span_.meshes; ++k) {
            meshes += counts_contact_in(k) ? 1 : 0;
        }
        add_contact_loss(meshes);
    }

    // True if any record of the span holds motions.
    bool with_motion() const { return span_.options.motion_meshes > 0; }

    MeshRecord& add_record(int k) {
        result_.content[static_cast<std::size_t>(k)] = static_cast<int>(result_.records.size());
        return result_.records.emplace_back(new_record(k < span_.options.motion_meshes));
    }

    MeshRecord& record_of(int k) {
        return result_
            .records[static_cast<std::size_t>(result_.content[static_cast<std::size_t>(k)])];
    }

    // Integrates every mesh period of the span, or those of its parts, after their run-in. Each
    // goes into its own record, or to RecordedSpan::on_record if `streamed`. Diverged lanes are
    // marked unless they are `unused`.
    void integrate_span(bool streamed, const LaneMask<W>& unused = {}) {
        MeshRecord scratch = new_record(streamed && with_motion());
        const auto keep_state = [&] {
            if (span_.options.states) {
                result_.states.all.push_back(state_);
            }
        };
        result_.states.run_in_meshes = span_.run_in_meshes;
        LaneMask<W> all;
        all.fill(true);
        const std::vector<SpanPart> whole{{0, span_.meshes}};
        int k = std::numeric_limits<int>::min();
        for (const auto& [first, end] : span_.parts.empty() ? whole : span_.parts) {
            for (k = std::max(k, first - span_.run_in_meshes); k < end; ++k) {
                keep_state();
                const bool recorded = k >= first;
                integrate_counting_contact(k, schedule_.all_overrides(k),
                                           !recorded || streamed ? scratch : add_record(k), all);
                if (recorded && streamed) {
                    span_.on_record(k, scratch);
                }
            }
        }
        keep_state();
        if (!streamed && !span_.parts.empty()) {
            std::ranges::replace(result_.content, kUnchanged,
                                 result_.content[static_cast<std::size_t>(span_.parts[0].first)]);
        }
        mark_diverged_lanes(unused);
    }

    void mark_diverged_lanes(const LaneMask<W>& unused = {}) {
        for (LaneId l{0}; l < W; ++l) {
            const auto lane = l;
            if (!unused[lane] && result_.status[lane] == LaneStatus::ok && diverged(l)) {
                mark_diverged(l);
            }
        }
    }

    const RecordedSpan& span_;

    using Base = IntegratedTile<W>;
    using Base::add_contact_loss, Base::contact_, Base::converge_to_periodic_orbit, Base::diverged,
        Base::integrate_mesh, Base::mark_diverged, Base::mark_not_converged, Base::new_record,
        Base::plan_, Base::result_, Base::schedule_, Base::separation_time_, Base::state_,
        Base::step_states_;
};

}  // namespace gearpod::lockstep
