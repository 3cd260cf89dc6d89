// Results of `calibrate` as text, as JSON and as the first comment of the calibrated study.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mc/calibration/calibrate.hpp"
#include "mc/calibration/healthy_records.hpp"

namespace gearpod::mc {

// Table of the inputs and table of the compared features.
std::string calibration_text(const CalibrationResult& result);

nlohmann::ordered_json calibration_json(const HealthySet& set, const CalibrationTask& task,
                                        const CalibrationResult& result);

// Comment lines of calibrated_study().
std::vector<std::string> calibration_intro(const Study& study, const HealthySet& set,
                                           const CalibrationResult& result);

}  // namespace gearpod::mc
