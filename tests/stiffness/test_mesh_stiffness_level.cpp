// Level of the mesh stiffness by every model of the gear bodies, against ISO 6336-1, KISSsoft's
// reports and finite elements: docs/validation/mesh-stiffness-level.md.
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

#include "stiffness/iso_6336.hpp"
#include "tests/stiffness/mesh_level_pairs.hpp"

using namespace gearpod;
using namespace gearpod::stiffness;
using mesh_level::LevelPair;

TEST_CASE("mesh stiffness by every model of the bodies", "[.level]") {
    std::puts(
        "| pair | held at, of root | ISO, N/(mm um) | KISSsoft | FE | FE without twist | rigid | "
        "rigid, "
        "load | Sainsot | Sainsot, load | ring | ring, load | ring without twist |");
    for (const LevelPair& p : mesh_level::all_pairs()) {
        const double per_width = 1e-9 / p.material.face_width_m;
        const auto iso = iso_6336_stiffness(p.geometry, p.helix_rad, p.material);
        const auto mean = [&](FoundationModel foundation, Contact contact) {
            return per_width * mesh_level::model_mean(p, foundation, contact);
        };
        std::printf("| %s | %.2f, %.2f | %.2f | %.2f | %.2f | %.2f |", p.name.c_str(),
                    p.held_1_m / p.geometry.gear(1).root_radius(),
                    p.held_2_m / p.geometry.gear(2).root_radius(),
                    iso ? per_width * iso->mesh : 0.0, per_width * p.report_N_m / p.report_blank,
                    per_width * mesh_level::elements_mean(p),
                    per_width * mesh_level::untwisted_elements_mean(p));
        for (const FoundationModel foundation :
             {FoundationModel::none, FoundationModel::sainsot, FoundationModel::elastic_ring})
            for (const Contact contact : {Contact::linear, Contact::load_dependent})
                std::printf(" %.2f |", mean(foundation, contact));
        std::printf(" %.2f |\n", per_width * mesh_level::untwisted_ring_mean(p));
    }
}
