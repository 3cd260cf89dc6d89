#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

#include "lockstep/strategies/solution.hpp"
#include "lockstep/tile/integrated_tile.hpp"

namespace gearpod::lockstep {
namespace {

template <int W>
class FullTile : SpanTile<W> {
  public:
    FullTile(const TileInputs& tile, const FullSolution& solution)
        : SpanTile<W>(tile, solution.convergence, solution.span, solution.tooth_errors,
                      solution.excitation) {}

    TileResult run() {
        this->start();
        this->integrate_span(this->span_.on_record != nullptr);
        this->add_contact_loss_of_span();
        return std::move(this->result_);
    }
};

template <int W>
class PeriodicTile : IntegratedTile<W> {
  public:
    // `gravity` is that of the solution, or null.
    PeriodicTile(const TileInputs& tile, const PeriodicSolution& solution,
                 const Excitation* gravity)
        : Base(tile, solution.convergence, nullptr, gravity), with_motion_(solution.with_motion) {}

    TileResult run() {
        mark_not_converged(converge_to_periodic_orbit(with_motion_));
        add_periodic_contact_loss();
        integrate_pattern();
        return std::move(result_);
    }

  private:
    using Base = IntegratedTile<W>;
    using Base::add_contact_loss, Base::contact_, Base::converge_to_periodic_orbit,
        Base::convergence_, Base::distance, Base::diverged, Base::faulty, Base::integrate_mesh,
        Base::integrate_periodic, Base::mark_diverged, Base::mark_not_converged, Base::new_record,
        Base::periodic_orbit_, Base::plan_, Base::result_, Base::schedule_, Base::separation_time_,
        Base::state_, Base::tile_;

    // Sets the contact loss of the healthy mesh period that repeats; integrates it once more.
    void add_periodic_contact_loss() {
        if (!contact_) {
            return;
        }
        LaneMask<W> all;
        all.fill(true);
        MeshRecord record = new_record(false);
        size_step_states(plan_, W, record);
        state_ = periodic_orbit_;
        integrate_periodic(record);
        state_ = periodic_orbit_;
        contact_->add_separation_time(record, schedule_.periodic_overrides(), all,
                                      separation_time_);
        add_contact_loss(1);
    }

    // Integrates one mesh period of the pattern; quiet lanes stay on their periodic orbit.
    void integrate_pattern_mesh(int k, std::array<bool, W>& unperturbed,
                                const std::array<bool, W>& finished) {
        const MeshOverrides overrides = schedule_.pattern_overrides(k);
        bool any = false;
        for (LaneId l{0}; l < W; ++l) {
            auto& q = unperturbed[l];
            q = q && (overrides.faults.empty() || !faulty(l));
            any = any || (!q && !finished[l]);
        }
        if (!any) {
            return;
        }
        MeshRecord record = new_record(with_motion_);
        integrate_mesh(0, overrides, record);
        int& id = result_.content[static_cast<std::size_t>(k)];
        if (id == 0) {
            id = static_cast<int>(result_.records.size());
            result_.records.push_back(result_.records[0]);
        }
        LaneMask<W> perturbed;
        std::ranges::transform(unperturbed, finished, perturbed.begin(),
                               [](bool still, bool done) { return !still && !done; });
        copy_lanes<W>(record, result_.records[static_cast<std::size_t>(id)], perturbed);
        for (LaneId l{0}; l < W; ++l) {
            auto& q = unperturbed[l];
            if (q || finished[l]) {
                continue;
            }
            if (diverged(l)) {
                mark_diverged(l);
                q = true;
            } else if (!schedule_.continues_after(k) &&
                       distance(state_, periodic_orbit_, result_.records[0], l) <=
                           convergence_.tolerance) {
                q = true;
            }
        }
        copy_lanes<W>(periodic_orbit_, state_, unperturbed);
    }

    // Integrates the pattern from the healthy periodic orbit. If a perturbation lasts longer than
    // the pattern, repeats it from its end state until the pattern itself repeats.
    void integrate_pattern() {
        const int length = tile_.faults.pattern.length;
        result_.content.assign(static_cast<std::size_t>(length), 0);
        std::array<bool, W> unperturbed;
        std::array<bool, W> finished;
        for (LaneId l{0}; l < W; ++l) {
            unperturbed[l] = true;
            finished[l] = !faulty(l);
        }
        const int passes = 1 + (convergence_.max_meshes + length - 1) / length;
        for (int pass = 0; pass < passes; ++pass) {
            const TileState before = state_;
            for (int k = 0; k < length; ++k) {
                integrate_pattern_mesh(k, unperturbed, finished);
            }
            bool any_pending = false;
            for (LaneId l{0}; l < W; ++l) {
                auto& done = finished[l];
                done = done || unperturbed[l] ||
                       distance(state_, before, result_.records[0], l) <= convergence_.tolerance;
                any_pending = any_pending || !done;
            }
            if (!any_pending) {
                return;
            }
        }
        mark_not_converged(finished);
    }

    const bool with_motion_;
};

template <int W>
class PerturbedTile : IntegratedTile<W> {
  public:
    PerturbedTile(const TileInputs& tile, const FaultPerturbation& solution)
        : Base(tile, solution.convergence, solution.tooth_errors, nullptr),
          healthy_(solution.healthy) {
        result_.content.assign(static_cast<std::size_t>(healthy_.span_meshes()), kUnchanged);
    }

    TileResult run() {
        MeshRecord scratch = new_record(false);
        LaneMask<W> all, perturbed{};
        all.fill(true);
        for (int k = -healthy_.run_in_meshes; k < healthy_.span_meshes(); ++k) {
            const LaneMask<W> unperturbed = start_perturbation(k, all, perturbed);
            if (std::ranges::none_of(perturbed, std::identity())) {
                continue;
            }
            copy_lanes<W>(healthy_.before(k), state_, unperturbed);
            MeshRecord& record = k >= 0 ? add_record(k) : scratch;
            integrate_mesh(k, schedule_.all_overrides(k), record);
            for (LaneId l{0}; l < W; ++l) {
                if (!perturbed[l]) {
                    fill_lane<W>(record.acceleration, l, NAN);
                    fill_lane<W>(record.te, l, NAN);
                }
            }
            end_perturbation(k, healthy_.before(k + 1), record, perturbed);
        }
        return std::move(result_);
    }

  private:
    using Base = IntegratedTile<W>;
    using Base::end_perturbation, Base::integrate_mesh, Base::new_record, Base::result_,
        Base::schedule_, Base::start_perturbation, Base::state_;

    MeshRecord& add_record(int k) {
        result_.content[static_cast<std::size_t>(k)] = static_cast<int>(result_.records.size());
        return result_.records.emplace_back(new_record(false));
    }

    const SpanStates& healthy_;
};

}  // namespace

template <int W>
TileResult FullSolution::run(const TileInputs& tile) const {
    return FullTile<W>(tile, *this).run();
}

template <int W>
TileResult PeriodicSolution::run(const TileInputs& tile) const {
    Excitation excitation;
    if (gravity) {
        excitation.gravity = Gravity{*gravity};
    }
    return PeriodicTile<W>(tile, *this, gravity ? &excitation : nullptr).run();
}

template <int W>
TileResult FaultPerturbation::run(const TileInputs& tile) const {
    if (!tile.faults.wear.empty()) {
        throw std::invalid_argument("wear changes every mesh period, not only passages");
    }
    return PerturbedTile<W>(tile, *this).run();
}

#define GEARPOD_LANES(W, REAL)                                             \
    template TileResult FullSolution::run<W>(const TileInputs&) const;     \
    template TileResult PeriodicSolution::run<W>(const TileInputs&) const; \
    template TileResult FaultPerturbation::run<W>(const TileInputs&) const;
GEARPOD_FOR_FLOAT_WIDTHS(GEARPOD_LANES)
#undef GEARPOD_LANES

}  // namespace gearpod::lockstep
