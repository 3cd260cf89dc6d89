// Checks that the group /numerical of earlier versions, whose attribute `rung` is `setting` now, is
// read.
#include <hdf5.h>

#include "mc/results/layout.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_numerical_groups {

TEST_CASE("The solver setting is read under its present and its earlier name") {
    Results results;
    results.noise_levels = {0.0, 1.0};
    results.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    results.numerical = NumericalError{"rk4", "rk4, finer", 8, {0.1, 0.2}, {0.3, 0.4}};
    const Hdf5Handle file = create_memory_file();
    write_numerical_groups(file.get(), results);

    const auto setting_read = [&] {
        Results back;
        back.noise_levels = results.noise_levels;
        back.features = results.features;
        read_numerical_groups(file.get(), 2, back);
        REQUIRE(back.numerical);
        CHECK(back.numerical->largest == results.numerical->largest);
        return back.numerical->setting;
    };
    CHECK(setting_read() == "rk4");
    const Hdf5Handle group = open_group(file.get(), "numerical");
    REQUIRE(H5Arename(group.get(), "setting", "rung") >= 0);
    CHECK(setting_read() == "rk4");
}

}  // namespace gearpod::mc::test_numerical_groups
