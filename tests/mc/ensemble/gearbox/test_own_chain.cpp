// Checks additional sensors with a measuring chain of their own: low-pass, mounting, delay,
// converter, sampling rate and noise. The closed forms are in
// tests/signals/path/test_frequency_response.cpp.
#include <fmt/format.h>

#include "mc/plan/sensor_plan.hpp"
#include "mc/study/sensor_signal.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/signals/butterworth.hpp"

namespace gearpod::test_own_chain {

using namespace test;
using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr double kLowPass_Hz = 120.0;  // of the small study
// Noise bandwidth of the low-pass over its cut-off frequency.
const double kBandwidth = (kPi / 8.0) / std::sin(kPi / 8.0);

// Sensors next to the first one, so that they differ by their measuring chain alone.
std::string side(const std::string& fields) {
    return " --set 'sensor.additional=[{name=\"side\", angle_deg=0, " + fields + "}]' ";
}

// Component of a signal at a harmonic of its length.
Complex component(const std::vector<double>& signal, std::size_t harmonic) {
    Complex sum = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const std::size_t turns = harmonic * i % signal.size();
        sum += signal[i] * std::polar(1.0, -2.0 * kPi * static_cast<double>(turns) /
                                               static_cast<double>(signal.size()));
    }
    return sum / static_cast<double>(signal.size());
}

// Rms of the noise in a column.
double noise_rms(const Columns& columns, const std::string& sensor) {
    return rms_of(difference(columns.at(sensor + "_noise_1"), columns.at(sensor)));
}

// The sensor does not measure the gearbox.
const std::string kSilent =
    " --set 'sensor.response_Hz=[0, 1000]' --set 'sensor.response_phase_deg=[0, 0]'"
    " --set 'sensor.response_gain=[0, 0]' ";

const std::string kChain =
    "low_pass_Hz=50, mounting_Hz=70, mounting_damping=0.05, delay_s=0.004, quantisation_m_s2=0.01";

// Response of a mounting of 70 Hz with a damping ratio of 0.05 after a low-pass of 50 Hz in place
// of 120 Hz, delayed by 4 ms.
Complex chain_at(double f_Hz) {
    const double r = f_Hz / 70.0;
    const Complex mounting = 1.0 + r * r / Complex(1.0 - r * r, 0.1 * r);
    return butterworth(f_Hz / 50.0) / butterworth(f_Hz / kLowPass_Hz) * mounting *
           std::polar(1.0, -2.0 * kPi * f_Hz * 0.004);
}

// Checks that a sensor has the first one's spectrum times that response.
void check_spectra(const Columns& columns) {
    const std::vector<double>&first = columns.at("sensor"), &own = columns.at("sensor_side");
    const double step_Hz = 1.0 / (columns.at("time")[1] * static_cast<double>(first.size()));
    const double largest = largest_magnitude(first);
    REQUIRE(largest > 0.0);
    for (std::size_t k = 0; k < first.size() / 2; k += 65) {
        INFO(k);
        CHECK(std::abs(component(own, k) - chain_at(step_Hz * static_cast<double>(k)) *
                                               component(first, k)) < 1e-9 * largest);
    }
}

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
    const auto noise = difference(columns.at("sensor_side_noise_1"), columns.at("sensor_side"));
    double lag = 0.0, all = 0.0;
    for (std::size_t i = 0; i + 1 < noise.size(); ++i) {
        lag += noise[i] * noise[i + 1];
        all += noise[i] * noise[i];
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
    check_same_features(results, plain);
    const auto &first = values(results.features, "sensor_rms"),
               &own = values(results.variants[2].features, "sensor_rms");
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(std::abs(own[i] / first[i] - 1.0) > 0.01);
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
    refused(" --set sensor.encoder_sampling_Hz=69",
            "sensor.encoder_sampling_Hz: 69 Hz is below twice the mesh frequency (35 Hz)");
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
    check_mentions(
        program("describe " + kSmall +
                side("sampling_Hz=110, low_pass_Hz=50, mounting_Hz=70, delay_s=-0.004")),
        {"sampling rate 110 Hz; low-pass 50 Hz; mounting resonance 70 Hz, damping 0.03; samples "
         "0.004 s early; noise 0.002 m/s^2 rms"});
}

TEST_CASE("A sampling rate of its own keeps the samples that the converter takes") {
    const Folder folder;
    const double sample_s = signals_of_small(folder, "").at("time")[1];
    const auto rate = fmt::format(", low_pass_Hz=50, sampling_Hz={}", 0.5 / sample_s);
    const std::string tone = "--set 'sensor.tones=[{frequency_Hz=61.3, amplitude_m_s2=0.7}]'";
    const auto all = signals_of_small(folder, side("noise=1, low_pass_Hz=50") + tone),
               own = signals_of_small(folder, side("noise=1" + rate) + tone);
    const std::vector<double>&before = all.at("sensor_side"), &after = own.at("sensor_side");
    REQUIRE(after.size() % 2 == 0);
    double largest_change = 0.0;
    for (std::size_t i = 0; i < after.size(); i += 2) {
        REQUIRE(after[i] == Approx(before[i]).margin(1e-9));
        largest_change = std::max(largest_change, std::abs(after[i + 1] - before[i + 1]));
    }
    CHECK(largest_change > 1e-3);  // aliases
}

TEST_CASE("A tone above half the sampling rate of a sensor has the folded frequency") {
    const Folder folder;
    const auto columns = signals_of_small(
        folder, kSilent + side("low_pass_Hz=40, sampling_Hz=100") +
                    "--set 'sensor.tones=[{frequency_Hz=61.3, amplitude_m_s2=0.7}]'");
    const std::vector<double>&own = columns.at("sensor_side"), &time = columns.at("time");
    const double length_s = time[1] * static_cast<double>(own.size());
    const double rate_Hz = std::round(100.0 * length_s) / length_s;
    const double angle = 2.0 * kPi * (rate_Hz - 61.3) * time[1];
    // x_i+1 + x_i-1 = 2 cos(angle) x_i holds for that sine alone.
    double square = 0.0;
    for (std::size_t i = 1; i + 1 < own.size(); ++i) {
        REQUIRE(own[i + 1] + own[i - 1] == Approx(2.0 * std::cos(angle) * own[i]).margin(1e-9));
        square += own[i] * own[i];
    }
    const auto gain = [](double f_Hz) { return 1.0 / std::sqrt(1.0 + std::pow(f_Hz, 8.0)); };
    CHECK(std::sqrt(2.0 * square / static_cast<double>(own.size())) ==
          Approx(0.7 * gain(61.3 / 40.0) / gain(61.3 / kLowPass_Hz)).epsilon(0.01));
}

TEST_CASE("Noise of a sensor lies below half its sampling rate, with the stated variance") {
    const Folder folder;
    const auto check = [&](const std::string& fields, const std::string& options, double rms) {
        const auto columns =
            signals_of_small(folder, side(fields + ", low_pass_Hz=40, sampling_Hz=100") + options);
        INFO(fields << options);
        CHECK(noise_rms(columns, "sensor_side") == Approx(rms).epsilon(0.08));
        const auto noise = difference(columns.at("sensor_side_noise_1"), columns.at("sensor_side"));
        const double step_Hz = 1.0 / (columns.at("time")[1] * static_cast<double>(noise.size()));
        const auto power = [&](double from_Hz, double to_Hz) {
            double sum = 0.0;
            for (auto k = static_cast<std::size_t>(std::ceil(from_Hz / step_Hz));
                 k < static_cast<std::size_t>(to_Hz / step_Hz); ++k) {
                sum += 2.0 * std::norm(component(noise, k));
            }
            return sum;
        };
        const double below = power(1.0, 35.0);
        CHECK(power(50.2, 70.0) < 1e-15 * below);
        return below / 34.0;  // density
    };
    // White noise of the same variance in less than half the bandwidth.
    CHECK(check("noise=2", "--set sensor.noise_m_s2=0.05", 0.1) ==
          Approx(0.01 / 50.0).epsilon(0.15));
    CHECK(check("quantisation_m_s2=1", "--set sensor.noise_m_s2=0", std::sqrt(1.0 / 12.0)) ==
          Approx(1.0 / 12.0 / 50.0).epsilon(0.15));
    // Filtered noise keeps its density where the low-pass passes it.
    CHECK(check("noise=1",
                "--set sensor.noise_m_s2=0 --set sensor.noise_density_m_s2_per_sqrt_Hz=0.01",
                0.01 * std::sqrt(kBandwidth * 40.0)) == Approx(1e-4).epsilon(0.15));
}

}  // namespace gearpod::test_own_chain
