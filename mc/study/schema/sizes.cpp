#include "mc/study/schema/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/study/faults/fault_kind.hpp"

namespace gearpod::mc {
namespace {

void sort_distinct(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<double> single_sizes(const Study& study) {
    if (study.fault.kind == nullptr) {
        return {0.0};
    }
    const RandomInput* random = study.find_random(fault_size_key(study).path());
    if (random == nullptr) {
        return {fault_size(study)};
    }
    std::vector<double> sizes = random->distribution.levels();
    sort_distinct(sizes);
    return sizes;
}

}  // namespace

const Key& fault_size_key(const Study& study) {
    return *find_key("fault", size_defining_kind(study).size().name);
}

double fault_size(const Study& study) {
    return study.fault.kind == nullptr ? 0.0
                                       : study.fault.kind->size().access.get(study).value_or(0.0);
}

void set_fault_size(Study& study, double size) {
    size_defining_kind(study).size().access.set(study, size);
}

std::string fault_size_column(const Study& study) {
    return "fault_" + fault_size_key(study).column();
}

const std::vector<double>& size_edges(const Study& study) {
    const bool length = !fault_size_key(study).unit.suffix.empty();
    return length ? study.detection.size_edges_m : study.detection.size_edges;
}

std::string size_edges_key(const Study& study) {
    const bool length = !fault_size_key(study).unit.suffix.empty();
    return length ? "detection.size_edges_mm" : "detection.size_edges";
}

std::vector<analysis::SizeGroup> size_groups(const Study& study) {
    std::vector<analysis::SizeGroup> groups;
    const std::vector<double>& edges = size_edges(study);
    if (!edges.empty() && study.fault.kind != nullptr) {
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            groups.push_back({edges[i], edges[i + 1]});
        }
        return groups;
    }
    for (const double size : single_sizes(study)) {
        groups.push_back({size, size});
    }
    return groups;
}

std::string size_text(const Study& study, const analysis::SizeGroup& group) {
    const Unit& unit = fault_size_key(study).unit;
    const std::string name = unit.suffix.empty() ? "" : " " + std::string(unit.name);
    return group.low == group.high ? fmt::format("{:g}{}", group.low / unit.to_si, name)
                                   : fmt::format("{:g} to {:g}{}", group.low / unit.to_si,
                                                 group.high / unit.to_si, name);
}

analysis::DetectionRequest detection_request(const Study& study) {
    analysis::DetectionRequest request{
        study.detection.false_alarm_rate,
        study.detection.confidence,
        study.sensor.noise_levels,
        size_groups(study),
        {fault_size_column(study), std::string(fault_size_key(study).unit.si_name)}};
    for (const std::string& path : study.detection.uncertain_inputs) {
        request.uncertain.push_back(find_key(path)->column());
    }
    request.threshold_records = static_cast<std::size_t>(study.ensemble.threshold_records);
    request.importance_sampling = study.ensemble.uses_importance_sampling();
    return request;
}

std::vector<double> fault_sizes(const Study& study) {
    std::vector<double> sizes;
    for (const analysis::SizeGroup& group : size_groups(study)) {
        sizes.push_back(group.low);
        sizes.push_back(group.high);
    }
    sort_distinct(sizes);
    std::erase(sizes, 0.0);
    return sizes;
}

}  // namespace gearpod::mc
