// Draws that gearboxes exchange: those of others in some places, their own elsewhere.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "mc/scene/sampling.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

using namespace gearpod;
using namespace gearpod::mc;

namespace {

constexpr int kNumbers = 2000;

std::vector<double> numbers(const Study& study, std::uint64_t index,
                            const std::vector<std::uint64_t>& exchanged = {},
                            Group group = Group::graded) {
    GearboxId id{group, index};
    id.exchanged = exchanged;
    Normals normals(study, id, "gearbox.planets");
    std::vector<double> all;
    for (int i = 0; i < kNumbers; ++i) {
        all.push_back(normals());
    }
    return all;
}

// Of places.
double share_of_same(const std::vector<double>& a, const std::vector<double>& b) {
    double same = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        same += a[i] == b[i] ? 1.0 / static_cast<double>(a.size()) : 0.0;
    }
    return same;
}

}  // namespace

TEST_CASE("Exchanged numbers are the gearbox's own or the other's, in shares of three kinds") {
    const Study study = test::study_of_text(tests::kExampleStudy);
    const std::vector<double> own = numbers(study, 4);
    std::array<int, 3> kinds{};
    for (std::uint64_t other = 100; other < 130; ++other) {
        const std::vector<double> exchanged = numbers(study, 4, {other});
        const double taken = share_of_same(exchanged, numbers(study, other));
        CHECK(share_of_same(exchanged, own) == Approx(1.0 - taken));
        constexpr std::array kShares{0.3, 0.1, 0.03};
        int kind = 0;
        while (kind < 2 && std::abs(taken - kShares[static_cast<std::size_t>(kind)]) > 0.035) {
            ++kind;
        }
        INFO(other << " gives " << taken);
        CHECK(taken == Approx(kShares[static_cast<std::size_t>(kind)]).margin(0.035));
        ++kinds[static_cast<std::size_t>(kind)];
    }
    for (const int kind : kinds) {
        CHECK(kind > 2);
    }
}

TEST_CASE("A later exchange goes over an earlier one") {
    const Study study = test::study_of_text(tests::kExampleStudy);
    const std::vector<double> both = numbers(study, 4, {100, 101});
    const std::vector<double> first = numbers(study, 4, {100}), own = numbers(study, 4);
    const std::vector<double> second = numbers(study, 4, {101});
    const std::vector<double> of_second = numbers(study, 101);
    for (std::size_t i = 0; i < both.size(); ++i) {
        CHECK(both[i] == (second[i] == of_second[i] ? of_second[i] : first[i]));
    }
    CHECK(share_of_same(both, own) < 1.0);
    CHECK(numbers(study, 4, {100}, Group::threshold) != first);
}

TEST_CASE("Random inputs, planets and records are exchanged as a whole") {
    const Study study = test::study_of_text(
        tests::kExampleStudy, {"random.sensor.path_exponent={distribution=\"uniform\",low=0,"
                               "high=1}",
                               "gearbox.pin_tangential_rms_um=8"});
    const Sampler sampler(study);
    std::size_t column = 0;
    while (sampler.columns()[column].name != "path_exponent") {
        ++column;
    }
    int taken = 0;
    constexpr int kGearboxes = 200;
    for (std::uint64_t index = 0; index < kGearboxes; ++index) {
        const std::vector<std::uint64_t> other{1000 + index};
        GearboxId id{Group::graded, index};
        const double own = sampler.sample(id).path_exponent;
        id.exchanged = other;
        const InstanceInputs inputs = sampler.sample(id);
        const double given = sampler.sample(Group::graded, other[0]).path_exponent;
        CHECK((inputs.path_exponent == own || inputs.path_exponent == given));
        taken += inputs.path_exponent == given ? 1 : 0;
        const std::uint64_t from = drawn_from(study, id, "sensor.path_exponent");
        CHECK(from == (inputs.path_exponent == given ? other[0] : index));
        CHECK(record_stream(study, id, "sensor.path_exponent")() ==
              gearbox_stream(study, {Group::graded, from}, "sensor.path_exponent")());
        CHECK(sampler.row(id)[column] == inputs.path_exponent);
    }
    // 14 % on average.
    CHECK(taken > 14);
    CHECK(taken < 46);
}
