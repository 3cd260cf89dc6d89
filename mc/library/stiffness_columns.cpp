#include "mc/library/stiffness_columns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "mc/scene/stiffness_curves.hpp"
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
                      return faulty_total(scene, pair, mesh, phase + period - start);
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
    const std::vector<int> pairs = faulty_pairs(scene);
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
        table.add(scene.drivetrain().pair_name(pair) + "_te_um", "um",
                  [&](double phase) { return 1e6 * loaded_approach(scene, pair, phase); });
    }
    return std::move(table).columns();
}

}  // namespace gearpod::mc
