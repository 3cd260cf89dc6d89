#include "lockstep/tile/tile.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>

#include "lockstep/tile/composed_tile.hpp"

namespace gearpod::lockstep {
namespace {

template <int W>
class TileMarch : MarchedTile<W> {
  public:
    using MarchedTile<W>::MarchedTile;

    TileResult run() {
        if (settings_.healthy != nullptr) {
            march_changes();
            return std::move(result_);
        }
        settle();
        if (settings_.march_meshes > 0) {
            march_everything(settings_.hear != nullptr);
            add_contact_loss_of_span();
        } else {
            add_contact_loss_of_orbit();
            march_pattern();
        }
        return std::move(result_);
    }

  private:
    using Base = MarchedTile<W>;
    using Base::add_contact_loss_of_orbit, Base::add_contact_loss_of_span, Base::add_record,
        Base::distance, Base::diverged, Base::faults_, Base::faulty, Base::march,
        Base::march_everything, Base::mark_unsettled, Base::new_record, Base::orbit_, Base::result_,
        Base::retire, Base::schedule_, Base::settings_, Base::settle, Base::state_;

    // Integrates one mesh period of the pattern; quiet lanes stay on their periodic orbit.
    void march_pattern_mesh(int k, std::array<bool, W>& quiet,
                            const std::array<bool, W>& finished) {
        const std::vector<PairOverride> passages = schedule_.overrides(k);
        bool any = false;
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            q = q && (passages.empty() || !faulty(l));
            any = any || (!q && !finished[static_cast<std::size_t>(l)]);
        }
        if (!any) {
            return;
        }
        MeshRecord record = new_record();
        march(0, {passages, {}}, record);
        int& id = result_.content[static_cast<std::size_t>(k)];
        if (id == 0) {
            id = static_cast<int>(result_.records.size());
            result_.records.push_back(result_.records[0]);
        }
        LaneMask<W> away;
        std::ranges::transform(quiet, finished, away.begin(),
                               [](bool still, bool done) { return !still && !done; });
        copy_lanes<W>(record, result_.records[static_cast<std::size_t>(id)], away);
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            if (q || finished[static_cast<std::size_t>(l)]) {
                continue;
            }
            if (diverged(l)) {
                retire(l);
                q = true;
            } else if (!schedule_.continues_after(k) &&
                       distance(state_, orbit_, result_.records[0], l) <= settings_.tolerance) {
                q = true;
            }
        }
        copy_lanes<W>(orbit_, state_, quiet);
    }

    // Integrates the pattern from the healthy periodic orbit. If a perturbation lasts longer than
    // the pattern, repeats it from its end state until the pattern itself repeats.
    void march_pattern() {
        const int length = faults_.pattern.length;
        result_.content.assign(static_cast<std::size_t>(length), 0);
        std::array<bool, W> quiet;
        std::array<bool, W> finished;
        for (int l = 0; l < W; ++l) {
            quiet[static_cast<std::size_t>(l)] = true;
            finished[static_cast<std::size_t>(l)] = !faulty(l);
        }
        const int passes = 1 + (settings_.max_meshes + length - 1) / length;
        for (int pass = 0; pass < passes; ++pass) {
            const TileState before = state_;
            for (int k = 0; k < length; ++k) {
                march_pattern_mesh(k, quiet, finished);
            }
            bool waiting = false;
            for (int l = 0; l < W; ++l) {
                auto& done = finished[static_cast<std::size_t>(l)];
                done = done || quiet[static_cast<std::size_t>(l)] ||
                       distance(state_, before, result_.records[0], l) <= settings_.tolerance;
                waiting = waiting || !done;
            }
            if (!waiting) {
                return;
            }
        }
        mark_unsettled(finished);
    }

    // Integrates the perturbation due to the fault's passages from the healthy solution's states,
    // until it has decayed.
    void march_changes() {
        MeshRecord unseen = new_record();
        bool away = false;
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            const auto at = static_cast<std::size_t>(k + settings_.run_in_meshes);
            if (!away && !schedule_.passes(k)) {
                continue;
            }
            if (!away) {
                state_ = (*settings_.healthy)[at];
            }
            MeshRecord& record = k >= 0 ? add_record(k) : unseen;
            march(k, schedule_.all_overrides(k), record);
            away = schedule_.continues_after(k);
            for (int l = 0; l < W; ++l) {
                if (result_.status[static_cast<std::size_t>(l)] != LaneStatus::ok) {
                    continue;
                }
                if (diverged(l)) {
                    retire(l);
                } else if (distance(state_, (*settings_.healthy)[at + 1], record, l) >
                           settings_.tolerance) {
                    away = true;
                }
            }
        }
    }
};

}  // namespace

template <int W>
TileResult run_tile(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings) {
    assert(inputs.size() == W && std::all_of(faults.curve.begin(), faults.curve.end(),
                                             [](const auto& lanes) { return lanes.size() == W; }));
    check_tooth_errors(plan, faults.tooth_errors, settings.march_meshes);
    check_excitation(settings.excitation, settings.march_meshes);
    if (settings.healthy != nullptr &&
        (settings.excitation != nullptr ||
         settings.healthy->size() !=
             static_cast<std::size_t>(settings.run_in_meshes + settings.march_meshes + 1))) {
        throw std::invalid_argument(
            "changes are marched from the states of as many steadily driven meshes");
    }
    if (settings.hear && (settings.march_meshes == 0 || settings.healthy != nullptr)) {
        throw std::invalid_argument("only meshes that are marched one by one are heard");
    }
    if (settings.compose && (faults.tooth_errors == nullptr || settings.excitation != nullptr ||
                             settings.healthy != nullptr)) {
        throw std::invalid_argument("meshes are composed of tooth errors under a steady drive");
    }
    return settings.compose ? ComposedTile<W>(plan, inputs, faults, settings).run()
                            : TileMarch<W>(plan, inputs, faults, settings).run();
}

#define GEARPOD_RUN_TILE(W)                                                                     \
    template TileResult run_tile<W>(const MarchPlan&, std::span<const dynamics::GearboxInputs>, \
                                    const FaultCurves&, const TileSettings&);
GEARPOD_RUN_TILE(1)
GEARPOD_RUN_TILE(4)
GEARPOD_RUN_TILE(8)
GEARPOD_RUN_TILE(16)
#undef GEARPOD_RUN_TILE

}  // namespace gearpod::lockstep
