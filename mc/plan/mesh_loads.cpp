#include "mc/plan/mesh_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "machine/contracts.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/scene_stiffness.hpp"

namespace gearpod::mc {
namespace {

constexpr double kMegapascal = 1e6;

// No gear steel endures more: ISO 6336-5 allows 1,650 N/mm^2 on the flank and 2 x 525 N/mm^2 at the
// root, for the best case-carburised steel.
constexpr double kMostContact_Pa = 2000.0 * kMegapascal, kMostRoot_Pa = 1050.0 * kMegapascal;
// Loaded gears have several hundred N/mm^2.
constexpr double kLeastContact_Pa = 50.0 * kMegapascal;
// Deflections in modules: 2,000 and 50 N/mm^2 cause about 0.02 and 0.00001.
constexpr double kMostDeflection = 0.1, kLeastDeflection = 1e-5;
// Deflection, as a fraction of the tooth errors, below which one tooth pair of many carries the
// load.
constexpr double kLeastOfErrors = 0.1;

// Mean mesh stiffnesses of ISO 6336-1, method C, for pairs outside the limits of method B.
constexpr double kUsualStiffness_Pa = 20e9;

std::optional<gears::MeshGeometry> geometry_of(const Study& study, const MeshMembers& members) {
    try {
        return gears::MeshGeometry(gear_of(study, members.member_1),
                                   gear_of(study, members.member_2),
                                   working_shifts(study).centre_distance_m);
    } catch (const std::invalid_argument&) {
        return std::nullopt;  // a given stiffness requires no teeth that mesh
    }
}

std::optional<stiffness::Material> material_of_flanks(const Gearbox& gearbox) {
    if (!gearbox.face_width_m || !gearbox.young_modulus_Pa || !gearbox.poisson_ratio) {
        return std::nullopt;
    }
    return stiffness::Material{*gearbox.young_modulus_Pa, *gearbox.poisson_ratio,
                               *gearbox.face_width_m};
}

// Mean stiffness of a mesh, N/m; 0 if it cannot be estimated.
double mean_stiffness(const Study& study, const MeshMembers& members,
                      const std::optional<gears::MeshGeometry>& geometry,
                      const std::optional<stiffness::Material>& material) {
    if (stiffness_given(study)) {
        return given_mean_stiffness(study, members.kind);
    }
    if (!geometry || !material) {
        return 0.0;
    }
    const auto iso =
        stiffness::iso_6336_stiffness(*geometry, study.gearbox.helix_angle_rad, *material);
    return iso ? iso->mesh : kUsualStiffness_Pa * material->face_width_m;
}

double sum_of(const std::vector<double>& amplitudes) {
    return std::accumulate(amplitudes.begin(), amplitudes.end(), 0.0,
                           [](double sum, double one) { return sum + std::abs(one); });
}

double largest_root_Pa(const stiffness::ToothStress& stress) {
    return std::fmax(stress.root_1_Pa, stress.root_2_Pa);
}

double in_modules(const Study& study, const MeshLoad& load) {
    return load.deflection_m / *study.gearbox.transverse_module_m();
}

// Load relative to the largest that any gear steel withstands; above 1 it cannot be meant. Contact
// stress counts squared, since it grows with the root of the force.
double excess(const Study& study, const MeshLoad& load) {
    double most = in_modules(study, load) / kMostDeflection;
    if (load.stress) {
        const double contact = load.stress->contact_Pa / kMostContact_Pa;
        most = std::fmax(most, contact * contact);
        most = std::fmax(most, largest_root_Pa(*load.stress) / kMostRoot_Pa);
    }
    return most;
}

// Load relative to the least that loads the teeth; below 1 they are nearly unloaded.
double shortfall(const Study& study, const MeshLoad& load) {
    const double contact = load.stress ? load.stress->contact_Pa / kLeastContact_Pa : 0.0;
    double least = load.stress ? contact * contact : in_modules(study, load) / kLeastDeflection;
    if (load.error_m > 0.0 && load.deflection_m > 0.0) {
        least = std::fmin(least, load.deflection_m / (kLeastOfErrors * load.error_m));
    }
    return least;
}

std::string micrometres(double metres) {
    return fmt::format("{:.3g} um", 1e6 * metres);
}

// Stress in N/mm^2 with three figures, or all figures before the decimal point.
std::string stress_figures(double stress_Pa) {
    const double value = stress_Pa / kMegapascal;
    return value >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string stress_list(const MeshLoad& load) {
    std::string text;
    if (load.stress) {
        text =
            fmt::format("contact {} N/mm2, tooth root {} ({}) and {} N/mm2 ({})",
                        stress_figures(load.stress->contact_Pa),
                        stress_figures(load.stress->root_1_Pa), member_name(load.members.member_1),
                        stress_figures(load.stress->root_2_Pa), member_name(load.members.member_2));
    }
    if (load.deflection_m > 0.0) {
        text += fmt::format("{}mean deflection {}{}", text.empty() ? "" : ", ",
                            micrometres(load.deflection_m),
                            load.stiffness_of_iso ? " by the stiffness of ISO 6336-1" : "");
    }
    return text;
}

std::string torque_of(const Study& study) {
    const bool planetary = study.gearbox.kind == GearboxKind::planetary;
    return fmt::format("{:.6g} N m on the {}", nominal_inputs(study).torque_N_m,
                       planetary ? member_name(study.operation.torque_on) : "pinion");
}

}  // namespace

std::vector<MeshLoad> mesh_loads(const Study& study) {
    EXPECTS(has_gears(study));
    const double force_N = std::abs(make_drivetrain(study)->mesh_force_N(nominal_inputs(study)));
    const std::optional<stiffness::Material> material = material_of_flanks(study.gearbox);
    std::vector<MeshLoad> loads;
    for (const MeshMembers& members : meshes_of(study.gearbox.kind)) {
        MeshLoad load{members, force_N, std::nullopt};
        const std::optional<gears::MeshGeometry> geometry = geometry_of(study, members);
        if (geometry && material) {
            load.stress = stiffness::iso_6336_stress(*geometry, study.gearbox.helix_angle_rad,
                                                     *material, force_N);
        }
        if (const double k = mean_stiffness(study, members, geometry, material); k > 0.0) {
            load.deflection_m = force_N / k;
            load.stiffness_of_iso = !stiffness_given(study);
        }
        load.error_m = sum_of(study.gearbox.meshes[members.kind].error_m) +
                       pitch_error_m(study, members.member_1) +
                       pitch_error_m(study, members.member_2);
        loads.push_back(load);
    }
    return loads;
}

std::string load_text(const MeshLoad& load) {
    const std::string stresses = stress_list(load);
    return fmt::format("{:.4g} kN{}{}", 1e-3 * load.force_N, stresses.empty() ? "" : ": ",
                       stresses);
}

Problems load_warnings(const Study& study, const std::string& file) {
    const std::vector<MeshLoad> loads = mesh_loads(study);
    const auto most = std::ranges::max_element(
        loads, {}, [&](const MeshLoad& load) { return excess(study, load); });
    const auto least = std::ranges::min_element(
        loads, {}, [&](const MeshLoad& load) { return shortfall(study, load); });
    const char* const key = "operation.torque_N_m";
    Problems warnings;
    if (excess(study, *most) > 1.0) {
        warnings.push_back(
            {file, 0, key,
             fmt::format("{} is more than any gear steel withstands at the {} mesh ({}; the best "
                         "steels endure {:.4g} N/mm2 in contact and {:.4g} N/mm2 at the root)",
                         torque_of(study), mesh_name(most->members), stress_list(*most),
                         kMostContact_Pa / kMegapascal, kMostRoot_Pa / kMegapascal),
             "check the unit (N m, not N mm), the member that it acts on, module and face width"});
    } else if (shortfall(study, *least) < 1.0) {
        std::string details = stress_list(*least);
        if (least->error_m > 0.0) {
            details += (details.empty() ? "tooth errors " : ", tooth errors ") +
                       micrometres(least->error_m);
        }
        warnings.push_back(
            {file, 0, key,
             fmt::format("{} leaves the teeth of the {} mesh nearly unloaded{}, so that real "
                         "teeth lose contact; loaded gears have a contact stress of several "
                         "hundred N/mm2",
                         torque_of(study), mesh_name(least->members),
                         details.empty() ? "" : " (" + details + ")"),
             "check the unit (N m, not kN m), the member that it acts on, module and face width"});
    }
    return warnings;
}

}  // namespace gearpod::mc
