#include "lockstep/tile/tile.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>

#include "lockstep/tile/superposed_tile.hpp"

namespace gearpod::lockstep {
namespace {

template <int W>
class TileIntegration : IntegratedTile<W> {
  public:
    using IntegratedTile<W>::IntegratedTile;

    TileResult run() {
        if (settings_.healthy != nullptr) {
            integrate_perturbation();
            return std::move(result_);
        }
        converge_to_periodic_orbit();
        if (settings_.recorded_meshes > 0) {
            integrate_span(settings_.on_record != nullptr);
            add_contact_loss_of_span();
        } else {
            add_periodic_contact_loss();
            integrate_pattern();
        }
        return std::move(result_);
    }

  private:
    using Base = IntegratedTile<W>;
    using Base::add_periodic_contact_loss, Base::add_contact_loss_of_span, Base::add_record,
        Base::distance, Base::diverged, Base::faults_, Base::faulty, Base::integrate_mesh,
        Base::integrate_span, Base::mark_not_converged, Base::new_record, Base::periodic_orbit_,
        Base::result_, Base::mark_diverged, Base::schedule_, Base::settings_,
        Base::converge_to_periodic_orbit, Base::state_;

    // Integrates one mesh period of the pattern; quiet lanes stay on their periodic orbit.
    void integrate_pattern_mesh(int k, std::array<bool, W>& unperturbed,
                                const std::array<bool, W>& finished) {
        const std::vector<PairOverride> passages = schedule_.overrides(k);
        bool any = false;
        for (int l = 0; l < W; ++l) {
            auto& q = unperturbed[static_cast<std::size_t>(l)];
            q = q && (passages.empty() || !faulty(l));
            any = any || (!q && !finished[static_cast<std::size_t>(l)]);
        }
        if (!any) {
            return;
        }
        MeshRecord record = new_record();
        integrate_mesh(0, {passages, {}}, record);
        int& id = result_.content[static_cast<std::size_t>(k)];
        if (id == 0) {
            id = static_cast<int>(result_.records.size());
            result_.records.push_back(result_.records[0]);
        }
        LaneMask<W> perturbed;
        std::ranges::transform(unperturbed, finished, perturbed.begin(),
                               [](bool still, bool done) { return !still && !done; });
        copy_lanes<W>(record, result_.records[static_cast<std::size_t>(id)], perturbed);
        for (int l = 0; l < W; ++l) {
            auto& q = unperturbed[static_cast<std::size_t>(l)];
            if (q || finished[static_cast<std::size_t>(l)]) {
                continue;
            }
            if (diverged(l)) {
                mark_diverged(l);
                q = true;
            } else if (!schedule_.continues_after(k) &&
                       distance(state_, periodic_orbit_, result_.records[0], l) <=
                           settings_.tolerance) {
                q = true;
            }
        }
        copy_lanes<W>(periodic_orbit_, state_, unperturbed);
    }

    // Integrates the pattern from the healthy periodic orbit. If a perturbation lasts longer than
    // the pattern, repeats it from its end state until the pattern itself repeats.
    void integrate_pattern() {
        const int length = faults_.pattern.length;
        result_.content.assign(static_cast<std::size_t>(length), 0);
        std::array<bool, W> unperturbed;
        std::array<bool, W> finished;
        for (int l = 0; l < W; ++l) {
            unperturbed[static_cast<std::size_t>(l)] = true;
            finished[static_cast<std::size_t>(l)] = !faulty(l);
        }
        const int passes = 1 + (settings_.max_meshes + length - 1) / length;
        for (int pass = 0; pass < passes; ++pass) {
            const TileState before = state_;
            for (int k = 0; k < length; ++k) {
                integrate_pattern_mesh(k, unperturbed, finished);
            }
            bool any_pending = false;
            for (int l = 0; l < W; ++l) {
                auto& done = finished[static_cast<std::size_t>(l)];
                done = done || unperturbed[static_cast<std::size_t>(l)] ||
                       distance(state_, before, result_.records[0], l) <= settings_.tolerance;
                any_pending = any_pending || !done;
            }
            if (!any_pending) {
                return;
            }
        }
        mark_not_converged(finished);
    }

    // Integrates the perturbation due to the fault's passages from the healthy solution's states,
    // until it has decayed.
    void integrate_perturbation() {
        MeshRecord scratch = new_record();
        bool perturbed = false;
        for (int k = -settings_.run_in_meshes; k < settings_.recorded_meshes; ++k) {
            const auto at = static_cast<std::size_t>(k + settings_.run_in_meshes);
            if (!perturbed && !schedule_.passes(k)) {
                continue;
            }
            if (!perturbed) {
                state_ = (*settings_.healthy)[at];
            }
            MeshRecord& record = k >= 0 ? add_record(k) : scratch;
            integrate_mesh(k, schedule_.all_overrides(k), record);
            perturbed = schedule_.continues_after(k);
            for (int l = 0; l < W; ++l) {
                if (result_.status[static_cast<std::size_t>(l)] != LaneStatus::ok) {
                    continue;
                }
                if (diverged(l)) {
                    mark_diverged(l);
                } else if (distance(state_, (*settings_.healthy)[at + 1], record, l) >
                           settings_.tolerance) {
                    perturbed = true;
                }
            }
        }
    }
};

}  // namespace

template <int W>
TileResult run_tile(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings) {
    assert(inputs.size() == W && std::all_of(faults.curve.begin(), faults.curve.end(),
                                             [](const auto& lanes) { return lanes.size() == W; }));
    check_tooth_errors(plan, faults.tooth_errors, settings.recorded_meshes);
    check_excitation(settings.excitation, settings.recorded_meshes);
    if (settings.healthy != nullptr &&
        (settings.excitation != nullptr ||
         settings.healthy->size() !=
             static_cast<std::size_t>(settings.run_in_meshes + settings.recorded_meshes + 1))) {
        throw std::invalid_argument(
            "changes are marched from the states of as many steadily driven meshes");
    }
    if (settings.on_record && (settings.recorded_meshes == 0 || settings.healthy != nullptr)) {
        throw std::invalid_argument("only meshes that are marched one by one are heard");
    }
    if (settings.superpose && (faults.tooth_errors == nullptr || settings.excitation != nullptr ||
                               settings.healthy != nullptr)) {
        throw std::invalid_argument("meshes are composed of tooth errors under a steady drive");
    }
    return settings.superpose ? SuperposedTile<W>(plan, inputs, faults, settings).run()
                              : TileIntegration<W>(plan, inputs, faults, settings).run();
}

#define GEARPOD_RUN_TILE(W)                                                                       \
    template TileResult run_tile<W>(const IntegrationPlan&,                                       \
                                    std::span<const dynamics::GearboxInputs>, const FaultCurves&, \
                                    const TileSettings&);
GEARPOD_RUN_TILE(1)
GEARPOD_RUN_TILE(4)
GEARPOD_RUN_TILE(8)
GEARPOD_RUN_TILE(16)
#undef GEARPOD_RUN_TILE

}  // namespace gearpod::lockstep
