// Checks the critical speeds and the page of gearpod modes.
#include "mc/library/stiffness_modes.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_modes_command {

using namespace test;

TEST_CASE("Critical speeds lie where a mesh harmonic crosses a natural frequency") {
    // Mesh frequency 10 Hz per rad/s; one mode at 50 Hz, two that rise from 20 to 40 Hz.
    std::vector<mc::SpeedFrequencies> speeds;
    for (int i = 0; i <= 10; ++i) {
        const double rising = 20.0 + 2.0 * i;
        speeds.push_back({static_cast<double>(i), 10.0 * i, {rising, rising, 50.0}});
    }
    const auto found = critical_speeds(speeds, 2);
    REQUIRE(found.size() == 4);
    // Second harmonic: 20 s = 20 + 2 s, then 20 s = 50. First: 10 s = 20 + 2 s and 10 s = 50.
    const double expected[][4] = {
        {20.0 / 18.0, 200.0 / 9.0, 2, 2}, {2.5, 25.0, 1, 2}, {2.5, 50.0, 2, 1}, {5.0, 50.0, 1, 1}};
    for (std::size_t i = 0; i < found.size(); ++i) {
        INFO(i);
        CHECK(found[i].speed_rad_s == Approx(expected[i][0]));
        CHECK(found[i].frequency_Hz == Approx(expected[i][1]));
        CHECK(found[i].harmonic == expected[i][2]);
        CHECK(found[i].modes == expected[i][3]);
    }
}

TEST_CASE("modes writes a Campbell diagram, and prints the critical speeds") {
    const Folder folder;
    const std::string html = folder.file("m.html");
    check_mentions(require_success("modes " + study("bell-206b.toml") + " --html " + html +
                                   " --json " + folder.file("m.json")),
                   {"speeds of the carrier at which mesh harmonics 1 to 5"});
    const auto json = json_of_file(folder.file("m.json"));
    const auto& campbell = json["campbell"];
    CHECK(campbell["nominal_rpm"].get<double>() == Approx(343.8));
    const auto at_rest = campbell["speeds"][0]["frequencies_Hz"];
    for (std::size_t i = 0; i < at_rest.size(); ++i) {
        CHECK(at_rest[i].get<double>() ==
              Approx(json["frequencies_Hz"][i].get<double>()).epsilon(1e-5).margin(1e-2));
    }
    for (const auto& one : campbell["critical_speeds"]) {
        // The mesh frequency is proportional to the speed.
        const auto& last = campbell["speeds"].back();
        const double mesh_Hz =
            last["mesh_Hz"].get<double>() * one["rpm"].get<double>() / last["rpm"].get<double>();
        CHECK(one["harmonic"].get<int>() * mesh_Hz ==
              Approx(one["frequency_Hz"].get<double>()).epsilon(1e-9));
    }
    CHECK(contains(bytes_of(html), "Campbell diagram"));
    // A study without tooth numbers has no mesh frequency, and an existing file is kept.
    check_refused("modes " + study("bell-206b.toml") + " --html " + folder.file("m.json"));
}

}  // namespace gearpod::test_modes_command
