// Checks tooth contact in the text of describe.
#include "tests/mc/program.hpp"

using namespace gearpod;
using test::program;

namespace {

const std::string kFew = " --set ensemble.instances=8 --set ensemble.threshold_instances=8";

}  // namespace

TEST_CASE("describe shows no share of time out of contact where teeth cannot separate") {
    const auto said = program("describe " + test::study("planet-crack-ideal.toml") + kFew);
    INFO(said.output);
    REQUIRE(said.code == 0);
    CHECK(!said.mentions("out of contact"));
    CHECK(!said.mentions("time step error"));
}
