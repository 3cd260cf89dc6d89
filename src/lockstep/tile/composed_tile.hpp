// Tile whose healthy mesh periods are superposed (composition.hpp) in the lanes in which all tooth
// pairs stay in contact. The perturbation due to a fault is integrated from the superposed states.
#pragma once

#include <optional>
#include <ranges>

#include "lockstep/tile/composition.hpp"
#include "lockstep/tile/marched_tile.hpp"

namespace gearpod::lockstep {

template <int W>
class ComposedTile : MarchedTile<W> {
  public:
    // The gearboxes must have tooth errors and a steady excitation.
    using MarchedTile<W>::MarchedTile;

    TileResult run() {
        settle();
        march_composed();
        add_contact_loss_of_span();
        return std::move(result_);
    }

  private:
    using Base = MarchedTile<W>;
    using Base::add_contact_loss_of_span, Base::add_record, Base::contact_, Base::distance,
        Base::diverged, Base::faults_, Base::faulty, Base::forget_contact, Base::hear_records,
        Base::march, Base::march_counting, Base::march_everything, Base::new_record, Base::orbit_,
        Base::plan_, Base::record_of, Base::result_, Base::retire, Base::schedule_, Base::settings_,
        Base::settle, Base::settled_, Base::state_;

    // Integrates mesh period k with its step states, and returns lower bounds of the contact
    // compression in it.
    machine::AlignedVector march_part_mesh(int k, const MeshOverrides& overrides,
                                           const MeshRecord* orbit, MeshRecord& record) {
        record = new_record();
        size_step_states(this->plan_, W, record);
        march(k, overrides, record);
        return contact_->least_pressing(record, overrides.gaps, orbit);
    }

    ComposedPart march_part(const Composition& whole, int teeth, LaneMask<W>& periodic) {
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
            part.pressing.push_back(
                march_part_mesh(k, {{}, tooth_gaps(plan_, errors, k)}, &whole.orbit, record));
            machine::AlignedVector().swap(record.step_states);
        }
        for (int l = 0; l < W; ++l) {
            periodic[static_cast<std::size_t>(l)] =
                periodic[static_cast<std::size_t>(l)] &&
                distance(state_, part.states.front(), part.records.back(), l) <=
                    settings_.tolerance;
        }
        return part;
    }

    // Integrates the periodic orbit to which the parts are added. Returns nothing if no lane may be
    // superposed, or if no lane keeps contact on the orbit itself.
    std::optional<Composition> march_orbit() {
        Composition whole;
        whole.orbit_state = orbit_;
        state_ = orbit_;
        const auto may = [this](int lane) { return may_compose(lane); };
        if (std::ranges::none_of(std::views::iota(0, W), may)) {
            return std::nullopt;
        }
        whole.orbit_pressing = march_part_mesh(0, {}, nullptr, whole.orbit);
        const std::vector<char> touching = whole.keeps_contact(0, 0, W);
        return std::ranges::count(touching, 1) > 0 ? std::optional(std::move(whole)) : std::nullopt;
    }

    void march_parts(Composition& whole, LaneMask<W>& periodic) {
        periodic = settled_;
        for (const int teeth : part_periods(*faults_.tooth_errors)) {
            whole.parts.push_back(march_part(whole, teeth, periodic));
        }
        whole.orbit.step_states = {};
        whole.take_orbit_once();
    }

    bool may_compose(int lane) const {
        return result_.status[static_cast<std::size_t>(lane)] == LaneStatus::ok &&
               (settings_.compose_faulty || !faulty(lane));
    }

    // Computes the mesh periods of the span: superposed in lanes that keep contact, fully
    // integrated in the others.
    void march_composed() {
        result_.composed.assign(W, false);
        std::optional<Composition> orbit = march_orbit();
        if (!orbit) {
            state_ = orbit_;
            march_everything(settings_.hear != nullptr);
            return;
        }
        Composition& whole = *orbit;
        LaneMask<W> kept;
        march_parts(whole, kept);
        const std::vector<char> touching =
            whole.keeps_contact(-settings_.run_in_meshes, settings_.march_meshes, W);
        bool all = true;
        for (std::size_t l = 0; l < W; ++l) {
            kept[l] = kept[l] && touching[l] && may_compose(static_cast<int>(l));
            all = all && kept[l];
        }
        result_.composed.assign(kept.begin(), kept.end());
        if (all && settings_.hear && !settings_.keep_states) {
            hear_composed(whole, kept);
            return;
        }
        if (!all) {
            state_ = orbit_;
            march_everything(false);
            forget_contact(kept);
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
        Changes changes(*this, whole, kept);
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            changes.change(k, k >= 0 ? &record_of(k) : nullptr);
        }
        if (settings_.hear) {
            hear_records();
        }
    }

    // Perturbation due to faults in superposed lanes, integrated mesh period by mesh period from
    // the start of the run-in.
    class Changes {
      public:
        Changes(ComposedTile& tile, const Composition& whole, const LaneMask<W>& kept)
            : tile_(tile),
              whole_(whole),
              kept_(kept),
              record_(tile.new_record()),
              healthy_(tile.state_) {}

        // Replaces the perturbed lanes in the record of mesh period k; `into` is null during the
        // run-in.
        void change(int k, MeshRecord* into) {
            const LaneMask<W> quiet = leave(k);
            if (std::ranges::none_of(away_, std::identity())) {
                return;
            }
            whole_.state(k, healthy_);
            copy_lanes<W>(healthy_, tile_.state_, quiet);
            tile_.march_counting(k, tile_.schedule_.all_overrides(k), record_, away_);
            whole_.state(k + 1, healthy_);
            if (into != nullptr) {
                copy_lanes<W>(record_, *into, away_);
            }
            come_back(k);
        }

      private:
        // Marks lanes as perturbed if a fault passes in mesh period k. Returns the lanes that were
        // unperturbed before.
        LaneMask<W> leave(int k) {
            const bool passes = tile_.schedule_.passes(k);
            LaneMask<W> quiet;
            for (std::size_t l = 0; l < W; ++l) {
                quiet[l] = !away_[l];
                away_[l] = away_[l] || (passes && kept_[l] && tile_.faulty(static_cast<int>(l)));
            }
            return quiet;
        }

        void come_back(int k) {
            for (int l = 0; l < W; ++l) {
                auto& own = away_[static_cast<std::size_t>(l)];
                if (own && tile_.diverged(l)) {
                    tile_.retire(l);
                    own = false;
                } else if (own && !tile_.schedule_.continues_after(k)) {
                    own = tile_.distance(tile_.state_, healthy_, record_, l) >
                          tile_.settings_.tolerance;
                }
            }
        }

        ComposedTile& tile_;
        const Composition& whole_;
        const LaneMask<W>& kept_;
        MeshRecord record_;
        TileState healthy_;
        LaneMask<W> away_{};
    };

    // Passes superposed mesh periods to the callback settings_.hear without keeping them; requires
    // that all lanes keep contact.
    void hear_composed(const Composition& whole, const LaneMask<W>& kept) {
        Changes changes(*this, whole, kept);
        MeshRecord composed = new_record();
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            if (k >= 0) {
                whole.record(k, composed);
            }
            changes.change(k, k >= 0 ? &composed : nullptr);
            if (k >= 0) {
                settings_.hear(k, composed);
            }
        }
    }
};

}  // namespace gearpod::lockstep
