#include "mc/library/stiffness_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <variant>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::mc {
namespace {

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

void add_faulty(const GearboxPlan& gearbox, PairId pair, const stiffness::FaultyMesh& mesh,
                double size, PhaseTable& table) {
    const double start = gearbox.pairs().start[pair];
    const int periods = static_cast<int>(std::ceil(start + mesh.duration()));
    for (int period = 0; period < periods; ++period) {
        table.add(fmt::format("{}_{}_period{}", gearbox.drivetrain->pair_name(pair),
                              gearbox.fault().plan().name_at(size), period + 1),
                  "N/m", [&](double phase) {
                      return faulty_total(gearbox.pairs(), pair, mesh, phase + period - start);
                  });
    }
}

}  // namespace

std::vector<SignalColumn> stiffness_columns(const GearboxPlan& gearbox, int points) {
    PhaseTable table(points);
    for (PairId pair{0}; pair < gearbox.pairs().pairs(); ++pair) {
        table.add(gearbox.drivetrain->pair_name(pair), "N/m",
                  [&](double phase) { return gearbox.pairs().total(pair, phase); });
    }
    const std::vector<PairId> pairs = faulty_pairs(gearbox.fault());
    for (int curve = 0; curve < gearbox.fault().curves(); ++curve) {
        for (const double size : gearbox.fault().plan().sizes) {
            add_faulty(gearbox, pairs[static_cast<std::size_t>(curve)],
                       *gearbox.fault().mesh(curve, size), size, table);
        }
    }
    return std::move(table).columns();
}

std::vector<SignalColumn> transmission_error_columns(const GearboxPlan& gearbox, int points) {
    PhaseTable table(points);
    for (PairId pair{0}; pair < gearbox.pairs().pairs(); ++pair) {
        table.add(gearbox.drivetrain->pair_name(pair) + "_te_um", "um", [&](double phase) {
            return 1e6 * loaded_approach(*gearbox.stiffness, pair, phase);
        });
    }
    return std::move(table).columns();
}

std::vector<double> natural_frequencies_Hz(const ModalPlan& plan) {
    dynamics::GearboxLayout at_rest = plan.bodies.layout;
    if (auto* planetary = std::get_if<dynamics::PlanetaryLayout>(&at_rest)) {
        planetary->inertial_terms = false;
    }
    return dynamics::natural_frequencies_Hz(
        dynamics::assemble(at_rest, plan.bodies.inputs(plan.nominal), plan.mean_pairs));
}

std::vector<SpeedFrequencies> frequencies_over_speed(const ModalPlan& plan, double highest,
                                                     int points) {
    std::vector<SpeedFrequencies> speeds;
    if (plan.drivetrain == nullptr) {
        return speeds;
    }
    for (int i = 0; i < points; ++i) {
        InstanceInputs inputs = plan.nominal;
        inputs.speed_rad_s *= highest * i / (points - 1);
        SpeedFrequencies& speed = speeds.emplace_back();
        speed.speed_rad_s = inputs.speed_rad_s;
        speed.mesh_Hz = std::abs(plan.drivetrain->mesh_frequency_rad_s(inputs.speed_rad_s)) /
                        (2.0 * std::numbers::pi);
        dynamics::GearboxInputs gearbox = plan.bodies.inputs(inputs);
        plan.drivetrain->set(inputs, gearbox);
        speed.frequencies_Hz = dynamics::rotating_frequencies_Hz(
            dynamics::assemble(plan.bodies.layout, gearbox, plan.mean_pairs));
    }
    return speeds;
}

std::vector<CriticalSpeed> critical_speeds(const std::vector<SpeedFrequencies>& speeds,
                                           int harmonics) {
    constexpr double kSame = 1e-6;
    std::vector<CriticalSpeed> all;
    for (int harmonic = 1; harmonic <= harmonics; ++harmonic) {
        const auto above = [&](const SpeedFrequencies& speed, std::size_t mode) {
            return harmonic * speed.mesh_Hz - speed.frequencies_Hz[mode];
        };
        for (std::size_t i = 1; i < speeds.size(); ++i) {
            const SpeedFrequencies &a = speeds[i - 1], &b = speeds[i];
            for (std::size_t mode = 0; mode < a.frequencies_Hz.size(); ++mode) {
                const double before = above(a, mode), after = above(b, mode);
                if (!(before < 0.0) || after < 0.0) {
                    continue;
                }
                const double share = before / (before - after);
                const CriticalSpeed critical{
                    std::lerp(a.speed_rad_s, b.speed_rad_s, share),
                    std::lerp(a.frequencies_Hz[mode], b.frequencies_Hz[mode], share), harmonic, 1};
                if (!all.empty() && all.back().harmonic == harmonic &&
                    std::abs(all.back().frequency_Hz - critical.frequency_Hz) <=
                        kSame * critical.frequency_Hz) {
                    ++all.back().modes;
                } else {
                    all.push_back(critical);
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
