// JSON as text that any reader takes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gearpod::mc {

// One line, or indented. Bytes that are no UTF-8, as file names and foreign attributes may hold,
// become U+FFFD; numbers that are not finite become null.
std::string json_text(const nlohmann::json& json, int indent = -1);
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace gearpod::mc
