// Converts JSON to text that any parser accepts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gearpod::mc {

// Text on one line (indent -1) or indented. Bytes that are not valid UTF-8, for example in file
// names, become U+FFFD. Numbers that are not finite become null.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace gearpod::mc
