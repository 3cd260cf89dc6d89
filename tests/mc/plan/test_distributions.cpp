// Checks distributions of random inputs against their closed forms.
#include "mc/plan/sampling.hpp"
#include "tests/mc/plan/random_samples.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_distributions {

using namespace tests;

TEST_CASE("Random values of Weibull and beta laws follow their distribution functions") {
    for (const double shape : {0.7, 2.0, 9.0}) {
        const std::string text =
            "{distribution='weibull', scale=3, shape=" + std::to_string(shape) + "}";
        CHECK(kolmogorov_smirnov(samples_of(text, kSamples), [&](double x) {
                  return 1.0 - std::exp(-std::pow(x / 3.0, shape));
              }) < kKsLimit);
    }
    // Closed forms: F = u^2 for alpha = 2, beta = 1; the arcsine law for alpha = beta = 1/2.
    CHECK(kolmogorov_smirnov(
              samples_of("{distribution='beta', low=-1, high=3, alpha=2, beta=1}", kSamples),
              [](double x) { return std::pow((x + 1) / 4, 2); }) < kKsLimit);
    CHECK(kolmogorov_smirnov(
              samples_of("{distribution='beta', low=0, high=2, alpha=0.5, beta=0.5}", kSamples),
              [](double x) { return 2 / 3.14159265358979324 * std::asin(std::sqrt(x / 2)); }) <
          kKsLimit);
}

void check_frequencies(const std::vector<double>& samples, const std::map<double, double>& shares) {
    for (const auto& [value, share] : shares) {
        const double found = static_cast<double>(std::count(samples.begin(), samples.end(), value));
        CHECK(found / kSamples ==
              Approx(share).margin(4 * std::sqrt(share * (1 - share) / kSamples)));
    }
}

TEST_CASE("Discrete values have the frequencies of their weights") {
    const auto samples =
        samples_of("{distribution='discrete', values=[30, 10, 20], weights=[1, 2, 5]}", kSamples);
    check_frequencies(samples, {{30.0, 0.125}, {10.0, 0.25}, {20.0, 0.625}});
    const Distribution discrete =
        distribution_of("{distribution='discrete', values=[30, 10, 20], weights=[1, 2, 5]}");
    CHECK(discrete.median() == 20.0);
    CHECK(discrete.support().low == 10.0);
    CHECK(discrete.support().high == 30.0);
    for (const char* bad : {"{distribution='discrete', values=[1, 2], weights=[1]}",
                            "{distribution='discrete', values=[1, 2], weights=[1, 0]}",
                            "{distribution='weibull', scale=1, shape=0.1}",
                            "{distribution='beta', low=1, high=1, alpha=1, beta=1}"}) {
        Problems problems;
        const Value document = parse_document(std::string("x = ") + bad, "test.toml", problems);
        CHECK(!Distribution::read(document.find("x")->value, "x", problems));
        CHECK(problems.size() == 1);
    }
}

TEST_CASE("Medians of Weibull and beta laws are those of the distribution function") {
    const auto median_of = [](const std::string& text) { return distribution_of(text).median(); };
    CHECK(median_of("{distribution='weibull', scale=2, shape=3}") ==
          Approx(2 * std::cbrt(std::log(2.0))));
    CHECK(median_of("{distribution='beta', low=0, high=4, alpha=3, beta=3}") == Approx(2));
}

TEST_CASE("Measured values are used with equal frequency") {
    const auto samples = samples_of("{distribution='empirical', values=[3, 1, 1, 7]}", kSamples);
    check_frequencies(samples, {{3.0, 0.25}, {1.0, 0.5}, {7.0, 0.25}});
    const Distribution measured =
        distribution_of("{distribution='empirical', values=[3, 1, 2], rows=4}");
    CHECK(measured.median() == 2.0);
    CHECK(measured.rows().group == 4);
    CHECK(measured.toml() == "{ distribution = \"empirical\", values = [3, 1, 2], rows = 4 }");
}

// Torque over path exponent of some gearboxes; in the lists below it is 1000 within a row.
std::vector<double> ratios(const Study& study) {
    std::vector<double> all;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const InstanceInputs inputs = Sampler(DrawPlan{study}).draw({Group::test, i}).inputs;
        all.push_back(inputs.torque_N_m / inputs.path_exponent);
    }
    return all;
}

const std::string kTorques = "random.operation.torque_N_m={distribution=\"empirical\",";
const std::string kExponents = "random.sensor.path_exponent={distribution=\"empirical\",";

TEST_CASE("Inputs linked in rows use the same position of their lists") {
    const auto study = [](const std::string& rows) {
        return gearpod::test::shipped_study("planet-crack-ideal.toml",
                                            {kTorques + "values=[100,200,300,400]" + rows + "}",
                                             kExponents + "values=[0.1,0.2,0.3,0.4]" + rows + "}"});
    };
    for (const double ratio : ratios(study(",rows=2"))) {
        CHECK(ratio == Approx(1000.0));
    }
    const auto apart = ratios(study(""));
    CHECK(std::ranges::any_of(apart, [](double ratio) { return std::abs(ratio - 1000) > 1; }));
    const auto uneven = read_study(
        gearpod::test::study_path("planet-crack-ideal.toml"),
        {kTorques + "values=[100,200],rows=1}", kExponents + "values=[0.1,0.2,0.3],rows=1}"});
    REQUIRE(uneven.problems.size() == 1);
    CHECK(format(uneven.problems)
              .find("has 3 values, but operation.torque_N_m with the same rows "
                    "has 2") != std::string::npos);
}

TEST_CASE("Columns of a file are used in rows, and missing ones are reported") {
    const gearpod::test::Folder folder;
    std::string text = "time;torque [N m];exponent\n";
    for (int i = 1; i <= 1500; ++i) {
        text += std::to_string(i) + ";" + std::to_string(100 + i) + ";" +
                std::to_string(0.0001 * (100 + i)) + "\n";
    }
    gearpod::test::write_bytes(folder.file("scada.csv"), text);
    const auto from = [&](const std::string& start, const std::string& column) {
        return start + "file=\"" + folder.file("scada.csv") + "\",column=\"" + column + "\"}";
    };
    const Study both = gearpod::test::shipped_study(
        "planet-crack-ideal.toml",
        {from(kTorques, "torque"), from("random.gearbox.planet.mass_kg={distribution="
                                        "\"empirical\",",
                                        "exponent")});
    for (std::uint64_t i = 0; i < 100; ++i) {
        const InstanceInputs inputs = Sampler(DrawPlan{both}).draw({Group::test, i}).inputs;
        CHECK(inputs.torque_N_m == Approx(10000.0 * inputs.bodies[Member::planet].mass_kg));
    }
    const auto problems_of = [&](const std::string& override) {
        return format(
            read_study(gearpod::test::study_path("planet-crack-ideal.toml"), {override}).problems);
    };
    CHECK(problems_of(from(kTorques, "power"))
              .find("no column power; its columns are time, torque, "
                    "exponent") != std::string::npos);
    CHECK(problems_of(kTorques + "file=\"none.csv\",column=\"torque\"}").find("none.csv") !=
          std::string::npos);
    gearpod::test::write_bytes(folder.file("bad.csv"), "torque\n1\nlots\n");
    CHECK(problems_of(kTorques + "file=\"" + folder.file("bad.csv") + "\",column=\"torque\"}")
              .find("bad.csv:3: \"lots\" is not a finite number") != std::string::npos);
    gearpod::test::write_bytes(folder.file("empty.csv"), "torque\n");
    CHECK(problems_of(kTorques + "file=\"" + folder.file("empty.csv") + "\",column=\"torque\"}")
              .find("empty.csv: has no row below its header") != std::string::npos);
}

TEST_CASE("Lists of a study may come from a column of a file") {
    const gearpod::test::Folder folder;
    std::string text = "tooth,sun [um]\n";
    std::vector<double> deviations;
    for (int tooth = 0; tooth < 19; ++tooth) {
        deviations.push_back(1e-6 * (tooth % 5 - 2));
        text += std::to_string(tooth) + "," + std::to_string(tooth % 5 - 2) + "\n";
    }
    gearpod::test::write_bytes(folder.file("teeth.csv"), text);
    const auto reading = [&](const std::string& column) {
        return read_study(gearpod::test::study_path("real-teeth.toml"),
                          {"gearbox.sun.index_um={file=\"" + folder.file("teeth.csv") +
                           "\",column=\"" + column + "\"}"});
    };
    const StudyReading given = reading("sun");
    INFO(format(given.problems));
    REQUIRE(given.study);
    const std::vector<double>& read = given.study->gearbox.bodies[Member::sun].index_m;
    REQUIRE(read.size() == deviations.size());
    for (std::size_t tooth = 0; tooth < read.size(); ++tooth) {
        CHECK(read[tooth] == Approx(deviations[tooth]));
    }
    CHECK(format(reading("ring").problems).find("gearbox.sun.index_um: ") != std::string::npos);
    CHECK(format(reading("ring").problems).find("no column ring; its columns are tooth, sun") !=
          std::string::npos);
}

}  // namespace gearpod::test_distributions
