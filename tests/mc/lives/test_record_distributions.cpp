// Checks inputs that vary per record, given by [random] or, in short form, by [life], and the
// conflicts of both.
#include <fmt/format.h>

#include <boost/math/distributions/normal.hpp>

#include "mc/lives/life_tile.hpp"
#include "mc/lives/superposition.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_record_distributions {

using namespace test;

const std::string kTorque =
    "random.operation.torque_N_m={distribution=\"uniform\",low=300,high=500,per=\"record\"}";

TEST_CASE("A lognormal law per record is equivalent to the scatter key") {
    const mc::GearboxId id{mc::Group::test, 2};
    const auto history = [&](const std::string& more) {
        const mc::Scene scene(life_study({more}));
        return mc::CrackLife(scene.life()).history(scene.life().sampler->draw(id), true);
    };
    // For a standard deviation of 0.1 of the logarithm, cv^2 = exp(0.01) - 1.
    const std::string cv = fmt::format("{:.17g}", std::sqrt(std::expm1(0.01)));
    const auto in_short = history("life.gain_scatter=0.1");
    const auto in_long = history(
        "random.sensor.gain={distribution=\"lognormal\",median=1,cv=" + cv + ",per=\"record\"}");
    REQUIRE(in_short.records.size() == in_long.records.size());
    for (std::size_t r = 0; r < in_short.records.size(); ++r) {
        CHECK(in_long.records[r].gain == Approx(in_short.records[r].gain).epsilon(1e-9));
        CHECK(in_long.records[r].torque == 1.0);
    }
}

TEST_CASE("Records follow the law given by [random], not centred on a value of the gearbox") {
    const mc::Study study = life_study({kTorque, "life.records=4000"});
    const mc::Scene scene(study);
    const mc::CrackLife crack(scene.life());
    const mc::Sampler& sampler = *scene.life().sampler;
    for (const std::uint64_t index : {0, 1}) {
        const mc::Realization gearbox = sampler.draw({mc::Group::threshold, index});
        const mc::InstanceInputs& inputs = gearbox.inputs;
        CHECK(inputs.torque_N_m == study.operation.torque_N_m);
        auto torques = std::vector<double>();
        for (const auto& record : crack.history(gearbox, false).records) {
            torques.push_back(record.torque * inputs.torque_N_m);
        }
        // Kolmogorov's distance of 4,000 values from the uniform law: above 1.63 / sqrt(n) once in
        // 100.
        std::ranges::sort(torques);
        double apart = 0.0;
        for (std::size_t i = 0; i < torques.size(); ++i) {
            const double share = (torques[i] - 300.0) / 200.0;
            apart = std::max(apart, std::abs(share - (static_cast<double>(i) + 0.5) / 4000.0));
        }
        CHECK(apart < 1.63 / std::sqrt(4000.0));
    }
    // The gearbox has no column of its own for this input.
    for (const auto& column : scene.life().campaign.ensemble.inputs) {
        CHECK(column.name != "torque_N_m");
    }
}

TEST_CASE("A record between two integrated values uses both, and one beyond them extrapolates") {
    const mc::RecordDistribution law(life_study(), mc::RecordQuantity::torque, 0.1);
    const auto two = law.integrated_factors();
    REQUIRE(two.size() == 2);
    CHECK(std::log(two[1] / two[0]) == Approx(0.3));
    const auto shares = mc::interpolation_weights(two, 1.05);
    CHECK(shares[0] * two[0] + shares[1] * two[1] == Approx(1.05));
    const std::vector<double> four{0.8, 0.9, 1.0, 1.2};
    CHECK(mc::interpolation_weights(four, 0.95)[0] == 0.0);
    CHECK(mc::interpolation_weights(four, 0.5)[0] > 1.0);
    CHECK(mc::interpolation_weights(four, 0.5)[2] == 0.0);
    CHECK(mc::interpolation_weights(four, 2.0)[3] > 1.0);
}

TEST_CASE("A discrete law is integrated at its values") {
    // Nine in ten at one torque: its quantiles at -1.5 and 1.5 may be equal.
    const mc::Study study =
        life_study({"random.operation.torque_N_m={distribution=\"discrete\",values=[300,429],"
                    "weights=[0.02,0.98],per=\"record\"}"});
    const mc::RecordDistribution law(study, mc::RecordQuantity::torque, 0.0);
    const auto integrated = law.integrated_factors();
    REQUIRE(integrated.size() == 2);
    CHECK(integrated[0] * study.operation.torque_N_m == Approx(300.0));
    CHECK(integrated[1] * study.operation.torque_N_m == Approx(429.0));
    CHECK(mc::interpolation_weights(integrated, integrated[0])[0] == Approx(1.0));
    const mc::RecordDistribution none(life_study(), mc::RecordQuantity::torque, 0.0);
    CHECK(none.integrated_factors() == std::vector<double>{1.0});
}

TEST_CASE("A snapshot's baseline record varies the inputs per record, and only these") {
    const std::vector<std::string> both{
        "features.use=[\"change_window_ratio\"]", "sensor.noise_levels=[1]", kTorque,
        "random.sensor.gain={distribution=\"uniform\",low=1,high=2}"};
    const mc::Sampler sampler(mc::DrawPlan{shipped_study("planet-crack-ideal.toml", both)});
    const auto test_record = sampler.draw({mc::Group::test, 3}).inputs;
    const auto before = sampler.draw({mc::Group::test, 3, mc::Record::baseline}).inputs;
    CHECK(test_record.torque_N_m != before.torque_N_m);
    CHECK(before.torque_N_m > 300.0);
    CHECK(before.torque_N_m < 500.0);
    CHECK(test_record.gain == before.gain);
    // With one record per gearbox the record's law is the gearbox's.
    auto plain = both;
    plain[2].replace(plain[2].find(",per"), 13, "");
    const mc::Sampler gearbox(mc::DrawPlan{shipped_study("planet-crack-ideal.toml", plain)});
    CHECK(gearbox.draw({mc::Group::test, 3}).inputs.torque_N_m == test_record.torque_N_m);
}

TEST_CASE("Keys of inputs per record are read, written and refused by name") {
    const mc::Study study = life_study({kTorque});
    CHECK(contains(mc::resolved_text(study), "per = \"record\""));
    CHECK(*mc::read_study_text(mc::resolved_text(study), "again").study == study);

    const auto refused = [&](const std::vector<std::string>& more) {
        std::string text;
        for (const auto& problem :
             mc::read_study(test::study("planet-crack-ideal.toml"), joined(kLife, more)).problems) {
            text += mc::format(problem) + "\n";
        }
        return text;
    };
    const auto law = [](const std::string& key, const std::string& rest) {
        return "random." + key + "={" + rest + ",per=\"record\"}";
    };
    const auto refuses = [&](const std::vector<std::string>& more, const std::string& words) {
        const std::string text = refused(more);
        INFO(text);
        CHECK(contains(text, words));
        CHECK(std::ranges::count(text, '\n') == 1);
    };
    refuses({law("gearbox.mesh_damping_ratio", "distribution=\"uniform\",low=0.04,high=0.1")},
            "mesh_damping_ratio is the same in all records of a life");
    refuses({"random.sensor.gain={distribution=\"uniform\",low=1,high=2,per=\"day\"}"},
            "must be \"record\", \"assembly\" or \"gearbox\"");
    refuses({law("sensor.gain", "distribution=\"levels\",values=[1,2]")},
            "takes its values in turn");
    refuses({kTorque, "life.torque_scatter=0.1"}, "conflicts with life.torque_scatter");
    auto snapshot = std::vector<std::string>{kTorque, "ensemble.threshold_records=3"};
    std::string text;
    for (const auto& problem :
         mc::read_study(test::study("planet-crack-ideal.toml"), snapshot).problems) {
        text += mc::format(problem) + "\n";
    }
    INFO(text);
    CHECK(contains(text, "the 3 records of a gearbox differ only in their noise"));
}

TEST_CASE("describe shows the law of inputs per record") {
    check_mentions(
        require_success("describe " + test::study("planet-crack-ideal.toml") + life_arguments() +
                        " --set '" + kTorque + "'"),
        {"operation.torque_N_m.distribution = \"uniform\"\n", "times the study's value"});
}

}  // namespace gearpod::test_record_distributions
