// Checks that a drawn value acts like the same value in a study file, for every random input.
#include <cstring>
#include <variant>

#include "mc/plan/sampling.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_instance_inputs {

bool equal_inputs(const InstanceInputs& a, const InstanceInputs& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST_CASE("A drawn value of any input gives the gearbox of a study with this nominal value") {
    for (const std::string& text : {tests::kExampleStudy, tests::kFixedShaftStudy}) {
        Study study = test::study_of_text(text);
        study.random.clear();
        REQUIRE_FALSE(has_random_planets(study));
        const Sampler sampler(DrawPlan{study});
        int effective = 0;
        for (const Key& key : schema()) {
            if (!key.may_be_random()) {
                continue;
            }
            INFO(key.path());
            const auto& access = std::get<NumberAccess>(key.access);
            const double value = 1.25 * access.get(study).value_or(2.0) + 0.125;
            Study other = study;
            access.set(other, value);
            const std::vector<GivenInput> given{{input_id(key.path()), value}};
            const InstanceInputs inputs = sampler.draw({Group::test, 0}, given).inputs;
            CHECK(equal_inputs(inputs, nominal_inputs(other)));
            effective += equal_inputs(inputs, nominal_inputs(study)) ? 0 : 1;
        }
        CHECK(effective > 20);
    }
}

}  // namespace gearpod::mc::test_instance_inputs
