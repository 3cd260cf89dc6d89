// Checks random numbers, distributions, and gearboxes and planets sampled from them.
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cstring>
#include <variant>

#include "mc/files/input/document.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "signals/noise/normals.hpp"
#include "tests/mc/plan/random_samples.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_sampling {

using namespace tests;
using test::mean_of;
using tests::samples_of;

Study study_with(const std::vector<std::string>& overrides) {
    return gearpod::test::study_of_text(kExampleStudy, overrides);
}

bool same(const InstanceInputs& a, const InstanceInputs& b) {
    return a.bodies[Member::planet].bearing_stiffness_N_m ==
               b.bodies[Member::planet].bearing_stiffness_N_m &&
           a.path_exponent == b.path_exponent && a.fault_size == b.fault_size;
}

TEST_CASE("Philox reproduces its authors' reference values") {
    // Source: Random123, tests/kat_vectors, philox4x64 with 10 rounds: counter, key, output.
    using Engine = r123::Philox4x64;
    const std::uint64_t ones = ~std::uint64_t{0};
    CHECK(Engine{}(Engine::ctr_type{{0, 0, 0, 0}}, Engine::key_type{{0, 0}}) ==
          Engine::ctr_type{{0x16554d9eca36314cu, 0xdb20fe9d672d0fdcu, 0xd7e772cee186176bu,
                            0x7e68b68aec7ba23bu}});
    CHECK(Engine{}(Engine::ctr_type{{ones, ones, ones, ones}}, Engine::key_type{{ones, ones}}) ==
          Engine::ctr_type{{0x87b092c3013fe90bu, 0x438c3c67be8d0224u, 0x9cc7d7c69cd777b6u,
                            0xa09caebf594f0ba0u}});
    CHECK(Engine{}(Engine::ctr_type{{0x243f6a8885a308d3u, 0x13198a2e03707344u, 0xa4093822299f31d0u,
                                     0x082efa98ec4e6c89u}},
                   Engine::key_type{{0x452821e638d01377u, 0xbe5466cf34e90c6cu}}) ==
          Engine::ctr_type{{0xa528f45403e61d95u, 0x38c72dbd566e9788u, 0xa5a1610e72fd18b5u,
                            0x57bd43b5e52b7fe6u}});
}

TEST_CASE("A stream consists of the blocks of its counter in order") {
    Philox stream(0, Group::threshold, 0, StreamPurpose{0});
    CHECK(stream() == 0x16554d9eca36314cu);
    CHECK(stream() == 0xdb20fe9d672d0fdcu);
    stream();
    CHECK(stream() == 0x7e68b68aec7ba23bu);
    const auto second =
        r123::Philox4x64{}(r123::Philox4x64::ctr_type{{1, 0, 0, 0}}, r123::Philox4x64::key_type{});
    CHECK(stream() == second[0]);

    Philox other(5, Group::test, 6, StreamPurpose{7});
    const auto block = r123::Philox4x64{}(r123::Philox4x64::ctr_type{{0, 6, 7, 0}},
                                          r123::Philox4x64::key_type{{5, 1}});
    CHECK(other() == block[0]);
}

TEST_CASE("Words of a stream are the same one by one and in bulk") {
    Philox single(5, Group::test, 6, StreamPurpose{7});
    Philox many(5, Group::test, 6, StreamPurpose{7});
    for (const std::size_t count : {1, 2, 9, 4, 0, 3, 16, 5}) {
        std::vector<std::uint64_t> words(count);
        many.fill(words);
        for (const std::uint64_t word : words) {
            CHECK(word == single());
        }
        CHECK(many() == single());
    }
}

TEST_CASE("Normal noise of different gearboxes, groups, purposes and seeds is uncorrelated") {
    constexpr std::size_t kCount = 20000;
    const auto normals = [](Philox stream) {
        std::vector<double> values(kCount);
        gearpod::signals::draw_normals(stream, values);
        return values;
    };
    const std::vector<std::vector<double>> noise{
        normals({7, Group::test, 3, StreamPurpose{11}}),
        normals({7, Group::test, 4, StreamPurpose{11}}),
        normals({7, Group::test, 3, StreamPurpose{12}}),
        normals({7, Group::threshold, 3, StreamPurpose{11}}),
        normals({8, Group::test, 3, StreamPurpose{11}})};
    for (std::size_t a = 0; a < noise.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            const double product =
                std::inner_product(noise[a].begin(), noise[a].end(), noise[b].begin(), 0.0);
            CHECK(std::abs(product) < 4.0 * std::sqrt(static_cast<double>(kCount)));
        }
    }
}

TEST_CASE("Random values of each distribution follow its distribution function") {
    const boost::math::normal normal;
    const auto phi = [&](double x) { return boost::math::cdf(normal, x); };

    const auto check = [](const std::string& law, const std::function<double(double)>& cdf) {
        INFO(law);
        CHECK(kolmogorov_smirnov(samples_of("{distribution=" + law + "}", kSamples), cdf) <
              kKsLimit);
    };
    check("'uniform', low=-2, high=3", [](double x) { return (x + 2) / 5; });
    check("'normal', mean=5, sd=2", [&](double x) { return phi((x - 5) / 2); });
    const boost::math::lognormal lognormal(std::log(3.0), std::sqrt(std::log(1 + 0.4 * 0.4)));
    check("'lognormal', median=3, cv=0.4",
          [&](double x) { return boost::math::cdf(lognormal, x); });
    check("'triangular', low=0, mode=1, high=4",
          [](double x) { return x <= 1 ? x * x / 4 : 1 - (4 - x) * (4 - x) / 12; });
    // Truncation around the mean, in the upper tail, in the lower tail.
    const double bounds[][2] = {{-1, 0.5}, {4, 5}, {-9, -6}};
    for (const auto& [low, high] : bounds) {
        // Differences of small tails, not of values near one.
        const double sign = low >= 0 ? -1.0 : 1.0;
        const double below = phi(sign * low), above = phi(sign * high);
        check("'truncated-normal', mean=0, sd=1, low=" + std::to_string(low) +
                  ", high=" + std::to_string(high),
              [&, a = below, b = above](double x) { return (phi(sign * x) - a) / (b - a); });
    }
}

TEST_CASE("Moments of the random values are those of the closed forms") {
    const auto lognormal = samples_of("{distribution='lognormal', median=2, cv=0.5}", kSamples);
    // Mean median sqrt(1 + cv^2), standard deviation cv times the mean; five standard errors.
    const double mean = 2 * std::sqrt(1.25), sd = 0.5 * mean, root = std::sqrt(1.0 * kSamples);
    CHECK(mean_of(lognormal) == Approx(mean).margin(5 * sd / root));
    double squares = 0.0;
    for (const double x : lognormal) {
        squares += (x - mean) * (x - mean);
    }
    CHECK(std::sqrt(squares / kSamples) == Approx(sd).epsilon(0.03));

    const auto triangular =
        samples_of("{distribution='triangular', low=0, mode=1, high=4}", kSamples);
    CHECK(mean_of(triangular) == Approx(5.0 / 3).margin(5 * 0.85 / root));
}

TEST_CASE("Medians agree with the distribution function") {
    const auto median_of = [](const std::string& text) { return distribution_of(text).median(); };
    CHECK(median_of("{distribution='uniform', low=1, high=4}") == 2.5);
    // Median of F(x) = 1 - (4 - x)^2 / 12.
    CHECK(median_of("{distribution='triangular', low=0, mode=1, high=4}") ==
          Approx(4 - std::sqrt(6.0)));
    CHECK(median_of("{distribution='triangular', low=-4, mode=-1, high=0}") ==
          Approx(std::sqrt(6.0) - 4));
    CHECK(median_of("{distribution='truncated-normal', mean=1, sd=2, low=-1, high=3}") ==
          Approx(1));
    CHECK(median_of("{distribution='grid', low=0, high=1, count=4}") == Approx(1.0 / 3));
    CHECK(median_of("{distribution='levels', values=[5, 1, 3]}") == 3);
}

TEST_CASE("Truncated normals keep their bounds even far in the tails") {
    for (const char* text : {"{distribution='truncated-normal', mean=0, sd=1, low=-30, high=30}",
                             "{distribution='truncated-normal', mean=0, sd=1, low=29, high=1e6}",
                             "{distribution='truncated-normal', mean=0, sd=1, low=-1e6, high=-29}",
                             "{distribution='truncated-normal', mean=1, sd=1e-3, low=0, high=2}"}) {
        for (const double x : samples_of(text, 2000)) {
            CHECK(std::isfinite(x));
            CHECK(std::abs(x) < 30.01);
        }
    }
}

TEST_CASE("Levels and grids alternate in the test group and are 0 in the threshold group") {
    const Sampler sampler(DrawPlan{study_with({})});
    const double depths_mm[] = {0, 1, 2, 3, 4.3};
    for (std::uint64_t i = 0; i < 12; ++i) {
        CHECK(sampler.draw({Group::test, i}).inputs.fault_size == Approx(depths_mm[i % 5] * 1e-3));
        CHECK(sampler.draw({Group::threshold, i}).inputs.fault_size == 0.0);
    }
    const auto grid = samples_of("{distribution='grid', low=0, high=1, count=3}", 4);
    CHECK(grid == std::vector<double>{0.0, 0.5, 1.0, 0.0});
}

TEST_CASE("Levels and grids of several inputs form all combinations, each equally often") {
    std::vector<std::string> overrides{
        "random.fault.depth_mm.values=[0, 1, 2, 3]",
        "random.gearbox.sun.mass_kg={distribution='grid', low=1, high=4, count=4}",
        "random.sensor.noise_m_s2={distribution='grid', low=0, high=3, count=4}"};
    const Sampler sampler(DrawPlan{study_with(overrides)});
    // Another random input, and one of constant value, change no random value.
    overrides.push_back("random.operation.torque_N_m={distribution='uniform', low=1, high=2}");
    overrides.push_back("random.gearbox.ring.mass_kg={distribution='constant', value=3}");
    const Sampler more(DrawPlan{study_with(overrides)});
    for (const Group group : {Group::test, Group::threshold}) {
        std::set<std::tuple<double, double, double>> combinations;
        for (std::uint64_t i = 0; i < 64; ++i) {
            const InstanceInputs x = sampler.draw({group, i}).inputs;
            combinations.insert({x.fault_size, x.bodies[Member::sun].mass_kg, x.noise_m_s2});
            if (group == Group::test) {
                CHECK(x.fault_size == Approx(1e-3 * static_cast<double>(i % 4)));
            }
            const InstanceInputs y = more.draw({group, i}).inputs;
            CHECK(y.bodies[Member::ring].mass_kg == 3.0);
            CHECK(same(x, y));
            CHECK(x.bodies[Member::sun].mass_kg == y.bodies[Member::sun].mass_kg);
            CHECK(x.noise_m_s2 == y.noise_m_s2);
        }
        CHECK(combinations.size() == (group == Group::test ? 64 : 16));
    }
    // The order of the schema determines the combinations: the mass varies faster than the noise.
    CHECK(sampler.draw({Group::test, 4}).inputs.bodies[Member::sun].mass_kg == 2.0);
    CHECK(sampler.draw({Group::test, 4}).inputs.noise_m_s2 == 0.0);
    CHECK(sampler.draw({Group::test, 16}).inputs.noise_m_s2 == 1.0);

    // More combinations than there are instance numbers.
    overrides.clear();
    for (const char* key : {"sun_mass_kg", "planet_mass_kg", "ring_mass_kg", "carrier_mass_kg"}) {
        overrides.push_back("random.gearbox." + std::string(key) +
                            "={distribution='grid', low=1, high=2, count=100000}");
    }
    const InstanceInputs last =
        Sampler(DrawPlan{study_with(overrides)}).draw({Group::test, 999999999}).inputs;
    CHECK(last.bodies[Member::sun].mass_kg == Approx(1 + 99999 / 99999.0));
    CHECK(last.bodies[Member::ring].mass_kg == 1.0);
    CHECK(last.bodies[Member::carrier].mass_kg == 1.0);
}

TEST_CASE("An instance does not depend on what was sampled before and how often") {
    const Sampler forward(DrawPlan{study_with({})}), backward(DrawPlan{study_with({})});
    std::vector<InstanceInputs> first = test::tabulated(50, [&](std::uint64_t i) {
        return forward.draw({Group::test, i}).inputs;
    });
    for (std::uint64_t i = 50; i-- > 0;) {
        CHECK(same(backward.draw({Group::test, i}).inputs, first[i]));
    }
    CHECK_FALSE(same(forward.draw({Group::threshold, 5}).inputs, first[5]));
    const Sampler reseeded(DrawPlan{study_with({"ensemble.seed=8"})});
    CHECK_FALSE(same(reseeded.draw({Group::test, 5}).inputs, first[5]));
}

TEST_CASE("A new random input leaves the random values of the others unchanged") {
    const Sampler before(DrawPlan{study_with({})});
    const Sampler after(DrawPlan{study_with(
        {"random.gearbox.sun.mass_kg={distribution='uniform', low=0.6, high=0.8}",
         "random.operation.torque_N_m={distribution='lognormal', median=429, cv=0.05}"})});
    for (std::uint64_t i = 0; i < 50; ++i) {
        CHECK(same(before.draw({Group::test, i}).inputs, after.draw({Group::test, i}).inputs));
        CHECK(same(before.draw({Group::threshold, i}).inputs,
                   after.draw({Group::threshold, i}).inputs));
    }
}

TEST_CASE("Different inputs of the same distribution are independent") {
    const Sampler sampler(DrawPlan{
        study_with({"random.gearbox.sun.mass_kg={distribution='uniform', low=1, high=2}",
                    "random.gearbox.ring.mass_kg={distribution='uniform', low=1, high=2}"})});
    double products = 0.0;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
        const InstanceInputs inputs = sampler.draw({Group::test, i}).inputs;
        products += 12 * (inputs.bodies[Member::sun].mass_kg - 1.5) *
                    (inputs.bodies[Member::ring].mass_kg - 1.5);
    }
    CHECK(std::abs(products / kSamples) < 5 / std::sqrt(1.0 * kSamples));  // correlation
}

TEST_CASE("Inertias come from J / r^2, J, or a solid disc on the pitch radius") {
    const InstanceInputs disc = nominal_inputs(study_with({}));
    const double cosine = std::cos(M_PI / 9);
    CHECK(disc.bodies[Member::sun].inertia_over_r2_kg == Approx(0.7 / (2 * cosine * cosine)));
    CHECK(disc.bodies[Member::ring].inertia_over_r2_kg == Approx(5.982 / (2 * cosine * cosine)));
    CHECK(disc.bodies[Member::carrier].inertia_over_r2_kg == Approx(5.0));

    const InstanceInputs given = nominal_inputs(
        study_with({"gearbox.planet.inertia_kg_m2=2e-3", "gearbox.carrier.inertia_kg_m2=0.1",
                    "gearbox.sun.inertia_over_r2_kg=0.39"}));
    const double base_m = 0.5 * 3.175e-3 * 31 * cosine, centre_m = 0.5 * 3.175e-3 * (19 + 31);
    CHECK(given.bodies[Member::planet].inertia_over_r2_kg == Approx(2e-3 / (base_m * base_m)));
    CHECK(given.bodies[Member::carrier].inertia_over_r2_kg == Approx(0.1 / (centre_m * centre_m)));
    CHECK(given.bodies[Member::sun].inertia_over_r2_kg == 0.39);
}

void check_columns(const EnsemblePlan& plan, const std::vector<std::string>& names) {
    CHECK(test::mapped(plan.inputs, [](const auto& column) {
              return column.name + " [" + column.unit + "]";
          }) == names);
}

TEST_CASE("A fixed-shaft gearbox's inputs are sampled like any other's") {
    const std::vector<std::string> overrides{
        "random.gearbox.motor_coupling_stiffness_N_m_rad={distribution='lognormal', median=4.4e4, "
        "cv=0.2}",
        "random.operation.load_torque_N_m={distribution='uniform', low=28, high=31}",
        "random.fault.chip_mm={distribution='levels', values=[0, 4, 8]}"};
    const Study study = gearpod::test::study_of_text(kFixedShaftStudy, overrides);
    const Sampler sampler(DrawPlan{study});
    CHECK(speed_member(study) == Member::pinion);
    check_columns(EnsemblePlan(study), {"motor_coupling_stiffness_N_m_rad [N m/rad]",
                                        "load_torque_N_m [N m]", "fault_chip_m [m]"});
    std::set<double> stiffnesses;
    for (std::uint64_t i = 0; i < 6; ++i) {
        const Realization drawn = sampler.draw({Group::test, i});
        const InstanceInputs& x = drawn.inputs;
        CHECK(x.fault_size == Approx(4e-3 * static_cast<double>(i % 3)));
        CHECK(x.fixed_shaft.load_torque_N_m >= 28.0);
        CHECK(x.fixed_shaft.load_torque_N_m <= 31.0);
        CHECK(sampler.draw({Group::threshold, i}).inputs.fault_size == 0.0);
        stiffnesses.insert(x.fixed_shaft.motor_coupling_stiffness_N_m_rad);
        CHECK(drawn.random_values ==
              std::vector<double>{x.fixed_shaft.motor_coupling_stiffness_N_m_rad,
                                  x.fixed_shaft.load_torque_N_m});
    }
    CHECK(stiffnesses.size() == 6);
}

TEST_CASE("A fixed-shaft gearbox's discs and balanced load follow from its gears") {
    // Source: Tian (2004), Table 4.1; the inertias are discs of the pitch radii.
    std::string text = kFixedShaftStudy;
    for (const char* line : {"pinion.inertia_kg_m2 = 4.3659e-4\n",
                             "gear.inertia_kg_m2 = 8.3602e-3\n", "load_torque_N_m = 48.8\n"}) {
        text = replaced(text, line, "");
    }
    const InstanceInputs inputs = nominal_inputs(gearpod::test::study_of_text(text));
    CHECK(inputs.bodies[Member::pinion].inertia_kg_m2 == Approx(4.3659e-4).epsilon(5e-4));
    CHECK(inputs.bodies[Member::gear].inertia_kg_m2 == Approx(8.3602e-3).epsilon(5e-4));
    CHECK(inputs.fixed_shaft.load_torque_N_m == Approx(11.9 * 48 / 19));
}

TEST_CASE("Rows of the results hold the sampled values in SI under their names") {
    const Study study =
        study_with({"random.operation.carrier_speed_rpm={distribution='uniform', low=8, high=9}"});
    const Sampler sampler(DrawPlan{study});
    const EnsemblePlan plan(study);
    check_columns(plan, {"planet_bearing_stiffness_N_m [N/m]", "carrier_speed_rad_s [rad/s]",
                         "path_exponent [1]", "fault_depth_m [m]"});
    CHECK(speed_member(study) == Member::carrier);
    for (const Group group : {Group::test, Group::threshold}) {
        const Realization drawn = sampler.draw({group, 3});
        std::vector<double> row;
        plan.append_inputs(drawn.random_values, 1.0, row);
        CHECK(row == std::vector<double>{drawn.inputs.bodies[Member::planet].bearing_stiffness_N_m,
                                         drawn.inputs.speed_rad_s, drawn.inputs.path_exponent});
    }
}

TEST_CASE("Planets differ by given and by random deviations, independently in each gearbox") {
    const Study given = study_with(
        {"gearbox.pin_tangential_um=[10, 0, 0, 0]", "gearbox.pin_radial_um=[0, 5, 0, 0]"});
    const Planets listed = nominal_inputs(given).planets;
    // Planet 1 lies on the x axis and moves towards y, planet 2 on the y axis.
    CHECK(listed[0].pin_x_m == Approx(0.0).margin(1e-20));
    CHECK(listed[0].pin_y_m == Approx(10e-6));
    CHECK(listed[1].pin_x_m == Approx(0.0).margin(1e-20));
    CHECK(listed[1].pin_y_m == Approx(5e-6));

    const std::vector<std::string> scatter{"gearbox.pin_tangential_rms_um=8",
                                           "gearbox.pin_radial_rms_um=3"};
    const Sampler sampler(DrawPlan{study_with(scatter)});
    double tangential = 0.0, radial = 0.0;
    constexpr int kGearboxes = 2000;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        const Planets planets = sampler.draw({Group::test, i}).inputs.planets;
        for (int n = 0; n < 4; ++n) {
            const double psi = 0.5 * std::numbers::pi * n;
            const auto& p = planets[static_cast<std::size_t>(n)];
            const double along = p.pin_y_m * std::cos(psi) - p.pin_x_m * std::sin(psi);
            const double out = p.pin_x_m * std::cos(psi) + p.pin_y_m * std::sin(psi);
            tangential += along * along / (4 * kGearboxes);
            radial += out * out / (4 * kGearboxes);
        }
        CHECK(planets[4].pin_x_m == 0.0);  // there is no fifth planet
    }
    CHECK(std::sqrt(tangential) == Approx(8e-6).epsilon(0.04));
    CHECK(std::sqrt(radial) == Approx(3e-6).epsilon(0.04));
    // A random scatter scales the deviations of its gearbox.
    const std::vector<std::string> twice{"gearbox.pin_tangential_rms_um=16",
                                         "gearbox.pin_radial_rms_um=6"};
    const Planets once = sampler.draw({Group::test, 7}).inputs.planets;
    const Planets twice_as_far =
        Sampler(DrawPlan{study_with(twice)}).draw({Group::test, 7}).inputs.planets;
    CHECK(twice_as_far[2].pin_x_m == Approx(2.0 * once[2].pin_x_m));
}

TEST_CASE("Different planets repeat every mesh: reused records equal integration of all meshes") {
    const auto features = [](const std::vector<std::string>& overrides) {
        Study study = gearpod::test::shipped_study(
            "planet-crack-ideal.toml",
            gearpod::test::joined(overrides,
                                  {"operation.carrier_speed_rpm=60", "sensor.sampling_Hz=20000",
                                   "sensor.encoder_sampling_Hz=20000", "sensor.noise_levels=[0]"}));
        study.ensemble.threshold_instances = 1;
        study.ensemble.instances = 7;
        const Results results = gearpod::test::run(study);
        std::vector<double> values;
        for (const auto& feature : results.features) {
            values.insert(values.end(), feature.values.begin(), feature.values.end());
        }
        return values;
    };
    const std::vector<std::string> unlike{"gearbox.pin_tangential_rms_um=20",
                                          "gearbox.pin_radial_rms_um=20"};
    const auto reused = features(unlike), alike = features({}),
               full_horizon = features(gearpod::test::joined(unlike, {"numerics.horizon=full"}));
    REQUIRE(reused.size() == full_horizon.size());
    double moved = 0.0;
    for (std::size_t i = 0; i < reused.size(); ++i) {
        INFO(i);
        CHECK(reused[i] == Approx(full_horizon[i]).epsilon(1e-6).margin(1e-6));
        moved = std::max(moved, std::abs(reused[i] / alike[i] - 1.0));
    }
    CHECK(moved > 0.02);
}

bool equal_inputs(const InstanceInputs& a, const InstanceInputs& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST_CASE("A drawn value of any input gives the gearbox of a study with this nominal value") {
    for (const std::string& text : {tests::kExampleStudy, tests::kFixedShaftStudy}) {
        Study study = gearpod::test::study_of_text(text);
        study.random.clear();
        REQUIRE_FALSE(has_random_planets(study));
        const Sampler sampler(DrawPlan{study});
        int effective = 0;
        for (const Key& key : schema()) {
            if (!key.may_be_random()) {
                continue;
            }
            INFO(key.path());
            const auto& access = std::get<NumberAccess>(key.access);
            const double value = 1.25 * access.get(study).value_or(2.0) + 0.125;
            Study other = study;
            access.set(other, value);
            const std::vector<GivenInput> given{{input_id(key.path()), value}};
            const InstanceInputs inputs = sampler.draw({Group::test, 0}, given).inputs;
            CHECK(equal_inputs(inputs, nominal_inputs(other)));
            effective += equal_inputs(inputs, nominal_inputs(study)) ? 0 : 1;
        }
        CHECK(effective > 20);
    }
}

}  // namespace gearpod::mc::test_sampling
