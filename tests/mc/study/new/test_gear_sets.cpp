// gearpod new planetary for real gear sets: describe accepts every study, and a run detects a
// crack.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "dynamics/effects/mesh_law.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/study/new/datasheet.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study/new/gear_sets.hpp"

namespace gearpod::test_gear_sets {

using namespace gearpod::test;

// True if the kernels can integrate so many tooth pairs in contact.
bool within_kernels(const GearSet& set) {
    return set.tooth_pairs <= dynamics::kMostToothPairs;
}

// Text with a crack of half the root thickness in half of the test gearboxes.
std::string with_half_crack(std::string text, double deepest_mm) {
    const std::size_t begin = text.find("fault.depth_mm = {");
    REQUIRE(begin != std::string::npos);
    const std::size_t end = text.find('\n', begin);
    return text.replace(begin, end - begin,
                        fmt::format("fault.depth_mm = {{ distribution = \"levels\", values = [0, "
                                    "{:.4g}] }}",
                                    0.5 * deepest_mm));
}

// Depth of a crack through the whole root, from the comment before the levels.
double deepest_mm_of(const std::string& text) {
    const std::string before = "% of the way through the root, ";
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + before.size()));
}

struct Detection {
    std::string feature;
    double pd = 0;
};

// Largest detection rate of the deepest crack at the study's own noise.
Detection best_detection(const nlohmann::json& report) {
    Detection best;
    for (const auto& feature : report.at("detection").at("features")) {
        for (const auto& level : feature.at("levels")) {
            const auto& pd = level.at("sizes").back().at("pd");
            if (level.at("noise_level") == 1.0 && pd.is_number() && pd > best.pd) {
                best = {feature.at("name"), pd};
            }
        }
    }
    return best;
}

TEST_CASE("new writes studies of real gear sets, or refuses what no kernel integrates") {
    for (const GearSet& set : gear_sets()) {
        INFO(set.name);
        const mc::NewStudy made = new_planetary(set.data, "new planetary");
        INFO(format(made.problems));
        if (!within_kernels(set)) {
            CHECK(made.text.empty());
            REQUIRE(made.problems.size() == 1);
            CHECK(made.problems[0].key == "--helix, --face-width");
            CHECK(contains(made.problems[0].what, "tooth pairs of a gear pair touch at once"));
            continue;
        }
        REQUIRE(made.problems.empty());
        const mc::StudyScene scene =
            make_scene("study.toml", mc::read_study_text(made.text, "study.toml"));
        INFO(format(scene.problems));
        CHECK(scene);
    }
}

TEST_CASE("The studies of real gear sets detect a crack through half of the root, or state why not",
          "[.long][gear-sets]") {
    constexpr double kDetected = 0.5;
    for (const GearSet& set : gear_sets()) {
        if (!within_kernels(set)) {
            continue;
        }
        INFO(set.name);
        const Folder folder;
        const std::string file = folder.file("set.toml"), results = folder.file("set.h5");
        const mc::NewStudy made = new_planetary(set.data, "new planetary");
        std::ofstream(file) << with_half_crack(made.text, deepest_mm_of(made.text));
        require_success("describe " + file);
        const auto run = require_success("run " + file +
                                         " --quiet --instances 40 --set "
                                         "ensemble.threshold_instances=40 --out " +
                                         results);
        const auto report = require_success("report " + results + " --json -");
        const Detection best = best_detection(nlohmann::json::parse(report.output));
        fmt::print("| {} | {} | {:.2f} | {} |\n", set.name, best.feature, best.pd, set.missed);
        CHECK((best.pd >= kDetected) == set.missed.empty());
        if (set.missed == kUnloaded) {
            CHECK(run.mentions("nearly unloaded"));
        }
    }
}

}  // namespace gearpod::test_gear_sets
