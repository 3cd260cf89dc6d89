// Checks unilateral contact per tooth pair: equal pairs against one mesh, and different pairs
// against an integration of the assembled matrices with separate teeth.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_unilateral_contact {

using dynamics::MeshLaw;
using test::LiangTrain;

const std::vector<double> kDepths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 3.5e-3, 4e-3, 4.28e-3};

IntegrationPlan plan_for(Integrator integrator, MeshLaw law, int steps, dynamics::Motion motion) {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan = train.plan(24, steps, motion, integrator);
    plan.mesh_law = law;
    if (law == MeshLaw::unilateral) {
        add_tooth_pairs(train.pairs, plan.grid, plan.nodes);
    }
    return plan;
}

// A train at high speed under partial load, so that teeth lose contact.
std::vector<dynamics::GearboxInputs> light_trains(double load, double speedup) {
    std::vector<dynamics::GearboxInputs> inputs;
    for (int l = 0; l < 8; ++l) {
        auto in = LiangTrain::instance().inputs(speedup, 1e8 * (0.8 + 0.05 * l));
        for (double& force : in.force_N) {
            force *= load;
        }
        inputs.emplace_back(in);
    }
    return inputs;
}

// Normal errors of every flank, one set for each of eight lanes.
ToothErrors random_errors(const PairSet& pairs, double rms_m, bool with_slopes) {
    std::mt19937 engine(7);
    std::normal_distribution<double> normal(0.0, rms_m);
    const auto draw = [&](std::size_t, std::size_t) { return normal(engine); };
    return with_slopes ? LiangTrain::tooth_errors(pairs, 8, draw, draw)
                       : LiangTrain::tooth_errors(pairs, 8, draw);
}

// One lane of the train with separate teeth: M q'' = f - (C + G) q' - (K + K_c) q - sum of R_p F_p.
class ToothByTooth {
  public:
    ToothByTooth(const IntegrationPlan& plan, const dynamics::PlanetaryInputs& in,
                 const ToothErrors& errors, std::size_t lane, double crack_m)
        : plan_(plan), in_(in), errors_(errors), lane_(lane) {
        auto bare = in;
        bare.mesh_damping = 0.0;
        matrices_ = dynamics::assemble(plan.layout, bare, std::vector<double>(8, 0.0));
        inverse_mass_ = dynamics::inverse(matrices_.mass);
        for (int pair = 0; pair < 8; ++pair) {
            rows_.push_back(dynamics::mesh_row(plan.layout, PairId{pair}));
        }
        if (crack_m > 0.0) {
            const auto fault = LiangTrain::instance().cracked.at(crack_m);
            cracked_ = LiangTrain::instance().ring_planet.faulty_pair(*fault);
        }
    }

    Eigen::VectorXd q, v;
    int lost = 0, open = 0;  // time steps in which a tooth pair, a whole mesh was out of contact

    // Integrates mesh k by the classical Runge-Kutta method, with two of its steps in one of the
    // grid's.
    void integrate_mesh(int k) {
        for (const Step& step : plan_.grid.steps) {
            const double inside = k + step.phase + 0.5 * step.length;
            for (const double part : {0.0, 0.5}) {
                const double x = k + step.phase + part * step.length;
                const double h = 0.5 * step.length, t = h * in_.mesh_period_s;
                const auto [v1, a1] = rates(q, v, x, inside);
                const auto [v2, a2] =
                    rates(q + 0.5 * t * v1, v + 0.5 * t * a1, x + 0.5 * h, inside);
                const auto [v3, a3] =
                    rates(q + 0.5 * t * v2, v + 0.5 * t * a2, x + 0.5 * h, inside);
                const auto [v4, a4] = rates(q + t * v3, v + t * a3, x + h, inside);
                q += t / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
                v += t / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            }
        }
    }

  private:
    std::pair<Eigen::VectorXd, Eigen::VectorXd> rates(const Eigen::VectorXd& at,
                                                      const Eigen::VectorXd& rate, double x,
                                                      double inside) {
        Eigen::VectorXd force = matrices_.force -
                                (matrices_.damping + matrices_.gyroscopic) * rate -
                                (matrices_.stiffness + matrices_.centrifugal) * at;
        for (int pair = 0; pair < 8; ++pair) {
            const Eigen::VectorXd& row = rows_[static_cast<std::size_t>(pair)];
            force -= mesh_force(pair, row.dot(at), row.dot(rate), x, inside) * row;
        }
        return {rate, inverse_mass_ * force};
    }

    double mesh_force(int pair, double d, double rate, double x, double inside) {
        const auto& train = LiangTrain::instance();
        const auto p = static_cast<std::size_t>(pair);
        const auto& mesh = pair < 4 ? train.sun_planet : train.ring_planet;
        double total = 0.0, pressed = 0.0;
        bool any_gap = false;
        for (int m = static_cast<int>(inside) - 4; m <= inside; ++m) {
            const double begun = m + train.pairs.start[p];
            if (inside < begun || inside > begun + mesh.contact_ratio()) {
                continue;
            }
            const double tau = std::clamp(x - begun, 0.0, mesh.contact_ratio());
            const bool faulty = pair == 4 && m % 31 == 0 && !cracked_.pieces().empty();
            const double k = faulty ? cracked_(tau) : mesh.tooth_pair(tau);
            const double gap = d - error(p, m, tau / mesh.contact_ratio() - 0.5);
            total += k;
            pressed += k * std::max(0.0, gap);
            any_gap = any_gap || gap < 0.0;
        }
        lost += any_gap && pressed > 0.0 ? 1 : 0;
        open += pressed > 0.0 ? 0 : 1;
        const double c = dynamics::mesh_damping_N_s_m(
            dynamics::MeshDamping::ratio,
            dynamics::mesh_damping_factor(plan_.layout, in_, PairId{pair}), total);
        return pressed > 0.0 ? pressed + c * rate : 0.0;
    }

    // Gap of the tooth pair that begins to engage in mesh m. The sun drives the planets and they
    // drive the ring; contact on a driving flank begins at its root.
    double error(std::size_t pair, int m, double place) const {
        double sum = 0.0;
        for (const int side : {0, 1}) {
            const GearErrors& gear =
                errors_.gears[static_cast<std::size_t>(errors_.pairs[pair].gear[side])];
            const int tooth =
                ((m - errors_.pairs[pair].first[side]) % gear.teeth + gear.teeth) % gear.teeth;
            const std::size_t at = static_cast<std::size_t>(tooth) * 8 + lane_;
            sum += gear.error_m[at];
            if (!gear.slope_m.empty()) {
                const bool is_input_side = pair < 4 ? side == 0 : side == 1;
                sum += (is_input_side ? place : -place) * gear.slope_m[at];
            }
        }
        return sum;
    }

    const IntegrationPlan& plan_;
    const dynamics::PlanetaryInputs& in_;
    const ToothErrors& errors_;
    std::size_t lane_;
    dynamics::GearboxMatrices matrices_;
    Eigen::MatrixXd inverse_mass_;
    std::vector<Eigen::VectorXd> rows_;
    stiffness::ToothPairCurve cracked_;
};

Eigen::VectorXd lane_of(const machine::AlignedVector& values, std::size_t lane) {
    Eigen::VectorXd own(static_cast<Eigen::Index>(values.size() / 8));
    for (Eigen::Index d = 0; d < own.size(); ++d) {
        own(d) = values[static_cast<std::size_t>(d) * 8 + lane];
    }
    return own;
}

TEST_CASE("Tooth pairs without errors act as one mesh that separates") {
    const auto& train = LiangTrain::instance();
    const auto integrator =
        GENERATE(from_range(all_integrators().begin(), all_integrators().end()));
    for (const auto motion :
         {dynamics::Motion::translational_torsional, dynamics::Motion::torsional}) {
        const auto faults = train.ring_side_cracks(kDepths);
        const auto trains = light_trains(0.05, 60.0);
        std::vector<TileState> ends;
        for (const auto law : {MeshLaw::separating, MeshLaw::unilateral, MeshLaw::with_error}) {
            IntegrationPlan plan = plan_for(integrator, law, 600, motion);
            const std::vector<MeshError> errors(8, MeshError{{6e-6}, {}});
            add_errors(train.pairs, plan.grid, errors, plan.nodes);
            TileState state = equilibrium_state(plan, trains);
            MeshRecord record = make_record(plan, 8, false);
            const auto integrate_mesh = make_mesh_integrator<8>(plan, trains);
            for (int k = 0; k < 2; ++k) {
                (*integrate_mesh)(FaultSchedule(plan, faults).all_overrides(k), state, record);
            }
            ends.push_back(std::move(state));
        }
        INFO("integrator " << static_cast<int>(integrator));
        const double size = test::largest_magnitude(ends[0].q);
        // Rounding differences grow where teeth regain contact.
        CHECK(test::largest_difference(ends[1].q, ends[0].q) < 1e-7 * size);
        CHECK(test::largest_difference(ends[2].q, ends[0].q) > 1e-3 * size);
    }
}

TEST_CASE("Teeth with errors move as in an independent integration, in and out of contact") {
    const auto& train = LiangTrain::instance();
    const bool with_slopes = GENERATE(false, true);
    // Tooth pairs lose contact under the load; with larger errors and a third of the load a whole
    // mesh does.
    for (const auto& [load, rms_m] : {std::pair{1.0, 1e-6}, std::pair{0.33, 3e-6}}) {
        const ToothErrors errors = random_errors(train.pairs, rms_m, with_slopes);
        const FaultCurves faults = train.ring_side_cracks(kDepths);
        const auto trains = light_trains(load, 10.0);
        for (const auto& [integrator, tolerance] :
             {std::pair{Integrator::rk4, 1e-6}, std::pair{Integrator::sdirk3, 1e-5},
              std::pair{Integrator::newmark, 1e-3},
              std::pair{Integrator::central_difference, 1e-3}}) {
            const IntegrationPlan plan = plan_for(integrator, MeshLaw::unilateral, 2400,
                                                  dynamics::Motion::translational_torsional);
            FaultSchedule schedule(plan, faults, &errors);
            TileState state = equilibrium_state(plan, trains);
            const TileState start = state;
            MeshRecord record = make_record(plan, 8, false);
            const auto integrate_mesh = make_mesh_integrator<8>(plan, trains);
            constexpr int kMeshes = 3;
            for (int k = 0; k < kMeshes; ++k) {
                (*integrate_mesh)(schedule.all_overrides(k), state, record);
            }
            for (const std::size_t lane : {0U, 7U}) {
                ToothByTooth expected(plan, std::get<dynamics::PlanetaryInputs>(trains[lane]),
                                      errors, lane, kDepths[lane]);
                expected.q = lane_of(start.q, lane);
                expected.v = lane_of(start.v, lane);
                for (int k = 0; k < kMeshes; ++k) {
                    expected.integrate_mesh(k);
                }
                const Eigen::VectorXd q = lane_of(state.q, lane);
                INFO("load " << load << ", integrator " << static_cast<int>(integrator) << ", lane "
                             << lane << ": lost " << expected.lost << ", open " << expected.open);
                CHECK(expected.lost > 100);
                CHECK((expected.open > 100) == (load < 1.0));
                // The damping force of a mesh that separates jumps within a step.
                const double allowed = expected.open > 0 ? 3e-3 : tolerance;
                CHECK((q - expected.q).norm() < allowed * expected.q.norm());
            }
        }
    }
}

TEST_CASE("Kernels for varying forces, variable speed and single precision treat separate teeth") {
    const auto& train = LiangTrain::instance();
    const ToothErrors errors = random_errors(train.pairs, 1e-6, true);
    const FaultCurves faults = train.ring_side_cracks(kDepths);
    const auto trains = light_trains(1.0, 10.0);
    const auto full = dynamics::Motion::translational_torsional;
    const auto end_of = [&](const IntegrationPlan& plan, auto& integrate_mesh) {
        TileState state = equilibrium_state(plan, trains);
        MeshRecord record = make_record(plan, 8, false);
        integrate_mesh(FaultSchedule(plan, faults, &errors).all_overrides(0), state, record);
        return state.q;
    };
    // The excitation is constant, but kernels for varying excitation run.
    Excitation torque, speed;
    const machine::AlignedVector none(8, 0.0), one(8, 1.0);
    torque.torque = Fluctuation{none, one, none, none, {}, {}, {}};
    speed.speed = Fluctuation{none, one, none, none, {}, {}, {}};
    for (const auto& [integrator, excitation] :
         {std::pair{Integrator::rk4, &torque}, std::pair{Integrator::sdirk3, &torque},
          std::pair{Integrator::rk4, &speed}}) {
        const IntegrationPlan plan = plan_for(integrator, MeshLaw::unilateral, 2400, full);
        excitation->input_degree =
            std::get<dynamics::PlanetaryLayout>(plan.layout).rotation_index(dynamics::sun);
        excitation->rotation_m_s = one;
        const auto steady = make_mesh_integrator<8>(plan, trains);
        const auto variable_excitation_integrator =
            make_excited_integrator<8>(plan, *excitation, trains);
        const auto expected = end_of(plan, *steady);
        const auto varied = [&](const auto& overrides, TileState& state, MeshRecord& record) {
            (*variable_excitation_integrator)(0, overrides, state, record);
        };
        CHECK(test::largest_difference(end_of(plan, varied), expected) <
              1e-9 * test::largest_magnitude(expected));
    }
    // Sixteen singles: the eight realizations twice.
    IntegrationPlan plan = plan_for(Integrator::rk4, MeshLaw::unilateral, 2400, full);
    const auto expected = end_of(plan, *make_mesh_integrator<8>(plan, trains));
    plan.precision = Precision::single_precision;
    ToothErrors twice = errors;
    for (GearErrors& gear : twice.gears) {
        for (auto* values : {&gear.error_m, &gear.slope_m}) {
            const machine::AlignedVector own = *values;
            values->resize(2 * own.size());
            for (std::size_t i = 0; i < values->size(); ++i) {
                (*values)[i] = own[i / 16 * 8 + i % 8];
            }
        }
    }
    auto sixteen = trains;
    sixteen.insert(sixteen.end(), trains.begin(), trains.end());
    auto depths = kDepths;
    depths.insert(depths.end(), kDepths.begin(), kDepths.end());
    const FaultCurves both = train.ring_side_cracks(depths);
    TileState state = equilibrium_state(plan, sixteen);
    MeshRecord record = make_record(plan, 16, false);
    (*make_mesh_integrator<16>(plan, sixteen))(FaultSchedule(plan, both, &twice).all_overrides(0),
                                               state, record);
    for (std::size_t i = 0; i < state.q.size(); ++i) {
        const double own = expected[i / 16 * 8 + i % 8];
        CHECK(state.q[i] == Approx(own).margin(1e-4 * test::largest_magnitude(expected)));
    }
}

}  // namespace gearpod::lockstep::test_unilateral_contact
