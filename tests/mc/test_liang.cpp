// Liang's planetary gearbox (2016): what its published figures show.
#include <algorithm>
#include <cmath>
#include <complex>
#include <kissfft/kissfft.hh>

#include "signals/sensor.hpp"
#include "study_file.hpp"

using namespace gearpod;
using test::shipped_study;

namespace {

mc::GearboxTile run_one(const mc::Scene& scene, bool with_motion = false) {
    const mc::GearboxId id{mc::Group::graded, 0};
    return mc::run_gearboxes(scene, mc::Sampler(scene.study()), mc::path_grid(scene),
                             std::span(&id, 1), 1, with_motion);
}

// The study with one gearbox and no scatter; a crack of the given depth on the given member.
mc::Study with_crack(mc::Member member, double depth_m,
                     const std::vector<std::string>& overrides = {}) {
    mc::Study study = shipped_study("liang-fig-5-8.toml", overrides);
    study.random.clear();
    study.fault.member = member;
    if (member != mc::Member::planet) {
        study.fault.side.reset();
    }
    study.fault.depth_m = depth_m;
    return study;
}

// Amplitudes of the sensor signal over `meshes` mesh periods; line i lies at i f_m / meshes.
std::vector<double> spectrum(const mc::Scene& scene, int meshes) {
    const auto tile = run_one(scene);
    const auto signal =
        signals::synthesize(tile.views, 0, tile.march.content, mc::span_layout(scene),
                            mc::path_grid(scene), tile.inputs[0].path_exponent, 0, meshes);
    std::vector<std::complex<double>> in(signal.begin(), signal.end()), out(signal.size());
    kissfft<double> fft(signal.size(), false);
    fft.transform(in.data(), out.data());
    std::vector<double> amplitudes;
    for (std::size_t i = 0; i < out.size() / 2; ++i) {
        amplitudes.push_back(2.0 * std::abs(out[i]) / static_cast<double>(out.size()));
    }
    return amplitudes;
}

// Lines that must vanish do so to the tolerance at which orbit and decay count as reached (1e-10 of
// the displacement, which is more of the acceleration).
constexpr double kNothing = 1e-7;

double largest_off_multiples_of_4(const std::vector<double>& amplitudes) {
    double largest = 0.0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
        if (i % 4 != 0) {
            largest = std::max(largest, amplitudes[i]);
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("Fig. 5.8: the cracked tooth's RMS over the others' rises with depth as measured") {
    const mc::Results results = test::run(shipped_study("liang-fig-5-8.toml"));
    const auto& ratio = results.features[test::feature_index(results, "window_ratio")].values;
    REQUIRE(ratio.size() == 8);
    for (std::size_t i = 2; i < ratio.size(); ++i) {
        CHECK(ratio[i] > ratio[i - 1]);
    }
    // An independent computation with an 800 Hz sensor: 0, 1, 2, 3, 4.3 mm (rows 1, 3, 5, 6, 7).
    // The thesis' 1, 1.10, 1.2, 1.44, 1.95 has the same order; studies/README.md compares.
    const double reference[] = {1.02, 1.04, 1.10, 1.22, 1.61};
    const std::size_t rows[] = {1, 3, 5, 6, 7};
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(ratio[rows[i]] == Approx(reference[i]).margin(0.025));
    }
}

TEST_CASE("The healthy resultant signal has only carrier orders that the planets divide") {
    const mc::Scene scene(with_crack(mc::Member::planet, 0.0));
    const auto lines = spectrum(scene, 81);  // one carrier turn: carrier orders
    const double largest = *std::max_element(lines.begin(), lines.end());
    CHECK(largest_off_multiples_of_4(lines) < kNothing * largest);

    // The largest line around mesh harmonic n is at n f_m (4 divides n), n f_m + - f_c (n odd) or
    // n f_m + - 2 f_c: Liang, section 4.4.
    for (int n = 1; n <= 30; ++n) {
        int strongest = -40;
        for (int offset = -40; offset <= 40; ++offset) {
            if (lines[static_cast<std::size_t>(81 * n + offset)] >
                lines[static_cast<std::size_t>(81 * n + strongest)]) {
                strongest = offset;
            }
        }
        INFO("harmonic " << n);
        CHECK(std::abs(strongest) == (n % 4 == 0 ? 0 : n % 2 == 1 ? 1 : 2));
    }
}

TEST_CASE("A cracked sun tooth adds lines between the healthy ones, and only where it may") {
    // The tooth meets the next planet every Z_s / N meshes, so the signal's lines j f_m / Z_s + m
    // f_c keep j - m divisible by N: multiples of 4 f_m / (Z_s Z_r). f_scrack = N f_m / Z_s is one.
    const int meshes = 19 * 81;
    const mc::Scene healthy(with_crack(mc::Member::sun, 0.0));
    const mc::Scene cracked(with_crack(mc::Member::sun, 3.9e-3));
    const auto before = spectrum(healthy, meshes);
    const auto after = spectrum(cracked, meshes);
    const double largest = *std::max_element(after.begin(), after.end());
    CHECK(largest_off_multiples_of_4(after) < kNothing * largest);
    // Lines of the healthy gearbox are carrier orders; everything else is the crack's.
    double sidebands_before = 0.0, sidebands_after = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (i % 19 != 0) {
            sidebands_before = std::max(sidebands_before, before[i]);
            sidebands_after = std::max(sidebands_after, after[i]);
        }
    }
    CHECK(sidebands_before < kNothing * largest);
    CHECK(sidebands_after > 1e-2 * largest);
    // The lines of the healthy gearbox are "rarely affected": Liang, section 4.4.
    const auto top =
        static_cast<std::size_t>(std::max_element(before.begin(), before.end()) - before.begin());
    CHECK(after[top] == Approx(before[top]).epsilon(0.1));
}

TEST_CASE("A cracked planet tooth repeats every Z_p meshes and the healthy lines stay") {
    const int meshes = 31 * 81;
    const mc::Scene healthy(with_crack(mc::Member::planet, 0.0));
    const mc::Scene cracked(with_crack(mc::Member::planet, 4.28e-3));
    const auto before = spectrum(healthy, meshes);
    const auto after = spectrum(cracked, meshes);
    const auto top =
        static_cast<std::size_t>(std::max_element(before.begin(), before.end()) - before.begin());
    CHECK(after[top] == Approx(before[top]).epsilon(0.1));
    double off = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (i % 31 != 0) {
            off = std::max(off, after[i]);
            CHECK(before[i] < kNothing * before[top]);
        }
    }
    CHECK(off > 1e-2 * after[top]);
}

TEST_CASE("Inertial terms do not show at 8.87 rpm and do at 950 rpm") {
    // Fig. 4.8: vertical displacement of the sun with a crack of 2.34 mm in a sun tooth.
    const auto sun_y = [](double rpm, bool inertial) {
        mc::Study study = with_crack(mc::Member::sun, 2.34e-3);
        study.operation.carrier_speed_rad_s = rpm * 2 * 3.14159265358979 / 60;
        study.effects.inertial_terms = inertial;
        study.sensor.sampling_Hz = 60000;
        study.sensor.low_pass_Hz = 20000;
        study.sensor.encoder_sampling_Hz = 60000;
        study.numerics.max_meshes = 20000;
        const mc::Scene scene(study);
        const auto tile = run_one(scene, true);
        REQUIRE(tile.march.status[0] == lockstep::LaneStatus::ok);
        std::vector<double> y;
        for (const int id : tile.march.content) {
            const auto& motion = tile.march.records[static_cast<std::size_t>(id)].motion;
            for (std::size_t i = 7; i < motion.size(); i += 21) {
                y.push_back(motion[i]);
            }
        }
        return y;
    };
    const auto difference = [&](double rpm) {
        const auto with = sun_y(rpm, true), without = sun_y(rpm, false);
        double d = 0.0, s = 0.0;
        for (std::size_t i = 0; i < with.size(); ++i) {
            d += (with[i] - without[i]) * (with[i] - without[i]);
            s += without[i] * without[i];
        }
        return std::sqrt(d / s);
    };
    CHECK(difference(8.87) < 0.005);
    CHECK(difference(950.0) > 0.05);
}

TEST_CASE("The raw acceleration is large; the 800 Hz sensor shows the thesis' few m/s^2") {
    // Sections 4.4 and 5.2: about 5 m/s^2 healthy and 10 m/s^2 with a 4.3 mm crack; hundreds of
    // m/s^2 before the low-pass (PHYSICS of the bandwidth).
    const auto peak = [](double depth_m) {
        const mc::Scene scene(with_crack(mc::Member::planet, depth_m));
        const auto tile = run_one(scene);
        const auto signal = signals::synthesize(
            tile.views, 0, tile.march.content, mc::span_layout(scene), mc::path_grid(scene),
            tile.inputs[0].path_exponent, 0, scene.span_meshes());
        return std::abs(*std::max_element(signal.begin(), signal.end(), [](double a, double b) {
            return std::abs(a) < std::abs(b);
        }));
    };
    CHECK(peak(0.0) == Approx(5.0).margin(1.5));
    CHECK(peak(4.28e-3) == Approx(10.0).margin(3.0));
}

TEST_CASE("With the sun held the carrier's turn repeats after each planet as well") {
    // The planets then turn the other way past the carrier: phases change sign and contact runs its
    // line of action backwards. Z_s meshes make a carrier turn; only orders that N divides remain.
    mc::Study study = with_crack(mc::Member::planet, 0.0);
    study.operation.fixed = mc::Member::sun;
    study.operation.input = mc::Member::ring;
    study.operation.torque_on = mc::Member::ring;
    // The rigid rotation that the turning frame feeds is removed at whole mesh periods, which the
    // planets meet at different phases: with inertial terms other orders reach 3e-7 of the largest.
    study.effects.inertial_terms = false;
    const mc::Scene scene(study);
    CHECK(scene.path_meshes() == 19);
    CHECK(scene.nominal_mesh_frequency_Hz() == Approx(19 * 8.87 / 60));
    const auto lines = spectrum(scene, 19);
    const double largest = *std::max_element(lines.begin(), lines.end());
    CHECK(largest_off_multiples_of_4(lines) < kNothing * largest);

    study.fault.member = mc::Member::sun;
    study.fault.side.reset();
    study.fault.depth_m = 3.9e-3;
    const auto cracked = spectrum(mc::Scene(study), 19 * 19);
    CHECK(largest_off_multiples_of_4(cracked) <
          kNothing * *std::max_element(cracked.begin(), cracked.end()));
}

TEST_CASE("With the carrier held the planets still mesh, driven from either side") {
    for (const auto input : {mc::Member::sun, mc::Member::ring}) {
        mc::Study study = with_crack(mc::Member::planet, 4.28e-3);
        study.operation.fixed = mc::Member::carrier;
        study.operation.input = input;
        study.operation.carrier_speed_rad_s.reset();
        study.operation.sun_speed_rad_s = 46.68 * 2 * 3.14159265358979 / 60;
        const mc::Scene scene(study);
        CHECK(scene.nominal_mesh_frequency_Hz() == Approx(19 * 46.68 / 60).epsilon(1e-6));
        const auto tile = run_one(scene);
        CHECK(tile.march.status[0] == lockstep::LaneStatus::ok);
        // Without a turning path the signal repeats with the cracked tooth, every Z_p meshes.
        const auto lines = spectrum(scene, 2 * 31);
        const double largest = *std::max_element(lines.begin(), lines.end());
        for (std::size_t i = 1; i < lines.size(); i += 2) {
            CHECK(lines[i] < kNothing * largest);
        }
    }
}
