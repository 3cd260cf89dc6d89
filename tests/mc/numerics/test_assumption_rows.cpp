// Checks gearboxes computed with changed assumptions against runs of the changed studies, and the
// limit of the answer that follows from them.
#include "mc/ensemble/ensemble.hpp"
#include "mc/numerics/assumption_rows.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/layout.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_assumption_rows {

Study study_with(const std::vector<std::string>& more = {}) {
    std::vector<std::string> overrides{
        "features.use=['te_rms','own_te_rms']",
        "features.baseline_torque_scatter=0.02",
        "fault.kind=reduction",
        "fault.member=sun",
        "fault.reduction=0",
        "random.fault.reduction={distribution='levels',values=[0,0.2,0.4,0.6]}",
        "sensor.encoder_noise_arcsec=0.5",
        "sensor.noise_levels=[0.5]",
        "ensemble.threshold_instances=80",
        "ensemble.instances=240",
        "ensemble.seed=2",
        "detection.false_alarm_rate=0.1"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return test::shipped_study("published/park-fig-10.toml", overrides);
}

Results run(const Study& study) {
    const Scene scene(study);
    Progress silent(1, true);
    return run_ensemble(scene.tile(), scene.ensemble(), silent);
}

TEST_CASE("Rows with a changed assumption are those of a run of the changed study") {
    const AssumptionRows found = assumption_rows(Planner(study_with()));
    REQUIRE(found.changed.size() == 4);
    REQUIRE(found.rows.size() == 16);
    const std::vector<std::string> changes{
        "features.baseline_torque_scatter=0.01", "features.baseline_torque_scatter=0.04",
        "sensor.noise_levels=[0.25]", "sensor.noise_levels=[1.0]"};
    for (std::size_t c = 0; c < changes.size(); ++c) {
        CAPTURE(changes[c]);
        const Results changed = run(study_with({changes[c]}));
        CHECK(changes[c].starts_with(found.changed[c].key));
        CHECK(found.changed[c].factor == (c % 2 == 0 ? 0.5 : 2.0));
        for (std::size_t i = 0; i < found.rows.size(); ++i) {
            for (std::size_t f = 0; f < 2; ++f) {
                CHECK(found.changed[c].values[2 * i + f] ==
                      changed.features[f].values[static_cast<std::size_t>(found.rows[i])]);
            }
        }
    }
}

TEST_CASE("A run without enough gearboxes or with tilted noise changes no assumption") {
    CHECK(assumption_rows(Planner(study_with({"ensemble.instances=40"}))).changed.empty());
    CHECK(assumption_pairs(Planner(study_with({"ensemble.instances=150"}))).variants.size() == 2);
    CHECK(assumption_pairs(Planner(study_with({"ensemble.instances=4000"}))).pairs == 16);
    CHECK(assumption_pairs(Planner(test::shipped_study(
                               "planet-crack-ideal.toml",
                               {"features.use=['change_window_ratio']",
                                "features.baseline_torque_scatter=0.02", "ensemble.instances=4000",
                                "ensemble.threshold_records=8", "ensemble.threshold_tilt=true"})))
              .variants.empty());
    CHECK(assumption_pairs(Planner(study_with({"fault.kind=none", "ensemble.instances=4000"})))
              .variants.empty());
    // Several levels of noise show its effect themselves.
    CHECK(assumption_pairs(Planner(study_with({"sensor.noise_levels=[0.5,1]"}))).variants.size() ==
          2);
}

TEST_CASE("The report names the assumption that changes the answer most, also from a file") {
    Results results = run(study_with());
    results.assumptions = assumption_rows(Planner(study_with()));
    results.detection = detect_all(results, ColumnRows(results));
    const Hdf5Handle file = create_memory_file();
    write_numerical_groups(file.get(), results);
    Results back = results;
    back.assumptions = {};
    read_numerical_groups(file.get(), 1000, back);
    CHECK(back.assumptions.rows == results.assumptions.rows);
    for (const Results& frame : {results, back}) {
        const ColumnRows rows(frame);
        const analysis::Report report =
            findings_of_run(frame, rows, reliability_of(frame, rows, "", 1)).report;
        const std::string text =
            analysis::report_text(analysis::sections_of(report, {"limits"}), 200);
        CAPTURE(text);
        CHECK(test::contains(text, "Assumed "));
        CHECK(test::contains(text, "torque scatter of the baseline"));
        CHECK(test::contains(text, "predicted with its 95 % interval from 16 gearboxes"));
    }
}

}  // namespace gearpod::mc::test_assumption_rows
