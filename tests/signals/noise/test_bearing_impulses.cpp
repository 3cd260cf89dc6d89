// Checks the vibration of a faulty bearing against closed forms.
#include "signals/noise/bearing_impulses.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_bearing_impulses {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double kLowPass_Hz = 800.0;

BearingImpulses inner_ring() {
    return {.rate_Hz = 54.15,
            .slip = 0.02,
            .load_turns_Hz = 10.0,
            .load_zone_rad = pi,
            .amplitude_m_s2 = 3.0,
            .resonance_Hz = 650.0,
            .damping = 0.05};
}

// Transfer function from an impulse of size 1 to the measured acceleration, from the definitions:
// a damped resonance, and a Butterworth filter of order 4.
Complex transfer(const BearingImpulses& b, double frequency_Hz) {
    const Complex s(0.0, 2.0 * pi * frequency_Hz);
    const double w = 2.0 * pi * b.resonance_Hz, cut = 2.0 * pi * kLowPass_Hz;
    Complex value = b.amplitude_m_s2 * w * std::sqrt(1.0 - b.damping * b.damping) /
                    (s * s + 2.0 * b.damping * w * s + w * w);
    for (const double angle : {pi / 8.0, 3.0 * pi / 8.0}) {
        value *= cut * cut / (s * s + 2.0 * std::cos(angle) * cut * s + cut * cut);
    }
    return value;
}

// Sum of x(t) exp(-i w t) over samples, times the sampling interval.
Complex fourier(const std::vector<double>& samples, double sample_s, double frequency_Hz) {
    Complex sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        sum += samples[i] *
               std::polar(1.0, -2.0 * pi * frequency_Hz * sample_s * static_cast<double>(i));
    }
    return sum * sample_s;
}

TEST_CASE("The response to one impulse has the spectrum of resonance and low-pass") {
    const BearingImpulses bearing = inner_ring();
    const double sample_s = 1.0 / 200'000.0, before_s = 0.4 * sample_s;
    ResonanceResponse response(bearing, kLowPass_Hz, sample_s);
    response.excite(2.0, before_s);
    std::vector<double> samples;
    while (static_cast<double>(samples.size()) * sample_s < response.decay_s()) {
        samples.push_back(response.sample());
        response.advance();
    }
    for (const double frequency_Hz : {30.0, 400.0, 650.0, 900.0, 2000.0}) {
        const Complex expected = 2.0 * transfer(bearing, frequency_Hz) *
                                 std::polar(1.0, 2.0 * pi * frequency_Hz * before_s);
        const Complex found = fourier(samples, sample_s, frequency_Hz);
        CHECK(std::abs(found - expected) < 1e-6 * std::abs(transfer(bearing, 650.0)));
    }
}

TEST_CASE("The energy of a response is that of its spectrum (Parseval)") {
    const BearingImpulses bearing = inner_ring();
    double sum = 0.0;
    const double step_Hz = 0.25;
    for (double f = 0.5 * step_Hz; f < 20'000.0; f += step_Hz) {
        sum += 2.0 * std::norm(transfer(bearing, f)) * step_Hz;
    }
    const ResonanceResponse response(bearing, kLowPass_Hz, 1e-3);
    CHECK(response.energy() == Approx(sum).epsilon(1e-6));
    CHECK(bearing_rms(bearing, kLowPass_Hz) == Approx(std::sqrt(54.15 * sum)).epsilon(1e-6));
}

TEST_CASE("The load of a faulty spot follows Stribeck's distribution") {
    CHECK(bearing_load(0.0, 0.3) == 1.0);
    CHECK(bearing_load(pi, 0.0) == 1.0);
    CHECK(bearing_load(pi, 7.0) == 1.0);
    CHECK(bearing_load(pi, 0.3) == 0.0);
    CHECK(bearing_load(pi, 1.0 / 6.0) == Approx(std::pow(0.5, 1.5)));
    CHECK(bearing_load(2.0 * pi / 3.0, -1.0 / 12.0) ==
          Approx(std::pow((std::sqrt(0.75) - 0.5) / 0.5, 1.5)));
}

TEST_CASE("Intervals between impulses have their mean and scatter, and positions drift") {
    BearingImpulses bearing = inner_ring();
    std::mt19937_64 engine(7);
    const double period_s = 1.0 / bearing.rate_Hz;
    constexpr int kTrains = 4000, kIntervals = 100;
    double mean = 0.0, square = 0.0, first = 0.0;
    for (int train = 0; train < kTrains; ++train) {
        ImpulseTimes times(bearing, 0.0, engine);
        const double start_s = times.next_s();
        for (int i = 0; i < kIntervals; ++i) {
            times.advance();
        }
        const double drift = (times.next_s() - start_s) / period_s - kIntervals;
        first += start_s / period_s / kTrains;
        mean += drift / kTrains;
        square += drift * drift / kTrains;
    }
    const double variance = kIntervals * bearing.slip * bearing.slip;
    CHECK(std::abs(mean) < 4.0 * std::sqrt(variance / kTrains));
    CHECK(square == Approx(variance).epsilon(4.0 * std::sqrt(2.0 / kTrains)));
    CHECK(first == Approx(0.5).margin(4.0 * std::sqrt(1.0 / 12.0 / kTrains)));
}

// Power of the vibration around the first multiples of the impulse rate, against the density of a
// renewal process behind resonance and low-pass.
TEST_CASE("Slipping impulses have the spectrum of a renewal process") {
    BearingImpulses bearing = inner_ring();
    bearing.load_zone_rad = 0.0;
    bearing.slip = 0.05;
    constexpr double kSample_s = 1.0 / 4000.0;
    constexpr int kSamples = 8192;
    constexpr int kRecords = 120;
    const double length_s = kSample_s * kSamples, rate_Hz = bearing.rate_Hz;
    std::mt19937_64 engine(11);
    std::vector<double> power(5, 0.0), expected(5, 0.0);  // by multiple of the rate, from 1
    const auto multiple = [&](double f) { return static_cast<std::size_t>(f / rate_Hz + 0.5); };
    const int last = static_cast<int>(5.5 * rate_Hz * length_s);
    FourierTransform transform(kSamples);
    std::vector<Complex> record_samples(kSamples), spectrum(kSamples);
    for (int record = 0; record < kRecords; ++record) {
        std::vector<double> samples(kSamples, 0.0);
        add_bearing_vibration(bearing, kLowPass_Hz, kSample_s, engine, samples);
        std::ranges::copy(samples, record_samples.begin());
        transform.transform(record_samples, spectrum);
        for (int line = 1; line < last; ++line) {
            const double f = line / length_s;
            if (multiple(f) >= 1) {
                power[multiple(f) - 1] += 2.0 *
                                          std::norm(spectrum[static_cast<std::size_t>(line)]) /
                                          (double{kSamples} * kSamples * kRecords);
            }
        }
    }
    for (int line = 1; line < last; ++line) {
        const double f = line / length_s, angle = 2.0 * pi * f / rate_Hz;
        if (multiple(f) < 1) {
            continue;
        }
        const Complex phi = std::polar(std::exp(-0.5 * std::pow(angle * bearing.slip, 2)), -angle);
        expected[multiple(f) - 1] += 2.0 * rate_Hz * ((1.0 + phi) / (1.0 - phi)).real() *
                                     std::norm(transfer(bearing, f)) / length_s;
    }
    for (std::size_t m = 0; m < power.size(); ++m) {
        INFO("multiple " << m + 1 << " of the rate");
        CHECK(power[m] == Approx(expected[m]).epsilon(0.08));
    }
}

// Without slip, and with commensurate rates, the vibration repeats. Lines stand at the rate plus
// multiples of the turns through the load zone, with the load's Fourier coefficients.
TEST_CASE("The load zone modulates the impulses") {
    BearingImpulses bearing = inner_ring();
    bearing.slip = 0.0;
    bearing.rate_Hz = 200.0;
    bearing.load_turns_Hz = 10.0;
    constexpr double kSample_s = 1.0 / 16'384.0;
    std::vector<double> samples(16'384, 0.0);
    std::mt19937_64 engine(3);
    add_bearing_vibration(bearing, kLowPass_Hz, kSample_s, engine, samples);
    for (const int line : {0, 1, -1, 2, -2}) {
        double coefficient = 0.0;
        constexpr int kParts = 4000;
        for (int i = 0; i < kParts; ++i) {
            const double turns = (i + 0.5) / kParts;
            coefficient +=
                bearing_load(bearing.load_zone_rad, turns) * std::cos(2.0 * pi * line * turns);
        }
        const double f = 3.0 * bearing.rate_Hz + line * bearing.load_turns_Hz;
        const double expected =
            bearing.rate_Hz * std::abs(coefficient / kParts) * std::abs(transfer(bearing, f));
        // Twenty impulses in a turn: coefficients of order 18 and higher alias onto these lines.
        CHECK(std::abs(fourier(samples, kSample_s, f)) == Approx(expected).epsilon(0.005));
    }
}

TEST_CASE("Vibration does not depend on the length of the record") {
    const BearingImpulses bearing = inner_ring();
    std::vector<double> whole(3000, 1.0), part(1200, 1.0);
    std::mt19937_64 one(5), other(5);
    add_bearing_vibration(bearing, kLowPass_Hz, 1e-4, one, whole);
    add_bearing_vibration(bearing, kLowPass_Hz, 1e-4, other, part);
    CHECK(std::equal(part.begin(), part.end(), whole.begin()));
}

TEST_CASE("Bearings with invalid frequencies or damping are refused") {
    const auto refuses = [](auto change) {
        BearingImpulses bearing = inner_ring();
        change(bearing);
        CHECK_THROWS_AS(ResonanceResponse(bearing, kLowPass_Hz, 1e-4), std::invalid_argument);
    };
    refuses([](BearingImpulses& b) { b.rate_Hz = 0.0; });
    refuses([](BearingImpulses& b) { b.resonance_Hz = -1.0; });
    refuses([](BearingImpulses& b) { b.damping = 0.0; });
    refuses([](BearingImpulses& b) { b.damping = 0.31; });
}

}  // namespace gearpod::signals::test_bearing_impulses
