// Recordings as other programs save them: what is read is what was written.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <vector>

#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/recording_bytes.hpp"

namespace gearpod::test {
namespace {

std::vector<double> sines(std::size_t count, double size) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(size * std::sin(0.37 * static_cast<double>(i)));
    }
    return values;
}

std::string written(const Folder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder.file(name), std::ios::binary) << bytes;
    return folder.file(name);
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(a[i] - b[i]));
    }
    return most;
}

std::string refusal(const std::string& path) {
    try {
        const auto file = mc::open_signal_file(path);
        for (const std::string& name : file->names()) {
            static_cast<void>(file->read(name));
        }
        static_cast<void>(file->sampling_Hz());
    } catch (const mc::SignalError& error) {
        return error.what();
    }
    return "";
}

TEST_CASE("a WAV file gives its samples as shares of the full scale, and its rate") {
    const Folder folder;
    const std::vector<double> values = sines(1001, 0.9);
    const std::pair<WavForm, double> forms[] = {
        {WavForm::whole_8, 0.5 / 128},      {WavForm::whole_16, 0.5 / 32768},
        {WavForm::whole_24, 0.5 / 8388608}, {WavForm::whole_32, 0.5 / 2147483648.0},
        {WavForm::floating_32, 0x1p-24},    {WavForm::floating_64, 0.0}};
    for (const auto& [form, rounding] : forms) {
        const auto file =
            mc::open_signal_file(written(folder, "a.wav", wav_bytes(values, 1, 5000, form)));
        CHECK(file->sampling_Hz() == 5000.0);
        REQUIRE(file->names() == std::vector<std::string>{"sensor"});
        CHECK(farthest(file->read("sensor"), values) <= rounding);
    }
}

TEST_CASE("the channels of a WAV file are told apart") {
    const Folder folder;
    std::vector<double> both;
    const std::vector<double> first = sines(300, 0.5), second = sines(300, -0.25);
    for (std::size_t i = 0; i < first.size(); ++i) {
        both.insert(both.end(), {first[i], second[i]});
    }
    const auto file = mc::open_signal_file(
        written(folder, "a.wav", wav_bytes(both, 2, 48000, WavForm::floating_64)));
    REQUIRE(file->names() == std::vector<std::string>{"channel1", "channel2"});
    CHECK(file->read("channel1") == first);
    CHECK(file->read("channel2") == second);
}

TEST_CASE("a universal file gives its function, its step and its unit, as text and as bytes") {
    const Folder folder;
    const std::vector<double> values = sines(1001, 30.0);
    const std::pair<UffForm, double> forms[] = {{UffForm::text_single, 5e-5},
                                                {UffForm::text_double, 5e-11},
                                                {UffForm::bytes_little, 0.0},
                                                {UffForm::bytes_big, 0.0}};
    for (const auto& [form, rounding] : forms) {
        const auto file =
            mc::open_signal_file(written(folder, "a.uff", uff_bytes(values, 2e-4, "m/s^2", form)));
        REQUIRE(file->names() == std::vector<std::string>{"sensor"});
        CHECK(file->sampling_Hz() == Approx(5000.0));
        CHECK(file->unit("sensor") == "m/s^2");
        CHECK(farthest(file->read("sensor"), values) <= rounding);
    }
}

TEST_CASE("recordings that are cut off or compressed are refused by name") {
    const Folder folder;
    const std::vector<double> values = sines(100, 0.5);
    std::string wav = wav_bytes(values, 1, 5000, WavForm::whole_16);
    std::string compressed = wav;
    compressed[20] = 2;  // ADPCM
    CHECK(refusal(written(folder, "a.wav", compressed)).find("compressed") != std::string::npos);
    CHECK(refusal(written(folder, "a.wav", wav.substr(0, 30))).find("a.wav") != std::string::npos);
    for (const UffForm form : {UffForm::text_double, UffForm::bytes_little}) {
        const std::string uff = uff_bytes(values, 2e-4, "g", form);
        CHECK(refusal(written(folder, "a.uff", uff.substr(0, uff.size() / 2))).find("of 100") !=
              std::string::npos);
    }
    std::string uneven = uff_bytes(values, 0.0, "g", UffForm::text_single);
    CHECK(refusal(written(folder, "a.uff", uneven)).find("step") != std::string::npos);
}

}  // namespace
}  // namespace gearpod::test
