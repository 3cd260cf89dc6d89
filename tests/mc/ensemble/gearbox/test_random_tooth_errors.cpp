// Checks the random errors of a gearbox's teeth: their assignment, their rotation with the gears,
// and their size.
#include "lockstep/plan/tooth_pairs.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_random_tooth_errors {

constexpr double kPi = std::numbers::pi;

// Liang's train with individual tooth errors.
Study study_with(std::vector<std::string> overrides) {
    overrides.push_back("numerics.horizon=full");
    return test::shipped_study("planet-crack-ideal.toml", overrides);
}

lockstep::ToothErrors errors_of(const Scene& scene, std::uint64_t index) {
    const Realization gearbox = scene.sampler().draw({Group::test, index});
    return draw_tooth_errors(*scene.gearbox().tooth_errors, scene.draw(), std::span(&gearbox, 1));
}

// Gaps of a pair at the phases k + 1/2 of many meshes: mean over the tooth pairs in contact, and
// largest difference between two of them.
struct Gaps {
    std::vector<double> mean;
    double apart = 0.0;
};
Gaps gaps_of(const Scene& scene, const lockstep::ToothErrors& errors, int pair, int meshes) {
    Gaps gaps;
    const lockstep::IntegrationPlan& plan = scene.solve().integration();
    for (int k = 0; k < meshes; ++k) {
        const auto all = lockstep::tooth_gaps(plan, errors, k);
        for (std::size_t s = 0; s < plan.grid.steps.size(); ++s) {
            const lockstep::Step& step = plan.grid.steps[s];
            const auto gap = [&](std::size_t at, int slot) {
                return lockstep::tooth_gap(plan, all, PairId{pair}, static_cast<int>(at), 0, slot,
                                           LaneId{0});
            };
            const double middle = step.phase + 0.5 * step.length;
            const int count =
                lockstep::engaged_teeth(scene.gearbox().pairs(), PairId{pair}, middle).count;
            if (count == 2) {
                gaps.apart = std::max(gaps.apart, std::abs(gap(s, 0) - gap(s, 1)));
            }
            if (step.phase <= 0.5 && step.phase + step.length > 0.5) {
                double sum = 0.0;
                for (int j = 0; j < count; ++j) {
                    sum += gap(s, j) / count;
                }
                gaps.mean.push_back(sum);
            }
        }
    }
    return gaps;
}

// First harmonic of `period` meshes: amplitude and phase of cos(2 pi k / period + phase).
std::pair<double, double> harmonic(const std::vector<double>& values, int period) {
    double c = 0.0, s = 0.0;
    for (int k = 0; k < period; ++k) {
        c += 2.0 / period * values[static_cast<std::size_t>(k)] * std::cos(2.0 * kPi * k / period);
        s += 2.0 / period * values[static_cast<std::size_t>(k)] * std::sin(2.0 * kPi * k / period);
    }
    return {std::hypot(c, s), std::atan2(-s, c)};
}

void clear_gear(lockstep::GearErrors& gear) {
    std::fill(gear.error_m.begin(), gear.error_m.end(), 0.0);
    std::fill(gear.slope_m.begin(), gear.slope_m.end(), 0.0);
}

TEST_CASE("An eccentric gear displaces all tooth pairs in contact, as a displaced planet would") {
    // Either the sun drives, or the carrier is fixed and the ring drives: then contact runs
    // backwards.
    const std::vector<std::string> forward{"gearbox.eccentricity_um=10"};
    auto backward = forward;
    backward.insert(backward.end(), {"operation.fixed=sun", "operation.input=ring"});
    for (const auto& overrides : {forward, backward}) {
        const Study study = study_with(overrides);
        const Scene scene(study);
        lockstep::ToothErrors errors = errors_of(scene, 3);
        const int planets = study.gearbox.planets;
        const int teeth = errors.gears[2].teeth;
        clear_gear(errors.gears[0]);
        clear_gear(errors.gears[1]);
        for (const int n : {0, 1}) {
            const Gaps sun = gaps_of(scene, errors, n, teeth);
            const Gaps ring = gaps_of(scene, errors, planets + n, teeth);
            const auto [sun_size, sun_phase] = harmonic(sun.mean, teeth);
            const auto [ring_size, ring_phase] = harmonic(ring.mean, teeth);
            INFO("reversed " << scene.gearbox().pairs().reversed << ", planet " << n + 1);
            CHECK(sun_size == Approx(ring_size).epsilon(0.02));
            // The remainder is the curvature of a sine over a tooth.
            CHECK(sun.apart < 0.05 * sun_size);
            CHECK(ring.apart < 0.05 * ring_size);
            // For a displacement a of the teeth the gap is a cos(phi - p_s) at the sun and a
            // cos(phi - p_r) at the ring, p_r - p_s = 2 alpha; phi decreases when the sun drives.
            const double lead = std::remainder(ring_phase - sun_phase, 2.0 * kPi);
            const double expected = 2.0 * study.gearbox.pressure_angle_rad;
            CHECK(lead ==
                  Approx(scene.gearbox().pairs().reversed ? -expected : expected).margin(0.02));
        }
    }
}

TEST_CASE("Tooth deviations follow the tolerances of their grade and grow with it") {
    const auto rms = [](const std::vector<std::string>& overrides, std::size_t gear) {
        const Scene scene(study_with(overrides));
        double squares = 0.0;
        std::size_t count = 0;
        for (std::uint64_t index = 0; index < 60; ++index) {
            const auto errors = errors_of(scene, index);
            for (const double e : errors.gears[gear].error_m) {
                squares += e * e;
                ++count;
            }
        }
        return std::sqrt(squares / static_cast<double>(count));
    };
    const Scene scene(study_with({"gearbox.tooth_quality=6"}));
    const auto& scales = scene.gearbox().stiffness->tooth_scales()[Member::planet];
    const double expected =
        std::numbers::sqrt2 * std::sqrt(0.5 * scales.eccentricity * scales.eccentricity +
                                        scales.waves * scales.waves + scales.pitch * scales.pitch);
    const double six = rms({"gearbox.tooth_quality=6"}, 2);
    CHECK(six == Approx(expected).epsilon(0.12));
    CHECK(rms({"gearbox.tooth_quality=8"}, 2) == Approx(2.0 * six).epsilon(1e-9));
    CHECK(rms({"gearbox.tooth_quality=6", "gearbox.planet.quality=8"}, 2) ==
          Approx(2.0 * six).epsilon(1e-9));
    CHECK(rms({"gearbox.tooth_quality=6", "gearbox.planet.quality=8"}, 0) ==
          Approx(rms({"gearbox.tooth_quality=6"}, 0)).epsilon(1e-9));
}

TEST_CASE("Tooth errors belong to the gearbox: the same in any lane, for any noise and path") {
    const auto of = [](std::vector<std::string> overrides, const std::vector<GearboxId>& ids) {
        overrides.push_back("gearbox.tooth_quality=6");
        const Scene scene(study_with(overrides));
        std::vector<Realization> gearboxes =
            test::mapped(ids, [&](const GearboxId& id) { return scene.sampler().draw(id); });
        return draw_tooth_errors(*scene.gearbox().tooth_errors, scene.draw(), gearboxes);
    };
    const auto alone = of({}, {{Group::test, 5}});
    const auto other = of({"sensor.noise_m_s2=3"}, {{Group::test, 4}, {Group::test, 5}});
    for (std::size_t g = 0; g < alone.gears.size(); ++g) {
        for (std::size_t t = 0; t < alone.gears[g].error_m.size(); ++t) {
            CHECK(alone.gears[g].error_m[t] == other.gears[g].error_m[2 * t + 1]);
            CHECK(alone.gears[g].slope_m[t] == other.gears[g].slope_m[2 * t + 1]);
            CHECK(alone.gears[g].error_m[t] != other.gears[g].error_m[2 * t]);
        }
    }
}

}  // namespace gearpod::mc::test_random_tooth_errors
