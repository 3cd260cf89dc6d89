// Checks that purposes of random numbers are stable and have streams of their own.
#include "mc/study/random/philox.hpp"
#include "mc/study/schema/schema.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_stream_purpose {

// Numbers of all purposes. Stored results depend on them: never change one.
constexpr std::pair<StreamPurpose, std::uint64_t> kStableNumbers[] = {
    {StreamPurpose::random_input, 0xcbf29ce484222325u},
    {StreamPurpose::table_row, 0xcca84f0f226b7f25u},
    {StreamPurpose::baseline_torque, 0xf446d155c2b14336u},
    {StreamPurpose::planets, 0xe7e8bf720e731aeeu},
    {StreamPurpose::pitch_errors, 0x90ad7ed49f020ccau},
    {StreamPurpose::index_waves, 0x4606be7d4fee5f3du},
    {StreamPurpose::profile_slopes, 0xc7768219861030d4u},
    {StreamPurpose::torque_noise, 0x4d1a8f8adcd86c06u},
    {StreamPurpose::speed_noise, 0x830ea67b5ae5fd07u},
    {StreamPurpose::tone_phases, 0x2aebedb682410a19u},
    {StreamPurpose::bearing_impulses, 0x65f6a4bd105a4482u},
    {StreamPurpose::stage_start, 0x63ffbc50074125a2u},
    {StreamPurpose::record_start, 0x6cfd7dd3525916a4u},
    {StreamPurpose::assembled_teeth, 0x256fdde146e2f937u},
    {StreamPurpose::sensor_noise, 0x270990c91ac696a3u},
    {StreamPurpose::sensor_noise_direction, 0x2a558d854e0ef780u},
    {StreamPurpose::background_noise, 0x64cff76e7964cdf5u},
    {StreamPurpose::sensor_noise_kind, 0x9f3a2b42eb7f6ea0u},
    {StreamPurpose::encoder_noise, 0x0bd8691ced3b77a7u},
    {StreamPurpose::life_records, 0x4b1bb08a1f409333u},
    {StreamPurpose::life_speeds, 0x02fa218f50312bb7u},
    {StreamPurpose::life_recording_starts, 0x6bd3e54400c5a7e6u},
    {StreamPurpose::reference_noise, 0x7099c65143972b4bu},
    {StreamPurpose::reference_torques, 0x38ea441487ac296du},
    {StreamPurpose::reference_speeds, 0x26d691b6efb781fau},
    {StreamPurpose::calibration_prior, 0x598fc103ee1f623au},
    {StreamPurpose::calibration_record, 0xc89b1e8c6017d224u},
    {StreamPurpose::forecast_signals, 0x534d5b00771b0efdu},
};

TEST_CASE("Suffixes continue the FNV-1a hash with 64 bits") {
    // Test vectors of the authors: "", "a", "foobar".
    CHECK(fnv1a("") == 0xcbf29ce484222325u);
    CHECK(fnv1a("a") == 0xaf63dc4c8601ec8cu);
    CHECK(fnv1a("foobar") == 0x85944171f73967e8u);
    CHECK(with_suffix(StreamPurpose{fnv1a("foo")}, "bar") == StreamPurpose{0x85944171f73967e8u});
}

TEST_CASE("The numbers of all purposes are stable") {
    for (const auto& [purpose, number] : kStableNumbers) {
        CHECK(static_cast<std::uint64_t>(purpose) == number);
    }
}

TEST_CASE("No two streams of a gearbox have the same purpose") {
    std::map<StreamPurpose, std::string> named;
    const auto add = [&](StreamPurpose purpose, const std::string& name) {
        const auto [place, added] = named.emplace(purpose, name);
        INFO(name << " and " << place->second);
        CHECK(added);
    };
    // Every purpose with the suffixes of records, their repetitions, and exchanges.
    const auto add_variants = [&](StreamPurpose purpose, const std::string& name) {
        std::vector<std::string> repeats{""};
        for (int repeat = 1; repeat <= 100; ++repeat) {
            repeats.push_back(".repeat." + std::to_string(repeat));
        }
        for (const std::string& repeat : repeats) {
            for (const char* record : {"", ".baseline", ".baseline.1", ".baseline.99"}) {
                for (const char* exchange : {"", ".exchange"}) {
                    const std::string suffix = repeat + record + exchange;
                    add(with_suffix(purpose, suffix), name + suffix);
                }
            }
        }
    };
    for (const auto& [purpose, number] : kStableNumbers) {
        add_variants(purpose, "purpose " + std::to_string(number));
    }
    for (const Key& key : schema()) {
        if (!key.may_be_random()) {
            continue;
        }
        const std::string path = flat_path(key.path());
        add_variants(with_suffix(StreamPurpose::random_input, path), path);
        add(with_suffix(StreamPurpose::calibration_prior, path), "prior of " + path);
    }
    for (int number = 1; number <= 50; ++number) {
        const std::string text = std::to_string(number);
        add_variants(with_suffix(StreamPurpose::bearing_impulses, text), "bearing " + text);
        for (const auto noise : {StreamPurpose::sensor_noise, StreamPurpose::sensor_noise_direction,
                                 StreamPurpose::background_noise}) {
            add_variants(with_suffix(noise, ".sensor." + text), "noise of sensor " + text);
        }
        add_variants(with_suffix(StreamPurpose::table_row, text), "table " + text);
        for (int record = 0; record < 50; ++record) {
            const std::string both = std::to_string(number - 1) + "." + std::to_string(record);
            add(with_suffix(StreamPurpose::calibration_record, both), "calibration " + both);
        }
    }
}

}  // namespace gearpod::mc::test_stream_purpose
