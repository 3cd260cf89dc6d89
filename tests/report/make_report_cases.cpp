// Writes the JSON of every report case into a folder, as input of the page's tests.
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "mc/report/run_report.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/report/report_cases.hpp"

using namespace gearpod;

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_report_cases FOLDER\n";
        return 2;
    }
    const auto write = [&](const std::string& name, const nlohmann::json& json) {
        std::ofstream file(std::string(argv[1]) + "/" + name + ".json");
        file << json.dump() << "\n";
        return file.good();
    };
    bool good = true;
    for (const tests::ReportCase& each : tests::report_cases()) {
        const mc::ColumnRows rows(each.results);
        const auto reliability = mc::reliability_of(each.results, rows, "", 2);
        nlohmann::json report = mc::report_json(each.results, rows, reliability);
        report["evidence"] = {{"file", "results.h5"}, {"report_by", mc::version_text()}};
        good &= write(each.name, report);
        if (each.name == "usual") {
            good &= write("too_large", mc::report_json(each.results, rows, std::nullopt));
            good &= write("by_condition",
                          mc::report_json(each.results, rows,
                                          mc::reliability_of(each.results, rows,
                                                             "ring_bearing_stiffness_N_m", 2)));
        }
    }
    return good ? 0 : 1;
}
