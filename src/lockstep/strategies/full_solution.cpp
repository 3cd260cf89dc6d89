#include "lockstep/strategies/full_solution.hpp"

#include "lockstep/tile/span_tile.hpp"

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

}  // namespace

template <int W>
TileResult FullSolution::run(const TileInputs& tile) const {
    return FullTile<W>(tile, *this).run();
}

template TileResult FullSolution::run<1>(const TileInputs&) const;
template TileResult FullSolution::run<4>(const TileInputs&) const;
template TileResult FullSolution::run<8>(const TileInputs&) const;
template TileResult FullSolution::run<16>(const TileInputs&) const;

}  // namespace gearpod::lockstep
