// Vibration of a rolling bearing with a local fault, as an accelerometer measures it.
//
// Every time the faulty spot meets the other surface, an impulse excites a resonance of the
// housing. The response to one impulse, before the sensor's anti-alias low-pass, is
//
//     a(t) = A exp(-zeta w t) sin(w sqrt(1 - zeta^2) t),    t > 0
//
// (P. D. McFadden and J. D. Smith, J. Sound Vib. 96 (1984), 69-82). The samples are the response
// after the low-pass (Butterworth, order 4) at the times of the samples, aliases included, summed
// over all impulses before them.
//
// Rolling elements slip. The intervals between impulses are independent and normal, of mean T and
// standard deviation s T, so that the position drifts (J. Antoni and R. B. Randall, Mech. Syst.
// Signal Process. 17 (2003), 1079-1101). The impulses are a renewal process, whose one-sided power
// density at frequency f, for impulses of size 1, is
//
//     S(f) = 2/T Re[(1 + phi)/(1 - phi)],    phi = exp(-2 pi i f T - 2 pi^2 f^2 s^2 T^2).
//
// A surface that turns through the load zone, of width L, is loaded by
// ((cos x - cos L/2) / (1 - cos L/2))^1.5 within it and by nothing outside, where x is its angle
// from the zone's centre (R. Stribeck's distribution; T. A. Harris, Rolling Bearing Analysis).
#pragma once

#include <algorithm>
#include <array>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <complex>
#include <span>

namespace gearpod::signals {

// Largest slip. With it, an interval that is not positive is ten standard deviations away.
inline constexpr double kMostSlip = 0.1;
// Largest damping ratio of the resonance; the low-pass has poles of larger damping ratios only.
inline constexpr double kMostResonanceDamping = 0.3;

struct BearingImpulses {
    double rate_Hz = 0.0;         // mean rate of the impulses, 1/T
    double slip = 0.0;            // s, 0 to kMostSlip
    double load_turns_Hz = 0.0;   // rate at which the faulty spot turns through the load zone
    double load_zone_rad = 0.0;   // L; 0 if the faulty spot has a constant load
    double amplitude_m_s2 = 0.0;  // A, in the middle of the load zone
    double resonance_Hz = 0.0;    // w / 2 pi
    double damping = 0.0;         // zeta, above 0, at most kMostResonanceDamping
};

// Load of a spot at an angle of that many turns from the middle of the load zone, relative to its
// largest. 1 for a zone of width 0.
double bearing_load(double load_zone_rad, double turns);

// Sampled response of resonance and low-pass to impulses between the samples.
class ResonanceResponse {
  public:
    // Throws std::invalid_argument unless all frequencies are positive and finite and the damping
    // ratio is within its limits.
    ResonanceResponse(const BearingImpulses& bearing, double low_pass_Hz, double sample_s);

    // Adds an impulse of relative size `size` that occurred `before_s` seconds before the current
    // sample.
    void excite(double size, double before_s);
    // Value at the current sample, m/s^2.
    double sample() const { return state_[0].real() + state_[1].real() + state_[2].real(); }
    // Proceeds to the next sample.
    void advance();
    // Time in which a response decays to 1e-9.
    double decay_s() const { return decay_s_; }
    // Integral of the squared response to an impulse of size 1, (m/s^2)^2 s.
    double energy() const;

  private:
    using Modes = std::array<std::complex<double>, 3>;  // one of each conjugate pair
    Modes pole_, weight_, decay_;
    Modes state_{};
    double decay_s_;
};

// Rms of the vibration after the low-pass while the faulty spot carries its largest load, m/s^2.
// Exact if the response to an impulse has decayed before the next one. Throws as ResonanceResponse.
double bearing_rms(const BearingImpulses& bearing, double low_pass_Hz);

// Times of impulses, s. Engine: a 64-bit uniform random bit generator.
template <class Engine>
class ImpulseTimes {
  public:
    // The first impulse follows `start_s` by a uniformly distributed part of an interval.
    ImpulseTimes(const BearingImpulses& bearing, double start_s, Engine& engine)
        : engine_(engine),
          interval_s_(1.0 / bearing.rate_Hz),
          slip_(bearing.slip),
          next_s_(start_s + interval_s_ * boost::random::uniform_01<double>()(engine)) {}

    double next_s() const { return next_s_; }
    void advance() { next_s_ += interval_s_ * std::max(0.0, 1.0 + slip_ * unit_(engine_)); }

  private:
    Engine& engine_;
    double interval_s_, slip_, next_s_;
    boost::random::normal_distribution<double> unit_;
};

// Adds the bearing's vibration to samples at the times 0, sample_s, 2 sample_s, ... The first
// samples do not depend on the number of samples. Throws as ResonanceResponse.
template <class Engine>
void add_bearing_vibration(const BearingImpulses& bearing, double low_pass_Hz, double sample_s,
                           Engine& engine, std::span<double> samples) {
    ResonanceResponse response(bearing, low_pass_Hz, sample_s);
    const double zone_turns = boost::random::uniform_01<double>()(engine);
    const long first = -static_cast<long>(response.decay_s() / sample_s);
    ImpulseTimes<Engine> impulses(bearing, static_cast<double>(first) * sample_s, engine);
    for (long i = first; i < static_cast<long>(samples.size()); ++i) {
        response.advance();
        const double now_s = static_cast<double>(i) * sample_s;
        for (; impulses.next_s() <= now_s; impulses.advance()) {
            const double turns = zone_turns + bearing.load_turns_Hz * impulses.next_s();
            response.excite(bearing_load(bearing.load_zone_rad, turns), now_s - impulses.next_s());
        }
        if (i >= 0) {
            samples[static_cast<std::size_t>(i)] += response.sample();
        }
    }
}

}  // namespace gearpod::signals
