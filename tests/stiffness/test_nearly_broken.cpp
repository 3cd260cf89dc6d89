// Checks cracks just short of breaking the tooth: the sections vanish there, and rounding
// dominates.
#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/crack.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_nearly_broken {

constexpr double kDegree = std::numbers::pi / 180;
const Material kSteel{2.06e11, 0.3, 0.018};

gears::Gear gear(int teeth) {
    return {teeth, false, 0.002, 20 * kDegree};
}

// Checks that the stiffness is between zero and that of the healthy pair.
void check_range(const AdditiveMesh& mesh, const ToothFault& fault) {
    const ToothPairCurve curve = mesh.faulty_pair(fault);
    for (int i = 0; i <= 20; ++i) {
        const double tau = mesh.contact_ratio() * i / 20;
        const double k = curve(tau);
        CHECK(k >= 0);
        CHECK(k <= mesh.tooth_pair(tau) * (1 + 1e-6));
    }
}

TEST_CASE("a crack just short of breaking the tooth leaves a stiffness between zero and healthy") {
    for (const Profile profile : {Profile::base_circle, Profile::root_circle, Profile::fillet}) {
        for (const int teeth : {18, 19, 28, 45}) {
            const gears::MeshGeometry geometry(gear(teeth), gear(40));
            const AdditiveMesh mesh(geometry, kSteel, profile);
            for (const double angle : {45 * kDegree, 60 * kDegree, 70 * kDegree, 89 * kDegree}) {
                const ToothCrack family(geometry, kSteel, profile, 1, angle);
                const double largest = family.largest_size();
                for (const double depth : {0.9 * largest, 0.99 * largest, 0.9999 * largest,
                                           std::nextafter(largest, 0.0)}) {
                    INFO(teeth << " teeth, " << angle / kDegree << " deg, " << depth);
                    check_range(mesh, *family.at(depth));
                }
            }
        }
    }
}

TEST_CASE("a crack that starts above the root may exit the tooth below its start") {
    const gears::MeshGeometry geometry(gear(18), gear(40));
    const AdditiveMesh mesh(geometry, kSteel, Profile::fillet);
    const ToothProfile tooth(gear(18), Profile::fillet);
    const double angle = 70 * kDegree, height = 0.002;
    for (const double part : {0.9, 0.99, 0.999, 0.9999}) {
        const double depth = part * max_crack_depth(tooth, angle, height);
        const SpatialCrack family(
            geometry, kSteel, Profile::fillet, 1,
            CrackGrowth{{depth}, {depth}, {0.018}, {height}, {height}, angle, angle});
        INFO(part);
        check_range(mesh, *family.at(1));
    }
}

}  // namespace gearpod::stiffness::test_nearly_broken
