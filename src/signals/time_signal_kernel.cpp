#include "signals/path_weights.hpp"
#include "signals/planet_count.hpp"
#include "signals/resultant.hpp"
#include "signals/time_signal.hpp"

namespace gearpod::signals {
namespace {

template <int N>
GEARPOD_INLINE void weights_of_turn(const PathGrid& path, double exponent, double* whole_steps,
                                    double* weight) {
    whole_step_table<1>(path.positions(), &exponent, whole_steps);
    for (long p = 0; p < path.phases(); ++p) {
        path_weights<N, 1>(path, p, &exponent, whole_steps, weight + p * path.positions() * N);
    }
}

template <int N>
GEARPOD_INLINE void signal_of_mesh(const PathGrid& path, const double* weight, int c,
                                   const double* accel, double* signal) {
    for (long p = 0; p < path.phases(); ++p) {
        const long place = p * path.positions() + c;
        signal[p] = resultant<N, 1>(accel + p * 2 * N, weight + place * N, path.sine()[place],
                                    path.cosine()[place], 0);
    }
}

GEARPOD_INLINE void weights_for(const PathGrid& path, double exponent, double* whole_steps,
                                double* weight) {
    with_planets(
        path.planets(), [&]<int N>() __attribute__((always_inline)) {
            weights_of_turn<N>(path, exponent, whole_steps, weight);
        });
}

GEARPOD_INLINE void signal_for(const PathGrid& path, const double* weight, int c,
                               const double* accel, double* signal) {
    with_planets(
        path.planets(), [&]<int N>() __attribute__((always_inline)) {
            signal_of_mesh<N>(path, weight, c, accel, signal);
        });
}

}  // namespace

GEARPOD_KERNEL(all_path_weights,
               (const PathGrid& path, double exponent, double* whole_steps, double* weight),
               (path, exponent, whole_steps, weight),
               weights_for(path, exponent, whole_steps, weight))
GEARPOD_KERNEL(mesh_signal,
               (const PathGrid& path, const double* weight, int c, const double* accel,
                double* signal),
               (path, weight, c, accel, signal), signal_for(path, weight, c, accel, signal))

}  // namespace gearpod::signals
