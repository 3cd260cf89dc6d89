// Checks the dataset of `report --dataset`: the numbers of the results file, splits that share no
// gearbox, the same bytes for any threads and merged parts, and refused outputs.
#include <fmt/format.h>

#include "mc/files/text/text_table.hpp"
#include "mc/report/dataset.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_dataset {

using namespace test;

const std::string kRun =
    "run " + study("planet-crack-ideal.toml") +
    " --instances 50 --set ensemble.threshold_instances=35 --set sensor.noise_levels=[0,1] --quiet"
    " --set 'sensor.additional=[{name=\"side\", angle_deg=90}]' ";
const std::vector<std::string> kData{"train.csv", "validation.csv", "test.csv"};

std::string dataset_of(const Folder& folder, const std::string& name, const std::string& run) {
    const std::string results = folder.file(name + ".h5");
    require_success(run + " --out " + results);
    check_mentions(require_success("report " + results + " --dataset " + folder.file(name)),
                   {"dataset: " + folder.file(name)});
    return folder.file(name);
}

struct Line {
    std::size_t split = 0;
    std::map<std::string, std::string> fields;

    double number(const std::string& column) const {
        const std::string& text = fields.at(column);
        return text.empty() ? std::nan("") : std::stod(text);
    }
};

std::vector<Line> lines_of(const std::string& folder) {
    std::vector<Line> lines;
    for (std::size_t split = 0; split < kData.size(); ++split) {
        const mc::TextTable table = mc::read_text_table(folder + "/" + kData[split]);
        for (const auto& row : table.rows) {
            Line line{split, {}};
            for (std::size_t c = 0; c < row.size(); ++c) {
                line.fields[table.columns[c].name] = row[c];
            }
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

std::string same_number(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b)) ? "same" : fmt::format("{} and {}", a, b);
}

TEST_CASE("A dataset holds the numbers of the results, each gearbox in one split") {
    const Folder folder;
    const std::string data = dataset_of(folder, "whole", kRun);
    const mc::Results results = mc::read_results(folder.file("whole.h5"));
    const std::vector<Line> lines = lines_of(data);
    // Two sensors and two noise levels of 85 gearboxes.
    REQUIRE(lines.size() == 4 * 85);
    std::map<std::string, std::set<std::size_t>> splits;
    std::array<int, 3> in_split{};
    std::set<std::string> places;
    for (const Line& line : lines) {
        splits[line.fields.at("gearbox")].insert(line.split);
        ++in_split[line.split];
        const std::size_t row = std::stoul(line.fields.at("row"));
        const std::size_t level = line.number("noise_level") == 0.0 ? 0 : 1;
        const std::string sensor = line.fields.at("sensor");
        places.insert(fmt::format("{} {} {}", row, level, sensor));
        INFO("row " << row << " level " << level << " sensor " << sensor);
        CHECK(line.fields.at("group") == (results.group[row] == 0 ? "threshold" : "graded"));
        for (const mc::ParameterResult& input : results.parameters) {
            CHECK(same_number(line.number(input.name), input.values[row]) == "same");
        }
        CHECK(line.number("faulty") == (results.parameters.back().values[row] > 0.0));
        const auto& features =
            sensor == "first" ? results.features : results.variants.at(0).features;
        for (const mc::FeatureResult& feature : features) {
            CHECK(same_number(line.number(feature.name), feature.values[2 * row + level]) ==
                  "same");
        }
    }
    CHECK(places.size() == lines.size());
    CHECK(splits.size() == 85);
    for (const auto& [gearbox, in] : splits) {
        INFO(gearbox);
        CHECK(in.size() == 1);
    }
    // 70 and 15 % of 85 gearboxes are expected; these bounds are five standard deviations away.
    CHECK(in_split[0] > 4 * 38);
    CHECK(in_split[1] > 0);
    CHECK(in_split[2] > 0);
    // The card names the study, and every column has a meaning.
    const std::string card = bytes_of(data + "/README.md");
    CHECK(contains(card, results.provenance_value("git_hash").substr(0, 12)));
    const mc::TextTable columns = mc::read_text_table(data + "/columns.csv");
    CHECK(columns.rows.size() == lines[0].fields.size());
    for (const auto& column : columns.rows) {
        INFO(column[0]);
        CHECK(lines[0].fields.contains(column[0]));
        CHECK_FALSE(column[3].empty());
        CHECK(contains(card, "| " + column[0] + " | " + column[1]));
    }
    // The study of the folder gives the same results.
    const std::string again = dataset_of(folder, "again", "run " + data + "/study.toml --quiet");
    CHECK(bytes_of(again + "/train.csv") == bytes_of(data + "/train.csv"));
}

TEST_CASE("A dataset has the same bytes for other threads and from merged parts") {
    const Folder folder;
    const std::string data = dataset_of(folder, "whole", kRun);
    ::setenv("OMP_NUM_THREADS", "1", 1);
    const std::string one = dataset_of(folder, "one", kRun);
    ::unsetenv("OMP_NUM_THREADS");
    const std::string first = dataset_of(folder, "first", kRun + " --part 1/2"),
                      second = dataset_of(folder, "second", kRun + " --part 2/2");
    require_success("merge " + first + ".h5 " + second + ".h5 --out " + folder.file("m.h5"));
    require_success("report " + folder.file("m.h5") + " --dataset " + folder.file("m"));
    for (const std::string& name : kData) {
        INFO(name);
        CHECK(bytes_of(one + "/" + name) == bytes_of(data + "/" + name));
        CHECK(bytes_of(folder.file("m/" + name)) == bytes_of(data + "/" + name));
    }
    // Parts number rows, gearboxes and splits as the whole study does.
    std::map<std::string, Line> whole;
    const auto key = [](const Line& line) {
        return line.fields.at("row") + " " + line.fields.at("sensor") + " " +
               line.fields.at("noise_level");
    };
    for (const Line& line : lines_of(data)) {
        whole[key(line)] = line;
    }
    std::size_t found = 0;
    for (const std::string& part : {first, second}) {
        for (const Line& line : lines_of(part)) {
            INFO(key(line));
            CHECK(whole.at(key(line)).fields == line.fields);
            CHECK(whole.at(key(line)).split == line.split);
            ++found;
        }
    }
    CHECK(found == whole.size());
}

TEST_CASE("Records of a gearbox stay together, and stored signals are written") {
    const Folder folder;
    const std::string data =
        dataset_of(folder, "records", kRun + " --set ensemble.threshold_records=3 --signals 4,110");
    std::map<std::string, std::set<std::string>> records;
    std::map<std::string, std::set<std::size_t>> splits;
    for (const Line& line : lines_of(data)) {
        records[line.fields.at("gearbox")].insert(line.fields.at("record"));
        splits[line.fields.at("gearbox")].insert(line.split);
    }
    CHECK(records.at("threshold-34") == std::set<std::string>{"0", "1", "2"});
    CHECK(records.at("graded-49") == std::set<std::string>{"0"});
    for (const auto& [gearbox, in] : splits) {
        CHECK(in.size() == 1);
    }
    // Row 110 is test gearbox 5, after 35 gearboxes with three records.
    const mc::TextTable stored = mc::read_text_table(data + "/signals_110.csv");
    const std::string simulated = folder.file("simulated.csv");
    require_success("simulate " + data + "/study.toml --instance 110 --meshes 31 --out " +
                    simulated);
    const mc::TextTable own = mc::read_text_table(simulated);
    const auto column = own.find("sensor"), same = stored.find("sensor");
    REQUIRE(column);
    REQUIRE(same);
    const std::size_t common = std::min(stored.rows.size(), own.rows.size());
    REQUIRE(common > 100);
    for (std::size_t i = 0; i < common; ++i) {
        CHECK(stored.rows[i][*same] == own.rows[i][*column]);
    }
    CHECK(std::filesystem::exists(data + "/signals_4.csv"));
}

TEST_CASE("Recordings of a named gearbox are in one split, whatever the file") {
    mc::Results frame;
    frame.provenance = {{"kind", mc::kRecordingsKind}, {"recorded_gearboxes", "A\nB\nA\n\n"}};
    const mc::RowIdentities identities(frame, std::nullopt);
    CHECK(identities.of(0).gearbox == "A");
    CHECK(identities.of(2).gearbox == "A");
    CHECK(identities.of(2).record == 1);
    CHECK(identities.of(1).record == 0);
    CHECK(identities.of(3).gearbox == "recording-3");
    // Over many names the shares are those stated, within four standard deviations.
    std::array<int, 3> counts{};
    for (int i = 0; i < 2000; ++i) {
        const std::string name = "gearbox " + std::to_string(i);
        frame.provenance = {{"recorded_gearboxes", "other\n" + name + "\n" + name + "\n"}};
        const mc::RowIdentities both(frame, std::nullopt);
        frame.provenance = {{"recorded_gearboxes", name + "\n"}};
        REQUIRE(both.of(1).split == both.of(2).split);
        REQUIRE(both.of(1).split == mc::RowIdentities(frame, std::nullopt).of(0).split);
        ++counts[both.of(1).split];
    }
    CHECK(std::abs(counts[0] - 1400) < 82);
    CHECK(std::abs(counts[1] - 300) < 64);
    CHECK(std::abs(counts[2] - 300) < 64);
}

TEST_CASE("A dataset replaces no other file, and lives have none") {
    const Folder folder;
    const std::string data = dataset_of(folder, "data", kRun), card = data + "/README.md";
    const std::string report = "report " + folder.file("data.h5") + " --dataset ";
    require_success(report + data);  // its own files
    for (const std::string name : {"README.md", "train.csv", "study.toml"}) {
        std::filesystem::create_directory(folder.file("other"));
        write_bytes(folder.file("other/" + name), "notes of a user\n");
        check_refused(report + folder.file("other"),
                      {"--dataset " + folder.file("other/" + name) +
                           ": is a file of another kind than this output",
                       "--force"});
        CHECK(std::distance(std::filesystem::directory_iterator(folder.file("other")),
                            std::filesystem::directory_iterator{}) == 1);
        std::filesystem::remove_all(folder.file("other"));
    }
    const std::string lives = folder.file("lives.h5");
    const Outcome ran = program("lives " + study("planet-crack-ideal.toml") + life_arguments() +
                                " --quiet --out " + lives);
    INFO(ran.output);
    check_refused("report " + lives + " --dataset " + folder.file("lives"),
                  {"lives.h5: holds lives", "--dataset"});
    CHECK_FALSE(std::filesystem::exists(folder.file("lives")));
}

}  // namespace gearpod::test_dataset
