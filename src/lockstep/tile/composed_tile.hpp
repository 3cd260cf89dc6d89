// A tile whose healthy meshes are composed of what each gear's tooth errors do (composition.hpp),
// in the lanes whose tooth pairs stay in contact; faults are marched from there.
#pragma once

#include "lockstep/tile/composition.hpp"
#include "lockstep/tile/marched_tile.hpp"

namespace gearpod::lockstep {

template <int W>
class ComposedTile : MarchedTile<W> {
  public:
    // The gearboxes must have tooth errors and be driven evenly.
    using MarchedTile<W>::MarchedTile;

    TileResult run() {
        settle();
        march_composed();
        return std::move(result_);
    }

  private:
    using Base = MarchedTile<W>;
    using Base::add_record, Base::distance, Base::diverged, Base::faults_, Base::faulty,
        Base::march, Base::march_everything, Base::new_record, Base::orbit_, Base::plan_,
        Base::record_of, Base::result_, Base::retire, Base::schedule_, Base::settings_,
        Base::settle, Base::settled_, Base::state_;

    // Mesh period k with its motion, and how its tooth pairs are pressed.
    machine::AlignedVector march_part_mesh(const Pressing& pressing, int k,
                                           const MeshOverrides& overrides, const MeshRecord* orbit,
                                           MeshRecord& record) {
        record = make_record(plan_, W, true);
        march(k, overrides, record);
        return pressing.least(record, overrides.gaps, orbit);
    }

    ComposedPart march_part(const Pressing& pressing, const Composition& whole, int teeth,
                            LaneMask<W>& periodic) {
        const ToothErrors errors = errors_of_part(*faults_.tooth_errors, teeth);
        MeshRecord unseen = new_record();
        ComposedPart part;
        state_ = whole.orbit_state;
        for (int k = -settings_.run_in_meshes; k < 0; ++k) {
            march(k, {{}, tooth_gaps(plan_, errors, k)}, unseen);
        }
        for (int k = 0; k < teeth; ++k) {
            part.states.push_back(state_);
            MeshRecord& record = part.records.emplace_back();
            part.pressing.push_back(march_part_mesh(pressing, k, {{}, tooth_gaps(plan_, errors, k)},
                                                    &whole.orbit, record));
            if (!settings_.with_motion) {
                record.motion = {};
            }
        }
        for (int l = 0; l < W; ++l) {
            periodic[static_cast<std::size_t>(l)] =
                periodic[static_cast<std::size_t>(l)] &&
                distance(state_, part.states.front(), part.records.back(), l) <=
                    settings_.tolerance;
        }
        return part;
    }

    Composition march_parts(LaneMask<W>& periodic) {
        const Pressing pressing(plan_);
        Composition whole;
        whole.orbit_state = orbit_;
        state_ = orbit_;
        whole.orbit_pressing = march_part_mesh(pressing, 0, {}, nullptr, whole.orbit);
        periodic = settled_;
        for (const int teeth : part_periods(*faults_.tooth_errors)) {
            whole.parts.push_back(march_part(pressing, whole, teeth, periodic));
        }
        return whole;
    }

    bool may_compose(int lane) const {
        return result_.status[static_cast<std::size_t>(lane)] == LaneStatus::ok &&
               (settings_.compose_faulty || !faulty(lane));
    }

    // The meshes of the span composed where a lane keeps contact, marched where it does not.
    void march_composed() {
        result_.composed.assign(W, false);
        bool any = false;
        for (int l = 0; l < W; ++l) {
            any = any || may_compose(l);
        }
        if (!any) {
            state_ = orbit_;
            march_everything();
            return;
        }
        LaneMask<W> kept;
        const Composition whole = march_parts(kept);
        const std::vector<char> touching =
            whole.keeps_contact(-settings_.run_in_meshes, settings_.march_meshes, W);
        bool all = true;
        for (std::size_t l = 0; l < W; ++l) {
            kept[l] = kept[l] && touching[l] && may_compose(static_cast<int>(l));
            all = all && kept[l];
        }
        if (!all) {
            state_ = orbit_;
            march_everything();
        }
        MeshRecord composed = new_record();
        for (int k = 0; k < settings_.march_meshes; ++k) {
            if (all) {
                whole.record(k, add_record(k));
            } else {
                whole.record(k, composed);
                copy_lanes<W>(composed, record_of(k), kept);
            }
        }
        if (settings_.keep_states) {
            TileState state = state_;
            for (int k = -settings_.run_in_meshes; k <= settings_.march_meshes; ++k) {
                whole.state(k, state);
                if (all) {
                    result_.states.push_back(state);
                } else {
                    copy_lanes<W>(
                        state,
                        result_.states[static_cast<std::size_t>(k + settings_.run_in_meshes)],
                        kept);
                }
            }
        }
        result_.composed.assign(kept.begin(), kept.end());
        change_composed(whole, kept);
    }

    // What faults change in composed lanes.
    void change_composed(const Composition& whole, const LaneMask<W>& kept) {
        MeshRecord record = new_record();
        TileState healthy = state_;
        LaneMask<W> away{};
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            const bool passes = schedule_.passes(k);
            bool any = false;
            LaneMask<W> quiet;
            for (int l = 0; l < W; ++l) {
                auto& own = away[static_cast<std::size_t>(l)];
                quiet[static_cast<std::size_t>(l)] = !own;
                own = own || (passes && kept[static_cast<std::size_t>(l)] && faulty(l));
                any = any || own;
            }
            if (!any) {
                continue;
            }
            whole.state(k, healthy);
            copy_lanes<W>(healthy, state_, quiet);
            march(k, schedule_.all_overrides(k), record);
            whole.state(k + 1, healthy);
            if (k >= 0) {
                copy_lanes<W>(record, record_of(k), away);
            }
            for (int l = 0; l < W; ++l) {
                auto& own = away[static_cast<std::size_t>(l)];
                if (own && diverged(l)) {
                    retire(l);
                    own = false;
                } else if (own && !schedule_.continues_after(k)) {
                    own = distance(state_, healthy, record, l) > settings_.tolerance;
                }
            }
        }
    }
};

}  // namespace gearpod::lockstep
