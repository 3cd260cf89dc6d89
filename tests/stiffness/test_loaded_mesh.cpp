// Checks quasi-static contact under load, without and with relief.
#include "gears/flank_gaps.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/gapped_mesh.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/test.hpp"

namespace gearpod::stiffness::test_loaded_mesh {

// Two equally stiff pairs, one at a time or both.
const SquareWaveMesh kAlike(1e9, 2e9, 1.6);
constexpr double kForce = 1e4;
constexpr double kDeflection = kForce / 1e9;  // of one pair

// The same pairs with linear long relief of both gears, from the end of single contact to the tip.
class LongRelief : public MeshStiffness {
  public:
    explicit LongRelief(double amount) : amount_(amount) {}
    double contact_ratio() const override { return kAlike.contact_ratio(); }
    double pitch_position() const override { return kAlike.pitch_position(); }
    std::vector<double> transitions() const override { return kAlike.transitions(); }
    void total(std::span<const double> tau, double inside, std::span<double> k) const override {
        kAlike.total(tau, inside, k);
    }
    void share(std::span<const double> tau, double inside, std::span<double> s) const override {
        kAlike.share(tau, inside, s);
    }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override {
        return kAlike.with_fault(fault);
    }
    bool has_gaps() const override { return true; }
    double slice_gap(int, double tau) const override {
        return amount_ * (std::max(0.0, 1 - tau / 0.6) + std::max(0.0, (tau - 1) / 0.6));
    }

  private:
    double amount_;
};

double varies(double amount) {
    return LoadedMesh(LongRelief(amount), kForce).range().peak_to_peak();
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

TEST_CASE("the approach of perfect flanks is the force over the stiffness") {
    const LoadedMesh mesh(kAlike, kForce);
    CHECK(mesh.approach(0.2, 0.3) == Approx(kDeflection / 2));
    CHECK(mesh.approach(0.8, 0.8) == Approx(kDeflection));
    CHECK(mesh.range().peak_to_peak() == Approx(kDeflection / 2));
    CHECK(mesh.range().mean == Approx(0.6 * kDeflection / 2 + 0.4 * kDeflection));
}

// Source: Munro (1989); relief by the deflection at the design load levels the transmission error
// there.
TEST_CASE("long relief by the deflection at the load leaves a constant transmission error") {
    const double none = varies(0);
    CHECK(varies(kDeflection) == Approx(0).margin(1e-6 * none));
    // The variation decreases towards that amount and grows beyond it: too little leaves a step,
    // too much separates the teeth.
    double last = none;
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        const double now = varies(part * kDeflection);
        CHECK(now == Approx((1 - part) * none).margin(1e-6 * none));
        CHECK(now < last);
        last = now;
    }
    CHECK(varies(1.5 * kDeflection) > 0.1 * none);
}

TEST_CASE("relief of a gear acts at the contact of its tip") {
    const gears::MeshGeometry mesh = spur(23, 47);
    const double pitch = mesh.base_pitch(), ratio = mesh.contact_ratio();
    CHECK(pitch == Approx(3e-3 * std::numbers::pi * std::cos(20 * std::numbers::pi / 180)));
    const gears::FlankRelief tip{20e-6, 2e-3}, mate{10e-6, 1e-3};
    CHECK(gears::relief_gap(mesh, tip, {}, ratio) == Approx(20e-6));
    CHECK(gears::relief_gap(mesh, tip, {}, ratio - 1e-3 / pitch) == Approx(10e-6));
    CHECK(gears::relief_gap(mesh, tip, {}, 0) == 0);
    CHECK(gears::relief_gap(mesh, {}, tip, 0) == Approx(20e-6));
    CHECK(gears::relief_kinks(mesh, tip, mate) ==
          std::vector<double>{1e-3 / pitch, ratio - 2e-3 / pitch});
}

// Pairs of real teeth are softer towards the ends, so the best amount is near the deflection.
TEST_CASE("on involute teeth the best long relief is near one pair's deflection") {
    const gears::MeshGeometry mesh = spur(30, 40);
    const Material steel{2.06e11, 0.3, 0.02, true};
    const AdditiveMesh teeth(mesh, steel, Profile::root_circle);
    const double force = 4e3, ratio = mesh.contact_ratio();
    double single = 0, at = 0.5 * ratio;
    teeth.tooth_pair({&at, 1}, {&single, 1});
    const double deflection = force / single, length = (ratio - 1) * mesh.base_pitch();
    const auto peak_to_peak = [&](double part) {
        const gears::FlankRelief relief{part * deflection, length};
        const GappedMesh ground(std::make_unique<AdditiveMesh>(mesh, steel, Profile::root_circle),
                                0, {mesh, relief, relief}, force, 1);
        return LoadedMesh(ground, force).range().peak_to_peak();
    };
    CHECK(peak_to_peak(1.0) < 0.3 * peak_to_peak(0.0));
    double best = 0, least = peak_to_peak(0);
    for (double part = 0.05; part < 2; part += 0.05) {
        const double now = peak_to_peak(part);
        if (now < least) {
            least = now;
            best = part;
        }
    }
    CHECK(best == Approx(1).margin(0.15));
}

}  // namespace gearpod::stiffness::test_loaded_mesh
