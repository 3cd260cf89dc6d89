// Checks that a study gives the parameter of its law of mesh damping, and of no other.
#include "mc/study/schema/schema.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_mesh_damping_keys {

template <class Law>
void check_law(MeshDamping kind) {
    Study study = test::study_of_text(tests::kExampleStudy);
    const Key* const key = find_key("gearbox", Law::kParameter.key);
    REQUIRE(key != nullptr);
    INFO(key->path());
    CHECK((key->unit.suffix.empty() || key->name.ends_with(key->unit.suffix)));
    CHECK(key->unit.to_si == 1.0);
    CHECK(key->may_be_random());
    for (const ChoiceName& other :
         std::get<ChoiceAccess>(find_key("effects", "mesh_damping")->access).names) {
        study.effects.mesh_damping = static_cast<MeshDamping>(other.value);
        const bool own = study.effects.mesh_damping == kind;
        CHECK(key->presence(study).need == (own ? Need::required : Need::forbidden));
    }
    std::get<NumberAccess>(key->access).set(study, 0.5);
    CHECK(study.gearbox.mesh_damping[kind] == 0.5);
    study.effects.motion = Motion::quasi_static;
    CHECK(key->presence(study).need == Need::optional);
}

TEST_CASE("The parameter of a law of mesh damping belongs to that law only") {
#define GEARPOD_MESH_DAMPING(NAME, LAW) check_law<dynamics::LAW>(MeshDamping::NAME);
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
}

}  // namespace gearpod::mc::test_mesh_damping_keys
