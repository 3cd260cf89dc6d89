// Checks one integrated mesh period against another solver, a closed form and the method's order.
#include <boost/numeric/odeint.hpp>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_integration {

using test::LiangTrain;

TileState rest(const IntegrationPlan& plan, const dynamics::PlanetaryInputs& in) {
    const std::vector<double> k(plan.nodes.stiffness.begin(), plan.nodes.stiffness.begin() + 8);
    return test::state_at(plan,
                          dynamics::static_equilibrium(dynamics::assemble(plan.layout, in, k)));
}

TileState integrate_mesh_period(const IntegrationPlan& plan, const dynamics::PlanetaryInputs& in,
                                TileState state, MeshRecord& record) {
    const dynamics::GearboxInputs inputs = in;
    record = make_record(plan, 1, false);
    (*make_mesh_integrator<1>(plan, std::span(&inputs, 1)))({}, state, record);
    return state;
}

// Same mesh period by an adaptive Dormand-Prince pair over the assembled matrices, restarted at
// every contact transition, with the stiffness evaluated anew.
std::vector<double> dormand_prince(const IntegrationPlan& plan, const dynamics::PlanetaryInputs& in,
                                   const TileState& from) {
    const auto& train = LiangTrain::instance();
    const std::size_t n = from.q.size();
    std::vector<double> x(from.q.begin(), from.q.end());
    x.insert(x.end(), from.v.begin(), from.v.end());
    const auto at_rest = dynamics::assemble(plan.layout, in, std::vector<double>(8, 0.0));
    const Eigen::MatrixXd inverse_mass =
        dynamics::inverse(with_mode_inertia(at_rest, plan.mode_inertia).mass);

    double middle = 0.0;  // within the smooth interval: determines the tooth pairs in contact
    const auto derivative = [&](const std::vector<double>& s, std::vector<double>& ds, double t) {
        std::vector<double> k(8, 0.0);
        const double phase = t / in.mesh_period_s;
        for (std::size_t pair = 0; pair < 8; ++pair) {
            const auto& curve = pair < 4 ? train.sun_planet : train.ring_planet;
            for (int age = 0; age < 3; ++age) {
                const double start = train.pairs.start[pair] - age;
                if (middle > start && middle < start + curve.contact_ratio()) {
                    const double tau = std::clamp(phase - start, 0.0, curve.contact_ratio());
                    k[pair] += curve.tooth_pair(tau);
                }
            }
        }
        const auto m = dynamics::assemble(plan.layout, in, k);
        const Eigen::Map<const Eigen::VectorXd> q(s.data(), static_cast<Eigen::Index>(n));
        const Eigen::Map<const Eigen::VectorXd> v(s.data() + n, static_cast<Eigen::Index>(n));
        const Eigen::VectorXd a = inverse_mass * (m.force - (m.damping + m.gyroscopic) * v -
                                                  (m.stiffness + m.centrifugal) * q);
        ds.resize(2 * n);
        std::copy(v.begin(), v.end(), ds.begin());
        std::copy(a.begin(), a.end(), ds.begin() + static_cast<std::ptrdiff_t>(n));
    };
    using namespace boost::numeric::odeint;
    auto stepper = make_controlled(1e-14, 1e-10, runge_kutta_dopri5<std::vector<double>>());
    std::vector<double> cuts = contact_transitions(train.pairs);
    cuts.push_back(1.0);
    double start = 0.0;
    for (const double cut : cuts) {
        if (cut - start > 1e-12) {
            middle = 0.5 * (start + cut);
            integrate_adaptive(stepper, derivative, x, start * in.mesh_period_s,
                               cut * in.mesh_period_s, 1e-6);
        }
        start = cut;
    }
    return x;
}

TEST_CASE("An integrated mesh period agrees with an adaptive solver over the assembled matrices") {
    const auto& train = LiangTrain::instance();
    // The speed is high enough for inertia, damping and the rotating frame to have an effect.
    const auto in = train.inputs(20.0);
    const IntegrationPlan plan = train.plan(24, 9600, dynamics::Motion::translational_torsional);
    const TileState start = rest(plan, in);
    MeshRecord record;
    const TileState ours = integrate_mesh_period(plan, in, start, record);
    const auto theirs = dormand_prince(plan, in, start);
    const double scale_q = test::largest_magnitude(ours.q),
                 scale_v = test::largest_magnitude(ours.v);
    for (std::size_t i = 0; i < ours.q.size(); ++i) {
        CHECK(ours.q[i] == Approx(theirs[i]).margin(1e-7 * scale_q));
        CHECK(ours.v[i] == Approx(theirs[ours.q.size() + i]).margin(1e-6 * scale_v));
    }
}

TEST_CASE("Central differences with selective mass scaling agree with the heavier gearbox") {
    const auto& train = LiangTrain::instance();
    const auto in = train.inputs(20.0);
    const auto motion = dynamics::Motion::translational_torsional;
    const auto errors_with = [&](int steps) {
        IntegrationPlan plan = train.plan(24, steps, motion, Integrator::central_difference);
        const std::vector<double> k(plan.nodes.stiffness.begin(), plan.nodes.stiffness.begin() + 8);
        plan.mode_inertia =
            mode_inertia(dynamics::assemble(plan.layout, in, k), 2.0 * std::numbers::pi * 3000.0);
        REQUIRE(plan.mode_inertia.modes > 4);
        const TileState start = rest(plan, in);
        MeshRecord record;
        const TileState ours = integrate_mesh_period(plan, in, start, record);
        const auto theirs = dormand_prince(plan, in, start);
        double difference = 0.0, scale = 0.0;
        for (std::size_t i = 0; i < ours.q.size(); ++i) {
            difference = std::max(difference, std::abs(ours.v[i] - theirs[ours.q.size() + i]));
            scale = std::max(scale, std::abs(ours.v[i]));
        }
        return difference / scale;
    };
    const double coarse = errors_with(4800), fine = errors_with(9600);
    CHECK(fine < 1e-4);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.2));
}

TEST_CASE("Runge-Kutta keeps order 4 across the contact transitions, in state and sensor signal") {
    const auto& train = LiangTrain::instance();
    const auto in = train.inputs(20.0);
    for (const auto motion :
         {dynamics::Motion::translational_torsional, dynamics::Motion::torsional}) {
        std::vector<double> positions, sensors;
        for (const int steps : {1200, 2400, 4800}) {
            const IntegrationPlan plan = train.plan(24, steps, motion);
            MeshRecord record;
            TileState state = integrate_mesh_period(plan, in, rest(plan, in), record);
            state = integrate_mesh_period(plan, in, state, record);
            positions.push_back(state.q.back());
            sensors.push_back(record.acceleration[static_cast<std::size_t>(17 * plan.channels())]);
        }
        const auto order = [](const std::vector<double>& x) {
            return std::log2(std::abs(x[0] - x[1]) / std::abs(x[1] - x[2]));
        };
        CHECK(order(positions) > 3.6);
        CHECK(order(sensors) > 3.6);
    }
}

TEST_CASE("An undamped mode of a gearbox with constant stiffness follows its cosine") {
    const auto& train = LiangTrain::instance();
    dynamics::PlanetaryInputs in = train.inputs();
    std::ranges::fill(in.bearing_damping_N_s_m, 0.0);
    in.support_damping_N_s_m = in.mesh_damping = 0.0;
    std::fill(std::begin(in.force_N), std::end(in.force_N), 0.0);
    in.mesh_period_s = 1e-3;

    IntegrationPlan plan = train.plan(10, 4000, dynamics::Motion::translational_torsional, false);
    std::fill(plan.nodes.stiffness.begin(), plan.nodes.stiffness.end(), 1.5e9);
    const auto matrices = dynamics::assemble(plan.layout, in, std::vector<double>(8, 1.5e9));
    const dynamics::Modes modes = dynamics::modes(matrices.stiffness, matrices.mass);
    for (const Eigen::Index mode : {1, 8, 20}) {
        const Eigen::VectorXd shape = 1e-6 * modes.shapes.col(mode);
        TileState state = rest(plan, in);
        std::copy(shape.begin(), shape.end(), state.q.begin());
        MeshRecord record;
        state = integrate_mesh_period(plan, in, state, record);
        const double w = std::sqrt(modes.squares(mode));
        for (std::size_t d = 0; d < state.q.size(); ++d) {
            const double expected = shape(static_cast<Eigen::Index>(d)) * std::cos(w * 1e-3);
            CHECK(state.q[d] == Approx(expected).margin(1e-7 * shape.cwiseAbs().maxCoeff()));
        }
    }
}

}  // namespace gearpod::lockstep::test_integration
