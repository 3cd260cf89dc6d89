// What `lives` says: cracks found before the tooth goes, how deep, how long before, at which cost.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "mc/lives/campaign.hpp"

namespace gearpod::mc {

// Ends with a newline.
std::string lives_text(const Study& study, const Campaign& campaign,
                       const std::vector<MonitoredFeature>& monitored);

// The keys are in mc/README.md.
nlohmann::json lives_json(const Study& study, const Campaign& campaign,
                          const std::vector<MonitoredFeature>& monitored);

}  // namespace gearpod::mc
