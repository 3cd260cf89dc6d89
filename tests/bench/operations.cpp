#include "operations.hpp"

#include <memory>
#include <variant>

#include "dynamics/planetary_motion.hpp"
#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/integrators/runge_kutta.hpp"

namespace gearpod::lockstep {

// No mode has additional inertia in the counted steps.
template <>
const ModeTables<bench::Counted>& ModeInertia::tables<bench::Counted>() const {
    static const ModeTables<bench::Counted> none;
    return none;
}

}  // namespace gearpod::lockstep

namespace gearpod::bench {

// Same as advance() of lockstep/integrators/integration_state.hpp for doubles.
inline Counted advance(Counted sum, Counted h, Counted rate, lockstep::NoRounding, int) {
    return std::fma(h, rate, sum);
}

namespace {

struct CountedState {
    machine::AlignedArray<Counted> q, v, filter;
};
[[maybe_unused]] lockstep::NoRounding position_rounding(CountedState&) {
    return {};
}

// Counts step `i`. The values have no influence: no kernel branches on them.
template <class Integrator, class Model>
Operations operations_of(const lockstep::IntegrationPlan& plan, int planets, int i) {
    typename Model::Lanes lanes{};
    lanes.planets = planets;
    const auto degrees = static_cast<std::size_t>(Model::degrees_of_freedom(lanes));
    const auto channels = static_cast<std::size_t>(plan.channels());
    CountedState state;
    state.q.resize(degrees);
    state.v.resize(degrees);
    state.filter.resize(channels * lockstep::kFilterStates);
    const machine::AlignedArray<Counted> filter(plan.grid.lengths.size() *
                                                lockstep::kFilterCoefficients);
    const auto stages = std::make_unique<typename Integrator::template Stages<Model>>();
    Operations::done() = {};
    Integrator::template step<Model>(plan, lanes, filter, {}, i, state, *stages);
    return Operations::done();
}

template <class Integrator>
Operations of_planetary(const lockstep::IntegrationPlan& plan, int i) {
    using dynamics::LinearMesh;
    const auto& layout = std::get<dynamics::PlanetaryLayout>(plan.layout);
    if (layout.motion == dynamics::Motion::torsional) {
        using Model = dynamics::TorsionalMotion<LinearMesh, 1, Counted>;
        return operations_of<Integrator, Model>(plan, layout.planets, i);
    }
    using Model =
        dynamics::TranslationalMotion<dynamics::WithInertialTerms, LinearMesh, 1, Counted>;
    return operations_of<Integrator, Model>(plan, layout.planets, i);
}

}  // namespace

Operations rk4_operations(const lockstep::IntegrationPlan& plan) {
    return of_planetary<lockstep::RungeKutta4>(plan, 0);
}

Operations central_difference_operations(const lockstep::IntegrationPlan& plan) {
    const auto& steps = plan.grid.steps;
    int i = 1;
    while (i + 1 < static_cast<int>(steps.size()) &&
           steps[static_cast<std::size_t>(i)].sample >= 0) {
        ++i;
    }
    return of_planetary<lockstep::CentralDifference>(plan, i);
}

double bytes_streamed(const lockstep::IntegrationPlan& plan, int lanes) {
    const auto steps = static_cast<double>(plan.grid.steps.size());
    const double nodes = static_cast<double>(plan.grid.stage_nodes.size());
    const double read = 2.0 * nodes * plan.nodes.pairs * sizeof(double);
    const double written = static_cast<double>(plan.samples()) * (plan.channels() + 1) * lanes *
                           sizeof(double) / steps;
    return read + written;
}

double bytes_of_tile(const lockstep::IntegrationPlan& plan, int lanes, int bytes_of_number) {
    const double degrees = dynamics::degrees_of_freedom(plan.layout);
    const double pairs = plan.nodes.pairs, channels = plan.channels();
    constexpr double kParameters = 4 * 4 + 3 * 3 + 2 + 4;  // rows of PlanetaryLanes
    const double rows = 7.0 * degrees                      // q, v, five rows of stages
                        + 2.0 * pairs + 3.0 * channels + lockstep::kFilterStates * channels +
                        lockstep::kFilterCoefficients + kParameters;
    return rows * lanes * bytes_of_number;
}

}  // namespace gearpod::bench
