// Checks TDMS files: segments, byte orders, scaling and names.
#include "tests/mc/files/recorded.hpp"
#include "tests/mc/tdms_bytes.hpp"

namespace test_tdms_files {

using namespace gearpod;
using namespace gearpod::test;

namespace {

using Catch::Contains;
using Names = std::vector<std::string>;
using Values = std::vector<double>;

constexpr unsigned kAll = kTdmsMeta | kTdmsNew | kTdmsRaw;

std::unique_ptr<mc::SignalFile> tdms(const Folder& folder, const std::string& bytes) {
    return mc::open_signal_file(file_with(folder, "a.tdms", bytes));
}
std::string tdms_error(const Folder& folder, const std::string& bytes) {
    return reading_error(file_with(folder, "a.tdms", bytes));
}

TEST_CASE("a TDMS file gives its channel, unit and rate, in both byte orders") {
    const Folder folder;
    for (const bool big : {false, true}) {
        const TdmsBytes to(big);
        const Values values = sine_values(100, 3.0);
        const auto file = tdms(
            folder,
            to.segment(
                kAll,
                {to.object("/", to.no_index()), to.object("/'Vibration'", to.no_index()),
                 to.object("/'Vibration'/'sensor'", to.index(10, 100),
                           {to.property("wf_increment", 1.0 / 1024),
                            to.property("wf_start_offset", 0.0), to.property("unit_string", "g")})},
                to.reals(values)));
        CHECK(file->names() == Names{"Vibration/sensor"});
        CHECK(file->find({"sensor"}) == "Vibration/sensor");
        CHECK(file->read("Vibration/sensor") == values);
        CHECK(file->unit("Vibration/sensor") == "g");
        CHECK(file->sampling_Hz() == 1024.0);
    }
}

TEST_CASE("segments of a TDMS file repeat, change and omit the indices of earlier ones") {
    const Folder folder;
    const TdmsBytes to, big(true);
    const std::string a = "/'g'/'a'", b = "/'g'/'b'", words = "/'g'/'words'";
    const std::string texts = to.number(28, 4) + to.number(0x20, 4) + to.number(1, 4) +
                              to.number(2, 8) + to.number(13, 8);
    std::string bytes;
    // Two chunks, with strings between the numbers.
    bytes += to.segment(
        kAll,
        {to.object(a, to.index(10, 2)), to.object(words, texts), to.object(b, to.index(2, 1))},
        to.reals({1, 2}) + to.number(2, 4) + to.number(5, 4) + "hello" + to.number(0xFFFF, 2) +
            to.reals({3, 4}) + to.number(2, 4) + to.number(5, 4) + "world" + to.number(7, 2));
    // No metadata: the same objects.
    bytes += to.segment(
        kTdmsRaw, {},
        to.reals({5, 6}) + to.number(2, 4) + to.number(5, 4) + "again" + to.number(8, 2));
    // The list goes on: a has other lengths, the strings end, b stays.
    bytes += big.segment(kTdmsMeta | kTdmsRaw,
                         {big.object(a, big.index(10, 1)), big.object(words, big.no_index())},
                         big.reals({7}) + big.number(0xFFFE, 2));
    // A new list refers to an earlier index.
    bytes += to.segment(kAll, {to.object(b, to.same_index())}, to.number(10, 2) + to.number(11, 2));
    const auto file = tdms(folder, bytes);
    CHECK(file->names() == Names{"g/a", "g/b"});
    CHECK(file->read("g/a") == Values{1, 2, 3, 4, 5, 6, 7});
    CHECK(file->read("g/b") == Values{-1, 7, 8, -2, 10, 11});
    CHECK(file->sampling_Hz() == std::nullopt);
}

TEST_CASE("interleaved TDMS channels of several types are separated") {
    const Folder folder;
    for (const bool big : {false, true}) {
        const TdmsBytes to(big);
        std::string raw;
        Values whole, real;
        for (int i = 0; i < 6; ++i) {
            whole.push_back(i - 3);
            real.push_back(0.5f * static_cast<float>(i));
            raw += to.number(static_cast<std::uint64_t>(i - 3), 4) +
                   to.number(std::bit_cast<std::uint32_t>(0.5f * static_cast<float>(i)), 4);
        }
        const auto file = tdms(folder, to.segment(kAll | kTdmsInterleaved,
                                                  {to.object("/'g'/'whole'", to.index(3, 3)),
                                                   to.object("/'g'/'real'", to.index(9, 3))},
                                                  raw));
        CHECK(file->read("g/whole") == whole);
        CHECK(file->read("g/real") == real);
    }
}

TEST_CASE("all integer types of TDMS keep their sign") {
    const Folder folder;
    const TdmsBytes to;
    const int widths[] = {1, 2, 4, 8};
    for (unsigned type = 1; type <= 8; ++type) {
        const int width = widths[(type - 1) % 4];
        const std::string raw = to.number(~std::uint64_t{0}, width) + to.number(3, width);
        const double first = type <= 4 ? -1.0 : std::ldexp(1.0, 8 * width) - (width < 8 ? 1 : 0);
        INFO(type);
        CHECK(tdms(folder, to.segment(kAll, {to.object("/'g'/'a'", to.index(type, 2))}, raw))
                  ->read("g/a") == Values{first, 3});
    }
}

TEST_CASE("scales of a TDMS channel are applied one after the other") {
    const Folder folder;
    const TdmsBytes to;
    std::vector<std::string> scales{
        to.property("NI_Scaling_Status", "unscaled"),
        to.property("NI_Number_Of_Scales", std::uint32_t{2}),
        to.property("NI_Scale[0]_Scale_Type", "Polynomial"),
        to.property("NI_Scale[0]_Polynomial_Coefficients_Size", std::uint32_t{3}),
        to.property("NI_Scale[0]_Polynomial_Coefficients[0]", 1.0),
        to.property("NI_Scale[0]_Polynomial_Coefficients[1]", 2.0),
        to.property("NI_Scale[0]_Polynomial_Coefficients[2]", 4.0),
        to.property("NI_Scale[0]_Polynomial_Input_Source", std::uint32_t{0xFFFFFFFF}),
        to.property("NI_Scale[1]_Scale_Type", "Linear"),
        to.property("NI_Scale[1]_Linear_Slope", 0.5),
        to.property("NI_Scale[1]_Linear_Y_Intercept", -3.0),
        to.property("NI_Scale[1]_Linear_Input_Source", std::uint32_t{0})};
    const std::string raw = to.number(0, 2) + to.number(1, 2) + to.number(0xFFFE, 2);
    const auto bytes = [&] {
        return to.segment(kAll, {to.object("/'g'/'a'", to.index(2, 3), scales)}, raw);
    };
    CHECK(tdms(folder, bytes())->read("g/a") == Values{-2.5, 0.5, 3.5});
    scales[8] = to.property("NI_Scale[1]_Scale_Type", "Thermocouple");
    CHECK_THAT(tdms_error(folder, bytes()),
               Contains("column g/a: its scaling Thermocouple is not supported"));
    scales[8] = to.property("NI_Scale[1]_Scale_Type", "Linear");
    scales[11] = to.property("NI_Scale[1]_Linear_Input_Source", std::uint32_t{1});
    CHECK_THAT(tdms_error(folder, bytes()), Contains("its scales form a circle"));
    scales[9] = to.property("comment", 1.0);
    CHECK_THAT(tdms_error(folder, bytes()),
               Contains("lacks the property NI_Scale[1]_Linear_Slope"));
    scales[0] = to.property("NI_Scaling_Status", "scaled");
    CHECK(tdms(folder, bytes())->read("g/a") == Values{0, 1, -2});
}

TEST_CASE("DAQmx channels are read from their buffer and scaled") {
    const Folder folder;
    const TdmsBytes to;
    const auto daqmx = [&](unsigned offset) {
        return to.number(0x1269, 4) + to.number(0xFFFFFFFF, 4) + to.number(1, 4) + to.number(3, 8) +
               to.number(1, 4) + to.number(3, 4) + to.number(0, 4) + to.number(offset, 4) +
               to.number(0, 4) + to.number(0, 4) + to.number(1, 4) + to.number(4, 4);
    };
    const std::vector<std::string> scales{
        to.property("NI_Scaling_Status", "unscaled"),
        to.property("NI_Number_Of_Scales", std::uint32_t{2}),
        to.property("NI_Scale[1]_Scale_Type", "Linear"),
        to.property("NI_Scale[1]_Linear_Slope", 0.25),
        to.property("NI_Scale[1]_Linear_Y_Intercept", 1.0),
        to.property("NI_Scale[1]_Linear_Input_Source", std::uint32_t{0})};
    std::string raw;
    for (const int value : {1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6, -6}) {
        raw += to.number(static_cast<std::uint64_t>(value), 2);
    }
    const auto file =
        tdms(folder,
             to.segment(kAll | kTdmsDaqmx,
                        {to.object("/'g'/'a'", daqmx(0), scales), to.object("/'g'/'b'", daqmx(2))},
                        raw));
    CHECK(file->read("g/a") == Values{1.25, 1.5, 1.75, 2, 2.25, 2.5});
    CHECK(file->read("g/b") == Values{-1, -2, -3, -4, -5, -6});
    std::string digital = daqmx(0);
    digital[0] = 0x6A;
    CHECK_THAT(tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", digital)}, raw)),
               Contains("DAQmx digital lines, which are not supported"));
    CHECK_THAT(tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", daqmx(3))}, raw)),
               Contains("lies outside of its buffer"));
}

TEST_CASE("timestamps of a TDMS file are seconds from the first one") {
    const Folder folder;
    for (const bool big : {false, true}) {
        const TdmsBytes to(big);
        const auto stamp = [&](std::uint64_t seconds, double part) {
            const std::string whole = to.number(seconds, 8);
            const std::string rest =
                to.number(static_cast<std::uint64_t>(std::ldexp(part, 60)) << 4, 8);
            return big ? whole + rest : rest + whole;
        };
        const auto file =
            tdms(folder, to.segment(kAll, {to.object("/'g'/'time'", to.index(0x44, 3))},
                                    stamp(3800000000, 0.75) + stamp(3800000001, 0.25) +
                                        stamp(3800000001, 0.75)));
        CHECK(file->read("g/time") == Values{0, 0.5, 1});
        CHECK(file->unit("g/time") == "s");
    }
}

TEST_CASE("TDMS channels with equal names need their group, and different sampling is refused") {
    const Folder folder;
    const TdmsBytes to;
    const auto sampled = [&](double step, double start) {
        return std::vector{to.property("wf_increment", step),
                           to.property("wf_start_offset", start)};
    };
    const auto bytes = [&](double step, double start) {
        return to.segment(kAll,
                          {to.object("/'it''s'/'a'", to.index(10, 2), sampled(0.5, 0.0)),
                           to.object("/'h'/'a'", to.index(10, 2), sampled(step, start)),
                           to.object("/'h'/'b'", to.index(10, 2), sampled(0.5, 0.0))},
                          to.reals({1, 2, 3, 4, 5, 6}));
    };
    const auto file = tdms(folder, bytes(0.5, 0.0));
    CHECK(file->names() == Names{"it's/a", "h/a", "h/b"});
    CHECK(file->find({"b"}) == "h/b");
    CHECK(file->find({"c"}).empty());
    CHECK(file->find({"a", "", false}).empty());
    CHECK(file->find({"a", "h/b", false}) == "h/a");
    CHECK(file->find({"b", "it's/a", false}).empty());
    CHECK(file->find({"b", "it's/a"}) == "h/b");
    CHECK_THROWS_WITH(file->find({"a"}), Contains("several channels: it's/a, h/a"));
    CHECK(file->read("it's/a") == Values{1, 2});
    CHECK(file->read("h/a") == Values{3, 4});
    CHECK(file->sampling_Hz() == 2.0);
    CHECK_THAT(tdms_error(folder, bytes(0.25, 0.0)), Contains("have different time steps"));
    CHECK_THAT(tdms_error(folder, bytes(0.5, 1.0)), Contains("start at different times"));
    // A column that is not in use does not matter.
    const auto one = tdms(folder, bytes(0.25, 1.0));
    CHECK(one->read("h/b") == Values{5, 6});
    CHECK(one->sampling_Hz() == 2.0);
}

TEST_CASE("a TDMS file that was not closed gives its complete values") {
    const Folder folder;
    const TdmsBytes to;
    const std::string raw = to.reals({1, 2, 3, 4, 5});
    const auto bytes = [&](unsigned contents) {
        return to.segment(
            contents,
            {to.object("/'g'/'a'", to.index(10, 1)), to.object("/'g'/'b'", to.index(10, 1))}, raw,
            false);
    };
    for (const unsigned contents : {kAll, kAll | kTdmsInterleaved}) {
        const auto file = tdms(folder, bytes(contents));
        CHECK(file->read("g/a") == Values{1, 3});
        CHECK(file->read("g/b") == Values{2, 4});
        REQUIRE(file->notes().size() == 1);
        CHECK_THAT(file->notes().front(), Contains("the file was not closed"));
    }
}

TEST_CASE("a damaged TDMS file is refused with the place") {
    const Folder folder;
    const TdmsBytes to;
    const std::string whole = to.segment(
        kAll, {to.object("/'g'/'a'", to.index(10, 4), {to.property("unit_string", "g")})},
        to.reals({1, 2, 3, 4}));
    for (std::size_t kept = 1; kept < whole.size(); ++kept) {
        INFO(kept);
        CHECK_THAT(tdms_error(folder, whole.substr(0, kept)), Contains("a.tdms: "));
    }
    CHECK_THAT(tdms_error(folder, whole + whole.substr(0, 60)),
               Contains(fmt::format("segment at byte {}: it lacks", whole.size())));
    CHECK_THAT(tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", to.index(10, 3))},
                                             to.reals({1, 2, 3, 4}))),
               Contains("not a whole number of chunks"));
    CHECK_THAT(tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", to.same_index())},
                                             to.reals({1}))),
               Contains("refers to an earlier segment that lacks it"));
    CHECK_THAT(tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", to.index(11, 1))},
                                             to.reals({1}))),
               Contains("type 0xb, which is not supported"));
    CHECK_THAT(
        tdms_error(folder, to.segment(kAll, {to.object("/'g'/'a'", to.index(10, 1ULL << 61))},
                                      to.reals({1}))),
        Contains("not a whole number of chunks"));
    CHECK_THAT(
        tdms_error(folder,
                   to.segment(kAll, {to.object(std::string("/'g'/'a\0b'", 10), to.index(10, 1))},
                              to.reals({1}))),
        Contains("has a zero byte in its path"));
    CHECK_THAT(tdms_error(folder, to.segment(kTdmsMeta, {to.object("/'g'", to.no_index())}, "")),
               Contains("has no channel with numbers"));
}

}  // namespace

}  // namespace test_tdms_files
