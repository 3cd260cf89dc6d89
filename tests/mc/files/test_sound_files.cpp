// Checks sound files: all containers give the values that were written.
#include <sndfile.h>

#include "tests/mc/files/recorded.hpp"
#include "tests/mc/recording_bytes.hpp"

namespace test_sound_files {

using namespace gearpod;
using namespace gearpod::test;

namespace {

using Catch::Contains;

TEST_CASE("a WAV file gives its samples as fractions of the full scale, and its rate") {
    const Folder folder;
    const std::vector<double> values = sine_values(1001, 0.9);
    const std::pair<WavForm, double> forms[] = {
        {WavForm::whole_8, 0.5 / 128},      {WavForm::whole_16, 0.5 / 32768},
        {WavForm::whole_24, 0.5 / 8388608}, {WavForm::whole_32, 0.5 / 2147483648.0},
        {WavForm::floating_32, 0x1p-24},    {WavForm::floating_64, 0.0}};
    for (const auto& [form, rounding] : forms) {
        const auto file =
            mc::open_signal_file(file_with(folder, "a.wav", wav_bytes(values, 1, 5000, form)));
        CHECK(file->sampling_Hz() == 5000.0);
        REQUIRE(file->names() == std::vector<std::string>{"sensor"});
        CHECK(largest_difference(file->read("sensor"), values) <= rounding);
    }
}

TEST_CASE("integers of a WAV file are divided by exactly the full scale") {
    const Folder folder;
    const std::vector<double> values = sine_values(300, 0.9);
    const std::pair<WavForm, double> forms[] = {{WavForm::whole_8, 128.0},
                                                {WavForm::whole_16, 32768.0},
                                                {WavForm::whole_24, 8388608.0},
                                                {WavForm::whole_32, 2147483648.0}};
    for (const auto& [form, full] : forms) {
        const auto read =
            mc::open_signal_file(file_with(folder, "a.wav", wav_bytes(values, 1, 5000, form)))
                ->read("sensor");
        REQUIRE(read.size() == values.size());
        bool equal = true;
        for (std::size_t i = 0; i < read.size(); ++i) {
            equal = equal && read[i] == static_cast<double>(std::llround(values[i] * full)) / full;
        }
        CHECK(equal);
    }
}

TEST_CASE("the channels of a WAV file are separated") {
    const Folder folder;
    std::vector<double> both;
    const std::vector<double> first = sine_values(9000, 0.5), second = sine_values(9000, -0.25);
    for (std::size_t i = 0; i < first.size(); ++i) {
        both.insert(both.end(), {first[i], second[i]});
    }
    const auto file = mc::open_signal_file(
        file_with(folder, "a.wav", wav_bytes(both, 2, 48000, WavForm::floating_64)));
    REQUIRE(file->names() == std::vector<std::string>{"channel1", "channel2"});
    CHECK(file->read("channel1") == first);
    CHECK(file->read("channel2") == second);
}

// Writes integers of the top `bits` bits of 32.
std::string sound_file(const Folder& folder, const std::string& name, int format, int bits) {
    SF_INFO info{};
    info.samplerate = 25600;
    info.channels = 2;
    info.format = format;
    SNDFILE* const file = sf_open(folder.file(name).c_str(), SFM_WRITE, &info);
    REQUIRE(file != nullptr);
    std::vector<int> values;
    for (int i = 0; i < 10000; ++i) {
        values.push_back(static_cast<int>(static_cast<unsigned>(i * 7919 - 30000) << (32 - bits)));
    }
    REQUIRE(sf_write_int(file, values.data(), 10000) == 10000);
    sf_close(file);
    return folder.file(name);
}

TEST_CASE("RF64, Wave64, FLAC, AIFF, AU and CAF give the same values as WAV") {
    const Folder folder;
    for (const auto& [subtype, bits] :
         {std::pair{SF_FORMAT_PCM_16, 16}, std::pair{SF_FORMAT_PCM_24, 24}}) {
        const auto wav =
            mc::open_signal_file(sound_file(folder, "a.wav", SF_FORMAT_WAV | subtype, bits));
        const auto expected = wav->read("channel2");
        REQUIRE(expected.size() == 5000);
        CHECK(expected[1] == std::ldexp(3 * 7919 - 30000, 1 - bits));
        const std::pair<const char*, int> others[] = {
            {"a.rf64", SF_FORMAT_RF64}, {"b.wav", SF_FORMAT_RF64},  {"a.w64", SF_FORMAT_W64},
            {"a.flac", SF_FORMAT_FLAC}, {"a.aiff", SF_FORMAT_AIFF}, {"a.au", SF_FORMAT_AU},
            {"a.caf", SF_FORMAT_CAF}};
        for (const auto& [name, container] : others) {
            INFO(name << " " << bits);
            const auto file =
                mc::open_signal_file(sound_file(folder, name, container | subtype, bits));
            CHECK(file->sampling_Hz() == 25600.0);
            CHECK(file->read("channel1") == wav->read("channel1"));
            CHECK(file->read("channel2") == expected);
        }
    }
}

TEST_CASE("12 bits in 16 are fractions of the full scale") {
    const Folder folder;
    const std::vector<double> values = sine_values(200, 0.5);
    std::string bytes = wav_bytes(values, 1, 5000, WavForm::whole_16);
    bytes[34] = 12;
    const auto file = mc::open_signal_file(file_with(folder, "a.wav", bytes));
    CHECK(largest_difference(file->read("sensor"), values) <= 0.5 / 32768);
}

TEST_CASE("a sound file that is truncated, damaged or compressed with loss is refused by reason") {
    const Folder folder;
    const std::vector<double> values = sine_values(4000, 0.5);
    const std::string wav = wav_bytes(values, 1, 5000, WavForm::whole_16);
    const auto error_of = [&](const std::string& name, const std::string& bytes) {
        return reading_error(file_with(folder, name, bytes));
    };
    CHECK_THAT(error_of("a.wav", wav.substr(0, 30)), Contains("a.wav: "));
    CHECK_THAT(error_of("a.wav", wav.substr(0, 4044)),
               Contains("a.wav: is truncated: 4000 bytes are missing"));
    std::string changed = wav;
    changed.replace(24, 4, 4, '\0');
    CHECK_THAT(error_of("a.wav", changed), Contains("its header states no valid sampling rate"));
    changed = wav;
    changed.replace(40, 4, "\xF0\xFF\xFF\x7F");
    CHECK_THAT(error_of("a.wav", changed), Contains("is truncated"));
    changed = wav;
    changed.replace(22, 2, 2, '\xFF');  // channels
    CHECK_THAT(error_of("a.wav", changed), Contains("a.wav: is not a sound file, or is damaged"));
    changed.replace(22, 2, 2, '\0');
    CHECK_THAT(error_of("a.wav", changed), Contains("a.wav: is ") && Contains("damaged"));
    // Length of a recording that was written to a pipe.
    changed = wav;
    changed.replace(4, 4, 4, '\xFF');
    changed.replace(40, 4, 4, '\xFF');
    CHECK(error_of("a.wav", changed).empty());
    CHECK_THAT(reading_error(sound_file(folder, "b.wav", SF_FORMAT_WAV | SF_FORMAT_IMA_ADPCM, 16)),
               Contains("is compressed with loss (IMA ADPCM); save it as plain samples"));
    const std::pair<const char*, int> others[] = {{"a.rf64", SF_FORMAT_RF64},
                                                  {"a.w64", SF_FORMAT_W64},
                                                  {"a.flac", SF_FORMAT_FLAC},
                                                  {"a.aiff", SF_FORMAT_AIFF}};
    for (const auto& [name, container] : others) {
        const std::string whole =
            bytes_of(sound_file(folder, name, container | SF_FORMAT_PCM_16, 16));
        for (const double share : {0.4, 0.99}) {
            INFO(name << " " << share);
            const auto kept = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
            const std::string error = error_of(name, whole.substr(0, kept));
            CHECK_THAT(error, Contains("is truncated") || Contains("is damaged"));
        }
    }
}

}  // namespace

}  // namespace test_sound_files
