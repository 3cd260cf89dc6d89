// Checks the recorded accelerations of sun and carrier, which all integrators low-pass, against the
// spectrum of the recorded motion.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/butterworth.hpp"

namespace gearpod::lockstep::test_bearing_sources {

using test::LiangTrain;
using Complex = std::complex<double>;

constexpr int kSamples = 960, kSteps = 1920, kMeshes = 80;
constexpr double kSpeedup = 20.0;
constexpr double kLowPass_rad_s = 2.0 * std::numbers::pi * 2000.0;

IntegrationPlan plan_with(Integrator integrator, bool bearings) {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan =
        train.plan(kSamples, kSteps, dynamics::Motion::translational_torsional, integrator);
    std::get<dynamics::PlanetaryLayout>(plan.layout).bearing_sources = bearings;
    plan.low_pass_rad_s = kLowPass_rad_s;
    return plan;
}

// Last of several mesh periods; after kMeshes the motion repeats.
MeshRecord last_mesh(const IntegrationPlan& plan, int meshes = kMeshes) {
    const dynamics::GearboxInputs inputs = LiangTrain::instance().inputs(kSpeedup);
    TileState state =
        test::state_at(plan, Eigen::VectorXd::Zero(dynamics::degrees_of_freedom(plan.layout)));
    MeshRecord record = make_record(plan, 1, true);
    const auto integrate = make_mesh_integrator<1>(plan, std::span(&inputs, 1));
    for (int k = 0; k < meshes; ++k) {
        (*integrate)({}, state, record);
    }
    return record;
}

// Values of one column of a record over the mesh period.
std::vector<double> column(const machine::AlignedVector& rows, int columns, int at) {
    return test::tabulated(kSamples,
                           [&](int p) { return rows[static_cast<std::size_t>(p * columns + at)]; });
}

Complex line(const std::vector<double>& values, int k) {
    Complex sum = 0.0;
    for (int p = 0; p < kSamples; ++p) {
        sum += values[static_cast<std::size_t>(p)] *
               std::polar(1.0, -2.0 * std::numbers::pi * k * p / kSamples);
    }
    return sum / static_cast<double>(kSamples);
}

Complex low_pass(double w) {
    return test::butterworth(w / kLowPass_rad_s);
}

// Largest error of the low harmonics of a source's absolute acceleration, over the largest one.
double channel_error(const IntegrationPlan& plan, const MeshRecord& record, int source,
                     int motion) {
    const auto in = LiangTrain::instance().inputs(kSpeedup);
    const int degrees = dynamics::degrees_of_freedom(plan.layout);
    const auto x = column(record.motion, degrees, motion),
               y = column(record.motion, degrees, motion + 1),
               ax = column(record.acceleration, plan.channels(), 2 * source),
               ay = column(record.acceleration, plan.channels(), 2 * source + 1);
    const double frame = in.carrier_speed_rad_s;
    double error = 0.0, largest = 0.0;
    for (int k = 0; k <= 12; ++k) {
        const double w = 2.0 * std::numbers::pi * k / in.mesh_period_s;
        const Complex i(0.0, 1.0), qx = line(x, k), qy = line(y, k);
        const Complex along_x =
                          low_pass(w) * (-(w * w + frame * frame) * qx - 2.0 * frame * i * w * qy),
                      along_y =
                          low_pass(w) * (-(w * w + frame * frame) * qy + 2.0 * frame * i * w * qx);
        error = std::max({error, std::abs(line(ax, k) - along_x), std::abs(line(ay, k) - along_y)});
        largest = std::max({largest, std::abs(along_x), std::abs(along_y)});
    }
    return error / largest;
}

TEST_CASE("Channels of sun and carrier are the low-passed accelerations of their motion") {
    const MeshRecord reference = last_mesh(plan_with(Integrator::rk4, true));
    for (const Integrator integrator : all_integrators()) {
        INFO(name(integrator));
        const IntegrationPlan plan = plan_with(integrator, true);
        REQUIRE(plan.channels() == 2 * (4 + dynamics::kBearingSources));
        const MeshRecord record = last_mesh(plan);
        CHECK(channel_error(plan, record, 4, dynamics::motion_index(dynamics::sun)) < 3e-4);
        CHECK(channel_error(plan, record, 5, dynamics::motion_index(dynamics::carrier)) < 3e-4);
        // All integrators agree.
        double difference = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < record.acceleration.size(); ++i) {
            if (i % 12 >= 8) {
                difference = std::max(difference,
                                      std::abs(record.acceleration[i] - reference.acceleration[i]));
                largest = std::max(largest, std::abs(reference.acceleration[i]));
            }
        }
        CHECK(difference < 2e-3 * largest);
    }
}

TEST_CASE("Recording sun and carrier leaves the bits of motion and planets unchanged") {
    for (const Integrator integrator : all_integrators()) {
        INFO(name(integrator));
        const MeshRecord without = last_mesh(plan_with(integrator, false), 2),
                         with = last_mesh(plan_with(integrator, true), 2);
        CHECK(with.motion == without.motion);
        CHECK(with.te == without.te);
        bool same = true;
        for (std::size_t i = 0; i < without.acceleration.size(); ++i) {
            same = same && with.acceleration[i / 8 * 12 + i % 8] == without.acceleration[i];
        }
        CHECK(same);
    }
}

}  // namespace gearpod::lockstep::test_bearing_sources
