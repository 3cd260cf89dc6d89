#include "lockstep/strategies/fault_perturbation.hpp"

#include "lockstep/tile/integrated_tile.hpp"

namespace gearpod::lockstep {
namespace {

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
        bool perturbed = false;
        for (int k = -healthy_.run_in_meshes; k < healthy_.span_meshes(); ++k) {
            if (!perturbed && !schedule_.passes(k)) {
                continue;
            }
            if (!perturbed) {
                state_ = healthy_.before(k);
            }
            MeshRecord& record = k >= 0 ? add_record(k) : scratch;
            integrate_mesh(k, schedule_.all_overrides(k), record);
            perturbed = remains_perturbed(k, record);
        }
        return std::move(result_);
    }

  private:
    using Base = IntegratedTile<W>;
    using Base::convergence_, Base::distance, Base::diverged, Base::integrate_mesh,
        Base::mark_diverged, Base::new_record, Base::result_, Base::schedule_, Base::state_;

    MeshRecord& add_record(int k) {
        result_.content[static_cast<std::size_t>(k)] = static_cast<int>(result_.records.size());
        return result_.records.emplace_back(new_record(false));
    }

    // True if, after mesh period k, a fault is still in contact or the motion of any lane differs
    // from the healthy one. Marks diverged lanes.
    bool remains_perturbed(int k, const MeshRecord& record) {
        bool perturbed = schedule_.continues_after(k);
        for (int l = 0; l < W; ++l) {
            if (result_.status[static_cast<std::size_t>(l)] != LaneStatus::ok) {
                continue;
            }
            if (diverged(l)) {
                mark_diverged(l);
            } else if (distance(state_, healthy_.before(k + 1), record, l) >
                       convergence_.tolerance) {
                perturbed = true;
            }
        }
        return perturbed;
    }

    const SpanStates& healthy_;
};

}  // namespace

template <int W>
TileResult FaultPerturbation::run(const TileInputs& tile) const {
    return PerturbedTile<W>(tile, *this).run();
}

template TileResult FaultPerturbation::run<1>(const TileInputs&) const;
template TileResult FaultPerturbation::run<4>(const TileInputs&) const;
template TileResult FaultPerturbation::run<8>(const TileInputs&) const;
template TileResult FaultPerturbation::run<16>(const TileInputs&) const;

}  // namespace gearpod::lockstep
