// Checks contact loss ratios and the error of the time steps in the results file.
#include <hdf5.h>

#include "mc/files/hdf5_data.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::mc::test_contact_results {

using namespace test;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Results example(int rows) {
    Results r;
    r.parameters = {{"fault_depth_m", "m", {}}};
    r.noise_levels = {0.0, 1.0};
    r.features = {{"te_rms", "rad", analysis::Alarm::high, {}}};
    r.contact_loss = {{"sun-planet", {}}, {"ring-planet", {}}};
    r.request.size = {"fault_depth_m", "m"};
    for (int row = 0; row < rows; ++row) {
        r.group.push_back(row < rows / 2 ? 0 : 1);
        r.status.push_back(row % 5 == 4 ? 1 : 0);
        r.parameters[0].values.push_back(row * 1e-6);
        r.features[0].values.insert(r.features[0].values.end(), {1.0 * row, -1.0 * row});
        r.contact_loss[0].values.push_back(row % 5 == 4 ? kNaN : row / (2.0 * rows));
        r.contact_loss[1].values.push_back(row % 5 == 4 ? kNaN : row / (1.0 * rows));
    }
    r.step_error = StepError{3.5e-3, 2e-4, 240, 960, 8, 16};
    return r;
}

bool has_group(const std::string& path, const char* name) {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening");
    return H5Lexists(file.get(), name, H5P_DEFAULT) > 0;
}

// More rows than writer and reader process at once.
TEST_CASE("Contact loss ratios read back as they were written, at once and in parts") {
    const Folder folder;
    const std::string path = folder.file("r.h5");
    const Results r = example(9001);
    write_results(path, r);
    CHECK(bits(read_results(path)) == bits(r));
    Results frame = read_frame(path);
    REQUIRE(frame.contact_loss.size() == 2);
    CHECK(frame.contact_loss[0].name == "sun-planet");
    CHECK(frame.contact_loss[1].name == "ring-planet");
    CHECK(frame.contact_loss[0].values.empty());
    const FileRows rows(path, frame);
    fill_columns(frame, rows);
    CHECK(bits(frame) == bits(r));
    REQUIRE(frame.step_error.has_value());
    CHECK(frame.step_error->sensor == 3.5e-3);
    CHECK(frame.step_error->te == 2e-4);
    CHECK(frame.step_error->steps == 240);
    CHECK(frame.step_error->finer_steps == 960);
    CHECK(frame.step_error->gearboxes == 8);
    CHECK(frame.step_error->meshes == 16);
}

TEST_CASE("The datasets of contact loss have descriptions") {
    const Folder folder;
    const std::string path = folder.file("r.h5");
    write_results(path, example(10));
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening");
    CHECK(read_text(file.get(), "contact_loss/sun-planet", "unit") == "1");
    CHECK(
        read_text(file.get(), "contact_loss/ring-planet", "description").find("carries no load") !=
        std::string::npos);
}

// Files of versions before 0.3, and of studies whose teeth cannot separate.
TEST_CASE("Results without contact loss have no value instead of zero") {
    const Folder folder;
    const std::string path = folder.file("r.h5");
    Results r = example(10);
    r.contact_loss.clear();
    r.step_error.reset();
    write_results(path, r);
    CHECK_FALSE(has_group(path, "contact_loss"));
    CHECK_FALSE(has_group(path, "step_error"));
    const Results back = read_results(path);
    CHECK(back.contact_loss.empty());
    CHECK_FALSE(back.step_error.has_value());
    CHECK(bits(back) == bits(r));
}

TEST_CASE("Contact loss with a wrong number of rows is not written") {
    const Folder folder;
    Results r = example(10);
    r.contact_loss[1].values.pop_back();
    CHECK_THROWS_AS(write_results(folder.file("r.h5"), r), std::invalid_argument);
    CHECK(folder.files() == 0);
}

}  // namespace gearpod::mc::test_contact_results
