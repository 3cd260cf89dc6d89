// Checks the choice of steps and mass scaling for an error over the features' scatter on gearboxes
// that the choice did not see.
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_scatter_choice {

// Gearboxes with real teeth at a speed at which a record is short.
Study real_teeth(std::vector<std::string> more = {}) {
    more.insert(
        more.begin(),
        {"operation.carrier_speed_rpm=20", "sensor.noise_levels=[1]",
         "ensemble.threshold_records=1", "detection.false_alarm_rate=0.05",
         "features.use=[\"sensor_rms\",\"window_ratio\",\"te_rms\",\"change_window_ratio\"]",
         "numerics.precision=single", "numerics.lanes=16"});
    Study study = test::shipped_study("fleet-alarms.toml", more);
    study.ensemble.threshold_instances = 32;
    study.ensemble.instances = 32;
    return study;
}

std::vector<double> values(const Scene& scene, const BatchRows& rows, std::size_t feature) {
    const RowShape& shape = scene.ensemble().shape;
    return test::tabulated(rows.count(), [&](std::size_t row) {
        return rows.values[row * shape.values() + shape.value_of(feature, 0)];
    });
}

TEST_CASE("Steps for a share of the scatter keep it on other gearboxes, with fewer steps") {
    const Planner planner(real_teeth({"numerics.scatter_tolerance=0.2"}));
    const ResolvedNumerics resolved = resolve_numerics(planner, planner.facts().numerics);
    REQUIRE(resolved.choice);
    CHECK(resolved.choice->of_scatter);
    CHECK(resolved.choice->error <= 0.2);
    CHECK(resolved.numerics.mass_scaling_Hz > 0.0);
    Numerics own = resolved.numerics;
    own.scatter_tolerance = own.mass_scaling_Hz = 0.0;
    own.steps_per_mesh = 0;
    const Scene chosen = planner.scene(resolved.numerics), reference = planner.scene(own);
    CHECK(2 * chosen.solve().integration().grid.steps.size() <
          reference.solve().integration().grid.steps.size());
    const auto others = test::tabulated(std::uint64_t{16}, [](std::uint64_t i) {
        return GearboxId{Group::threshold, 16 + i};
    });
    const BatchRows here = rows_of_gearboxes(chosen.tile(), chosen.ensemble(), others),
                    there = rows_of_gearboxes(reference.tile(), reference.ensemble(), others);
    for (std::size_t f = 0; f < chosen.features().used.size(); ++f) {
        const std::vector<double> a = values(chosen, here, f), b = values(reference, there, f);
        std::vector<double> errors =
            test::tabulated(a.size(), [&](std::size_t i) { return std::abs(a[i] - b[i]); });
        std::ranges::nth_element(errors, errors.begin() + 8);
        CHECK(errors[8] / 0.6745 < 2.0 * 0.2 * standard_deviation(b));
        CHECK(errors[8] > 0.0);
    }
}

TEST_CASE("A tighter share of the scatter takes more steps, and the choice can be written out") {
    const auto steps_for = [](const char* tolerance) {
        const Study study = real_teeth({std::string("numerics.scatter_tolerance=") + tolerance});
        return resolved_plan(study).solve().integration().grid.steps.size();
    };
    CHECK(steps_for("0.005") > steps_for("0.3"));
    Study study = real_teeth({"numerics.scatter_tolerance=0.3", "numerics.paired_gearboxes=8"});
    const Planner planner(study);
    const ResolvedNumerics resolved = resolve_numerics(planner, study.numerics, true);
    study.numerics = resolved.numerics;
    const auto again = find_numerical_error(planner.with(study.numerics));
    FineRows fine = *resolved.choice->fine;
    const auto known = find_numerical_error(planner.with(study.numerics), nullptr, &fine);
    REQUIRE((again && known));
    CHECK(known->rms == again->rms);
    CHECK(known->pairs.changed[0].values == again->pairs.changed[0].values);
    std::ranges::fill(fine.rows.values, 0.0);  // they are indeed the ones used
    CHECK(find_numerical_error(planner.with(study.numerics), nullptr, &fine)->rms != known->rms);
    test::check_reads_back(study);
    CHECK(resolve_numerics(Planner(study), study.numerics).numerics == study.numerics);
}

TEST_CASE("Features with mass scaling have the same bits for any lanes") {
    Study study = real_teeth({"numerics.integrator=central-difference", "numerics.precision=double",
                              "numerics.mass_scaling_Hz=3000", "numerics.lanes=8"});
    study.ensemble.threshold_instances = 3;
    study.ensemble.instances = 2;
    const std::vector<std::uint64_t> eight = test::feature_bits(study);
    for (const int lanes : {4, 1}) {
        study.numerics.lanes = lanes;
        CHECK(test::feature_bits(study) == eight);
    }
}

TEST_CASE("Pairs have all sizes, also where their number divides that of the gearboxes") {
    Study study = test::shipped_study("planet-crack.toml", {"ensemble.instances=384"});
    const Scene scene(study);
    std::map<double, int> count;
    for (const GearboxId& id : paired_gearboxes(scene.tile(), scene.ensemble(), 15)) {
        ++count[scene.sampler().draw(id).inputs.fault_size];
    }
    CHECK(count.size() == 6);  // healthy ones, and five sizes
    for (const auto& [size, number] : count) {
        CHECK(number == (size > 0.0 ? 3 : 15));
    }
}

TEST_CASE("Faulty gearboxes of pairs share the tiles of short records") {
    const Scene scene(test::shipped_study("planet-crack.toml",
                                          {"ensemble.instances=384", "sensor.record_turns=1.2"}));
    const std::uint64_t together = scene.tile().record.same_positions;
    REQUIRE(together == 16);
    std::set<std::uint64_t> tiles;
    std::set<double> sizes;
    const std::vector<GearboxId> ids = paired_gearboxes(scene.tile(), scene.ensemble(), 15);
    CHECK(ids.size() == 30);
    for (const GearboxId& id : std::span(ids).first(15)) {
        tiles.insert(id.index / together);
        sizes.insert(scene.sampler().draw(id).inputs.fault_size);
    }
    CHECK(tiles.size() == 2);
    CHECK(sizes.size() == 5);
    CHECK(std::ranges::is_sorted(std::span(ids).first(15), {}, &GearboxId::index));
}

TEST_CASE("Pairs of a run with mass scaling are healthy and faulty gearboxes in equal numbers") {
    Study study = test::shipped_study(
        "planet-crack-ideal.toml",
        {"numerics.integrator=central-difference", "numerics.mass_scaling_Hz=3000",
         "numerics.paired_gearboxes=10", "sensor.noise_levels=[1]"});
    study.ensemble.threshold_instances = 40;
    study.ensemble.instances = 28;
    const auto found = find_numerical_error(Planner(study));
    REQUIRE(found);
    // Rows of the run and rows with fine steps are used where they are known.
    const Scene scene(study);
    Progress silent(1, true);
    const Results run = run_ensemble(scene.tile(), scene.ensemble(), silent);
    const ColumnRows rows(run);
    const auto from_run = find_numerical_error(Planner(study), &rows);
    REQUIRE(from_run);
    CHECK(from_run->rms == found->rms);
    CHECK(from_run->largest == found->largest);
    CHECK(found->gearboxes == 10);
    CHECK(std::ranges::count_if(found->pairs.rows, [](std::int64_t row) { return row < 40; }) ==
          10);
    REQUIRE(found->pairs.rows.size() == 20);
    REQUIRE(found->pairs.changed.size() == 1);
    CHECK(found->pairs.changed[0].values == from_run->pairs.changed[0].values);
    // The fine steps are those of the integrator's own rule, without scaling.
    CHECK_FALSE(test::contains(found->finer, "mass_scaling_Hz"));
    CHECK(test::contains(found->setting, "mass_scaling_Hz=3000"));

    study.ensemble.instances = 1;
    study.ensemble.threshold_instances = 1;
    const auto few = find_numerical_error(Planner(study));
    REQUIRE(few);
    CHECK(few->pairs.changed.empty());
}

TEST_CASE("Mass scaling and its choice are refused where they cannot work") {
    const auto refusal = [](const std::vector<std::string>& more) {
        const StudyReading reading = read_study(test::study_path("fleet-alarms.toml"), more);
        if (!reading.study) {
            return format(reading.problems);
        }
        try {
            resolved_plan(*reading.study);
        } catch (const SceneError& error) {
            return error.key() + ": " + error.what();
        }
        return std::string("accepted");
    };
    CHECK_THAT(refusal({"numerics.integrator=rk4", "numerics.mass_scaling_Hz=3000",
                        "numerics.precision=double", "numerics.lanes=8"}),
               Catch::Contains("is for the integrator central-difference"));
    const std::string method = "numerics.integrator=central-difference";
    CHECK_THAT(
        refusal({method, "numerics.mass_scaling_Hz=3000",
                 "random.gearbox.planet.mass_kg={distribution=\"uniform\",low=0.6,high=0.8}"}),
        Catch::Contains("needs the same masses"));
    CHECK_THAT(refusal({method, "numerics.scatter_tolerance=0.2", "numerics.mass_scaling_Hz=3000"}),
               Catch::Contains("is chosen by numerics.scatter_tolerance"));
    CHECK_THAT(refusal({method, "numerics.scatter_tolerance=0.2", "numerics.steps_per_mesh=9000"}),
               Catch::Contains("is chosen by numerics.scatter_tolerance"));
    CHECK_THAT(refusal({method, "numerics.mass_scaling_Hz=500"}),
               Catch::Contains("lie in the sensor's band of 800 Hz"));
    CHECK_THAT(refusal({method, "numerics.mass_scaling_Hz=3000", "numerics.tolerance=0.01"}),
               Catch::Contains("does not see the error of numerics.mass_scaling_Hz"));
    CHECK_THAT(refusal({"numerics.paired_gearboxes=7"}), Catch::Contains("too few"));
    CHECK_THAT(
        refusal({"numerics.scatter_tolerance=0.2",
                 "random.gearbox.planet.mass_kg={distribution=\"uniform\",low=0.6,high=0.8}"}),
        Catch::Contains("numerics.scatter_tolerance: needs the same masses"));
    CHECK_THAT(refusal({"numerics.scatter_tolerance=0.2", "numerics.tolerance=0.01"}),
               Catch::Contains("chooses the steps, too"));
}

}  // namespace gearpod::mc::test_scatter_choice
