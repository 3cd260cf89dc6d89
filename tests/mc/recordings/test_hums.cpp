// Checks the recordings of the HUMS 2023 challenge, if present
// (docs/validation/measured-machines.md).
#include "mc/files/hdf5_data.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_hums {

using namespace test;

// Report on all recordings; null without the data.
nlohmann::json report_of(const std::string& options) {
    const char* file = std::getenv("GEARPOD_HUMS_DATA");
    if (file == nullptr || !std::filesystem::exists(file)) {
        WARN("HUMS data not there: set GEARPOD_HUMS_DATA to hums2023.h5");
        return nullptr;
    }
    const Folder folder;
    const mc::Hdf5Handle data(H5Fopen(file, H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, file);
    const auto days = mc::read_integers(data.get(), "day", 1000000);
    std::string table = "file,row,time [day],label\n";
    for (std::size_t i = 0; i < days.size(); ++i) {
        table += std::string(file) + "," + std::to_string(i) + "," + std::to_string(days[i]) + "," +
                 (days[i] <= 20 ? "healthy" : "faulty") + "\n";
    }
    write_bytes(folder.file("m.csv"), table);
    require_success("features --manifest " + folder.file("m.csv") + " --study " +
                    study("bell-206b.toml") + " --samples-per-mesh 117 --quiet " + options +
                    " --out " + folder.file("f.h5"));
    return json_of("report " + folder.file("f.h5") + " --json -");
}

// Data: the recordings of the HUMS 2023 challenge, if present
// (docs/validation/measured-machines.md).
TEST_CASE("A gearbox whose planet cracks alarms on its last days", "[hums]") {
    const auto json = report_of("");
    if (json.is_null()) {
        return;
    }
    // Monitored in sequence, with the alarm set up to day 20: both later days alarm. The windowed
    // teeth do so within the first 60 records of day 26, with the drift of days 17 to 20.
    REQUIRE(json["monitoring"]["refusal"] == "");
    double best = 0.0;
    for (const auto& one : json["monitoring"]["watched"]) {
        CHECK(one["healthy"]["alarms"].get<long>() * 100 <=
              one["healthy"]["recordings"].get<long>());
        const auto& gearbox = one["gearboxes"][0];
        best =
            std::max(best, gearbox["alarms"].get<double>() / gearbox["recordings"].get<double>());
        if (one["feature"] == "window_ratio" || one["feature"] == "fused") {
            INFO(one.dump());
            const auto& first = gearbox["first"];
            REQUIRE(!first.is_null());
            CHECK(first["time"] == 26);
            CHECK(first["row"].get<int>() < 282 + 60);
        }
    }
    CHECK(best >= 0.6);
}

TEST_CASE("The kurtosis of the change alarms in all later recordings and in no healthy one",
          "[hums]") {
    // 262 healthy recordings after the baseline set thresholds of 1 in 263 at best.
    for (const char* average : {"1", "5"}) {
        const auto json = report_of(
            std::string("--baseline-records 20 --set detection.false_alarm_rate=0.003 --set "
                        "'features.use=[\"change_kurtosis\"]' --average ") +
            average);
        if (json.is_null()) {
            return;
        }
        const auto& monitoring = json["monitoring"];
        CHECK(monitoring["smallest_rate"].get<double>() == Approx(1.0 / 263.0));
        const auto& series = monitoring["recordings"][0];
        const auto watched = std::find_if(
            monitoring["watched"].begin(), monitoring["watched"].end(), [](const auto& one) {
                return one["feature"] == "change_kurtosis" && one["detector"] == "single";
            });
        REQUIRE(watched != monitoring["watched"].end());
        CHECK((*watched)["healthy"]["alarms"] == 0);
        CHECK((*watched)["healthy"]["sustained"] == 0);
        int alarms[28] = {}, all[28] = {};
        for (std::size_t i = 0; i < series["time"].size(); ++i) {
            const auto day = series["time"][i].get<std::size_t>();
            const auto& deviation = series["deviations"]["change_kurtosis"][i];
            ++all[day];
            alarms[day] += !deviation.is_null() &&
                                   deviation.get<double>() > (*watched)["threshold"].get<double>()
                               ? 1
                               : 0;
        }
        CHECK(all[27] == 21);
        CHECK(alarms[27] == all[27]);
        CHECK(100 * alarms[26] >= 95 * all[26]);
        const auto& gearbox = (*watched)["gearboxes"][0];
        CHECK(gearbox["sustained"]["time"] == 26);
        CHECK(gearbox["tooth"]["same"] == gearbox["tooth"]["recordings"]);
        for (std::size_t i = 0; i < series["alignment"].size(); ++i) {
            CHECK(series["alignment"][i].get<double>() >
                  (series["healthy"][i].get<bool>() ? 0.65 : 0.25));
        }
    }
}

}  // namespace gearpod::test_hums
