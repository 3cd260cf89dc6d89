// Studies too small for their false-alarm rate: said before the run, and first of all after it.
#include "tests/mc/program.hpp"

using namespace gearpod;
using test::Folder;
using test::Outcome;
using test::program;
using test::study;

namespace {

const std::string kSmall = study("planet-crack-ideal.toml") +
                           " --set ensemble.threshold_instances=30"
                           " --set ensemble.instances=28 --set sensor.noise_levels=[0,1]";

}  // namespace

TEST_CASE("A sample without a threshold is told before the run, and no fault counts as not found") {
    const Folder folder;
    const std::string rare = kSmall + " --set detection.false_alarm_rate=0.001";
    const Outcome described = program("describe " + rare);
    CHECK(described.mentions("Too few healthy gearboxes for a false-alarm rate of 0.001: 30"));
    CHECK(described.mentions("takes 999"));
    const std::string results = folder.file("r.h5");
    const Outcome run = program("run " + rare + " --quiet --out " + results);
    REQUIRE(run.code == 0);
    CHECK(run.mentions("Too few healthy gearboxes"));  // also where only problems are wanted
    const Outcome report = program("report " + results);
    CHECK(report.output.starts_with("Too few healthy gearboxes for a false-alarm rate of 0.001"));
    CHECK(report.mentions("no threshold: nothing is known of the faults found"));
    CHECK(!report.mentions("no tested fault"));
    CHECK(!report.mentions("not reached"));
    REQUIRE(program("report " + results + " --html " + folder.file("r.html")).code == 0);
    const std::string page = test::bytes_of(folder.file("r.html"));
    CHECK(page.find("Too few healthy gearboxes") != std::string::npos);
    CHECK(page.find("No tested crack") == std::string::npos);
    const Outcome compared = program("compare " + results + " " + results);
    CHECK(compared.mentions("no threshold: nothing is known of the faults found"));
}

TEST_CASE("A sample that does not fix its rate is told, one that does is not") {
    const Outcome few = program("describe " + kSmall);
    CHECK(few.mentions("Few healthy gearboxes for a false-alarm rate of 0.05: 30 fix it"));
    const Outcome enough =
        program("describe " + kSmall + " --set ensemble.threshold_instances=100");
    CHECK(!enough.mentions("ew healthy"));
    CHECK(enough.mentions("100 healthy gearboxes fix it to between"));
}

TEST_CASE("Costs of an alarm and of a miss give a threshold, all three or none") {
    const Folder folder;
    const std::string results = folder.file("r.h5");
    REQUIRE(program("run " + kSmall + " --quiet --out " + results).code == 0);
    const std::string costs = " --alarm-cost 10 --miss-cost 500";
    const Outcome two = program("report " + results + costs);
    CHECK(two.code == 2);
    CHECK(two.mentions("need all three"));
    const Outcome all = program("report " + results + costs + " --fault-share 0.01");
    CHECK(all.code == 0);
    CHECK(all.mentions("least expected cost by"));
    CHECK(all.mentions("without any alarm 5"));  // a hundredth of 500
    CHECK(program("report " + results).output.find("expected cost") == std::string::npos);
    CHECK(program("report " + results + costs + " --fault-share 2").code == 2);
    const Outcome json = program("report " + results + costs + " --fault-share 0.01 --json -");
    CHECK(json.mentions("\"least_cost\""));
    CHECK(json.mentions("\"by_false_alarm_rate\""));
}
