// Checks Park's transmission errors over the models' degrees of freedom: rigid rotation of the
// train gives none.
#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/planetary.hpp"
#include "gears/planetary.hpp"
#include "tests/test.hpp"

namespace gearpod::dynamics::test_rigid_transmission_error {

TEST_CASE("The free rotation of the model gives no transmission error in any working condition") {
    const gears::PlanetaryTrain train{16, 26, 68, 3, {}};
    const double module = 14e-3, angle = 0.43;
    const double r_c = module * 42 / 2, r_r = module * 68 / 2 * std::cos(angle),
                 r_s = module * 16 / 2 * std::cos(angle);
    using gears::Member;
    const gears::PowerFlow conditions[] = {
        {Member::sun, Member::ring},    {Member::sun, Member::carrier},
        {Member::ring, Member::sun},    {Member::ring, Member::carrier},
        {Member::carrier, Member::sun}, {Member::carrier, Member::ring}};
    for (const gears::PowerFlow& flow : conditions) {
        const gears::CentralMembers w = gears::transmission_error_weights(train, flow);
        for (const auto motion : {Motion::torsional, Motion::translational_torsional}) {
            PlanetaryLayout layout;
            layout.planets = 3;
            layout.pressure_angle_rad = angle;
            layout.fixed = flow.fixed;
            layout.motion = motion;
            const Eigen::VectorXd turn = rigid_rotation(layout);
            const double seen = w.carrier / r_c * turn(layout.rotation_index(carrier)) +
                                w.ring / r_r * turn(layout.rotation_index(ring)) +
                                w.sun / r_s * turn(layout.rotation_index(sun));
            CHECK(turn.cwiseAbs().maxCoeff() >= 1.0);
            CHECK(std::abs(seen) < 1e-13 / r_s);
        }
    }
}

}  // namespace gearpod::dynamics::test_rigid_transmission_error
