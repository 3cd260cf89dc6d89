// Checks the table of features: its entries, and the signals that follow from their parameters.
#include "features/feature.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_all_features {

TEST_CASE("Every feature is registered once, with its unit, alarm side and definition") {
    int basic = 0;
    std::set<std::string_view> titles;
    for (const Feature& feature : all_features()) {
        basic += feature.basic() ? 1 : 0;
        CHECK(find_feature(feature.name) == &feature);
        CHECK(!feature.unit.empty());
        CHECK(!feature.doc.empty());
        CHECK(titles.insert(feature.title).second);  // says which feature it is
        CHECK(feature.title.find('_') == std::string_view::npos);
        const bool falls = feature.name == "te_fc" || feature.name == "own_te_fc" ||
                           feature.name == "baseline_correlation";
        CHECK((feature.alarm == AlarmSide::low) == falls);
    }
    CHECK(basic == 7);
    CHECK(find_feature("te_RMS") == nullptr);
}

TEST_CASE("Equal external features have one address, and the one declared last is found") {
    Feature own;
    own.name = "own_of_user";
    own.external = true;
    const Feature* const first = &declare_feature(own);
    CHECK(find_feature("own_of_user") == first);
    own.alarm = AlarmSide::low;
    const Feature* const second = &declare_feature(own);
    CHECK(second != first);
    CHECK(find_feature("own_of_user") == second);
    own.alarm = AlarmSide::high;
    CHECK(&declare_feature(own) == first);
    CHECK(find_feature("own_of_user") == first);
    CHECK(find_feature("own_of") == nullptr);
}

TEST_CASE("A feature needs the signals of its parameters") {
    const auto needs = [](const char* name) { return find_feature(name)->needs; };
    CHECK(needs("te_fm4").has<TeParts>());
    CHECK(!find_feature("te_fm4")->from_sensor);
    CHECK(!needs("te_fm4").has<TeTurn, SensorTurn, HealthyRecords>());
    CHECK(needs("na4").has<SensorTurn>());
    CHECK(needs("na4").has<HealthyRecords>());
    CHECK(find_feature("na4")->from_sensor);
    CHECK(needs("sun_window_ratio").within(SignalSet::of<ToothRms<gears::Member::sun>>()));
    CHECK(needs("ring_window_m8a").overlaps(kCentralGears));
    CHECK(!needs("window_m8a").overlaps(kCentralGears));
    CHECK(needs("own_frms").has<FilteredSensor>());
    CHECK(SignalSet().empty());
    CHECK(!needs("te_rms").empty());
}

TEST_CASE("A feature of a gear uses the teeth of that gear") {
    const std::vector<double> even(19, 2.0);
    std::vector<double> odd(even);
    odd[3] = 5.0;
    FeatureInput input;
    input.get<ToothRms<gears::Member::planet>>() = {even};
    input.get<ToothMoments<gears::Member::planet>>() = {even, odd, odd};
    input.get<ToothRms<gears::Member::sun>>() = {odd};
    input.get<ToothMoments<gears::Member::sun>>() = {even, odd, even};
    input.get<ToothRms<gears::Member::ring>>() = {even};
    input.get<ToothMoments<gears::Member::ring>>() = {odd, even, odd};
    const auto value = [&](const std::string& name) { return find_feature(name)->value(input); };
    CHECK(value("window_ratio") == 1.0);
    CHECK(value("sun_window_ratio") == 2.5);
    CHECK(value("ring_window_ratio") == 1.0);
    CHECK(value("window_z") == 0.0);
    CHECK(value("sun_window_z") > 1e5);
    CHECK(value("ring_window_z") == 0.0);
    CHECK(value("window_kurtosis") == 1.0);
    CHECK(value("window_crest") == 2.5);
    CHECK(value("window_m8a") == 2.5);
    CHECK(value("sun_window_kurtosis") == 1.0);
    CHECK(value("sun_window_crest") == 2.5);
    CHECK(value("sun_window_m8a") == 1.0);
    CHECK(value("ring_window_kurtosis") == 2.5);
    CHECK(value("ring_window_crest") == 1.0);
    CHECK(value("ring_window_m8a") == 2.5);
}

TEST_CASE("Features compare a record with its baseline and with the change since then") {
    const std::vector<double> now{1.0, 1.0, 3.0}, before{1.0, 1.0, 2.0}, since{1.0, 1.0, 4.0};
    FeatureInput input, baseline, change;
    input.baseline = &baseline;
    input.change = &change;
    input.get<ToothRms<gears::Member::planet>>() = {now};
    baseline.get<ToothRms<gears::Member::planet>>() = {before};
    change.get<ToothRms<gears::Member::planet>>() = {since};
    CHECK(find_feature("window_ratio")->value(input) == 3.0);
    CHECK(find_feature("own_window_ratio")->value(input) == 1.5);
    CHECK(find_feature("change_window_ratio")->value(input) == 4.0);
    CHECK(!find_feature("own_window_ratio")->basic());
    CHECK(!find_feature("change_window_ratio")->basic());
}

}  // namespace gearpod::features::test_all_features
