#include "mc/lives/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "machine/no_value.hpp"

namespace gearpod::mc {
namespace {

// Columns that follow those of the random inputs.
struct LifeColumn {
    const char *name, *unit;
};
constexpr std::array<LifeColumn, 5> kLifeColumns{{{"end_h", "h"},
                                                  {"records", ""},
                                                  {"interpolation_first", ""},
                                                  {"interpolation_last", ""},
                                                  {"interpolation_load", ""}}};

// Columns after the features, one value per record.
struct RecordColumn {
    const char *name, *unit;
    double LifeRecord::*member;
};
constexpr std::array<RecordColumn, 5> kRecordColumns{{{"crack_depth", "m", &LifeRecord::depth_m},
                                                      {"record_torque", "", &LifeRecord::torque},
                                                      {"record_speed", "", &LifeRecord::speed},
                                                      {"record_gain", "", &LifeRecord::gain},
                                                      {"record_noise", "", &LifeRecord::noise}}};

// Names of entries in a lives file that describe the cost of its rows.
constexpr const char *kGearboxTime = "gearboxes_processor_s", *kRecordTime = "records_processor_s",
                     *kGearboxCount = "gearboxes_computed", *kRecordCount = "records_computed",
                     *kRecordText = "record", *kInterpolationError = "interpolation_error";

// NaN if the file does not contain it.
double error_in(const Results& frame) {
    const std::string text = frame.provenance_value(kInterpolationError);
    double error = kNan;
    std::from_chars(text.data(), text.data() + text.size(), error);
    return error;
}

long count_in(const Results& frame, const char* name) {
    const std::string text = frame.provenance_value(name);
    long count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    return count;
}

BatchRows life_rows(const LifeTiles& tiles, const Batch& batch, Seconds& seconds) {
    std::vector<Realization> gearboxes;
    for (std::size_t i = 0; i < batch.gearboxes; ++i) {
        gearboxes.push_back(tiles.draw({batch.group, batch.first_index + i}));
    }
    BatchRows rows;
    LifeCosts costs;
    for (std::size_t first = 0; first < gearboxes.size(); first += tiles.lanes()) {
        const auto part =
            std::span(gearboxes).subspan(first, std::min(tiles.lanes(), gearboxes.size() - first));
        std::vector<InterpolationErrors> errors(part.size());
        const auto measured_count = static_cast<std::size_t>(
            std::ranges::count_if(part, measures_interpolation, &Realization::id));
        const auto lives = tiles.run(part, batch.group == Group::test, costs,
                                     std::span(errors).first(measured_count));
        for (LaneId lane{0}; lane < part.size(); ++lane) {
            add_life(tiles.plan().campaign, part[lane], lives[lane], errors[lane], rows);
        }
    }
    seconds.integration += costs.gearboxes;
    seconds.features += costs.records;
    seconds.gearboxes += costs.gearbox_count;
    seconds.records += costs.record_count;
    return rows;
}

}  // namespace

BatchPlan lives_plan(const CampaignPlan& plan) {
    return {plan.ensemble.threshold_gearboxes + plan.counting_lives, plan.ensemble.test_gearboxes};
}

Results lives_frame(const CampaignPlan& plan) {
    Results frame = results_frame(plan.ensemble);
    frame.parameters.pop_back();  // the fault size, which is not constant
    frame.variants.clear();
    frame.contact_loss.clear();  // superposed records have no contact loss ratio
    frame.integration.clear();
    for (const LifeColumn& column : kLifeColumns) {
        frame.parameters.push_back({column.name, column.unit, {}});
    }
    for (const RecordColumn& column : kRecordColumns) {
        frame.features.push_back({column.name, column.unit, analysis::Alarm::high, {}});
    }
    frame.noise_levels.clear();
    for (int i = 0; i < plan.records; ++i) {
        frame.noise_levels.push_back(i * plan.interval_h);
    }
    frame.request.groups.clear();
    frame.provenance.emplace_back("kind", kLivesKind);
    return frame;
}

CampaignPlan check_lives(const std::string& path, const Results& frame, const RowSource& rows) {
    const auto plan = recorded_campaign_plan(frame.provenance_value("study"), path);
    if (!plan) {
        throw std::runtime_error(path + ": its study cannot be read, or has no [life]");
    }
    check_against(path, frame, rows,
                  ExpectedResults{lives_frame(*plan), lives_plan(*plan), "lives", true});
    return *plan;
}

bool measures_interpolation(const GearboxId& id) {
    constexpr std::uint64_t kMeasuredLives = 8;
    return id.group == Group::test && id.index < kMeasuredLives;
}

void add_life(const CampaignPlan& plan, const Realization& gearbox, const GearboxLife& life,
              const InterpolationErrors& errors, BatchRows& rows) {
    const auto& records = life.history.records;
    rows.status.push_back(static_cast<int>(life.status));
    plan.ensemble.append_inputs(gearbox.random_values, 1.0, rows.values);
    rows.values.insert(rows.values.end(),
                       {life.history.end_hours.value_or(kNan), static_cast<double>(records.size()),
                        errors.first, errors.last, errors.load});
    const std::size_t missing_records = static_cast<std::size_t>(plan.records) - records.size();
    for (std::size_t f = 0; f < plan.ensemble.features.size(); ++f) {
        if (life.status == Status::ok) {
            rows.values.insert(rows.values.end(), life.values[f].begin(), life.values[f].end());
        } else {
            rows.values.insert(rows.values.end(), records.size(), kNan);
        }
        rows.values.insert(rows.values.end(), missing_records, kNan);
    }
    for (const RecordColumn& column : kRecordColumns) {
        for (const LifeRecord& record : records) {
            rows.values.push_back(record.*column.member);
        }
        rows.values.insert(rows.values.end(), missing_records, kNan);
    }
}

LifeRow life_of_row(const CampaignPlan& plan, const Results& frame, const ResultRow& row) {
    const RowShape shape = row_shape(frame);
    const double* values = row.values;
    const double* columns = values + shape.parameters - kLifeColumns.size();
    if (!(columns[1] >= 0.0 && columns[1] <= static_cast<double>(shape.levels))) {
        throw std::runtime_error("/instances/records contains an invalid number");
    }
    LifeRow result;
    result.interpolation = {columns[2], columns[3], columns[4]};
    GearboxLife& life = result.life;
    life.status = static_cast<Status>(row.status);
    LifeHistory& history = life.history;
    if (!std::isnan(columns[0])) {
        history.end_hours = columns[0];
    }
    history.records.resize(static_cast<std::size_t>(columns[1]));
    const std::size_t features = plan.ensemble.features.size();
    for (std::size_t r = 0; r < history.records.size(); ++r) {
        history.records[r].hours = frame.noise_levels[r];
        for (std::size_t c = 0; c < kRecordColumns.size(); ++c) {
            history.records[r].*kRecordColumns[c].member = values[shape.value_of(features + c, r)];
        }
    }
    history.first_cracked = row.group == static_cast<int>(Group::test)
                                ? static_cast<std::size_t>(plan.baseline_records)
                                : history.records.size();
    for (std::size_t f = 0; life.status == Status::ok && f < features; ++f) {
        const double* first = values + shape.value_of(f, 0);
        life.values.emplace_back(first, first + history.records.size());
    }
    return result;
}

EnsembleOutcome run_lives(const LifeTiles& tiles, const BatchPlan& plan, const EnsembleRun& run) {
    const BatchComputer compute = [&tiles](const Batch& batch, Seconds& seconds) {
        return life_rows(tiles, batch, seconds);
    };
    return run_batches(tiles.plan().campaign.ensemble, plan, run,
                       [&]() -> BatchComputers { return [compute] { return compute; }; });
}

void store_run_costs(const LifePlan& plan, double interpolation_error,
                     const EnsembleOutcome& outcome, Results& frame) {
    frame.provenance.emplace_back(kRecordText, plan.record);
    if (!std::isnan(interpolation_error)) {
        frame.provenance.emplace_back(kInterpolationError, fmt::format("{}", interpolation_error));
    }
    const Seconds work = outcome.work();
    frame.timing.push_back({kGearboxTime, work.integration});
    frame.timing.push_back({kRecordTime, work.features});
    frame.timing.push_back({"lives_s", outcome.wall_s});
    frame.provenance.emplace_back(kGearboxCount, std::to_string(work.gearboxes));
    frame.provenance.emplace_back(kRecordCount, std::to_string(work.records));
}

Campaign campaign_of(const CampaignPlan& plan, const Results& frame, const RowSource& rows) {
    Campaign campaign;
    const auto threshold_lives = static_cast<std::size_t>(plan.ensemble.threshold_gearboxes);
    for_each_row(rows, [&](const ResultRow& row) {
        LifeRow read = life_of_row(plan, frame, row);
        campaign.interpolation.take(read.interpolation);
        campaign.failed += read.life.status == Status::ok ? 0 : 1;
        auto& lives = row.group == static_cast<int>(Group::test) ? campaign.cracked
                      : row.index < threshold_lives              ? campaign.threshold_lives
                                                                 : campaign.healthy;
        lives.push_back(std::move(read.life));
    });
    for (const Timing& timing : frame.timing) {
        campaign.costs.gearboxes += timing.name == kGearboxTime ? timing.seconds : 0.0;
        campaign.costs.records += timing.name == kRecordTime ? timing.seconds : 0.0;
    }
    campaign.record = frame.provenance_value(kRecordText);
    campaign.interpolation.change = error_in(frame);
    campaign.costs.gearbox_count = count_in(frame, kGearboxCount);
    campaign.costs.record_count = count_in(frame, kRecordCount);
    return campaign;
}

}  // namespace gearpod::mc
