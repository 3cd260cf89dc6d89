// Checks the orders of healthy spectra when teeth differ. A recording of identical teeth repeats
// with the carrier; errors of planet teeth add lines at the orders of their turns, errors of sun
// teeth at the sun's.
#include "mc/files/hdf5_data.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_pass_orders {

using namespace test;

// Study with 13/11/35 teeth, 8 samples per mesh period.
const std::string kSmall = std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/small.toml";

// Amplitudes of the noise-free sensor signal over so many mesh periods, by cycles in them.
std::vector<double> amplitudes(int meshes, const std::string& errors) {
    const auto [folder, path] = TemporaryFile("s.h5");
    require_success("simulate " + kSmall + errors + " --instance 2 --meshes " +
                    std::to_string(meshes) + " --out " + path);
    const mc::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
    const mc::Hdf5Handle group = mc::open_group(file.get(), "signals");
    const auto samples = mc::read_numbers(group.get(), "sensor", 1000000).values;
    const std::vector<std::complex<double>> in(samples.begin(), samples.begin() + 8 * meshes);
    std::vector<std::complex<double>> out(in.size());
    signals::FourierTransform(8 * meshes).transform(in, out);
    std::vector<double> all;
    for (std::size_t k = 0; 2 * k < out.size(); ++k) {
        all.push_back(2.0 * std::abs(out[k]) / static_cast<double>(out.size()));
    }
    return all;
}

double rms(const std::vector<double>& lines, int multiple, bool at_multiples) {
    double sum = 0.0;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        if ((k % static_cast<std::size_t>(multiple) == 0) == at_multiples) {
            sum += 0.5 * lines[k] * lines[k];
        }
    }
    return std::sqrt(sum);
}

TEST_CASE("Identical teeth leave nothing between the carrier's orders, teeth with errors do") {
    struct Gear {
        const char* what;
        int meshes, carrier_turns;
        std::string grade;  // option that gives this gear alone, or almost, a grade
    };
    // Number of carrier turns of 35 mesh periods until the gear's teeth meet the same ring teeth.
    for (const Gear& gear : {Gear{"planet", 11 * 35, 11, " --set gearbox.planet.quality="},
                             Gear{"sun", 13 * 35, 13,
                                  " --set gearbox.planet.quality=0 --set gearbox.ring.quality=0"
                                  " --set gearbox.tooth_quality="}}) {
        INFO(gear.what);
        const auto ideal = amplitudes(gear.meshes, "");
        CHECK(rms(ideal, gear.carrier_turns, false) < 1e-6 * rms(ideal, gear.carrier_turns, true));
        const double finer =
            rms(amplitudes(gear.meshes, gear.grade + "4"), gear.carrier_turns, false);
        const double coarser =
            rms(amplitudes(gear.meshes, gear.grade + "6"), gear.carrier_turns, false);
        CHECK(coarser > 0.02 * rms(ideal, gear.carrier_turns, true));
        // One grade is a factor of sqrt(2) of all deviations; no tooth pair loses contact here.
        CHECK(coarser / finer == Approx(2.0).epsilon(0.2));
    }
    // Errors of the ring teeth have the carrier's orders, where the ideal lines are.
    const auto ring = amplitudes(11 * 35, " --set gearbox.ring.quality=6");
    CHECK(rms(ring, 11, false) < 1e-6 * rms(ring, 11, true));
}

}  // namespace gearpod::test_pass_orders
