#include "mc/ensemble.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>

#include "analysis/feature_alarm.hpp"
#include "mc/gearbox_tile.hpp"
#include "mc/instance_features.hpp"
#include "mc/study_sizes.hpp"

namespace gearpod::mc {
namespace {

struct Seconds {
    double sampling = 0.0, stiffness = 0.0, march = 0.0, signals = 0.0, features = 0.0;

    Seconds& operator+=(const Seconds& other) {
        sampling += other.sampling;
        stiffness += other.stiffness;
        march += other.march;
        signals += other.signals;
        features += other.features;
        return *this;
    }
};

int status_of(lockstep::LaneStatus status) {
    switch (status) {
        case lockstep::LaneStatus::diverged:
            return static_cast<int>(Status::diverged);
        case lockstep::LaneStatus::unsettled:
            return static_cast<int>(Status::not_settled);
        case lockstep::LaneStatus::ok:
            break;
    }
    return static_cast<int>(Status::ok);
}

class EnsembleRun {
  public:
    EnsembleRun(const Scene& scene, Progress& progress)
        : scene_(scene), progress_(progress), sampler_(scene.study()), path_(path_grid(scene)) {
        shape_results();
    }

    Results run() {
        const auto start = std::chrono::steady_clock::now();
        const int lanes = scene_.study().numerics.lanes;
        const auto tiles = static_cast<long>((rows() + static_cast<std::size_t>(lanes) - 1) /
                                             static_cast<std::size_t>(lanes));
        const int threads = static_cast<int>(std::min<long>(thread_count(scene_.study()), tiles));
        std::exception_ptr failure;
        std::atomic<bool> failed = false;
        // Nothing may leave the parallel region by an exception; the first one ends the others'
        // work.
        const auto guarded = [&](auto&& work) {
            if (failed) {
                return;
            }
            try {
                work();
            } catch (...) {
                if (!failed.exchange(true)) {
                    failure = std::current_exception();
                }
            }
        };
#pragma omp parallel num_threads(threads)
        {
            std::optional<InstanceFeatures> features;
            guarded([&] { features.emplace(scene_); });
            Seconds seconds;
#pragma omp for schedule(dynamic, 1)
            for (long t = 0; t < tiles; ++t) {
                guarded([&] { run_rows(static_cast<std::size_t>(t * lanes), *features, seconds); });
            }
#pragma omp critical(gearpod_seconds)
            total_ += seconds;
        }
        if (failure) {
            std::rethrow_exception(failure);
        }
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
        results_.timing = {
            {"sampling_thread_s", total_.sampling}, {"stiffness_thread_s", total_.stiffness},
            {"march_thread_s", total_.march},       {"signals_thread_s", total_.signals},
            {"features_thread_s", total_.features}, {"ensemble_s", wall.count()}};
        return std::move(results_);
    }

  private:
    std::size_t thresholds() const {
        return static_cast<std::size_t>(scene_.study().ensemble.threshold_instances);
    }
    std::size_t rows() const {
        return thresholds() + static_cast<std::size_t>(scene_.study().ensemble.instances);
    }
    GearboxId id_of(std::size_t row) const {
        return row < thresholds() ? GearboxId{Group::threshold, row}
                                  : GearboxId{Group::graded, row - thresholds()};
    }

    void shape_results() {
        const Study& study = scene_.study();
        for (const ParameterColumn& column : sampler_.columns()) {
            results_.parameters.push_back({column.name, column.unit, std::vector<double>(rows())});
        }
        results_.group.resize(rows());
        results_.status.resize(rows());
        results_.noise_levels = study.sensor.noise_levels;
        results_.request = detection_request(study);
        for (const features::Feature* feature : used_features(study)) {
            results_.features.push_back(
                {std::string(feature->name), std::string(feature->unit),
                 analysis::alarm_of(*feature),
                 std::vector<double>(rows() * results_.noise_levels.size())});
        }
    }

    // One tile: the gearboxes of consecutive rows. Every row is written by one thread only.
    void run_rows(std::size_t first, InstanceFeatures& features, Seconds& seconds) {
        const int lanes = scene_.study().numerics.lanes;
        const std::size_t count = std::min(static_cast<std::size_t>(lanes), rows() - first);
        std::vector<GearboxId> ids;
        for (std::size_t i = 0; i < count; ++i) {
            ids.push_back(id_of(first + i));
        }
        const GearboxTile tile = run_gearboxes(scene_, sampler_, path_, ids, lanes);
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t lane = 0; lane < count; ++lane) {
            write_row(first + lane, ids[lane], tile, static_cast<int>(lane), features);
        }
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        seconds += {tile.sampling_s, tile.stiffness_s, tile.march_s, tile.signals_s, spent.count()};
        progress_.advance(static_cast<long>(count));
    }

    void write_row(std::size_t row, const GearboxId& id, const GearboxTile& tile, int lane,
                   InstanceFeatures& features) {
        const std::vector<double> parameters = sampler_.row(id.group, id.index);
        for (std::size_t p = 0; p < parameters.size(); ++p) {
            results_.parameters[p].values[row] = parameters[p];
        }
        results_.group[row] = static_cast<int>(id.group);
        const auto status = tile.march.status[static_cast<std::size_t>(lane)];
        results_.status[row] = status_of(status);

        const std::size_t levels = results_.noise_levels.size();
        std::vector<double> values(results_.features.size() * levels,
                                   std::numeric_limits<double>::quiet_NaN());
        if (status == lockstep::LaneStatus::ok) {
            std::vector<double> folded(tile.folded.size() /
                                       static_cast<std::size_t>(tile.views.lanes));
            std::vector<double> te(tile.te_turn.size() /
                                   static_cast<std::size_t>(tile.views.lanes));
            signals::copy_lane(tile.folded, tile.views.lanes, lane, folded);
            signals::copy_lane(tile.te_turn, tile.views.lanes, lane, te);
            values = features.compute(folded, te, tile.inputs[static_cast<std::size_t>(lane)],
                                      id.group, id.index);
        }
        for (std::size_t f = 0; f < results_.features.size(); ++f) {
            std::copy_n(
                values.begin() + static_cast<std::ptrdiff_t>(f * levels), levels,
                results_.features[f].values.begin() + static_cast<std::ptrdiff_t>(row * levels));
        }
    }

    const Scene& scene_;
    Progress& progress_;
    const Sampler sampler_;
    const signals::PathGrid path_;
    Results results_;
    Seconds total_;
};

}  // namespace

Results run_ensemble(const Scene& scene, Progress& progress) {
    return EnsembleRun(scene, progress).run();
}

int thread_count(const Study& study) {
    return study.numerics.threads > 0 ? study.numerics.threads : omp_get_num_procs();
}

std::vector<analysis::FeatureDetection> detect_all(const Results& results) {
    const auto size =
        std::find_if(results.parameters.begin(), results.parameters.end(),
                     [&](const auto& p) { return p.name == results.request.size_name; });
    std::vector<double> healthy_size, graded_size;
    std::vector<std::size_t> healthy_rows, graded_rows;
    for (std::size_t row = 0; row < results.group.size(); ++row) {
        const bool threshold = results.group[row] == static_cast<int>(Group::threshold);
        (threshold ? healthy_rows : graded_rows).push_back(row);
        (threshold ? healthy_size : graded_size)
            .push_back(size == results.parameters.end() ? 0.0 : size->values[row]);
    }
    const std::size_t levels = results.noise_levels.size();
    const auto rows_of = [&](const FeatureResult& feature, const std::vector<std::size_t>& rows) {
        std::vector<double> values;
        for (const std::size_t row : rows) {
            const auto first = feature.values.begin() + static_cast<std::ptrdiff_t>(row * levels);
            values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(levels));
        }
        return values;
    };
    std::vector<analysis::FeatureDetection> all;
    for (const FeatureResult& feature : results.features) {
        const auto healthy = rows_of(feature, healthy_rows);
        const auto graded = rows_of(feature, graded_rows);
        all.push_back(analysis::detect(feature.name, feature.alarm, {healthy_size, healthy},
                                       {graded_size, graded}, results.request));
    }
    return all;
}

}  // namespace gearpod::mc
