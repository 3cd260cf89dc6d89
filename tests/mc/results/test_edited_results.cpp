// Checks results files with a valid checksum and invalid contents: every reader refuses them with
// the reason.
#include "tests/mc/edited_results.hpp"
#include "tests/mc/results/small_results.hpp"

namespace gearpod::test_edited_results {

using namespace test;
namespace fs = std::filesystem;

// Results of a small run, computed once: three healthy gearboxes, five graded, two noise levels.
const std::string& genuine() {
    static const SmallRun run(test::study("crack-in-sun.toml") +
                              " --instances 5 --set ensemble.threshold_instances=3");
    return run.path;
}

std::string text_of(const std::string& path, const std::string& name) {
    return mc::read_frame(path).provenance_value(name);
}

struct Edit {
    const char* what;
    std::function<void(hid_t)> edit;
    const char* words;
};

void replace_text(hid_t root, const std::string& object, const std::string& name,
                  const std::string& text) {
    mc::check(H5Adelete_by_name(root, object.c_str(), name.c_str(), H5P_DEFAULT), name);
    mc::write_text(root, object, name, text);
}

std::vector<Edit> edits() {
    const std::string study = text_of(genuine(), "study");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = study;
        text.replace(text.find(from), from.size(), to);
        return [text](hid_t root) { replace_text(root, ".", "study", text); };
    };
    const auto levels = [](std::vector<double> values) {
        return [values](hid_t root) {
            replace_numbers(root, "noise_levels", {values.size()}, values);
        };
    };
    return {
        {"fewer noise levels", levels({0.0}), "noise_levels"},
        {"more noise levels", levels({0.0, 0.5, 1.0}), "noise_levels"},
        {"other noise levels", levels({0.0, 0.75}), "differ from the study's"},
        {"a noise level that is none", levels({0.0, NAN}), "must be finite"},
        {"an infinite noise level", levels({0.0, INFINITY}), "must be finite"},
        {"descending noise levels", levels({0.5, 0.0}), "ascending"},
        {"a study of other noise levels",
         with("noise_levels = [0, 0.5]", "noise_levels = [0, 0.5, 1]"), "the study's 3"},
        {"a study of one noise level", with("noise_levels = [0, 0.5]", "noise_levels = [0]"),
         "the study's 1"},
        {"a study of other features", with("\"window_z\"", "\"te_rms\""), "/features: column"},
        {"a study of fewer gearboxes", with("instances = 5", "instances = 2"), "8 gearboxes"},
        {"a study of fewer healthy gearboxes",
         with("instances = 5\nthreshold_instances = 3", "instances = 6\nthreshold_instances = 2"),
         "/instances/group of row 2"},
        {"a feature less",
         [](hid_t root) { mc::check(H5Ldelete(root, "features/window_z", H5P_DEFAULT), ""); },
         "/features: column"},
        {"an input that is none",
         [](hid_t root) {
             replace_numbers(root, "instances/fault_depth_m", {8}, std::vector<double>(8, NAN));
             mc::write_text(root, "instances/fault_depth_m", "unit", "m");
         },
         "not finite"},
        {"an infinite feature",
         [](hid_t root) {
             std::vector<double> values(16, 1.0);
             values[5] = INFINITY;
             mc::check(H5Ldelete(root, "features/window_z", H5P_DEFAULT), "");
             mc::write_numbers(root, "features/window_z", {8, 2}, values);
             mc::write_text(root, "features/window_z", "unit", "1");
             mc::write_text(root, "features/window_z", "alarm", "high");
         },
         "/features"},
        {"a status that is none",
         [](hid_t root) {
             mc::check(H5Ldelete(root, "status", H5P_DEFAULT), "");
             mc::write_integers(root, "status", {8}, {0, 0, 0, 0, 99, 0, 0, 0});
         },
         "/status of row 4 has the invalid value 99"},
        {"too short a column",
         [](hid_t root) {
             replace_numbers(root, "instances/path_exponent", {3}, {1, 2, 3});
         },
         "damaged"},
        {"records of healthy gearboxes that have one each",
         [](hid_t root) { mc::write_number(root, "detection", "threshold_records", 3.0); },
         "threshold_records = 3, but the study has 1"},
        {"a link to another file",
         [](hid_t root) {
             mc::check(H5Ldelete(root, "noise_levels", H5P_DEFAULT), "");
             mc::check(H5Lcreate_external("other.h5", "/noise_levels", root, "noise_levels",
                                          H5P_DEFAULT, H5P_DEFAULT),
                       "");
         },
         "has links to other places"},
        {"a confidence of nothing",
         [](hid_t root) {
             mc::check(H5Adelete_by_name(root, "detection", "confidence", H5P_DEFAULT), "");
             mc::write_number(root, "detection", "confidence", NAN);
         },
         "confidence"},
    };
}

TEST_CASE("A results file that is unchanged, or has a new checksum only, is reported") {
    const auto [folder, path] = TemporaryFile("r.h5");
    fs::copy_file(genuine(), path);
    edit_results(path, [](hid_t) {});
    for (const std::string& file : {genuine(), path}) {
        require_success("report " + file + " --json " + folder.file("r.json"));
    }
}

TEST_CASE("A modified results file with a valid checksum is refused with the reason") {
    const auto [folder, path] = TemporaryFile("r.h5");
    for (const Edit& edit : edits()) {
        fs::copy_file(genuine(), path, fs::copy_options::overwrite_existing);
        edit_results(path, edit.edit);
        for (const std::string& command :
             {"report " + path, "report " + path + " --json " + folder.file("r.json"),
              "report " + path + " --html " + folder.file("r.html"),
              "run " + test::study("crack-in-sun.toml") +
                  " --instances 6 --set ensemble.threshold_instances=3 --resume --out " + path}) {
            const Outcome outcome = check_refused(command, {"r.h5: "});
            if (command.starts_with("report")) {
                CHECK(outcome.mentions(edit.words));
            }
        }
        CHECK(folder.files() == 1);
    }
}

TEST_CASE("Names that are not valid UTF-8 do not prevent a report's JSON") {
    const auto [folder, path] = TemporaryFile("caf\xe9.h5");
    fs::copy_file(genuine(), path);
    edit_results(path, [](hid_t root) { replace_text(root, ".", "host", "caf\xe9"); });
    check_mentions(require_success("report '" + path + "' --json -"), {"caf\xef\xbf\xbd.h5"});
}

}  // namespace gearpod::test_edited_results
