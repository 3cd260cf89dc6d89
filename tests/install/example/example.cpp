// The stiffness of a cracked gear pair, the signals of one gearbox of a study and the probability
// of detection from a table, with the installed library: example STUDY.toml
#include <cstdio>
#include <exception>
#include <gearpod/analysis/inspection.hpp>
#include <gearpod/mc/library/open_study.hpp>
#include <gearpod/stiffness/additive_mesh.hpp>
#include <gearpod/stiffness/faults/tooth_crack.hpp>
#include <numbers>

int main(int, char** argv) {
    using namespace gearpod;
    try {
        // A pinion of 19 teeth with a crack of 3 mm, and a gear of 48.
        const double degree = std::numbers::pi / 180;
        const gears::MeshGeometry pair({19, false, 3.175e-3, 20 * degree},
                                       {48, false, 3.175e-3, 20 * degree});
        const stiffness::Material steel{2.068e11, 0.3, 0.016};  // E in Pa, Poisson, face width in m
        const stiffness::AdditiveMesh mesh(pair, steel, stiffness::Profile::root_circle);
        const stiffness::ToothCrack cracks(pair, steel, stiffness::Profile::root_circle, 1,
                                           45 * degree);
        const auto cracked = stiffness::faulty_mesh(mesh, cracks.at(3e-3));
        std::printf("stiffness %.4e N/m, cracked %.4e N/m\n", total_at(mesh, 0.8),
                    total_at(*cracked, mesh.transitions(), 0.8));

        mc::OpenStudy study(argv[1]);
        const mc::Simulation gearbox =
            mc::simulate_row(study.plans().tile, study.plans().ensemble, 0);
        for (const mc::SignalColumn& signal : gearbox.columns) {
            std::printf("%s [%s]: %zu samples\n", signal.name.c_str(), signal.unit.c_str(),
                        signal.values.size());
        }

        const analysis::Inspections table{.size = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
                                          .value = {0, 0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 1},  // hits
                                          .specimen = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
        const analysis::InspectionResult pod = analysis::inspect(table, {});
        std::printf("a90 %.3f\n", pod.hit_miss.a90.estimate.size);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
