#include "lockstep/strategies/solution.hpp"

#include <optional>
#include <ranges>
#include <stdexcept>

#include "lockstep/tile/integrated_tile.hpp"
#include "lockstep/tile/superposed_motion.hpp"

namespace gearpod::lockstep {
namespace {

template <int W>
class SuperposedTile : SpanTile<W> {
  public:
    SuperposedTile(const TileInputs& tile, const SuperposedSolution& solution)
        : Base(tile, solution.convergence, solution.span, &solution.tooth_errors, nullptr),
          tooth_errors_(solution.tooth_errors),
          superpose_faulty_(solution.superpose_faulty) {}

    TileResult run() {
        converged_ = this->start();
        superpose_span();
        this->add_contact_loss_of_span();
        return std::move(result_);
    }

  private:
    using Base = SpanTile<W>;
    using Base::add_record, Base::contact_, Base::convergence_, Base::distance,
        Base::end_perturbation, Base::faulty, Base::integrate_counting_contact,
        Base::integrate_mesh, Base::integrate_span, Base::new_record, Base::periodic_orbit_,
        Base::plan_, Base::record_of, Base::result_, Base::schedule_, Base::span_,
        Base::start_perturbation, Base::state_, Base::with_motion;

    // Integrates mesh period k with its step states, and returns lower bounds of the contact
    // compression in it.
    machine::AlignedVector integrate_part_mesh(int k, const MeshOverrides& overrides,
                                               const MeshRecord* periodic_orbit,
                                               MeshRecord& record) {
        record = new_record(with_motion());
        size_step_states(plan_, W, record);
        integrate_mesh(k, overrides, record);
        return contact_->least_compression(record, overrides.gaps, periodic_orbit);
    }

    SuperpositionPart integrate_part(const SuperposedMotion& whole, int teeth,
                                     LaneMask<W>& periodic) {
        const ToothErrors errors = errors_of_part(tooth_errors_, teeth);
        MeshRecord scratch = new_record(false);
        SuperpositionPart part;
        state_ = whole.periodic_orbit_state;
        for (int k = -span_.run_in_meshes; k < 0; ++k) {
            integrate_mesh(k, {{}, tooth_gaps(plan_, errors, k)}, scratch);
        }
        for (int k = 0; k < teeth; ++k) {
            part.states.push_back(state_);
            MeshRecord& record = part.records.emplace_back();
            part.compression.push_back(integrate_part_mesh(k, {{}, tooth_gaps(plan_, errors, k)},
                                                           &whole.periodic_orbit, record));
            machine::AlignedVector().swap(record.step_states);
        }
        for (LaneId l{0}; l < W; ++l) {
            periodic[l] = periodic[l] && distance(state_, part.states.front(), part.records.back(),
                                                  l) <= convergence_.tolerance;
        }
        return part;
    }

    // Integrates the periodic orbit to which the parts are added. Returns nothing if no lane may be
    // superposed, or if no lane keeps contact on the orbit itself.
    std::optional<SuperposedMotion> integrate_periodic_orbit() {
        SuperposedMotion whole;
        whole.periodic_orbit_state = periodic_orbit_;
        state_ = periodic_orbit_;
        if (std::ranges::none_of(std::views::iota(0, W),
                                 [&](int l) { return may_superpose(LaneId{l}); })) {
            return std::nullopt;
        }
        whole.periodic_orbit_compression =
            integrate_part_mesh(0, {}, nullptr, whole.periodic_orbit);
        const std::vector<char> in_contact = whole.keeps_contact(0, 0, W);
        return std::ranges::count(in_contact, 1) > 0 ? std::optional(std::move(whole))
                                                     : std::nullopt;
    }

    void integrate_parts(SuperposedMotion& whole, LaneMask<W>& periodic) {
        periodic = converged_;
        for (const int teeth : part_periods(tooth_errors_)) {
            whole.parts.push_back(integrate_part(whole, teeth, periodic));
        }
        machine::AlignedVector().swap(whole.periodic_orbit.step_states);
        whole.count_periodic_orbit_once();
    }

    bool may_superpose(LaneId lane) const {
        return result_.status[lane] == LaneStatus::ok && (superpose_faulty_ || !faulty(lane));
    }

    // Computes the mesh periods of the span: superposed in lanes that keep contact, fully
    // integrated in the others.
    void superpose_span() {
        result_.superposed.assign(W, false);
        std::optional<SuperposedMotion> periodic_orbit = integrate_periodic_orbit();
        if (!periodic_orbit) {
            state_ = periodic_orbit_;
            integrate_span(span_.on_record != nullptr);
            return;
        }
        SuperposedMotion& whole = *periodic_orbit;
        LaneMask<W> kept;
        integrate_parts(whole, kept);
        const std::vector<char> in_contact =
            whole.keeps_contact(-span_.run_in_meshes, span_.meshes, W);
        bool all = true;
        for (LaneId l{0}; l < W; ++l) {
            kept[l] = kept[l] && in_contact[l] && may_superpose(l);
            all = all && kept[l];
        }
        result_.superposed.assign(kept.begin(), kept.end());
        if (all && span_.on_record && !span_.options.states) {
            record_superposed_response(whole, kept);
            return;
        }
        if (!all) {
            state_ = periodic_orbit_;
            integrate_span(false, kept);
            this->clear_contact_loss(kept);
        }
        MeshRecord superposed = new_record(with_motion());
        for (int k = 0; k < span_.meshes; ++k) {
            if (all) {
                whole.record(k, add_record(k));
            } else {
                whole.record(k, superposed);
                copy_lanes<W>(superposed, record_of(k), kept);
            }
        }
        if (span_.options.states) {
            keep_superposed_states(whole, kept, all);
        }
        LanePerturbation perturbation(*this, whole, kept);
        for (int k = -span_.run_in_meshes; k < span_.meshes; ++k) {
            perturbation.integrate_record(k, k >= 0 ? &record_of(k) : nullptr);
        }
        if (span_.on_record) {
            record_sensor_response();
        }
    }

    // Sets TileResult::states; replaces those of the lanes `kept` unless `all` are superposed.
    void keep_superposed_states(const SuperposedMotion& whole, const LaneMask<W>& kept, bool all) {
        result_.states.run_in_meshes = span_.run_in_meshes;
        TileState state = state_;
        for (int k = -span_.run_in_meshes; k <= span_.meshes; ++k) {
            whole.state(k, state);
            if (all) {
                result_.states.all.push_back(state);
            } else {
                copy_lanes<W>(state, result_.states.before(k), kept);
            }
        }
    }

    // Passes the kept records to span_.on_record and discards them.
    void record_sensor_response() {
        for (int k = 0; k < span_.meshes; ++k) {
            span_.on_record(k, record_of(k));
        }
        result_.records.resize(1);
        std::ranges::fill(result_.content, kUnchanged);
    }

    // Perturbation due to faults in superposed lanes, integrated mesh period by mesh period from
    // the start of the run-in.
    class LanePerturbation {
      public:
        LanePerturbation(SuperposedTile& tile, const SuperposedMotion& whole,
                         const LaneMask<W>& kept)
            : tile_(tile),
              whole_(whole),
              kept_(kept),
              record_(tile.new_record(tile.with_motion())),
              healthy_(tile.state_) {}

        // Replaces the perturbed lanes in the record of mesh period k; `into` is null during the
        // run-in.
        void integrate_record(int k, MeshRecord* into) {
            const LaneMask<W> unperturbed = tile_.start_perturbation(k, kept_, perturbed_);
            if (std::ranges::none_of(perturbed_, std::identity())) {
                return;
            }
            whole_.state(k, healthy_);
            copy_lanes<W>(healthy_, tile_.state_, unperturbed);
            tile_.integrate_counting_contact(k, tile_.schedule_.all_overrides(k), record_,
                                             perturbed_);
            whole_.state(k + 1, healthy_);
            if (into != nullptr) {
                copy_lanes<W>(record_, *into, perturbed_);
            }
            tile_.end_perturbation(k, healthy_, record_, perturbed_);
        }

      private:
        SuperposedTile& tile_;
        const SuperposedMotion& whole_;
        const LaneMask<W>& kept_;
        MeshRecord record_;
        TileState healthy_;
        LaneMask<W> perturbed_{};
    };

    // Passes superposed mesh periods to the callback span_.on_record without keeping them;
    // requires that all lanes keep contact.
    void record_superposed_response(const SuperposedMotion& whole, const LaneMask<W>& kept) {
        LanePerturbation perturbation(*this, whole, kept);
        MeshRecord superposed = new_record(with_motion());
        for (int k = -span_.run_in_meshes; k < span_.meshes; ++k) {
            if (k >= 0) {
                whole.record(k, superposed);
            }
            perturbation.integrate_record(k, k >= 0 ? &superposed : nullptr);
            if (k >= 0) {
                span_.on_record(k, superposed);
            }
        }
    }

    const ToothErrors& tooth_errors_;
    const bool superpose_faulty_;
    LaneMask<W> converged_{};  // lanes that converged to the periodic orbit
};

}  // namespace

template <int W>
TileResult SuperposedSolution::run(const TileInputs& tile) const {
    if (!tile.faults.wear.empty()) {
        throw std::invalid_argument("worn flanks are not superposed, but integrated in full");
    }
    return SuperposedTile<W>(tile, *this).run();
}

template TileResult SuperposedSolution::run<1>(const TileInputs&) const;
template TileResult SuperposedSolution::run<4>(const TileInputs&) const;
template TileResult SuperposedSolution::run<8>(const TileInputs&) const;
template TileResult SuperposedSolution::run<16>(const TileInputs&) const;

}  // namespace gearpod::lockstep
