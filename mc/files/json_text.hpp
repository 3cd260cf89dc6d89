// Converts JSON to text that any parser accepts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gearpod::mc {

// Text on one line (indent -1) or indented. Bytes that are not valid UTF-8, for example in file
// names, become U+FFFD. Numbers that are not finite become null.
std::string json_text(const nlohmann::json& json, int indent = -1);
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace gearpod::mc
