// Transmission paths from planets, ring and bearings to a sensor, tabulated over the mesh phases
// and carrier positions.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "gears/planetary.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Fraction of a planet's vibration that reaches the sensor, as a function of the planet's angle x
// in [0, 2 pi). x is measured from the point opposite the sensor: the planet passes the sensor at x
// = pi.
struct PathWindow {
    std::string_view name;
    double (*weight)(double x_rad);
    std::string_view doc;
};

std::span<const PathWindow> path_windows();

// Window of the given name. Throws std::invalid_argument, which lists the known names, if there is
// none.
const PathWindow& path_window(std::string_view name);

// Transmission path from the planets to the sensor on the housing: Liang (2016), Eq. 4.3.1,
//
//     y = sum over n of g(x_n) (sin theta a_x,n + cos theta a_y,n),
//     g(x) = exp(alpha (x - pi)^2) w(x),    x_n = mod(theta + psi_n, 2 pi),
//
// with theta the carrier angle, psi_n planet n's position and a_x, a_y planet n's acceleration
// along the carrier frame's axes. The sensor measures the vertical component of the rotated vector.
//
// The sensor's low-pass filter acts on each planet's acceleration before the path, not on the
// resultant. Each mesh period is then filtered once for all carrier angles at which it recurs. The
// filter's time constant 1/omega_c is milliseconds, while the path varies with the carrier at
// Omega, within seconds. The two operations therefore commute up to a few Omega/omega_c. The
// difference is 7e-4 of the signal's rms for a carrier at 8.87 rpm and an 800 Hz filter, where
// Omega/omega_c is 2e-4 (measured by tests/signals/path/test_path_and_filter.cpp). Most of it is
// the filter's delay.

enum class CarrierSense { positive, negative };

// Place and kind of a sensor on the housing. Without them it is Liang's: it measures along the line
// from the centre to itself, and planet n passes it at x_n = pi.
struct SensorPosition {
    double angle_deg = 0.0;   // around the axis from that place, in the positive sense
    bool tangential = false;  // measures across the line to the centre
    double gain = 1.0;
    // Part of the acceleration at right angles to its axis, radial for a tangential sensor, that it
    // adds to that along its axis.
    double cross_axis = 0.0;
};

// One axis of the load that planets put on an elastic ring with a mode of n nodal diameters. With
// planet n's acceleration as the load at the angle d from the sensor, radial a_r and tangential
// a_t, an inextensional mode (W. Soedel, Vibrations of Shells and Plates) has the modal loads
//
//     radial sensor       sum of  a_r cos(n d) - a_t sin(n d) / n
//     tangential sensor   sum of (a_r sin(n d) + a_t cos(n d) / n) / n.
//
// Each sum is split into those of the accelerations along the carrier frame's x and y axes. A mode
// without nodal diameters has radial load only.
struct RingLoad {
    enum class Axis { x, y };
    int nodal_diameters = 0;
    Axis axis = Axis::x;
};

// Path from one source, a bearing of the housing, of which the whole acceleration reaches the
// sensor at every carrier angle. Sources are numbered as in TileSignals.
struct BearingSource {
    int source = 0;
};

// Part of the path that all gearboxes of a study share, tabulated at every sample of a carrier
// turn. At mesh c = 0..M_c - 1 and phase p/P, theta = 2 pi (c + p/P) / M_c, or its negative where
// the carrier turns in the negative sense. For a stationary carrier theta = 0 at all phases.
//
// A carrier in the negative sense is the mirror image of one in the positive sense with the planets
// at -psi_n: g(x) = g(2 pi - x), and sin theta changes its sign.
//
// A sensor at the angle beta has theta - beta instead of theta, rounded to 0.01 degree. One that
// measures along the tangent has cos and -sin instead of sin and cos. The cross-axis part adds to
// these two the other pair times its factor, and likewise for the load on an elastic ring.
//
// Only exp(alpha (x - pi)^2) differs between lanes. At a given phase the planet angles are
// equidistant in c: x - pi = h (m + f) with h = 2 pi / M_c, integer m and a fraction f. Hence
//
//     exp(alpha (x - pi)^2) = exp(alpha h^2 m^2) exp(2 alpha h^2 f)^m exp(alpha h^2 f^2):
//
// a table over m, powers of one number, and a factor (path_weights.hpp).
class PathGrid {
  public:
    // Throws std::invalid_argument unless planets and phases are positive.
    PathGrid(const PathWindow& window, const gears::PlanetPositions& planets, int phases,
             const SpanLayout& layout, CarrierSense sense = CarrierSense::positive,
             const SensorPosition& sensor = {});
    // Path to an elastic ring, whose weights take the place of the window.
    PathGrid(const RingLoad& load, const gears::PlanetPositions& planets, int phases,
             const SpanLayout& layout, CarrierSense sense, const SensorPosition& sensor);
    // Path of a bearing, as of a single planet with constant weight.
    PathGrid(const BearingSource& bearing, int phases, const SpanLayout& layout, CarrierSense sense,
             const SensorPosition& sensor);
    // Path of equally spaced planets.
    PathGrid(const PathWindow& window, int planets, int phases, const SpanLayout& layout);

    int planets() const { return planets_; }
    int first_source() const { return first_source_; }  // its first planet among the sources
    int phases() const { return phases_; }
    int positions() const { return positions_; }  // M_c

    // [p][c]: sine and cosine of the carrier angle.
    const double* sine() const { return sine_.data(); }
    const double* cosine() const { return cosine_.data(); }
    // [p][c][n]: w(x) of planet n.
    const double* window() const { return window_.data(); }
    // [p][n]: f, in [-1/2, 1/2) for odd M_c and [0, 1) for even M_c, and the carrier index at which
    // m = 0. m takes M_c consecutive values from -floor(M_c / 2).
    const double* fraction() const { return fraction_.data(); }
    const int* centre() const { return centre_.data(); }

  private:
    PathGrid(const gears::PlanetPositions& planets, int phases, const SpanLayout& layout);

    // A turn in whole steps, which planets, samples and the sensor's angle are multiples of.
    struct Turn {
        long parts = 0;         // per position of planets
        long planet_steps = 0;  // per mesh period and phase
        long steps = 0;
        long sensor = 0;  // step at the sensor
        double step_rad = 0.0;
    };
    Turn turn_of(const gears::PlanetPositions& planets, CarrierSense sense,
                 const SensorPosition& sensor) const;
    // Fills the tables. weight(n, step): of planet n at x_n = step. direction(angle): sine and
    // cosine at a carrier angle.
    template <class Weight, class Direction>
    void tabulate(const gears::PlanetPositions& planets, CarrierSense sense, const Turn& turn,
                  Weight weight, Direction direction);

    int planets_;
    int first_source_ = 0;
    int phases_;
    int positions_;
    std::vector<double> sine_;
    std::vector<double> cosine_;
    std::vector<double> window_;
    std::vector<double> fraction_;
    std::vector<int> centre_;
};

}  // namespace gearpod::signals
