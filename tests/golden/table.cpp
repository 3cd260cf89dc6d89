// Table of golden curves. To add one, add a line here and run `make_golden NAME`.
#include "tests/golden/golden.hpp"

namespace gearpod::golden {
namespace {

// Tolerance of curves of faulty teeth, which are fitted to 1e-8 of the healthy tooth pair.
constexpr double kFitted = 5e-8;
// Tolerance of signals and features, which include the errors of time integration and of the
// periodic orbit.
constexpr double kIntegrated = 1e-6;

}  // namespace

const std::vector<Golden>& goldens() {
    // clang-format off
    static const std::vector<Golden> table{
        {"liang-fig-3-16", "stiffness studies/published/liang-fig-3-16.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"liang-fig-3-12", "stiffness studies/published/liang-fig-3-12.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"liang-fig-3-14", "stiffness studies/published/liang-fig-3-14.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"liang-fig-5-8", "run studies/published/liang-fig-5-8.toml --quiet", Source::results, {"instances/fault_depth_m", "features/window_ratio", "features/sensor_rms"}, 1, kIntegrated},
        {"liang-fig-3-16-features", "run studies/published/liang-fig-3-16.toml --quiet", Source::results, {"instances/fault_depth_m", "features/window_ratio", "features/sensor_rms", "features/te_rms", "features/te_kurtosis"}, 1, kIntegrated},
        {"liang-fig-4-6", "simulate studies/published/liang-fig-4-6.toml --instance 3 --meshes 19", Source::results, {"signals/mesh_phase", "signals/sun_x", "signals/sun_y"}, 20, kIntegrated},
        {"liang-sensor-4.28mm", "simulate studies/published/liang-fig-5-8.toml --instance 7 --meshes 62", Source::results, {"signals/mesh_phase", "signals/sensor"}, 25, kIntegrated},
        {"planet-crack-ideal-te-turn", "simulate studies/planet-crack-ideal.toml --instance 2006", Source::results, {"signals/mesh_phase", "signals/te"}, 20, kIntegrated},
        {"yang-fig-15", "stiffness studies/published/yang-fig-15.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"yang-healthy", "simulate studies/published/yang-fig-15.toml --instance 1 --meshes 1", Source::results, {"signals/mesh_phase", "signals/sun_u", "signals/planet4_u"}, 1, kIntegrated},
        {"yang-case-5", "simulate studies/published/yang-fig-15.toml --instance 6 --meshes 28", Source::results, {"signals/mesh_phase", "signals/sun_u", "signals/planet4_u"}, 8, kIntegrated},
        {"yang-features", "run studies/published/yang-fig-15.toml --quiet", Source::results, {"instances/fault_stage", "features/sensor_rms", "features/window_ratio", "features/te_rms", "features/te_kurtosis"}, 1, kIntegrated},
        {"yang-separation", "simulate studies/published/yang-separation.toml --instance 4 --meshes 1", Source::results, {"signals/mesh_phase", "signals/sun_u", "signals/planet1_u"}, 2, kIntegrated},
        {"lin-parker-n3", "modes studies/published/lin-parker-n3.toml --json -", Source::json, {"frequencies_Hz"}, 1, kIntegrated},
        {"lin-parker-n4", "modes studies/published/lin-parker-n4.toml --json -", Source::json, {"frequencies_Hz"}, 1, kIntegrated},
        {"lin-parker-n5", "modes studies/published/lin-parker-n5.toml --json -", Source::json, {"frequencies_Hz"}, 1, kIntegrated},
        {"tian-stiffness", "stiffness studies/published/tian-fig-4-3.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"tian-stiffness-chip", "stiffness studies/published/tian-fig-4-6.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"tian-stiffness-crack", "stiffness studies/published/tian-fig-4-9.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"tian-stiffness-broken", "stiffness studies/published/tian-fig-4-12.toml --csv - --points 100", Source::csv, {}, 1, kFitted},
        {"tian-fig-4-3", "simulate studies/published/tian-fig-4-3.toml --instance 1 --meshes 2", Source::results, {"signals/mesh_phase", "signals/sensor", "signals/pinion_y"}, 1, kIntegrated},
        {"park-fig-9", "simulate studies/published/park-fig-9.toml --instance 1", Source::results, {"signals/mesh_phase", "signals/te"}, 9, kIntegrated},
        {"park-fig-10", "simulate studies/published/park-fig-10.toml --instance 1", Source::results, {"signals/mesh_phase", "signals/te"}, 9, kIntegrated},
        {"park-fig-11-70", "simulate studies/published/park-fig-11.toml --instance 4", Source::results, {"signals/mesh_phase", "signals/te"}, 9, kIntegrated},
        {"park-fig-12", "run studies/published/park-fig-12.toml --quiet", Source::results, {"instances/torque_N_m", "instances/fault_reduction", "features/te_rms", "features/te_kurtosis", "features/te_fc", "features/te_fm0"}, 1, kIntegrated},
        {"park-fig-13", "run studies/published/park-fig-13.toml --quiet", Source::results, {"instances/fault_reduction", "features/te_rms", "features/te_kurtosis", "features/te_fc", "features/te_fm0"}, 1, kIntegrated},
        {"park-dynamic", "run studies/published/park-dynamic.toml --quiet", Source::results, {"instances/fault_reduction", "features/te_rms", "features/te_kurtosis", "features/te_fc", "features/te_fm0"}, 1, kIntegrated},
    };
    // clang-format on
    return table;
}

}  // namespace gearpod::golden
