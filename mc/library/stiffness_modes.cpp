#include "mc/library/stiffness_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <variant>

#include "dynamics/gearbox_matrices.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/scene.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

// "3mm", or "0.1" for a pure number.
std::string size_name(const Study& study, double size) {
    const Unit& unit = fault_size_key(study).unit;
    return fmt::format("{:g}{}", size / unit.to_si, unit.suffix);
}

// Adds columns to a table over one mesh period.
class PhaseTable {
  public:
    explicit PhaseTable(int points) : points_(points) {
        add("phase", "mesh periods", [](double phase) { return phase; });
    }
    void add(std::string name, std::string unit, const std::function<double(double)>& value) {
        columns_.push_back({std::move(name), std::move(unit), {}});
        for (int i = 0; i < points_; ++i) {
            columns_.back().values.push_back(value(static_cast<double>(i) / points_));
        }
    }
    std::vector<SignalColumn> columns() && { return std::move(columns_); }

  private:
    int points_;
    std::vector<SignalColumn> columns_;
};

void add_faulty(const Scene& scene, int pair, const stiffness::FaultyMesh& mesh, double size,
                PhaseTable& table) {
    const double start = scene.pairs().start[static_cast<std::size_t>(pair)];
    const int periods = static_cast<int>(std::ceil(start + mesh.duration()));
    for (int period = 0; period < periods; ++period) {
        table.add(fmt::format("{}_{}_{}_period{}", scene.drivetrain().pair_name(pair),
                              choice_text(scene.study(), "fault", "kind"),
                              size_name(scene.study(), size), period + 1),
                  "N/m", [&](double phase) {
                      return faulty_total(scene.pairs(), pair, mesh, phase + period - start);
                  });
    }
}

}  // namespace

std::vector<SignalColumn> stiffness_columns(const Scene& scene, int points) {
    PhaseTable table(points);
    for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
        table.add(scene.drivetrain().pair_name(pair), "N/m",
                  [&](double phase) { return scene.pairs().total(pair, phase); });
    }
    const std::vector<int> pairs = faulty_pairs(scene.fault());
    for (int curve = 0; curve < scene.fault().curves(); ++curve) {
        for (const double size : fault_sizes(scene.study())) {
            add_faulty(scene, pairs[static_cast<std::size_t>(curve)],
                       *scene.fault().mesh(curve, size), size, table);
        }
    }
    return std::move(table).columns();
}

std::vector<SignalColumn> transmission_error_columns(const Scene& scene, int points) {
    PhaseTable table(points);
    for (int pair = 0; pair < scene.pairs().pairs(); ++pair) {
        table.add(scene.drivetrain().pair_name(pair) + "_te_um", "um", [&](double phase) {
            return 1e6 * loaded_approach(*scene.gearbox().stiffness, pair, phase);
        });
    }
    return std::move(table).columns();
}

namespace {

std::vector<double> mean_pairs(const Study& study) {
    return study.gearbox.tooth_profile == ToothProfile::constant
               ? constant_pairs(study)
               : Scene(resolve_numerics(study).study).mean_pairs();
}

// Gearbox layout at rest, without inertial terms.
dynamics::GearboxLayout layout_at_rest(const Study& study) {
    dynamics::GearboxLayout layout = BodyModel(study).layout;
    if (auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&layout)) {
        planetary->inertial_terms = false;
    }
    return layout;
}

// True if the study gives every mass and inertia that the modes need.
bool has_masses(const Study& study) {
    const Gearbox& g = study.gearbox;
    const FixedShaft& f = study.fixed_shaft;
    const auto has = [&](Member member) { return g.bodies[member].mass_kg.has_value(); };
    return g.kind == GearboxKind::planetary ? has(Member::sun) && has(Member::planet) &&
                                                  has(Member::ring) && has(Member::carrier)
                                            : has(Member::pinion) && has(Member::gear) &&
                                                  f.motor_inertia_kg_m2 && f.load_inertia_kg_m2;
}

void check_masses(const Study& study) {
    if (!has_masses(study)) {
        throw SceneError("gearbox", "masses or inertias are missing, but modes need them",
                         "add them to [gearbox]");
    }
}

}  // namespace

std::vector<double> natural_frequencies_Hz(const Study& study) {
    check_masses(study);
    const auto inputs = BodyModel(study).inputs(nominal_inputs(study));
    return dynamics::natural_frequencies_Hz(
        dynamics::assemble(layout_at_rest(study), inputs, mean_pairs(study)));
}

std::vector<SpeedFrequencies> frequencies_over_speed(const Study& study, double highest,
                                                     int points) {
    check_masses(study);
    std::vector<SpeedFrequencies> speeds;
    if (!has_gears(study)) {
        return speeds;
    }
    const auto drivetrain = make_drivetrain(study);
    const BodyModel bodies(study);
    const std::vector<double> pairs = mean_pairs(study);
    const InstanceInputs nominal = nominal_inputs(study);
    for (int i = 0; i < points; ++i) {
        InstanceInputs inputs = nominal;
        inputs.speed_rad_s *= highest * i / (points - 1);
        SpeedFrequencies& at = speeds.emplace_back();
        at.speed_rad_s = inputs.speed_rad_s;
        at.mesh_Hz = std::abs(drivetrain->mesh_frequency_rad_s(inputs.speed_rad_s)) /
                     (2.0 * std::numbers::pi);
        dynamics::GearboxInputs gearbox = bodies.inputs(inputs);
        drivetrain->set(inputs, gearbox);
        at.frequencies_Hz =
            dynamics::rotating_frequencies_Hz(dynamics::assemble(bodies.layout, gearbox, pairs));
    }
    return speeds;
}

std::vector<CriticalSpeed> critical_speeds(const std::vector<SpeedFrequencies>& speeds,
                                           int harmonics) {
    constexpr double kSame = 1e-6;
    std::vector<CriticalSpeed> all;
    for (int harmonic = 1; harmonic <= harmonics; ++harmonic) {
        const auto above = [&](const SpeedFrequencies& at, std::size_t mode) {
            return harmonic * at.mesh_Hz - at.frequencies_Hz[mode];
        };
        for (std::size_t i = 1; i < speeds.size(); ++i) {
            const SpeedFrequencies &a = speeds[i - 1], &b = speeds[i];
            for (std::size_t mode = 0; mode < a.frequencies_Hz.size(); ++mode) {
                const double before = above(a, mode), after = above(b, mode);
                if (!(before < 0.0) || after < 0.0) {
                    continue;
                }
                const double share = before / (before - after);
                const CriticalSpeed one{
                    std::lerp(a.speed_rad_s, b.speed_rad_s, share),
                    std::lerp(a.frequencies_Hz[mode], b.frequencies_Hz[mode], share), harmonic, 1};
                if (!all.empty() && all.back().harmonic == harmonic &&
                    std::abs(all.back().frequency_Hz - one.frequency_Hz) <=
                        kSame * one.frequency_Hz) {
                    ++all.back().modes;
                } else {
                    all.push_back(one);
                }
            }
        }
    }
    std::ranges::sort(all, [](const CriticalSpeed& a, const CriticalSpeed& b) {
        return std::abs(a.speed_rad_s) < std::abs(b.speed_rad_s);
    });
    return all;
}

}  // namespace gearpod::mc
