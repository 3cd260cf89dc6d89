#include "signals/path/transmission_path.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_path_and_filter {

constexpr double kPi = std::numbers::pi;

// Fourth-order Butterworth low-pass, two sections by the bilinear transform.
class Butterworth {
  public:
    Butterworth(double cutoff_Hz, double sampling_Hz) {
        const double w = std::tan(kPi * cutoff_Hz / sampling_Hz);
        for (int s = 0; s < 2; ++s) {
            const double damping = 2.0 * std::cos(kPi * (2 * s + 1) / 8.0);
            const double norm = 1.0 / (1.0 + damping * w + w * w);
            sections_[s] = {w * w * norm, 2.0 * (w * w - 1.0) * norm,
                            (1.0 - damping * w + w * w) * norm, 0.0, 0.0};
        }
    }
    double operator()(double x) {
        for (Section& s : sections_) {
            const double y = s.b * x + s.z1;
            s.z1 = 2.0 * s.b * x - s.a1 * y + s.z2;
            s.z2 = s.b * x - s.a2 * y;
            x = y;
        }
        return x;
    }

  private:
    struct Section {
        double b, a1, a2, z1, z2;
    };
    Section sections_[2];
};

// Relative rms difference between two orders: filtering each planet's acceleration before the path,
// and filtering the resultant after it. Evaluated over the second of two carrier turns.
double difference_of_orders(double carrier_rpm, double cutoff_Hz, double sampling_Hz) {
    constexpr int kPlanets = 4;
    constexpr double kAlpha = 0.1;
    const double speed = carrier_rpm * 2.0 * kPi / 60.0;
    const double mesh_Hz = 81.0 * speed / (2.0 * kPi);
    const auto turn = static_cast<long>(sampling_Hz * 2.0 * kPi / speed);
    std::vector<Butterworth> before(2 * kPlanets, Butterworth(cutoff_Hz, sampling_Hz));
    Butterworth after(cutoff_Hz, sampling_Hz);
    double difference = 0.0;
    double total = 0.0;
    for (long i = 0; i < 2 * turn; ++i) {
        const double t = static_cast<double>(i) / sampling_Hz;
        const double theta = speed * t;
        double early = 0.0;
        double raw = 0.0;
        for (int n = 0; n < kPlanets; ++n) {
            // A decaying 570 Hz oscillation after each engagement, with a steady inward
            // acceleration.
            const double since = std::fmod(mesh_Hz * t + 0.25 * n, 1.0) / mesh_Hz;
            const double burst =
                50.0 * std::exp(-200.0 * since) * std::cos(2 * kPi * 570.0 * since);
            const double accel[2] = {burst - 0.08, 0.7 * burst};
            const double x = std::fmod(theta + 2.0 * kPi * n / kPlanets, 2.0 * kPi);
            const double g =
                std::exp(kAlpha * (x - kPi) * (x - kPi)) * path_window("hamming").weight(x);
            raw += g * (std::sin(theta) * accel[0] + std::cos(theta) * accel[1]);
            const double filtered_x = before[2 * n](accel[0]);
            const double filtered_y = before[2 * n + 1](accel[1]);
            early += g * (std::sin(theta) * filtered_x + std::cos(theta) * filtered_y);
        }
        const double late = after(raw);
        if (i >= turn) {
            difference += (early - late) * (early - late);
            total += late * late;
        }
    }
    return std::sqrt(difference / total);
}

TEST_CASE("The low-pass may be applied before the path: they commute to the ratio of their rates") {
    const double ratio = (8.87 / 60.0) / 800.0;  // Omega / omega_c
    const double difference = difference_of_orders(8.87, 800.0, 20000.0);
    WARN("filter before against after the path at 8.87 rpm, 800 Hz: relative rms difference "
         << difference << ", Omega/omega_c " << ratio);
    CHECK(difference < 5.0 * ratio);
    // The ratio determines the difference: four times the speed, four times the difference.
    CHECK(difference_of_orders(4 * 8.87, 800.0, 20000.0) / difference == Approx(4.0).epsilon(0.3));
}

}  // namespace gearpod::signals::test_path_and_filter
