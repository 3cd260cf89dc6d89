// The loaded static transmission error, without and with relief.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "gears/flank_relief.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/helical_mesh.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/square_wave_mesh.hpp"

using namespace gearpod;
using namespace gearpod::stiffness;

namespace {

// Two pairs as stiff as each other, one at a time or both.
const SquareWaveMesh kAlike(1e9, 2e9, 1.6);
constexpr double kForce = 1e4;
constexpr double kDeflection = kForce / 1e9;  // of one pair

// Linear long relief of both gears: from the end of single contact to the tip.
LoadedMesh with_long_relief(double amount) {
    const auto gap = [amount](double tau) {
        return amount * (std::max(0.0, 1 - tau / 0.6) + std::max(0.0, (tau - 1) / 0.6));
    };
    return {kAlike, gap, {0.6, 1.0}, kForce};
}

gears::MeshGeometry spur(int one, int two) {
    gears::Gear gear;
    gear.teeth = one;
    gear.module_m = 3e-3;
    gear.pressure_angle_rad = 20 * std::numbers::pi / 180;
    gears::Gear mate = gear;
    mate.teeth = two;
    return {gear, mate};
}

}  // namespace

TEST_CASE("perfect flanks approach by the force over the stiffness") {
    const LoadedMesh mesh(
        kAlike, [](double) { return 0.0; }, {}, kForce);
    CHECK(mesh.approach(0.2, 0.3) == Approx(kDeflection / 2));
    CHECK(mesh.approach(0.8, 0.8) == Approx(kDeflection));
    CHECK(mesh.error(0.2, 0.3) == Approx(0).margin(1e-18));
    CHECK(mesh.range().peak_to_peak() == Approx(kDeflection / 2));
    CHECK(mesh.range().mean == Approx(0.6 * kDeflection / 2 + 0.4 * kDeflection));
}

// Munro (1989): relief of the deflection at the design load levels the transmission error there.
TEST_CASE("long relief of the deflection at that load leaves no transmission error to vary") {
    const double none = with_long_relief(0).range().peak_to_peak();
    CHECK(with_long_relief(kDeflection).range().peak_to_peak() == Approx(0).margin(1e-6 * none));
    // It falls towards that amount and grows beyond it: too little leaves a step, too much parts
    // the teeth.
    double last = none;
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        const double now = with_long_relief(part * kDeflection).range().peak_to_peak();
        CHECK(now == Approx((1 - part) * none).margin(1e-6 * none));
        CHECK(now < last);
        last = now;
    }
    CHECK(with_long_relief(1.5 * kDeflection).range().peak_to_peak() > 0.1 * none);
}

TEST_CASE("relief of a gear lies where its tip and root touch") {
    const gears::MeshGeometry mesh = spur(23, 47);
    const double pitch = mesh.base_pitch(), ratio = mesh.contact_ratio();
    CHECK(pitch == Approx(3e-3 * std::numbers::pi * std::cos(20 * std::numbers::pi / 180)));
    const gears::FlankRelief tip{20e-6, 2e-3, 0, 0}, root{0, 0, 10e-6, 1e-3},
        curved{20e-6, 2e-3, 0, 0, gears::ReliefShape::parabolic};
    CHECK(gears::relief_gap(mesh, tip, {}, ratio) == Approx(20e-6));
    CHECK(gears::relief_gap(mesh, tip, {}, ratio - 1e-3 / pitch) == Approx(10e-6));
    CHECK(gears::relief_gap(mesh, curved, {}, ratio - 1e-3 / pitch) == Approx(5e-6));
    CHECK(gears::relief_gap(mesh, tip, {}, 0) == 0);
    CHECK(gears::relief_gap(mesh, {}, tip, 0) == Approx(20e-6));
    CHECK(gears::relief_gap(mesh, root, tip, 0) == Approx(30e-6));
    CHECK(gears::relief_gap(mesh, {}, root, ratio) == Approx(10e-6));
    CHECK(gears::relief_kinks(mesh, tip, root) ==
          std::vector<double>{ratio - 2e-3 / pitch, ratio - 1e-3 / pitch});
}

// Real teeth: their pairs are softer towards the ends, so what is best lies near the deflection.
TEST_CASE("on involute teeth the best long relief is near one pair's deflection") {
    const gears::MeshGeometry mesh = spur(30, 40);
    const AdditiveMesh teeth(mesh, {2.06e11, 0.3, 0.02, true}, Profile::root_circle);
    const double force = 4e3, ratio = mesh.contact_ratio();
    double single = 0, at = 0.5 * ratio;
    teeth.tooth_pair({&at, 1}, {&single, 1});
    const double deflection = force / single, length = (ratio - 1) * mesh.base_pitch();
    const auto varies = [&](double part) {
        const gears::FlankRelief relief{part * deflection, length, 0, 0};
        const LoadedMesh loaded(
            teeth,
            [&](double tau) {
                return part > 0 ? gears::relief_gap(mesh, relief, relief, tau) : 0.0;
            },
            {}, force);
        return loaded.range().peak_to_peak();
    };
    CHECK(varies(1.0) < 0.3 * varies(0.0));
    double best = 0, least = varies(0);
    for (double part = 0.05; part < 2; part += 0.05) {
        const double now = varies(part);
        if (now < least) {
            least = now;
            best = part;
        }
    }
    CHECK(best == Approx(1).margin(0.15));
    // The error that the march is given restores the approach: d = F / k + e.
    const gears::FlankRelief relief{deflection, length, 0, 0};
    const LoadedMesh loaded(
        teeth, [&](double tau) { return gears::relief_gap(mesh, relief, relief, tau); }, {}, force);
    for (const double tau : {0.1, 0.5, 0.8}) {
        double total = 0;
        teeth.total({&tau, 1}, tau, {&total, 1});
        CHECK(force / total + loaded.error(tau, tau) == Approx(loaded.approach(tau, tau)));
        CHECK(loaded.error_rate(tau, tau) ==
              Approx((loaded.error(tau + 1e-4, tau) - loaded.error(tau - 1e-4, tau)) / 2e-4)
                  .margin(1e-3 * deflection));
    }
}

// F = k (d - C / 3) where the whole width touches, F = 2/3 k d^(3/2) / C^(1/2) where its middle
// does.
TEST_CASE("crowned teeth approach as the parabola's integral says") {
    const auto flat = [](double) { return 0.0; };
    const double alone = 0.8;  // one pair touches
    const double crowning = 0.3 * kDeflection, more = 5 * kDeflection;
    CHECK(LoadedMesh(kAlike, flat, {}, kForce, crowning).approach(alone, alone) ==
          Approx(kDeflection + crowning / 3).epsilon(1e-12));
    CHECK(LoadedMesh(kAlike, flat, {}, kForce, more).approach(alone, alone) ==
          Approx(std::pow(1.5 * kDeflection * std::sqrt(more), 2.0 / 3)).epsilon(1e-2));
    CHECK(LoadedMesh(kAlike, flat, {}, kForce, 0.0).approach(alone, alone) ==
          LoadedMesh(kAlike, flat, {}, kForce).approach(alone, alone));
}

// The force over the approach, summed over ten thousand slices that only push.
TEST_CASE("relieved and crowned helical teeth carry their load slice by slice") {
    const gears::MeshGeometry geometry = spur(23, 47);
    const Material material{2.06e11, 0.3, 0.03};
    const double overlap = 0.8, amount = 12e-6, crowning = 6e-6;
    const gears::FlankRelief tip{amount, 3e-3, 0, 0};
    const auto gap = [&](double tau) { return gears::relief_gap(geometry, tip, tip, tau); };
    const AdditiveMesh slices(geometry, material, Profile::root_circle);
    const HelicalMesh mesh(std::make_unique<AdditiveMesh>(geometry, material, Profile::root_circle),
                           overlap);
    const double force = 8e3;
    const LoadedMesh loaded(mesh, gap, gears::relief_kinks(geometry, tip, tip), force, crowning);
    constexpr int kSlices = 10000;
    for (const double tau : {0.05, 0.33, 0.61, 0.92}) {
        const double d = loaded.approach(tau, tau);
        double sum = 0;
        for (int i = 0; i < kSlices; ++i) {
            const double place = (i + 0.5) / kSlices, begun = tau - overlap * place;
            const double from_middle = 2 * place - 1;
            for (int age = -2; age <= 2; ++age) {
                const double at = begun + age;
                if (at > 0 && at < slices.contact_ratio())
                    sum += slices.tooth_pair(at) / kSlices *
                           std::max(0.0, d - gap(at) - crowning * from_middle * from_middle);
            }
        }
        CHECK(sum == Approx(force).epsilon(3e-3));
        CHECK(loaded.error(tau, tau) > 0);
    }
    // Perfect flanks have no error.
    const LoadedMesh perfect(
        mesh, [](double) { return 0.0; }, {}, force);
    for (const double tau : {0.05, 0.33, 0.92})
        CHECK(perfect.error(tau, tau) == Approx(0).margin(1e-8 * perfect.approach(tau, tau)));
}
