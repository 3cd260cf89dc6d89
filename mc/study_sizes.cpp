#include "mc/study_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearpod::mc {
namespace {

void sort_distinct(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool continuous(const Study& study) {
    return !study.detection.size_edges_m.empty();
}

std::vector<double> single_depths_m(const Study& study) {
    if (study.fault.kind == FaultKind::none) {
        return {0.0};
    }
    const RandomInput* random = study.find_random("fault.depth_mm");
    if (random == nullptr) {
        return {study.fault.depth_m.value_or(0.0)};
    }
    std::vector<double> depths;
    for (const double level : random->distribution.levels()) {
        depths.push_back(level * random->to_si);
    }
    sort_distinct(depths);
    return depths;
}

}  // namespace

std::vector<analysis::SizeGroup> size_groups(const Study& study) {
    std::vector<analysis::SizeGroup> groups;
    if (continuous(study) && study.fault.kind == FaultKind::crack) {
        const std::vector<double>& edges = study.detection.size_edges_m;
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            groups.push_back({edges[i], edges[i + 1]});
        }
        return groups;
    }
    for (const double depth : single_depths_m(study)) {
        groups.push_back({depth, depth});
    }
    return groups;
}

double size_in_si(double in_file) {
    return in_file * 1e-3;
}

std::string size_text(const analysis::SizeGroup& group) {
    return group.low_m == group.high_m
               ? fmt::format("{:g} mm", group.low_m * 1e3)
               : fmt::format("{:g} to {:g} mm", group.low_m * 1e3, group.high_m * 1e3);
}

analysis::DetectionRequest detection_request(const Study& study) {
    return {study.detection.false_alarm_rate, study.detection.confidence, study.sensor.noise_levels,
            size_groups(study)};
}

std::vector<double> fault_depths_m(const Study& study) {
    std::vector<double> depths;
    for (const analysis::SizeGroup& group : size_groups(study)) {
        depths.push_back(group.low_m);
        depths.push_back(group.high_m);
    }
    sort_distinct(depths);
    std::erase(depths, 0.0);
    return depths;
}

}  // namespace gearpod::mc
