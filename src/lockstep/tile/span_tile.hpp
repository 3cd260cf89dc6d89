// Tile during the time integration of every mesh period of a span.
#pragma once

#include <algorithm>
#include <limits>

#include "lockstep/tile/integrated_tile.hpp"

namespace gearpod::lockstep {

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
        for (int l = 0; l < W; ++l) {
            if (lanes[static_cast<std::size_t>(l)]) {
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

    // Appends the record of mesh period k of the span.
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
        for (int l = 0; l < W; ++l) {
            const auto lane = static_cast<std::size_t>(l);
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
