// Checks additional sensors with a measuring chain of their own: low-pass, mounting, delay,
// converter and noise. The closed forms are in tests/signals/path/test_frequency_response.cpp.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "mc/plan/sensor_plan.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/ensemble/gearbox/chain_signals.hpp"
#include "tests/mc/study_file.hpp"

namespace test_own_chain {

using namespace gearpod;
using namespace gearpod::test;
using Complex = std::complex<double>;

namespace {

constexpr double kPi = std::numbers::pi;

const std::string kChain =
    "low_pass_Hz=50, mounting_Hz=70, mounting_damping=0.05, delay_s=0.004, quantisation_m_s2=0.01";

// The same with a sampling rate of its own.
const std::string kSampled = kChain + ", sampling_Hz=110";

// Response of a mounting of 70 Hz with a damping ratio of 0.05 after a low-pass of 50 Hz in place
// of 120 Hz, delayed by 4 ms.
Complex chain_at(double f_Hz) {
    const auto low_pass = [&](double corner_Hz) {
        Complex product = 1.0;
        for (const double eighths : {5.0, 7.0, 9.0, 11.0}) {
            product *= Complex(0.0, f_Hz / corner_Hz) - std::polar(1.0, eighths * kPi / 8.0);
        }
        return 1.0 / product;
    };
    const double r = f_Hz / 70.0;
    const Complex mounting = 1.0 + r * r / Complex(1.0 - r * r, 0.1 * r);
    return low_pass(50.0) / low_pass(kLowPass_Hz) * mounting *
           std::polar(1.0, -2.0 * kPi * f_Hz * 0.004);
}

// Checks that a sensor has the first one's spectrum times that response.
void check_spectra(const Columns& columns) {
    const std::vector<double>&first = columns.at("sensor"), &own = columns.at("sensor_side");
    const double step_Hz = 1.0 / (columns.at("time")[1] * static_cast<double>(first.size()));
    double largest = 0.0;
    for (const double value : first) {
        largest = std::max(largest, std::abs(value));
    }
    REQUIRE(largest > 0.0);
    for (std::size_t k = 0; k < first.size() / 2; k += 65) {
        INFO(k);
        CHECK(std::abs(component(own, k) - chain_at(step_Hz * static_cast<double>(k)) *
                                               component(first, k)) < 1e-9 * largest);
    }
}

const std::vector<double>& values(const std::vector<mc::FeatureResult>& features,
                                  const std::string& name) {
    return std::ranges::find(features, name, &mc::FeatureResult::name)->values;
}

}  // namespace

TEST_CASE("A measuring chain changes the spectrum of the gearbox by its response") {
    const Folder folder;
    check_spectra(signals_of_small(folder, side(kChain)));
}

TEST_CASE("Faulty bearings pass the measuring chain, but not the housing") {
    const Folder folder;
    check_spectra(signals_of_small(
        folder, kSilent + side(kChain) +
                    "--set 'sensor.bearings=[{fault=\"inner\", shaft=\"sun\", elements=9, "
                    "diameter_ratio=0.2, amplitude_m_s2=0.05, resonance_Hz=90}]'"));
}

TEST_CASE("A tone has the amplitude and phase of its own frequency after the measuring chain") {
    const Folder folder;
    constexpr double kTone_Hz = 61.3;
    const auto columns = signals_of_small(folder, kSilent + side(kChain) +
                                                      "--set 'sensor.tones=[{frequency_Hz=61.3, "
                                                      "amplitude_m_s2=0.7}]'");
    const std::vector<double>&first = columns.at("sensor"), &own = columns.at("sensor_side"),
          &time = columns.at("time");
    // Amplitude of the first sensor's tone from two samples; the others follow from both.
    const double angle = 2.0 * kPi * kTone_Hz * time[1];
    const double sine = first[0], cosine = (first[1] - sine * std::cos(angle)) / std::sin(angle);
    CHECK(std::hypot(sine, cosine) == Approx(0.7).epsilon(1e-9));
    const Complex factor = chain_at(kTone_Hz);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Complex tone =
            Complex(cosine, sine) * std::polar(1.0, 2.0 * kPi * kTone_Hz * time[i]);
        REQUIRE(own[i] == Approx((factor * tone).imag()).margin(1e-9));
    }
}

TEST_CASE("A delay of whole samples shifts the samples") {
    const Folder folder;
    const double sample_s = signals_of_small(folder, "").at("time")[1];
    constexpr std::size_t kShift = 5;
    const auto columns =
        signals_of_small(folder, side("delay_s=" + fmt::format("{}", kShift * sample_s)));
    const std::vector<double>&first = columns.at("sensor"), &own = columns.at("sensor_side");
    for (std::size_t i = 0; i < first.size(); ++i) {
        REQUIRE(own[(i + kShift) % own.size()] == Approx(first[i]).margin(1e-9));
    }
}

TEST_CASE("Noise by density passes the low-pass of each sensor") {
    const Folder folder;
    const std::string density =
        "--set sensor.noise_m_s2=0 --set sensor.noise_density_m_s2_per_sqrt_Hz=0.01";
    const auto columns = signals_of_small(folder, side("low_pass_Hz=40, noise=3") + density);
    CHECK(noise_rms(columns, "sensor") ==
          Approx(0.01 * std::sqrt(kBandwidth * kLowPass_Hz)).epsilon(0.05));
    CHECK(noise_rms(columns, "sensor_side") ==
          Approx(3.0 * 0.01 * std::sqrt(kBandwidth * 40.0)).epsilon(0.07));
    // The samples are those of a sensor with that low-pass: half a period of 40 Hz apart, 3.5
    // samples, they are anticorrelated; white noise is not.
    const std::vector<double>&clean = columns.at("sensor_side"),
          &noisy = columns.at("sensor_side_noise_1");
    double lag = 0.0, all = 0.0;
    for (std::size_t i = 0; i + 1 < clean.size(); ++i) {
        lag += (noisy[i] - clean[i]) * (noisy[i + 1] - clean[i + 1]);
        all += (noisy[i] - clean[i]) * (noisy[i] - clean[i]);
    }
    CHECK(lag / all > 0.7);
}

TEST_CASE("A background passes the low-pass of each sensor") {
    const Folder folder;
    const auto columns = signals_of_small(
        folder, side("low_pass_Hz=30") +
                    "--set sensor.noise_m_s2=0 --set sensor.background_Hz=[10,60] "
                    "--set sensor.background_density_m_s2_per_sqrt_Hz=[0.05,0.05]");
    double power = 0.0;  // midpoint rule
    for (double f_Hz = 10.005; f_Hz < 60.0; f_Hz += 0.01) {
        power += 0.01 * 0.05 * 0.05 / (1.0 + std::pow(f_Hz / 30.0, 8.0));
    }
    CHECK(noise_rms(columns, "sensor") == Approx(0.05 * std::sqrt(50.0)).epsilon(0.05));
    CHECK(noise_rms(columns, "sensor_side") == Approx(std::sqrt(power)).epsilon(0.1));
}

TEST_CASE("White noise stays white, and the converter is that of each sensor") {
    const Folder folder;
    const auto rms = [&](const std::string& fields, const std::string& options) {
        return noise_rms(signals_of_small(folder, side(fields) + options), "sensor_side");
    };
    const std::string white = "--set sensor.noise_m_s2=0.1 ",
                      steps = "--set sensor.quantisation_m_s2=0.5 ";
    CHECK(rms("low_pass_Hz=40", white) == Approx(0.1).epsilon(0.05));
    CHECK(rms("low_pass_Hz=40", white + steps) ==
          Approx(std::sqrt(0.01 + 0.25 / 12.0)).epsilon(0.05));
    CHECK(rms("quantisation_m_s2=0", white + steps) == Approx(0.1).epsilon(0.05));
    CHECK(rms("quantisation_m_s2=1, noise=2", white + steps) ==
          Approx(std::sqrt(0.04 + 1.0 / 12.0)).epsilon(0.05));
    CHECK(rms("quantisation_m_s2=1", "--set sensor.noise_m_s2=0 ") ==
          Approx(std::sqrt(1.0 / 12.0)).epsilon(0.05));
}

TEST_CASE("The variances of all parts of a sensor's noise add") {
    const mc::Study study = valid_study(mc::read_study(
        kSmall,
        {"sensor.noise_density_m_s2_per_sqrt_Hz=0.01", "sensor.background_Hz=[10, 60]",
         "sensor.background_density_m_s2_per_sqrt_Hz=[0.05, 0.02]", "sensor.quantisation_m_s2=0.3",
         "sensor.additional=[{name='a', angle_deg=0, noise=2, "
         "low_pass_Hz=30, quantisation_m_s2=0.1}, "
         "{name='b', angle_deg=0, noise=2}]"}));
    const auto& sensors = study.sensor.additional;
    const mc::SensorNoise first = mc::sensor_noise(mc::noise_model(study), {0.01, 0.4, 1.0});
    const double background = 2.0 * mc::background_spectrum(study).rms_m_s2(30.0),
                 white = 4.0 * 0.16 + 0.01 / 12.0;
    const mc::SensorNoise own = mc::noise_stage(study, &sensors[0]).of(first),
                          twice = mc::noise_stage(study, &sensors[1]).of(first);
    CHECK(own.background_m_s2 == Approx(background).epsilon(1e-12));
    CHECK(own.white_m_s2 == Approx(std::sqrt(white)).epsilon(1e-12));
    CHECK(own.all_m_s2 ==
          Approx(std::sqrt(4e-4 * kBandwidth * 30.0 + white + background * background))
              .epsilon(1e-12));
    CHECK(twice.all_m_s2 == 2.0 * first.all_m_s2);
    CHECK(twice.white_m_s2 == 2.0 * first.white_m_s2);
    CHECK(twice.background_m_s2 == 2.0 * first.background_m_s2);
}

TEST_CASE("The first sensor and sensors without a chain keep their bits") {
    const Folder folder;
    const std::string twins =
        " --set 'sensor.additional=[{name=\"twin\", angle_deg=0}, {name=\"same\", angle_deg=0, "
        "delay_s=0}, {name=\"own\", angle_deg=0, " +
        kChain + "}]'";
    const mc::Results plain =
                          run_small(folder, "p.h5",
                                    " --set 'sensor.additional=[{name=\"twin\", angle_deg=0}]'"),
                      results = run_small(folder, "r.h5", twins);
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
        INFO(plain.features[f].name);
        CHECK(bits_of_values(results.features[f].values) ==
              bits_of_values(plain.features[f].values));
        CHECK(bits_of_values(results.variants[0].features[f].values) ==
              bits_of_values(plain.variants[0].features[f].values));
    }
    const auto &first = values(results.features, "sensor_rms"),
               &own = values(results.variants[2].features, "sensor_rms");
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(std::abs(own[i] / first[i] - 1.0) > 0.01);
    }
}

TEST_CASE("Rows with a measuring chain keep their bits over threads, parts and merging") {
    check_equal_bits_over_parts(side(kSampled) +
                                "--set sensor.noise_density_m_s2_per_sqrt_Hz=0.001 "
                                "--set 'sensor.tones=[{frequency_Hz=31, amplitude_m_s2=0.1}]' ");
}

TEST_CASE("Rows with a measuring chain keep their bits over lanes") {
    const auto rows = [](int lanes) {
        const mc::Study study = valid_study(mc::read_study(
            kSmall, {"sensor.additional=[{name='side', angle_deg=90, " + kSampled + "}]",
                     "ensemble.threshold_instances=5", "ensemble.instances=6",
                     fmt::format("numerics.lanes={}", lanes)}));
        return bits(run(study));
    };
    const auto eight = rows(8);
    CHECK(rows(1) == eight);
    CHECK(rows(4) == eight);
}

TEST_CASE("Exported samples of a measuring chain have the features of the run") {
    const Folder folder;
    const std::string options =
        side(kSampled) + "--set sensor.noise_density_m_s2_per_sqrt_Hz=0.001 ";
    const mc::Results results = run_small(folder, "run.h5", options);
    const auto measured = features_of_export(folder, "sensor_side_noise_1", options);
    for (const char* name : {"sensor_rms", "window_ratio", "fm4", "crest_factor"}) {
        INFO(name);
        CHECK(values(results.variants[0].features, name)[25] ==
              Approx(printed_value(measured, name)).epsilon(1e-5));
    }
}

TEST_CASE("Measuring chains of signals recorded during integration equal those of kept motion") {
    const Folder folder;
    const std::string options =
        side(kSampled) +
        "--set 'features.use=[\"sensor_rms\", \"window_ratio\", \"change_window_ratio\", "
        "\"crest_factor\"]' --set features.baseline_torque_scatter=0.02"
        " --set sensor.record_s=9 --set sensor.noise_levels=[0] ";
    const mc::Results kept = run_small(folder, "kept.h5", options),
                      recorded =
                          run_small(folder, "recorded.h5", options + "--set numerics.horizon=full");
    for (std::size_t f = 0; f < kept.features.size(); ++f) {
        INFO(kept.features[f].name);
        const auto &a = kept.variants[0].features[f].values,
                   &b = recorded.variants[0].features[f].values;
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            CHECK(a[i] == Approx(b[i]).epsilon(2e-3));
        }
    }
}

TEST_CASE("Problems of a measuring chain are reported") {
    const auto refused = [](const std::string& options, const char* text) {
        check_refused("describe " + kSmall + options, {text});
    };
    refused(side("low_pass_Hz=130"),
            "sensor 1: low_pass_Hz = 130 Hz is above sensor.low_pass_Hz, 120 Hz");
    refused(side("sampling_Hz=300"),
            "sensor 1: sampling_Hz = 300 Hz is above sensor.sampling_Hz, 280 Hz");
    refused(side("sampling_Hz=90, low_pass_Hz=50"),
            "sensor 1: sampling_Hz = 90 Hz is not above twice its low-pass, 50 Hz");
    refused(side("sampling_Hz=50, low_pass_Hz=20"),
            "sampling_Hz = 50 Hz is below twice the mesh frequency");
    refused(side("sampling_Hz=0"), "sensor 1: sampling_Hz must be");
    refused(side("low_pass_Hz=0"), "sensor 1: low_pass_Hz must be");
    refused(side("delay_s=1.5"), "sensor 1: delay_s must be");
    refused(side("mounting_Hz=0"), "sensor 1: mounting_Hz must be");
    refused(side("mounting_Hz=50, mounting_damping=0"), "sensor 1: mounting_damping must be");
    refused(side("mounting_damping=0.1"), "mounting_damping is given, but no mounting_Hz");
    refused(side("quantisation_m_s2=-1"), "sensor 1: quantisation_m_s2 must be");
    refused(side("low_pass_Hz=5") + "--set sensor.noise_density_m_s2_per_sqrt_Hz=0.01",
            "low_pass_Hz = 5 Hz is too low for sensor.sampling_Hz, 280 Hz");
    refused(side("low_pass_Hz=5") +
                "--set sensor.background_Hz=[60,100] --set "
                "sensor.background_density_m_s2_per_sqrt_Hz=[0.1,0.1]",
            "passes nothing of the background, which begins at 60 Hz");
    const auto described =
        program("describe " + kSmall +
                side("sampling_Hz=110, low_pass_Hz=50, mounting_Hz=70, delay_s=-0.004"));
    INFO(described.output);
    CHECK(described.mentions(
        "sampling rate 110 Hz; low-pass 50 Hz; mounting resonance 70 Hz, damping 0.03; samples "
        "0.004 s early; noise 0.002 m/s^2 rms"));
}

TEST_CASE("A study with measuring chains reads back from its resolved text") {
    const mc::Study reading = valid_study(mc::read_study(
        kSmall,
        {"sensor.additional=[{name='b', angle_deg=30, sampling_Hz=150, low_pass_Hz=50.5, "
         "mounting_Hz=70, "
         "mounting_damping=0.1, delay_s=-1e-3, quantisation_m_s2=0, range_m_s2=20}, {name='c', "
         "angle_deg=1, mounting_Hz=1e4}]"}));
    check_reads_back(reading);
}

}  // namespace test_own_chain
