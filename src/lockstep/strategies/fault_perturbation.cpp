#include "lockstep/strategies/fault_perturbation.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

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
            for (std::size_t l = 0; l < W; ++l) {
                if (!perturbed[l]) {
                    fill_lane<W>(record.acceleration, static_cast<int>(l), NAN);
                    fill_lane<W>(record.te, static_cast<int>(l), NAN);
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
TileResult FaultPerturbation::run(const TileInputs& tile) const {
    if (!tile.faults.wear.empty()) {
        throw std::invalid_argument("wear changes every mesh period, not only passages");
    }
    return PerturbedTile<W>(tile, *this).run();
}

template TileResult FaultPerturbation::run<1>(const TileInputs&) const;
template TileResult FaultPerturbation::run<4>(const TileInputs&) const;
template TileResult FaultPerturbation::run<8>(const TileInputs&) const;
template TileResult FaultPerturbation::run<16>(const TileInputs&) const;

}  // namespace gearpod::lockstep
