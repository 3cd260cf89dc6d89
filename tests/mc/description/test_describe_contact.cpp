// Checks tooth contact in the text of describe.
#include "tests/mc/program.hpp"

namespace test_describe_contact {

using namespace gearpod;
using test::program;

namespace {

const std::string kFew = " --set ensemble.instances=8 --set ensemble.threshold_instances=8";

}  // namespace

TEST_CASE("describe shows no share of time out of contact where teeth cannot separate") {
    const auto description = program("describe " + test::study("planet-crack-ideal.toml") + kFew);
    INFO(description.output);
    REQUIRE(description.code == 0);
    CHECK(!description.mentions("out of contact"));
    CHECK(!description.mentions("time step error"));
}

}  // namespace test_describe_contact
