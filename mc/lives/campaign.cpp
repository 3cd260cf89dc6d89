#include "mc/lives/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mc/lives/life_rows.hpp"

namespace gearpod::mc {
namespace {

// Names of entries in a lives file that describe the cost of its rows.
constexpr const char *kGearboxTime = "gearboxes_processor_s", *kRecordTime = "records_processor_s",
                     *kGearboxCount = "gearboxes_computed", *kRecordCount = "records_computed",
                     *kRecordText = "record", *kInterpolationError = "interpolation_error";

// NaN if the file does not contain it.
double error_in(const Results& frame) {
    const std::string text = frame.provenance_value(kInterpolationError);
    double error = std::numeric_limits<double>::quiet_NaN();
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
        const auto lives = tiles.run(part, batch.group == Group::graded, costs,
                                     std::span(errors).first(measured_count));
        for (std::size_t lane = 0; lane < part.size(); ++lane) {
            add_life(tiles.scene().study(), part[lane], lives[lane], errors[lane], rows);
        }
    }
    seconds.integration += costs.gearboxes;
    seconds.features += costs.records;
    seconds.gearboxes += costs.gearbox_count;
    seconds.records += costs.record_count;
    return rows;
}

}  // namespace

EnsembleOutcome run_lives(const LifeTiles& tiles, const BatchPlan& plan, const EnsembleRun& run) {
    const Study& study = tiles.scene().study();
    const BatchComputer compute = [&tiles](const Batch& batch, Seconds& seconds) {
        return life_rows(tiles, batch, seconds);
    };
    return run_batches(study, plan, run,
                       [&]() -> BatchComputers { return [compute] { return compute; }; });
}

void store_run_costs(const Scene& scene, double interpolation_error, const EnsembleOutcome& outcome,
                     Results& frame) {
    frame.provenance.emplace_back(kRecordText, record_text(scene));
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

Campaign campaign_of(const Study& study, const Results& frame, const RowSource& rows) {
    Campaign campaign;
    const auto threshold_lives = static_cast<std::size_t>(study.ensemble.threshold_instances);
    for_each_row(rows, [&](const ResultRow& row) {
        LifeRow read = life_of_row(study, frame, row);
        campaign.interpolation.take(read.interpolation);
        campaign.failed += read.life.status == Status::ok ? 0 : 1;
        auto& lives = row.group == static_cast<int>(Group::graded) ? campaign.cracked
                      : row.index < threshold_lives                ? campaign.threshold_lives
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

Campaign run_campaign(const Scene& scene) {
    const Study& study = scene.study();
    const LifeTiles tiles(scene);
    const BatchPlan plan = lives_plan(study);
    MemoryRows store(plan.batches());
    const Ranks alone;
    Progress silent(1, true);
    const EnsembleOutcome outcome =
        run_lives(tiles, plan, {.ranks = alone, .store = store, .progress = silent});
    if (!outcome.failure.empty()) {
        throw std::runtime_error(outcome.failure);
    }
    Results frame = lives_frame(study);
    store_run_costs(scene, std::numeric_limits<double>::quiet_NaN(), outcome, frame);
    return campaign_of(study, frame, StoredRows(store, plan, outcome.batches));
}

}  // namespace gearpod::mc
