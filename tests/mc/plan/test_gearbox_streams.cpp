// Checks exchange of random inputs between gearboxes: mixed with those of others, or replaced as a
// whole.
#include "mc/plan/sampling.hpp"
#include "signals/noise/normals.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_gearbox_streams {

using analysis::InputExchange;

constexpr int kNumbers = 2000;
constexpr std::uint64_t kSeed = 7;

std::vector<double> numbers(std::uint64_t index, const std::vector<InputExchange>& exchanged = {},
                            Group group = Group::test) {
    GearboxId id{group, index};
    id.exchanged = exchanged;
    Normals normals(kSeed, id, StreamPurpose::planets);
    return test::tabulated(kNumbers, [&](int) { return normals(); });
}

std::vector<double> many_numbers(const GearboxId& id) {
    std::vector<double> all(kNumbers);
    Normals::of_noise(kSeed, id, StreamPurpose::sensor_noise).normals(all);
    return all;
}

std::size_t column_of(const Study& study, const std::string& name) {
    std::size_t column = 0;
    while (EnsemblePlan(study).inputs[column].name != name) {
        ++column;
    }
    return column;
}

// Share 1 - s of an exchange in which `mixed` became (1 - s) before +
// sqrt(1 - (1 - s)^2) other.
double kept_share(const std::vector<double>& mixed, const std::vector<double>& before,
                  const std::vector<double>& other) {
    // Two positions determine both factors.
    const double determinant = before[0] * other[1] - before[1] * other[0];
    const double kept = (mixed[0] * other[1] - mixed[1] * other[0]) / determinant;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        const double expected = kept * before[i] + std::sqrt(1.0 - kept * kept) * other[i];
        REQUIRE(mixed[i] == Approx(expected).margin(1e-12));
    }
    return kept;
}

TEST_CASE("Exchanged numbers are normal mixtures of both with the weights of the given share") {
    const std::vector<double> unmixed = numbers(4);
    for (const double share : {0.0, 0.01, 0.3, 1.0}) {
        const std::vector<double> mixed = numbers(4, {{100, share}});
        CHECK(kept_share(mixed, unmixed, numbers(100)) == Approx(1.0 - share).margin(1e-12));
    }
    CHECK(numbers(4, {{100, 0.0}}) == unmixed);
}

TEST_CASE("A later exchange mixes the result of the earlier ones") {
    const std::vector<double> both = numbers(4, {{100, 0.2}, {101, 0.4}});
    const std::vector<double> first = numbers(4, {{100, 0.2}});
    CHECK(kept_share(both, first, numbers(101)) == Approx(0.6));
    CHECK(numbers(4, {{100, 0.2}}, Group::threshold) != first);
}

TEST_CASE("Noise is exchanged number by number, separately for each record and repeat") {
    GearboxId id{Group::test, 4}, other{Group::test, 100};
    const std::vector<InputExchange> exchanged{{100, 0.1}};
    for (const Record record : {Record::test, Record::baseline}) {
        for (const std::uint64_t repeat : {0, 3}) {
            id.record = other.record = record;
            id.repeat = other.repeat = repeat;
            id.exchanged.reset();
            const std::vector<double> unmixed = many_numbers(id);
            std::vector<double> plain(kNumbers);
            Philox engine = noise_stream(kSeed, id, StreamPurpose::sensor_noise);
            signals::draw_normals(engine, std::span(plain));
            CHECK(unmixed == plain);
            id.exchanged = exchanged;
            CHECK(kept_share(many_numbers(id), unmixed, many_numbers(other)) == Approx(0.9));
        }
    }
}

TEST_CASE("Random inputs of exchanging gearboxes keep their law and change by normal numbers") {
    const Study study = test::study_of_text(
        tests::kExampleStudy, {"random.sensor.path_exponent={distribution=\"uniform\",low=0,"
                               "high=1}",
                               "random.sensor.gain={distribution=\"discrete\",values=[1,2],"
                               "weights=[1,3]}",
                               "gearbox.pin_tangential_rms_um=8"});
    const Sampler sampler(DrawPlan{study});
    const std::size_t column = column_of(study, "path_exponent");
    constexpr int kGearboxes = 2000;
    double sum = 0.0, squares = 0.0, twos = 0.0;
    for (std::uint64_t index = 0; index < kGearboxes; ++index) {
        const std::vector<InputExchange> none, others{{5000 + index, 0.3}, {9000 + index, 0.6}};
        // Computed by the quantile of the input's normal number, also without exchanges.
        const auto with = [&](std::span<const InputExchange> exchanged) {
            GearboxId id{Group::test, index};
            id.exchanged = exchanged;
            const auto& [drawn_id, inputs, random_values] = sampler.draw(id);
            CHECK(random_values[column] == inputs.path_exponent);
            CHECK(inputs.path_exponent ==
                  standard_normal_cdf(
                      Normals(kSeed, id,
                              with_suffix(StreamPurpose::random_input, "sensor.path_exponent"))()));
            return inputs;
        };
        with(none);
        const InstanceInputs inputs = with(others);
        sum += inputs.path_exponent / kGearboxes;
        squares += inputs.path_exponent * inputs.path_exponent / kGearboxes;
        twos += inputs.gain == 2.0 ? 1.0 / kGearboxes : 0.0;
        CHECK(inputs.gain * (3.0 - inputs.gain) == Approx(2.0));
    }
    CHECK(sum == Approx(0.5).margin(0.02));
    CHECK(squares == Approx(1.0 / 3.0).margin(0.02));
    CHECK(twos == Approx(0.75).margin(0.03));
}

TEST_CASE("Inputs without an underlying normal number are exchanged as a whole") {
    int taken = 0;
    for (std::uint64_t index = 0; index < 200; ++index) {
        const std::vector<InputExchange> other{{1000 + index, 0.2}};
        GearboxId id{Group::test, index};
        id.exchanged = other;
        const std::uint64_t from = source_index(kSeed, id, StreamPurpose::tone_phases);
        CHECK((from == index || from == 1000 + index));
        taken += from == 1000 + index ? 1 : 0;
        CHECK(record_stream(kSeed, id, StreamPurpose::tone_phases)() ==
              gearbox_stream(kSeed, {Group::test, from}, StreamPurpose::tone_phases)());
    }
    CHECK(taken > 20);
    CHECK(taken < 60);
}

}  // namespace gearpod::mc::test_gearbox_streams
