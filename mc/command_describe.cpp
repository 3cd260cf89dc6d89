#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/dispatch.hpp"
#include "mc/command_support.hpp"
#include "mc/ensemble.hpp"
#include "mc/instance_features.hpp"

namespace gearpod::mc {
namespace {

void heading(const char* text) {
    fmt::print("\n{}\n", text);
}

void entry(const char* name, const std::string& value) {
    fmt::print("  {:<26}{}\n", name, value);
}

void print_gearbox(const Scene& scene) {
    const auto& train = scene.train();
    heading("gearbox");
    entry("teeth (sun/planet/ring)",
          fmt::format("{}/{}/{}, {} planets", train.sun_teeth, train.planet_teeth, train.ring_teeth,
                      train.planets));
    std::string sun, ring;
    for (int n = 0; n < train.planets; ++n) {
        sun += fmt::format(" {:.4g}", gears::sun_mesh_phase(train, n, scene.planet_sense()));
        ring += fmt::format(" {:.4g}", gears::ring_mesh_phase(train, n, scene.planet_sense()));
    }
    entry("mesh phases, sun", sun.substr(1));
    entry("mesh phases, ring",
          ring.substr(1) + fmt::format("; ring to sun {:g}", gears::ring_to_sun_phase(train)));
    const auto mesh = [&](const char* name, const stiffness::PairStiffness& pair) {
        entry(name, fmt::format("contact ratio {:.4f}, mean {:.4g} N/m", pair.contact_ratio(),
                                pair.mean()));
    };
    mesh("sun-planet mesh", scene.sun_planet());
    mesh("ring-planet mesh", scene.ring_planet());
    entry("mesh frequency", fmt::format("{:.4f} Hz", scene.nominal_mesh_frequency_Hz()));
}

void print_effects(const Scene& scene) {
    const Study& study = scene.study();
    const Effects& e = study.effects;
    const bool torsional = e.motion == Motion::torsional;
    heading("simulated");
    entry("motion", torsional ? "rotations only (rigid bearings)" : "x, y and rotation");
    const char* damping[] = {"ratio of critical", "proportional to stiffness", "constant"};
    entry("mesh damping", damping[static_cast<int>(e.mesh_damping)]);
    const char* path[] = {"hamming", "hann", "rectangular"};
    entry("transmission path",
          fmt::format("{} window, exponent {:g}", path[static_cast<int>(e.path)],
                      study.sensor.path_exponent));
    entry("sensor low-pass",
          fmt::format("{:g} Hz, 4th-order Butterworth", study.sensor.low_pass_Hz));
    if (e.inertial_terms && !torsional) {
        entry("inertial terms", "Coriolis and centrifugal, rigid rotation removed every mesh");
    }
    if (study.fault.kind == FaultKind::crack) {
        const char* member[] = {"sun", "planet", "ring", "carrier"};
        std::string where = member[static_cast<int>(*study.fault.member)];
        if (study.fault.side) {
            where += fmt::format(" {}, {} side", study.fault.planet,
                                 member[static_cast<int>(*study.fault.side)]);
        }
        entry("fault", "tooth crack on the " + where);
    }
    const bool sensor_noise =
        study.sensor.noise_m_s2 > 0.0 || study.find_random("sensor.noise_m_s2") != nullptr;
    const bool encoder_noise = study.sensor.encoder_noise_rad > 0.0 ||
                               study.find_random("sensor.encoder_noise_arcsec") != nullptr;
    if (sensor_noise) {
        entry("sensor noise",
              fmt::format("{:g} m/s^2 rms times the noise level", study.sensor.noise_m_s2));
    }
    if (encoder_noise) {
        entry("encoder noise",
              fmt::format("{:.4g} rad rms times the noise level", study.sensor.encoder_noise_rad));
    }
    heading("left out");
    if (torsional) {
        entry("x and y motion", "effects.motion = \"torsional\"");
        entry("inertial terms", "rotations feel none");
    } else if (!e.inertial_terms) {
        entry("inertial terms", "effects.inertial_terms = false");
    }
    if (study.fault.kind == FaultKind::none) {
        entry("fault", "fault.kind = \"none\"");
    }
    if (!sensor_noise) {
        entry("sensor noise", "sensor.noise_m_s2 is 0");
    }
    if (!encoder_noise) {
        entry("encoder noise", "sensor.encoder_noise_arcsec is 0");
    }
    if (!std::isfinite(scene.decay_meshes())) {
        fmt::print("  nothing damps the vibration: no gearbox will settle on an orbit\n");
    }
    entry("tooth separation", "the meshes are linear springs under steady load");
}

// Mesh periods a tile marches: the approach to the orbit and the passages of the fault.
double marched_meshes(const Scene& scene) {
    const Study& study = scene.study();
    if (study.numerics.horizon == Horizon::march) {
        return scene.span_meshes();
    }
    const double settle =
        std::min(1.0 + scene.decay_meshes() * -std::log(study.numerics.settle_tolerance),
                 static_cast<double>(scene.max_meshes()));
    if (scene.faulty_pair() < 0) {
        return settle;
    }
    const double passage =
        std::ceil(scene.pairs().curve(scene.faulty_pair()).contact_ratio()) + settle;
    return settle + std::min(passage * static_cast<double>(scene.pattern().passages.size()),
                             static_cast<double>(scene.pattern().length));
}

void print_cost(const Scene& scene) {
    const Study& study = scene.study();
    const auto& plan = scene.plan();
    heading("cost");
    entry("degrees of freedom", std::to_string(plan.layout.degrees_of_freedom()));
    entry("samples a mesh period",
          fmt::format("{} (sensor), {} (encoders)", scene.samples_per_mesh(),
                      scene.te_samples_per_mesh()));
    entry("sampling rate",
          fmt::format("{:.1f} Hz", scene.samples_per_mesh() * scene.nominal_mesh_frequency_Hz()));
    entry("steps a mesh period",
          fmt::format("{} (at least {})", plan.grid.steps.size(), scene.least_steps()));
    entry("mesh periods marched", fmt::format("about {:.0f} of the {} looked at",
                                              marched_meshes(scene), scene.span_meshes()));
    const long rows = study.ensemble.instances + study.ensemble.threshold_instances;
    entry("gearboxes", fmt::format("{} graded and {} for the thresholds, {} noise levels",
                                   study.ensemble.instances, study.ensemble.threshold_instances,
                                   study.sensor.noise_levels.size()));
    // Per step and gearbox in a full tile, measured with an AVX-512 core near 3 GHz for N = 4;
    // proportional to the degrees of freedom. One lane costs as much as eight.
    const double step_s = 0.65e-6 * plan.layout.degrees_of_freedom() / 21.0 / study.numerics.lanes;
    const double seconds = static_cast<double>(rows) * marched_meshes(scene) *
                           static_cast<double>(plan.grid.steps.size()) * step_s * 1.3 /
                           thread_count(study);
    entry("estimated time",
          fmt::format("{:.0f} s on {} threads of an AVX-512 machine (now: {})", std::ceil(seconds),
                      thread_count(study), machine::name(machine::active_instruction_set())));
    const double mesh_bytes =
        8.0 * scene.samples_per_mesh() * study.numerics.lanes * (2.0 * scene.train().planets + 1.0);
    // The rows go to the disk; what detection needs of them at a time is a feature's values.
    const double rows_bytes =
        8.0 * static_cast<double>(rows) * static_cast<double>(study.sensor.noise_levels.size() + 4);
    entry(
        "estimated memory",
        fmt::format(
            "{:.0f} MB",
            (mesh_bytes * marched_meshes(scene) * thread_count(study) + rows_bytes) / 1e6 + 10.0));
}

}  // namespace

int describe_command(const StudyOptions& options) {
    const auto study = load_study(options);
    if (!study) {
        return kBadInput;
    }
    fmt::print("# the resolved study\n{}", resolved_text(*study));
    if (!study->gearbox.has_teeth() || !study->gearbox.module_m) {
        fmt::print("\nno tooth numbers: only modes are defined\n");
        return kDone;
    }
    const auto scene = load_scene(options);
    if (!scene) {
        return kBadInput;
    }
    print_gearbox(*scene);
    print_effects(*scene);
    print_cost(*scene);
    return kDone;
}

}  // namespace gearpod::mc
