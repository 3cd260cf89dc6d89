// Tile during time integration: its state and records, the integration to the periodic orbit, and
// the integration of every mesh period of the span.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/tile/excited_integrator.hpp"
#include "lockstep/tile/mesh_forces.hpp"
#include "lockstep/tile/mesh_integrator.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_lanes.hpp"
#include "lockstep/tile/tile_records.hpp"
#include "lockstep/tile/tooth_contact.hpp"

namespace gearpod::lockstep {

template <int W>
class IntegratedTile {
  public:
    IntegratedTile(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                   const FaultCurves& faults, const TileSettings& settings)
        : plan_(plan),
          faults_(faults),
          schedule_(plan, faults),
          settings_(settings),
          mesh_integrator_(make_mesh_integrator<W>(plan, inputs)),
          excited_integrator_(make_excited(plan, inputs, settings.excitation)),
          rotation_(plan.layout, inputs),
          state_(equilibrium_state(plan, inputs)) {
        if (dynamics::separates(plan.mesh_law)) {
            contact_.emplace(plan, dynamics::mesh_periods_s(inputs));
            separation_time_.assign(static_cast<std::size_t>(plan.nodes.pairs) * W, 0.0);
        }
        if (settings_.with_motion) {
            mesh_forces_.emplace(plan, inputs);
        }
        result_.status.assign(W, LaneStatus::ok);
        result_.content.assign(static_cast<std::size_t>(settings_.recorded_meshes), kUnchanged);
    }

  protected:
    // A larger motion counts as diverged.
    static constexpr double kDivergedMotion_m = 1.0;

    bool faulty(int lane) const {
        return faults_.faulty(lane) &&
               result_.status[static_cast<std::size_t>(lane)] == LaneStatus::ok;
    }

    static std::unique_ptr<ExcitedIntegrator<W>> make_excited(
        const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
        const Excitation* excitation) {
        if (excitation == nullptr) {
            return nullptr;
        }
        if constexpr (W <= 8) {
            return make_excited_integrator<W>(plan, *excitation, inputs);
        } else {
            throw std::invalid_argument("gearboxes that are driven unevenly march in doubles");
        }
    }

    // Integrates mesh period `mesh` under its input excitation.
    void integrate_mesh(int mesh, const MeshOverrides& overrides, MeshRecord& record) {
        integrate(excited_integrator_ != nullptr, mesh, overrides, record);
    }

    // Same for mesh period k of the span; also adds the contact loss of the lanes in the mask.
    void integrate_counting_contact(int k, const MeshOverrides& overrides, MeshRecord& record,
                                    const LaneMask<W>& lanes) {
        if (!contact_ || k < 0 || !counts_contact(k, settings_.contact_meshes)) {
            integrate_mesh(k, overrides, record);
            return;
        }
        record.step_states.swap(step_states_);
        size_step_states(plan_, W, record);
        integrate_mesh(k, overrides, record);
        contact_->add_separation_time(record, overrides.gaps, lanes, separation_time_);
        record.step_states.swap(step_states_);
    }

    // Clears the contact loss of superposed lanes, whose tooth pairs never separate.
    void clear_contact_loss(const LaneMask<W>& lanes) {
        for (int l = 0; l < W; ++l) {
            if (lanes[static_cast<std::size_t>(l)]) {
                fill_lane<W>(separation_time_, l, 0.0);
            }
        }
    }

    // Sets TileResult::contact_loss from this many counted mesh periods; NaN in diverged lanes.
    void add_contact_loss(int meshes) {
        if (!contact_) {
            return;
        }
        result_.contact_loss = separation_time_;
        for (std::size_t i = 0; i < separation_time_.size(); ++i) {
            result_.contact_loss[i] /= contact_->time_engaged(static_cast<int>(i / W)) * meshes;
        }
        for (int l = 0; l < W; ++l) {
            if (result_.status[static_cast<std::size_t>(l)] == LaneStatus::diverged) {
                fill_lane<W>(result_.contact_loss, l, NAN);
            }
        }
    }

    // Same, after integrating the mesh periods of the span.
    void add_contact_loss_of_span() {
        int meshes = 0;
        for (int k = 0; k < settings_.recorded_meshes; ++k) {
            meshes += counts_contact(k, settings_.contact_meshes) ? 1 : 0;
        }
        add_contact_loss(meshes);
    }

    // Same for the healthy mesh period that repeats; integrates it once more.
    void add_periodic_contact_loss() {
        if (!contact_) {
            return;
        }
        LaneMask<W> all;
        all.fill(true);
        MeshRecord record = new_record();
        size_step_states(plan_, W, record);
        state_ = periodic_orbit_;
        integrate_periodic(record);
        state_ = periodic_orbit_;
        contact_->add_separation_time(record, {}, all, separation_time_);
        add_contact_loss(1);
    }

    // Integrates a healthy mesh period under an excitation that repeats every mesh period.
    void integrate_periodic(MeshRecord& record) {
        integrate(excited_integrator_ != nullptr && settings_.excitation->repeats(), 0, {}, record);
    }

    // Integrates a mesh period, under the time-varying excitation if `excited`, and records the
    // mesh forces if requested.
    void integrate(bool excited, int mesh, const MeshOverrides& overrides, MeshRecord& record) {
        const bool sized = !record.step_states.empty();
        if (mesh_forces_ && !sized) {
            record.step_states.swap(step_states_);
            size_step_states(plan_, W, record);
        }
        if (excited) {
            (*excited_integrator_)(mesh, overrides, state_, record);
        } else {
            (*mesh_integrator_)(overrides, state_, record);
        }
        if (mesh_forces_) {
            mesh_forces_->write(overrides, record);
            if (!sized) {
                record.step_states.swap(step_states_);
            }
        }
        ++result_.integrated_meshes;
        rotation_.remove(state_);
    }

    MeshRecord new_record() const { return make_record(plan_, W, settings_.with_motion); }

    // Distance of two states relative to the motion. Velocities are weighted at the sensor's band
    // edge, and filtered accelerations by the largest recorded one.
    double distance(const TileState& a, const TileState& b, const MeshRecord& record,
                    int lane) const {
        const double scale = largest<W>(b.q, lane);
        // Lower bound of the scale, so that rounding does not count as motion where the sensor
        // signal is nearly zero.
        const double acceleration =
            std::max(largest<W>(record.acceleration, lane),
                     0.01 * scale * plan_.low_pass_rad_s * plan_.low_pass_rad_s);
        const double dq = largest_difference<W>(a.q, b.q, lane);
        const double dv = largest_difference<W>(a.v, b.v, lane) / plan_.low_pass_rad_s;
        double df = 0.0;
        for (std::size_t i = static_cast<std::size_t>(lane); i < a.filter.size();
             i += 2 * W) {  // outputs of the filter sections; their rates follow
            df = std::max(df, std::abs(a.filter[i] - b.filter[i]));
        }
        const double motion = scale > 0.0 ? std::max(dq, dv) / scale : 0.0;
        return std::max(motion, acceleration > 0.0 ? df / acceleration : 0.0);
    }

    bool diverged(int lane) const {
        return !(largest<W>(state_.q, lane) < kDivergedMotion_m) ||
               !std::isfinite(largest<W>(state_.v, lane)) ||
               !std::isfinite(largest<W>(state_.filter, lane));
    }

    // Removes a diverged lane from the integration: sets its records to NaN and its periodic orbit
    // to zero.
    void mark_diverged(int lane) {
        result_.status[static_cast<std::size_t>(lane)] = LaneStatus::diverged;
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

    // Sets the status of lanes that did not converge to their periodic orbit within max_meshes.
    void mark_not_converged(const std::array<bool, W>& converged) {
        for (std::size_t l = 0; l < W; ++l) {
            if (!converged[l]) {
                result_.status[l] = LaneStatus::not_converged;
            }
        }
    }

    // Integrates until the mesh period of every lane repeats the previous one, and keeps that one.
    void converge_to_periodic_orbit() {
        result_.records.push_back(new_record());
        periodic_orbit_ = state_;
        MeshRecord record = new_record();
        std::array<bool, W> converged{};
        for (int mesh = 0; mesh < settings_.max_meshes; ++mesh) {
            const TileState before = state_;
            integrate_periodic(record);
            LaneMask<W> unconverged;
            std::ranges::transform(converged, unconverged.begin(), std::logical_not());
            copy_lanes<W>(record, result_.records[0], unconverged);
            copy_lanes<W>(state_, periodic_orbit_, unconverged);
            bool any_pending = false;
            for (int l = 0; l < W; ++l) {
                if (converged[static_cast<std::size_t>(l)]) {
                    continue;
                }
                const bool lost = diverged(l);
                if (lost) {
                    mark_diverged(l);
                }
                const bool done =
                    lost || distance(state_, before, record, l) <= settings_.tolerance;
                converged[static_cast<std::size_t>(l)] = done;
                any_pending = any_pending || !done;
            }
            if (!any_pending) {
                break;
            }
        }
        converged_ = converged;
        // Separating teeth need not have a periodic motion, and full integration does not require
        // one.
        const bool may_be_aperiodic =
            settings_.recorded_meshes > 0 && dynamics::separates(plan_.mesh_law);
        if (!may_be_aperiodic) {
            mark_not_converged(converged);
        }
        state_ = periodic_orbit_;
    }

    // Appends the record of mesh period k of the span.
    MeshRecord& add_record(int k) {
        result_.content[static_cast<std::size_t>(k)] = static_cast<int>(result_.records.size());
        return result_.records.emplace_back(new_record());
    }

    MeshRecord& record_of(int k) {
        return result_
            .records[static_cast<std::size_t>(result_.content[static_cast<std::size_t>(k)])];
    }

    // Integrates every mesh period of the span. Each goes into its own record, or to
    // settings_.on_record if `streamed`.
    void integrate_span(bool streamed) {
        MeshRecord scratch = new_record();
        const auto keep_state = [&] {
            if (settings_.keep_states) {
                result_.states.push_back(state_);
            }
        };
        LaneMask<W> all;
        all.fill(true);
        for (int k = -settings_.run_in_meshes; k < settings_.recorded_meshes; ++k) {
            keep_state();
            integrate_counting_contact(k, schedule_.all_overrides(k),
                                       k < 0 || streamed ? scratch : add_record(k), all);
            if (k >= 0 && streamed) {
                settings_.on_record(k, scratch);
            }
        }
        keep_state();
        for (int l = 0; l < W; ++l) {
            if (result_.status[static_cast<std::size_t>(l)] == LaneStatus::ok && diverged(l)) {
                mark_diverged(l);
            }
        }
    }

    // Passes the kept records to settings_.on_record and discards them.
    void record_sensor_response() {
        for (int k = 0; k < settings_.recorded_meshes; ++k) {
            settings_.on_record(k, record_of(k));
        }
        result_.records.resize(1);
        std::ranges::fill(result_.content, kUnchanged);
    }

    const IntegrationPlan& plan_;
    const FaultCurves& faults_;
    FaultSchedule schedule_;
    const TileSettings& settings_;
    const std::unique_ptr<const MeshIntegrator<W>> mesh_integrator_;
    const std::unique_ptr<ExcitedIntegrator<W>>
        excited_integrator_;  // null for a steady excitation
    const RigidRotation rotation_;
    std::optional<MeshForces<W>> mesh_forces_;  // present if motions are requested
    std::optional<ToothContact> contact_;       // present if teeth can separate
    // sums of ToothContact::add_separation_time over the counted mesh periods
    machine::AlignedVector separation_time_;
    machine::AlignedVector step_states_;  // MeshRecord::step_states of the counted mesh periods
    TileState state_;
    TileState periodic_orbit_;  // healthy periodic orbit at an integer phase
    LaneMask<W> converged_{};   // lanes that converged to that orbit
    TileResult result_;
};

}  // namespace gearpod::lockstep
