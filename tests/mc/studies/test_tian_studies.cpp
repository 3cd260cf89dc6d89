// Checks the shipped studies of Tian's figures (2004, chapter 4): signal of the sensor on the
// pinion's bearing for perfect gears and for a chipped, a cracked and a broken pinion tooth.
#include "tests/mc/liang_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::test_tian_studies {

using namespace gearpod::test;

constexpr double kMesh_Hz = 570.0;
constexpr int kPinionTeeth = 19;

// Studies whose test gearbox 0 is healthy and 1 faulty.
const std::vector<std::string> kFaults{"published/tian-fig-4-6.toml", "published/tian-fig-4-9.toml",
                                       "published/tian-fig-4-12.toml"};

// Frequency of the oscillation between two phases (mesh periods), from the signal's extremes.
double ringing_Hz(const std::vector<double>& signal, int samples, double from, double to) {
    std::vector<double> turns;
    const auto first = static_cast<std::size_t>(from * samples) + 1,
               last = static_cast<std::size_t>(to * samples);
    for (std::size_t i = first; i < last; ++i) {
        const double before = signal[i] - signal[i - 1], after = signal[i + 1] - signal[i];
        if (before * after < 0.0) {
            // Vertex of the parabola through the three samples.
            turns.push_back(static_cast<double>(i) + 0.5 * (before + after) / (before - after));
        }
    }
    REQUIRE(turns.size() >= 3);
    const double meshes = (turns.back() - turns.front()) / samples;
    return 0.5 * static_cast<double>(turns.size() - 1) / meshes * kMesh_Hz;
}

long dominant(const std::vector<double>& amplitudes) {
    return std::max_element(amplitudes.begin() + 1, amplitudes.end()) - amplitudes.begin();
}

// Faulty minus healthy signal of a study, over two turns of the pinion.
std::vector<double> fault_signal(const mc::Scene& scene) {
    return difference(sensor_signal(scene, 2 * kPinionTeeth, 1),
                      sensor_signal(scene, 2 * kPinionTeeth, 0));
}

// Natural frequency of pinion with motor against gear with load, with couplings and bearings fixed
// by their dampers.
double closed_form_Hz(const mc::Study& study, double stiffness_N_m) {
    const auto& bodies = study.gearbox.bodies;
    const mc::FixedShaft& shaft = study.fixed_shaft;
    const double module = study.gearbox.module_m.value();
    double sum = 0.0;
    for (const auto& [teeth, mass, rotor] :
         {std::tuple{19, *bodies[mc::Member::pinion].mass_kg, *shaft.motor_inertia_kg_m2},
          std::tuple{48, *bodies[mc::Member::gear].mass_kg, *shaft.load_inertia_kg_m2}}) {
        const double pitch = 0.5 * module * teeth;
        const double base = pitch * std::cos(study.gearbox.pressure_angle_rad);
        sum += base * base / (0.5 * mass * pitch * pitch + rotor);
    }
    return std::sqrt(stiffness_N_m * sum) / (2.0 * std::numbers::pi);
}

TEST_CASE(
    "Fig. 4.3: the sensor signal oscillates at 3788 Hz with two pairs in contact and at 3049 Hz "
    "with one") {
    const mc::Scene scene(shipped_study("published/tian-fig-4-3.toml"));
    const int samples = scene.record().samples;
    const auto signal = sensor_signal(scene, 3);
    const double two = 1.0 + scene.gearbox().pairs().start[0];
    const double one = two + scene.gearbox().pairs().curve(PairId{0}).contact_ratio() - 1.0;
    const double shock = 0.06e-3 * kMesh_Hz;
    CHECK(ringing_Hz(signal, samples, two + shock, one) == Approx(3788.0).epsilon(0.08));
    CHECK(ringing_Hz(signal, samples, one + shock, two + 1.0) == Approx(3049.0).epsilon(0.08));
}

TEST_CASE("A mesh of nearly constant stiffness oscillates at the closed form's frequency") {
    for (const double stiffness : {6e8, 9e8, 1.1e9}) {
        mc::Study study = shipped_study("published/tian-fig-4-3.toml");
        study.gearbox.tooth_profile = mc::StiffnessSource::square_wave;
        study.gearbox.meshes[mc::MeshKind::pinion_gear] = {{}, 0.9999 * stiffness, stiffness, 1.9};
        const mc::Scene scene(study);
        const double two = 1.0 + scene.gearbox().pairs().start[0];
        CHECK(ringing_Hz(sensor_signal(scene, 3), scene.record().samples, two + 0.05, two + 0.8) ==
              Approx(closed_form_Hz(study, stiffness)).epsilon(0.01));
    }
}

TEST_CASE("Figs. 4.4, 4.5: the 7th mesh harmonic dominates, without shear energy the 10th") {
    // The thesis reads the 6th and the 8th from its plots: see docs/validation/published.md.
    CHECK(dominant(spectrum(mc::Scene(shipped_study("published/tian-fig-4-3.toml")), 1)) == 7);
    CHECK(dominant(spectrum(mc::Scene(shipped_study("published/tian-fig-4-5.toml")), 1)) == 10);
}

TEST_CASE("Coarse steps keep the dominant harmonic, or do not converge") {
    // With 60 samples, and steps, per mesh period; see tests/peers/tian-loose-tolerances.
    for (const auto& [name, expected] : {std::pair{"published/tian-fig-4-3.toml", 7},
                                         std::pair{"published/tian-fig-4-5.toml", 10}}) {
        const std::vector<std::string> coarse{
            "sensor.sampling_Hz=34200", "sensor.encoder_sampling_Hz=34200",
            "sensor.low_pass_Hz=15390", "numerics.steps_per_mesh=10"};
        CHECK(dominant(spectrum(mc::Scene(shipped_study(name, coarse)), 1)) == expected);
        // The trapezoidal rule does not damp modes that are this much faster than its steps.
        const auto trapezoidal = joined(coarse, {"numerics.integrator=\"newmark\""});
        CHECK(run_one(mc::Scene(shipped_study(name, trapezoidal))).integration.status[0] ==
              lockstep::LaneStatus::not_converged);
    }
}

TEST_CASE("Section 4.2.1: there is no motion along x") {
    for (const auto& name : kFaults) {
        const auto tile = run_one(mc::Scene(shipped_study(name)), true, 1);
        double along_x = 0.0, along_y = 0.0;
        for (const auto& record : tile.integration.records) {
            const auto& q = record.motion;
            for (std::size_t i = 0; i < q.size(); i += dynamics::fixed_shaft_motions) {
                along_x = std::max(
                    {along_x, std::abs(q[i + dynamics::x_1]), std::abs(q[i + dynamics::x_2])});
                along_y = std::max(along_y, std::abs(q[i + dynamics::y_1]));
            }
        }
        CHECK(along_x < 1e-12 * along_y);
    }
}

TEST_CASE("Fig. 4.7: the chipped tooth's signal departs from the healthy one at 22.4 degrees") {
    const mc::Scene scene(shipped_study("published/tian-fig-4-6.toml"));
    // Rotation of the pinion since the tooth came into contact.
    const auto degrees = [](double meshes) { return meshes * 360.0 / kPinionTeeth; };
    const auto& healthy = scene.gearbox().pairs().curve(PairId{0});
    const auto chipped = scene.gearbox().fault().mesh(0, 8e-3);
    double first = 0.0;
    while (first < healthy.contact_ratio() &&
           stiffness::total_at(*chipped, healthy.transitions(), first) >
               (1.0 - 1e-6) * stiffness::total_at(healthy, first)) {
        first += 1e-4;
    }
    CHECK(degrees(first) == Approx(22.4).margin(0.1));

    const auto rise = fault_signal(scene);
    const double largest = largest_magnitude(rise);
    std::size_t first_deviation = 0;
    while (std::abs(rise[first_deviation]) < 1e-3 * largest) {
        ++first_deviation;
    }
    const double since = static_cast<double>(first_deviation) / scene.record().samples -
                         scene.gearbox().fault().pattern().passages.front().start;
    CHECK(degrees(since) == Approx(22.4).margin(1.0));
}

TEST_CASE("Figs. 4.6-4.14: a peak every 19 meshes, chip below crack below broken tooth") {
    std::vector<double> peaks;
    for (const auto& name : kFaults) {
        INFO(name);
        const mc::Scene scene(shipped_study(name));
        const auto rise = fault_signal(scene);
        const std::size_t turn = rise.size() / 2,
                          samples = static_cast<std::size_t>(scene.record().samples);
        peaks.push_back(largest_magnitude(rise));
        // The whole change is within the meshes of the tooth and the oscillation after them.
        double change = 0.0, later = 0.0;
        for (std::size_t i = 0; i < turn; ++i) {
            change = std::max(change, std::abs(rise[i + turn] - rise[i]));
            later = std::max(later, i < 6 * samples ? 0.0 : std::abs(rise[i]));
        }
        CHECK(change < kNothing * peaks.back());
        CHECK(later < 0.02 * peaks.back());
    }
    const double healthy =
        largest_magnitude(sensor_signal(mc::Scene(shipped_study(kFaults[0])), 1));
    CHECK(peaks[0] < 0.2 * healthy);
    CHECK(peaks[1] > 2.0 * peaks[0]);
    CHECK(peaks[1] < healthy);
    CHECK(peaks[2] > 50.0 * healthy);
}

TEST_CASE(
    "Figs. 4.8, 4.11, 4.14: a faulty tooth causes harmonics of the shaft, perfect ones none") {
    double before = kNothing;
    for (const auto& name : kFaults) {
        INFO(name);
        const mc::Scene scene(shipped_study(name));
        const auto between = [&](std::uint64_t number) {
            const auto lines = spectrum(scene, kPinionTeeth, number);
            double largest = 0.0;
            for (std::size_t i = 0; i < lines.size(); ++i) {
                largest = i % kPinionTeeth == 0 ? largest : std::max(largest, lines[i]);
            }
            return largest / *std::max_element(lines.begin(), lines.end());
        };
        CHECK(between(0) < kNothing);
        CHECK(between(1) > 2.0 * before);
        before = between(1);
    }
    CHECK(before == 1.0);  // shaft harmonics are the largest lines of the broken tooth
}

TEST_CASE("Figs. 4.13, 4.14: the broken tooth's impact oscillates at 2530 Hz") {
    const mc::Scene scene(shipped_study("published/tian-fig-4-12.toml"));
    const auto signal = sensor_signal(scene, kPinionTeeth, 1);
    const auto shock = std::max_element(signal.begin(), signal.end()) - signal.begin();
    const double at = static_cast<double>(shock) / scene.record().samples;
    CHECK(ringing_Hz(signal, scene.record().samples, at + 0.1e-3 * kMesh_Hz,
                     at + 1.2e-3 * kMesh_Hz) == Approx(2530.0).epsilon(0.08));
    const double largest_Hz =
        static_cast<double>(dominant(spectrum(scene, kPinionTeeth, 1))) * kMesh_Hz / kPinionTeeth;
    CHECK(largest_Hz == Approx(2530.0).epsilon(0.08));
}

}  // namespace gearpod::test_tian_studies
