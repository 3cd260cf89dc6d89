// Contact of the teeth in the text of describe.
#include "tests/mc/program.hpp"

using namespace gearpod;
using test::program;

namespace {

const std::string kFew = " --set ensemble.instances=8 --set ensemble.threshold_instances=8";

}  // namespace

TEST_CASE("describe shows the share of time out of contact and the error of the steps") {
    const auto said = program("describe " + test::study("planet-crack.toml") + kFew);
    INFO(said.output);
    REQUIRE(said.code == 0);
    CHECK(said.mentions("out of contact"));
    CHECK(said.mentions("sun-planet"));
    CHECK(said.mentions("ring-planet"));
    CHECK(said.mentions("of a tooth pair's time, mean (5 to 95 % of"));
    CHECK(said.mentions("error of the steps"));
}

TEST_CASE("describe shows no share of time out of contact where teeth cannot part") {
    const auto said = program("describe " + test::study("planet-crack-ideal.toml") + kFew);
    INFO(said.output);
    REQUIRE(said.code == 0);
    CHECK(!said.mentions("out of contact"));
    CHECK(!said.mentions("error of the steps"));
}
