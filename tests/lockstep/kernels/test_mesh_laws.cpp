// Checks meshes with transmission error and meshes that separate against closed forms.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/pair_of_masses.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_mesh_laws {

using dynamics::MeshLaw;
using test::LiangTrain;
using test::PairOfMasses;

// A ball that lands on a spring with a damper and leaves it where d passes 0, computed from one
// event to the next by the closed forms of both phases.
class BouncingBall {
  public:
    BouncingBall(double d, double v, double gravity, double w, double damping_ratio)
        : d_(d), v_(v), gravity_(gravity), w_(w), zeta_(damping_ratio) {}

    std::pair<double, double> after(double time) const {
        double d = d_, v = v_;
        bool pressed = d > 0.0;
        while (true) {
            const double until = event(d, v, pressed, time);
            std::tie(d, v) = flow(d, v, pressed, until);
            time -= until;
            if (time <= 0.0) {
                return {d, v};
            }
            d = 0.0;
            pressed = !pressed;
        }
    }

  private:
    std::pair<double, double> flow(double d, double v, bool pressed, double t) const {
        if (!pressed) {
            return {d + t * (v + 0.5 * gravity_ * t), v + gravity_ * t};
        }
        const double rest = gravity_ / (w_ * w_), damped = w_ * std::sqrt(1.0 - zeta_ * zeta_);
        const double a = d - rest, b = (v + zeta_ * w_ * a) / damped;
        const double decay = std::exp(-zeta_ * w_ * t);
        const double c = std::cos(damped * t), s = std::sin(damped * t);
        return {rest + decay * (a * c + b * s),
                decay * ((b * damped - zeta_ * w_ * a) * c - (a * damped + zeta_ * w_ * b) * s)};
    }

    // The first time after which d has changed its sign, at most `limit`.
    double event(double d, double v, bool pressed, double limit) const {
        const double step = 0.01 / w_;
        for (double t = step; t < limit; t += step) {
            if ((flow(d, v, pressed, t).first > 0.0) != pressed) {
                double low = t - step, high = t;
                for (int i = 0; i < 80; ++i) {
                    const double middle = 0.5 * (low + high);
                    const bool same = (flow(d, v, pressed, middle).first > 0.0) == pressed;
                    (same ? low : high) = middle;
                }
                return high;
            }
        }
        return limit;
    }

    double d_, v_, gravity_, w_, zeta_;
};

std::vector<dynamics::GearboxInputs> eight_trains(double backlash_m) {
    std::vector<dynamics::GearboxInputs> inputs;
    for (int l = 0; l < 8; ++l) {
        auto in = LiangTrain::instance().inputs(10.0, 1e8 * (0.8 + 0.05 * l));
        in.backlash_m = backlash_m;
        inputs.emplace_back(in);
    }
    return inputs;
}

TEST_CASE("No force acts in the gap, and a collision conserves momentum and energy") {
    PairOfMasses masses(MeshLaw::separating, 4000, 1e-4);
    masses.state.q[2] = -3e-6;
    masses.state.v = {0.0, 0.0, 0.2, -0.05};
    const double momentum = masses.momentum(), energy = std::pow(masses.rate(), 2);
    const auto free_velocity = masses.state.v;
    PairOfMasses in_gap = masses;
    in_gap.in.mesh_period_s = 1.9e-5;  // the gap closes after 2e-5 s
    in_gap.integrate_mesh();
    CHECK(in_gap.state.v == free_velocity);  // equal to the bit
    masses.integrate_mesh();
    CHECK(masses.deflection() < 0.0);  // it has returned
    CHECK(masses.rate() == Approx(-std::sqrt(energy)).epsilon(1e-6));
    CHECK(masses.momentum() == Approx(momentum).epsilon(1e-12));
}

TEST_CASE("Undamped tooth pairs that touch one after another conserve energy") {
    // Three tooth pairs of different stiffness, whose gaps close one after another.
    const double stiffness[] = {1e8, 2e8, 3e8}, gap[] = {0.0, 1.3e-6, 2.1e-6};
    for (const auto integrator : {Integrator::rk4, Integrator::central_difference}) {
        std::vector<double> errors;
        for (const int steps : {4000, 8000}) {
            PairOfMasses masses(MeshLaw::unilateral, steps, 3e-4, 0.0, integrator);
            StiffnessNodes& nodes = masses.plan.nodes;
            nodes.tooth_pairs = 3;
            for (std::size_t i = 0; i < nodes.stiffness.size() / 2; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    nodes.tooth_stiffness.insert(nodes.tooth_stiffness.end(), {stiffness[j], 0.0});
                    nodes.tooth_gap.insert(nodes.tooth_gap.end(), {gap[j], 0.0});
                    nodes.tooth_position.insert(nodes.tooth_position.end(), 2, 0.0);
                }
            }
            masses.in.force_N[dynamics::sun] = 0.0;
            masses.state.q[2] = 0.5e-6;
            masses.state.v = {0.0, 0.0, 0.12, 0.0};
            const auto energy = [&] {
                double sum = 0.5 * PairOfMasses::kMass * std::pow(masses.rate(), 2);
                for (std::size_t j = 0; j < 3; ++j) {
                    const double pressed = std::max(0.0, masses.deflection() - gap[j]);
                    sum += 0.5 * stiffness[j] * pressed * pressed;
                }
                return sum;
            };
            const double before = energy(), momentum = masses.momentum();
            const auto d = masses.integrate_mesh();
            CHECK(*std::ranges::max_element(d) > gap[2]);  // all three have touched
            CHECK(masses.momentum() == Approx(momentum).epsilon(1e-12));
            errors.push_back(std::abs(energy() / before - 1.0));
        }
        INFO("integrator " << static_cast<int>(integrator) << ": errors " << errors[0] << ", "
                           << errors[1]);
        CHECK(errors[1] < 2e-6);
    }
}

TEST_CASE("A loaded pair bounces as the event-driven solution does") {
    const auto integrator = GENERATE(Integrator::rk4, Integrator::newmark, Integrator::sdirk3,
                                     Integrator::central_difference);
    for (const double damping_ratio : {0.0, 0.08}) {
        PairOfMasses base(MeshLaw::separating, 40000, 1e-3);
        const double w = base.natural_rad_s();
        const double c = 2.0 * damping_ratio * w * PairOfMasses::kMass;
        const double gravity = 5e3, start = -2e-6;
        const BouncingBall ball(start, 0.0, gravity, w, damping_ratio);
        std::vector<double> errors;
        for (const int steps : {20000, 40000}) {
            PairOfMasses masses(MeshLaw::separating, steps, 1e-3, c, integrator);
            masses.in.force_N[dynamics::sun] = gravity * PairOfMasses::kSun;
            masses.state.q[2] = start;
            const auto d = masses.integrate_mesh();
            double error = 0.0, size = 0.0;
            int solver_families = 0;
            for (int i = 0; i < steps; i += steps / 400) {
                const double expected = ball.after(1e-3 * i / steps).first;
                error = std::max(error, std::abs(d[static_cast<std::size_t>(i)] - expected));
                size = std::max(size, std::abs(expected));
                solver_families += expected < 0.0 ? 1 : 0;
            }
            CHECK(solver_families > 10);
            errors.push_back(error / size);
        }
        INFO("integrator " << static_cast<int>(integrator) << ", damping ratio " << damping_ratio
                           << ": errors " << errors[0] << ", " << errors[1]);
        // The damping force jumps at contact, at an arbitrary position within a step.
        CHECK(errors[1] < (damping_ratio > 0.0 ? 2e-3 : 1e-5));
        CHECK((damping_ratio == 0.0 || errors[1] < 0.7 * errors[0]));
    }
}

TEST_CASE(
    "Between front and back flanks a pair rattles with the period of free motion and half waves") {
    const double backlash = 5e-6, speed = 0.3;
    const auto integrator = GENERATE(Integrator::rk4, Integrator::newmark, Integrator::sdirk3,
                                     Integrator::central_difference);
    PairOfMasses masses(MeshLaw::separating, 60000, 1.0, 0.0, integrator);
    masses.in.backlash_m = backlash;
    const double period = 2.0 * backlash / speed + 2.0 * std::numbers::pi / masses.natural_rad_s();
    masses.in.mesh_period_s = 6.0 * period;
    masses.state.v = {0.0, 0.0, speed, 0.0};
    const auto d = masses.integrate_mesh();
    CHECK(masses.deflection() == Approx(0.0).margin(1e-4 * backlash));
    CHECK(masses.rate() == Approx(speed).epsilon(1e-4));
    const double depth = speed / masses.natural_rad_s();
    CHECK(*std::max_element(d.begin(), d.end()) == Approx(depth).epsilon(1e-4));
    CHECK(*std::min_element(d.begin(), d.end()) == Approx(-backlash - depth).epsilon(1e-4));
}

TEST_CASE("A loaded train that never separates keeps the linear integration's bits") {
    const auto integrator = GENERATE(Integrator::rk4, Integrator::central_difference);
    const auto& train = LiangTrain::instance();
    for (const auto motion :
         {dynamics::Motion::translational_torsional, dynamics::Motion::torsional}) {
        IntegrationPlan plan = train.plan(24, 1200, motion, integrator);
        const std::vector<double> depths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 3.5e-3, 4e-3, 4.28e-3};
        const auto faults = train.ring_side_cracks(depths);
        const auto cracks_of_four = train.ring_side_cracks({depths.begin() + 4, depths.end()});
        const auto trains = eight_trains(1e-5);
        const TileResult linear = run_tile<8>(plan, trains, faults, PeriodicSolution{});
        for (const auto law : {MeshLaw::with_error, MeshLaw::separating}) {
            plan.mesh_law = law;
            const TileResult other = run_tile<8>(plan, trains, faults, PeriodicSolution{});
            const TileResult four =
                run_tile<4>(plan, std::span(trains).last(4), cracks_of_four, PeriodicSolution{});
            CHECK(other.content == linear.content);
            REQUIRE(other.records.size() == linear.records.size());
            for (std::size_t r = 0; r < linear.records.size(); ++r) {
                CHECK(other.records[r].te == linear.records[r].te);
                CHECK(other.records[r].acceleration == linear.records[r].acceleration);
            }
            REQUIRE(four.content == linear.content);
            for (std::size_t r = 0; r < four.records.size(); ++r) {
                const auto &own = four.records[r].acceleration,
                           &all = linear.records[r].acceleration;
                REQUIRE(2 * own.size() == all.size());
                for (std::size_t i = 0; i < own.size(); ++i) {
                    CHECK(own[i] == all[8 * (i / 4) + 4 + i % 4]);
                }
            }
        }
    }
}

TEST_CASE(
    "A pair responds to each harmonic of its transmission error with its frequency response") {
    const double period = 1.3e-4, damping_ratio = 0.06;
    const MeshError error{{2e-6, 0.7e-6, 0.4e-6}, {0.3, -1.1, 2.0}};
    for (const auto& [law, integrator, tolerance] :
         {std::tuple{MeshLaw::with_error, Integrator::rk4, 1e-6},
          std::tuple{MeshLaw::separating, Integrator::rk4, 1e-6},
          std::tuple{MeshLaw::with_error, Integrator::sdirk3, 1e-6},
          std::tuple{MeshLaw::separating, Integrator::sdirk3, 1e-6},
          std::tuple{MeshLaw::separating, Integrator::newmark, 1e-4},
          std::tuple{MeshLaw::with_error, Integrator::central_difference, 1e-4},
          std::tuple{MeshLaw::separating, Integrator::central_difference, 1e-4}}) {
        PairOfMasses base(law, 2000, period);
        const double w = base.natural_rad_s();
        PairOfMasses masses(law, 2000, period, 2.0 * damping_ratio * w * PairOfMasses::kMass,
                            integrator);
        // The load is high enough to keep contact.
        const double gravity = 1e5;
        masses.in.force_N[dynamics::sun] = gravity * PairOfMasses::kSun;
        for (const Step& step : masses.plan.grid.steps) {
            for (const double node : masses.plan.grid.stage_nodes) {
                const ErrorValue e = error_at(error, step.phase + node * step.length);
                masses.plan.nodes.error.insert(masses.plan.nodes.error.end(), {e.error, 0.0});
                masses.plan.nodes.error_rate.insert(masses.plan.nodes.error_rate.end(),
                                                    {e.rate, 0.0});
            }
        }
        masses.state.q[2] = gravity / (w * w);
        machine::AlignedVector d;
        for (int mesh = 0; mesh < 60; ++mesh) {
            d = masses.integrate_mesh();
        }
        double worst = 0.0;
        for (int i = 0; i < 2000; i += 20) {
            // Frequency response of d'' + 2 z w d' + w^2 d = g + 2 z w e' + w^2 e.
            std::complex<double> sum = gravity / (w * w);
            for (std::size_t h = 0; h < 3; ++h) {
                const double rate = 2.0 * std::numbers::pi * static_cast<double>(h + 1) / period;
                const std::complex<double> j(0.0, 1.0);
                const auto input = error.amplitude_m[h] *
                                   std::exp(j * (rate * period * i / 2000.0 + error.phase_rad[h]));
                const auto spring = w * w + 2.0 * j * damping_ratio * w * rate;
                sum += (spring * input / (spring - rate * rate)).imag();
            }
            worst = std::max(worst, std::abs(d[static_cast<std::size_t>(i)] - sum.real()));
        }
        INFO("integrator " << static_cast<int>(integrator) << ", worst " << worst / 2e-6);
        CHECK(worst < tolerance * 2e-6);
    }
}

TEST_CASE("Errors shift with the pairs' phases and run backwards where contact does") {
    const auto& train = LiangTrain::instance();
    PairSet pairs = train.pairs;
    const MeshError error{{1e-6, 0.5e-6}, {0.4}};
    const std::vector<MeshError> errors(8, error);
    const PhaseGrid grid = make_phase_grid(20, 20, {});
    const auto table = [&] {
        StiffnessNodes nodes = tabulate(pairs, grid, dynamics::MeshDamping::ratio);
        add_errors(pairs, grid, errors, nodes);
        return nodes;
    };
    const StiffnessNodes forward = table();
    // Planet 2 of 19/31/81 meshes three quarters of a period after planet 1, 15 steps of 20.
    const auto at = [&](const StiffnessNodes& nodes, int step, int node, int pair) {
        return nodes.error[static_cast<std::size_t>(((step % 20) * 3 + node) * 8 + pair)];
    };
    for (int step = 0; step < 20; ++step) {
        CHECK(at(forward, step + 15, 0, 1) == Approx(at(forward, step, 0, 0)).margin(1e-18));
        CHECK(at(forward, step, 2, 0) == Approx(at(forward, step + 1, 0, 0)).margin(1e-18));
    }
    CHECK(at(forward, 0, 0, 0) == Approx(1e-6 * std::sin(0.4)).margin(1e-18));  // pitch point
    // Mirror image: the same engagements in reverse time, t to -t.
    pairs.reversed = true;
    for (int pair = 0; pair < 8; ++pair) {
        const auto i = static_cast<std::size_t>(pair);
        pairs.start[i] =
            phase_in_period(-pairs.start[i] - pairs.curve(PairId{pair}).contact_ratio());
    }
    const StiffnessNodes mirrored = table();
    for (int step = 1; step < 20; ++step) {
        for (int pair = 0; pair < 8; ++pair) {
            CHECK(at(mirrored, step, 0, pair) ==
                  Approx(at(forward, 20 - step, 0, pair)).margin(1e-18));
            const auto rate = [&](const StiffnessNodes& nodes, int s) {
                return nodes.error_rate[static_cast<std::size_t>(s * 3 * 8 + pair)];
            };
            CHECK(rate(mirrored, step) == Approx(-rate(forward, 20 - step)).margin(1e-17));
        }
    }
}

TEST_CASE("Planets in phase have equal motions under errors and separation") {
    const auto& train = LiangTrain::instance();
    for (const auto motion :
         {dynamics::Motion::translational_torsional, dynamics::Motion::torsional}) {
        IntegrationPlan plan = train.plan(24, 1200, motion, false);
        plan.mesh_law = MeshLaw::separating;
        plan.nodes.error.resize(plan.nodes.stiffness.size());
        plan.nodes.error_rate.resize(plan.nodes.stiffness.size());
        const MeshError error{{12e-6}, {}};
        for (std::size_t i = 0; i < plan.nodes.stiffness.size(); ++i) {
            // Expected motion of all planets: that of planet 1.
            const std::size_t first = i - i % 8 + (i % 8 < 4 ? 0 : 4);
            plan.nodes.stiffness[i] = plan.nodes.stiffness[first];
            plan.nodes.damping_shape[i] = plan.nodes.damping_shape[first];
            const Step& step = plan.grid.steps[i / 24];
            const ErrorValue e =
                error_at(error, step.phase + 0.5 * static_cast<double>(i / 8 % 3) * step.length);
            plan.nodes.error[i] = e.error;
            plan.nodes.error_rate[i] = e.rate;
        }
        // Rounding differences between planets at different positions may grow where teeth
        // separate; the rotations alone have none.
        const bool torsional = motion == dynamics::Motion::torsional;
        auto in = train.inputs(60.0);
        for (double& force : in.force_N) {
            force *= torsional ? 0.005 : 0.5;
        }
        const dynamics::GearboxInputs inputs = in;
        const int degrees = torsional ? 7 : 21, first = torsional ? 3 : 11;
        TileState state;
        state.q.assign(static_cast<std::size_t>(degrees), 0.0);
        state.v = state.q;
        state.filter.assign(8 * kFilterStates, 0.0);
        MeshRecord record = make_record(plan, 1, true);
        const auto mesh_integrator = make_mesh_integrator<1>(plan, std::span(&inputs, 1));
        bool parted = false;
        for (int mesh = 0; mesh < 40; ++mesh) {
            (*mesh_integrator)({}, state, record);
            for (int sample = 0; sample < 24; ++sample) {
                const double* q = record.motion.data() + sample * degrees;
                for (int n = 1; n < 4; ++n) {
                    const double other = q[first + n * (torsional ? 1 : 3)];
                    CHECK(std::abs(other - q[first]) <=
                          (torsional ? 0.0 : 1e-9 * std::abs(q[first])));
                }
                if (torsional) {
                    const double d = q[2] + q[3] - q[0] * std::cos(LiangTrain::kAngle);
                    parted = parted || d < error_at(error, sample / 24.0).error;
                }
            }
        }
        CHECK(parted == torsional);
    }
}

TEST_CASE("From a far start a loaded train converges to the periodic orbit reached from rest") {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan = train.plan(24, 1200, dynamics::Motion::torsional);
    plan.mesh_law = MeshLaw::separating;
    const dynamics::GearboxInputs inputs = train.inputs(10.0);
    const TileResult periodic_orbit =
        run_tile<1>(plan, std::span(&inputs, 1), train.no_fault(1), PeriodicSolution{});
    TileState state;
    state.q.assign(7, 0.0);
    state.v.assign(7, 0.0);
    state.filter.assign(8 * kFilterStates, 0.0);
    state.q[2] = -1e-3;  // the sun rotated back by a millimetre
    MeshRecord record = make_record(plan, 1, false);
    const auto mesh_integrator = make_mesh_integrator<1>(plan, std::span(&inputs, 1));
    for (int mesh = 0; mesh < 400; ++mesh) {
        (*mesh_integrator)({}, state, record);
    }
    for (std::size_t i = 0; i < 24; ++i) {
        CHECK(record.te[i] == Approx(periodic_orbit.records[0].te[i]).epsilon(1e-6));
    }
}

}  // namespace gearpod::lockstep::test_mesh_laws
