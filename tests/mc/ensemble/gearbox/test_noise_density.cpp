// Checks accelerometer noise given by its density before the low-pass.
#include "mc/plan/calibration_plan.hpp"
#include "mc/plan/sensor_plan.hpp"
#include "mc/study/sensor_signal.hpp"
#include "mc/study/study.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_noise_density {

using namespace test;

const std::string kSmall = std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/small.toml";

// The small study with noise by density instead.
std::string by_density(const Folder& folder, const std::string& density) {
    std::string text = bytes_of(kSmall);
    const std::size_t at = text.find("noise_m_s2 =");
    REQUIRE(at != std::string::npos);
    text.replace(at, text.find('\n', at) - at, "noise_density_m_s2_per_sqrt_Hz = " + density);
    const std::string path = folder.file("density.toml");
    write_bytes(path, text);
    return path;
}

// Noise of a record: its rms, and the share of its power above twice the low-pass frequency.
struct Noise {
    double rms = 0.0, below = 0.0;
};

Noise noise_of(const std::string& study, const std::string& options, const std::string& path,
               double low_pass_Hz) {
    require_success("simulate " + study + " --instance 2 --meshes 455 --out " + path + options);
    const auto columns = columns_of(path);
    std::vector<double> noise = columns.at("sensor_noise_1");
    const std::vector<double>& clean = columns.at("sensor");
    double sum = 0.0;
    for (std::size_t i = 0; i < noise.size(); ++i) {
        noise[i] -= clean[i];
        sum += noise[i] * noise[i];
    }
    signals::OrderSpectrum spectrum(static_cast<int>(noise.size()));
    spectrum.load(noise);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    const double length_s = columns.at("time")[1] * static_cast<double>(noise.size());
    double below = 0.0, all = 0.0;
    for (std::size_t order = 1; order < amplitude.size(); ++order) {
        const double power = amplitude[order] * amplitude[order];
        all += power;
        below += static_cast<double>(order) / length_s < 2.0 * low_pass_Hz ? power : 0.0;
    }
    return {std::sqrt(sum / static_cast<double>(noise.size())), below / all};
}

// White noise after a Butterworth filter of order 4 has 1.1e-3 of its power above twice the corner
// frequency: the integral of 1/(1 + x^8) from 2 on over that from 0 on. Aliased components are
// included.
TEST_CASE("The low-pass limits noise by density; a higher sampling rate leaves it unchanged") {
    const Folder folder;
    const mc::Study study = valid_study(mc::read_study(kSmall));
    const double low_pass = study.sensor.low_pass_Hz, sampling = study.sensor.sampling_Hz;
    const std::string density = by_density(folder, "0.01");
    const double expected = 0.01 * std::sqrt(low_pass * (M_PI / 8.0) / std::sin(M_PI / 8.0));
    const std::string fast = " --set sensor.sampling_Hz=" + std::to_string(4.0 * sampling) + " ";
    for (const std::string& options : {std::string(" "), fast}) {
        const Noise noise = noise_of(density, options, folder.file("s.csv"), low_pass);
        CHECK(noise.rms == Approx(expected).epsilon(0.05));
        CHECK(noise.below > 0.997);
    }
    // White noise independent of the low-pass: the same rms over four times the band.
    const Noise white = noise_of(kSmall, fast, folder.file("w.csv"), low_pass);
    CHECK(white.rms == Approx(study.sensor.noise_m_s2).epsilon(0.05));
    CHECK(white.below == Approx(240.0 / 560.0).epsilon(0.05));
}

TEST_CASE("Noise by density, by rms and by quantisation adds in quadrature") {
    const Folder folder;
    const mc::Study study = valid_study(mc::read_study(kSmall));
    const double low_pass = study.sensor.low_pass_Hz, sampling = study.sensor.sampling_Hz;
    // The white parts have 240 of 280 Hz below twice the low-pass, or all of them.
    const double bandwidth = low_pass * (M_PI / 8.0) / std::sin(M_PI / 8.0);
    const std::string density = by_density(folder, "0.01");
    const double filtered = 1e-4 * bandwidth, white = 0.09, rounding = 0.36 / 12.0;
    const auto rms_with = [&](const std::string& options) {
        return noise_of(density, options, folder.file("s.csv"), low_pass).rms;
    };
    const std::string background = " --set sensor.noise_m_s2=0.3",
                      steps = " --set sensor.quantisation_m_s2=0.6";
    CHECK(rms_with(background) == Approx(std::sqrt(filtered + white)).epsilon(0.05));
    CHECK(rms_with(steps) == Approx(std::sqrt(filtered + rounding)).epsilon(0.05));
    CHECK(rms_with(background + steps) ==
          Approx(std::sqrt(filtered + white + rounding)).epsilon(0.05));
    const double own = study.sensor.noise_m_s2;
    CHECK(noise_of(kSmall, steps, folder.file("w.csv"), low_pass).rms ==
          Approx(std::sqrt(own * own + rounding)).epsilon(0.05));
    // The parts keep their spectra: only the white one lies above twice the low-pass.
    const Noise wide = noise_of(
        density, background + " --set sensor.sampling_Hz=" + std::to_string(4.0 * sampling),
        folder.file("f.csv"), low_pass);
    CHECK(wide.below ==
          Approx((filtered + white * 2.0 * low_pass / (2.0 * sampling)) / (filtered + white))
              .epsilon(0.05));
}

TEST_CASE("A study may give its noise by rms and by density") {
    using tests::example_with;
    const auto read = [](const std::string& text) { return mc::read_study_text(text, "s.toml"); };
    const std::string rms = "noise_m_s2 = 0.3", density = "noise_density_m_s2_per_sqrt_Hz = 0.01";
    const auto both = read(example_with(rms, rms + "\n" + density));
    REQUIRE(both.study);
    CHECK(mc::sensor_noise_m_s2(*both.study) ==
          Approx(std::hypot(0.3, 0.01 * std::sqrt(1.0261721529 * 800.0))));
    // A factor on the rms leaves the other parts alone.
    const mc::SensorNoise scaled =
        mc::noise_stage(*both.study)
            .with_rms_factor(mc::sensor_noise(mc::noise_model(*both.study), {0.01, 0.3}), 2.0);
    CHECK(scaled.white_m_s2 == Approx(0.6));
    CHECK(scaled.all_m_s2 == Approx(std::hypot(0.6, 0.01 * std::sqrt(1.0261721529 * 800.0))));

    const auto one = read(example_with(rms, density));
    REQUIRE(one.study);
    CHECK(mc::sensor_noise_m_s2(*one.study) == Approx(0.01 * std::sqrt(1.0261721529 * 800.0)));
    const auto again = read(resolved_text(*one.study));
    REQUIRE(again.study);
    CHECK(*again.study == *one.study);

    // The random key alone: its median is the nominal value.
    std::string text = example_with(rms + "\n", "");
    text.insert(text.find("[random]\n") + 9,
                "sensor.noise_density_m_s2_per_sqrt_Hz = { distribution = \"lognormal\", median = "
                "0.02, cv = 0.2 }\n");
    const auto random = read(text);
    INFO(format(random.problems));
    REQUIRE(random.study);
    CHECK(mc::noise_by_density(*random.study));
    CHECK(mc::sensor_noise_m_s2(*random.study) == Approx(0.02 * std::sqrt(1.0261721529 * 800.0)));

    const auto fine = read(example_with(rms + "\nnoise_levels", density + "\nnoise_levels"));
    REQUIRE(fine.study);
    std::string slow = example_with(rms, density);
    slow.replace(slow.find("low_pass_Hz = 800"), 17, "low_pass_Hz = 50 ");
    const auto coarse = read(slow);
    REQUIRE(coarse.problems.size() == 1);
    CHECK(coarse.problems[0].key == "sensor.sampling_Hz");
}

// Upper limit of a background of 2 m/s^2 rms in the key's unit after 800 Hz.
TEST_CASE("A study with noise by density is calibrated by its density") {
    const mc::Study study = valid_study(mc::read_study_text(
        tests::example_with("noise_m_s2 = 0.3", "noise_density_m_s2_per_sqrt_Hz = 0.01"),
        "s.toml"));
    const auto inputs = mc::make_calibration_plan(study, "").default_inputs(2.0);
    const auto at = std::ranges::find(inputs, "sensor.noise_density_m_s2_per_sqrt_Hz",
                                      &mc::CalibratedInput::key);
    REQUIRE(at != inputs.end());
    CHECK(at->high == Approx(1.05 * 2.0 / std::sqrt(1.0261721529 * 800.0)));
    CHECK(at->independent_of_motion());
    CHECK(std::ranges::find(inputs, "sensor.noise_m_s2", &mc::CalibratedInput::key) ==
          inputs.end());
}

const std::string kBackground =
    " --set sensor.background_Hz=[10,60] --set "
    "sensor.background_density_m_s2_per_sqrt_Hz=[0.05,0.05] ";

// From 10 to 60 Hz the low-pass of 120 Hz passes all but 1e-3 of the power.
TEST_CASE("The background of the machine has the rms of its density, and none out of band") {
    const Folder folder;
    const std::string quiet = kBackground + "--set sensor.noise_m_s2=0 ";
    const double expected = 0.05 * std::sqrt(50.0);
    const Noise noise = noise_of(kSmall, quiet, folder.file("b.csv"), 31.0);
    CHECK(noise.rms == Approx(expected).epsilon(0.05));
    CHECK(noise.below > 0.999);
    const Noise loud =
        noise_of(kSmall, quiet + "--set sensor.background_level=3 ", folder.file("l.csv"), 31.0);
    CHECK(loud.rms == Approx(3.0 * noise.rms).epsilon(1e-6));
    const Noise both =
        noise_of(kSmall, kBackground + "--set sensor.noise_m_s2=0.4 ", folder.file("w.csv"), 31.0);
    CHECK(both.rms == Approx(std::hypot(0.4, expected)).epsilon(0.05));
}

TEST_CASE("A background needs two frequencies and a density for each") {
    const auto refused = [](const std::string& options, const char* text) {
        check_refused("describe " + kSmall + options, {text});
    };
    refused(" --set sensor.background_Hz=[10,60]", "sensor.background_Hz is given");
    refused(" --set sensor.background_density_m_s2_per_sqrt_Hz=[1,2]",
            "only with sensor.background_Hz");
    refused(
        " --set sensor.background_Hz=[10] --set "
        "sensor.background_density_m_s2_per_sqrt_Hz=[1]",
        "a spectrum needs two");
    refused(
        " --set sensor.background_Hz=[10,60,70] --set "
        "sensor.background_density_m_s2_per_sqrt_Hz=[1,2]",
        "has 2 values, but sensor.background_Hz has 3");
    CHECK(program("describe " + kSmall + kBackground).mentions("0.3535 of the background"));
}

}  // namespace gearpod::test_noise_density
